"""Peak ground acceleration, and the peak of a ground velocity that comes to rest."""

from __future__ import annotations

import logging
from typing import NamedTuple

import numpy as np

from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.signal.baseline import baseline_corrected
from shaketable.signal.integrate import velocity

log = logging.getLogger(__name__)

DRIFT = 0.05  # of the peak: a final velocity beyond it is the instrument's, not the ground's


class Peaks(NamedTuple):
    """Peaks of a motion.

    Attributes:
        acceleration: PGA [m/s²].
        velocity: PGV [m/s].
        corrected: whether the velocity is that of the motion with its baseline corrected.
    """

    acceleration: float
    velocity: float
    corrected: bool


def peaks(motion: Motion) -> Peaks:
    """PGA and PGV of the horizontal component.

    Where the integrated velocity does not come back to rest, as in records of a permanent
    displacement by an instrument whose zero shifts, the baseline is corrected in a way that keeps
    the permanent displacement. Processed records are integrated as they are.
    """
    v = velocity(motion.horizontal, motion.time_step)
    largest = float(np.abs(v).max())
    corrected = abs(float(v[-1])) > DRIFT * largest
    if corrected:
        try:
            fixed = baseline_corrected(motion)
            largest = float(np.abs(velocity(fixed.horizontal, fixed.time_step)).max())
        except InputError as error:
            corrected = False
            log.warning("%s: its velocity does not come to rest: %s", motion.name, error)
    return Peaks(motion.peak_ground_acceleration, largest, corrected)
