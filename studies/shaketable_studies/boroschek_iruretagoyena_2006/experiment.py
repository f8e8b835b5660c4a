"""The paper's test of seven bodies on a shaking table (tables V and VI, figure 13), simulated.

Records of table VI that are among the motions are used, scaled as printed. Up to as many as the
paper used, those that overturn the most bodies are then added, scaled down to what the table could
do, as the paper did.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.signal import displacement, velocity
from shaketable.simulate import ShakingSet, fell, simulate_many
from shaketable.tilting import TiltCounts, count_outcomes
from shaketable.units import STANDARD_GRAVITY
from shaketable_studies.boroschek_iruretagoyena_2006.printed import (
    SHAKER_ACCELERATION_G,
    SHAKER_VELOCITY,
    TABLE_5,
    TABLE_6,
    TEST_TILTS,
    ScaledRecord,
)

NEAR = 5.0  # degrees: azimuths so close are of one component, as networks round them


class Chosen(NamedTuple):
    """A motion of the test, what table VI calls it ("" if it is not there), and its scale."""

    motion: Motion
    printed: str
    scale: float

    @property
    def peak_displacement(self) -> float:
        """Of the scaled motion as it is integrated, without correction [m]."""
        path = displacement(self.motion.horizontal, self.motion.time_step)
        return self.scale * float(np.abs(path).max())


class Experiment(NamedTuple):
    """The records chosen, and the outcomes of the seven bodies at TEST_TILTS.

    In `mirrored` the centres of gravity are measured from the other edge.
    """

    chosen: list[Chosen]
    counts: TiltCounts
    mirrored: TiltCounts


def simulate_tests(motions: Sequence[Motion], done: Callable[[int], None]) -> Experiment:
    """The tests with the motions at hand, by the rocking model."""
    chosen = choose(motions, done)
    trial = ShakingSet([one.motion.scaled(one.scale) for one in chosen])
    counts, mirrored = (
        count_outcomes(
            [specimen.body(from_left) for specimen in TABLE_5], trial, TEST_TILTS, progress=done
        )
        for from_left in (True, False)
    )
    return Experiment(chosen, counts, mirrored)


def choose(motions: Sequence[Motion], done: Callable[[int], None]) -> list[Chosen]:
    """The records of the test; fewer than table VI has if there are fewer motions."""
    # where two rows mean the same motion, the first of them counts
    found = {
        index: row for row in reversed(TABLE_6) if (index := _index_of(row, motions)) is not None
    }
    bodies = [specimen.body() for specimen in TABLE_5]
    runs = simulate_many(bodies, motions, progress=done)
    falls = fell(runs).sum(["body", "polarity", "tilt", "scale"]).values
    moving = [k for k, motion in enumerate(motions) if motion.peak_ground_acceleration > 0.0]
    if not moving:
        raise InputError("none of the motions moves: their accelerations are all zero")
    strongest = sorted((k for k in moving if k not in found), key=lambda k: -falls[k])
    matched = [Chosen(motions[k], found[k].name, found[k].scale) for k in sorted(found)]
    others = strongest[: max(0, len(TABLE_6) - len(matched))]
    return matched + [Chosen(motions[k], "", shaker_scale(motions[k])) for k in others]


def _index_of(row: ScaledRecord, motions: Sequence[Motion]) -> int | None:
    """The motion that a row of table VI means, in either direction, if it is there."""
    for index, motion in enumerate(motions):
        origin = motion.origin
        if origin is None or origin.azimuth is None:
            continue
        apart = (origin.azimuth - row.azimuth + 90.0) % 180.0 - 90.0
        told, place = (
            f"{words} {Path(origin.file).name}".upper() for words in (origin.event, origin.station)
        )
        if abs(apart) <= NEAR and re.search(row.event, told) and re.search(row.station, place):
            return index
    return None


def shaker_scale(motion: Motion) -> float:
    """The largest factor, at most 1, that the shaker's acceleration and velocity allow."""
    peak: NDArray[np.float64] = np.abs(velocity(motion.horizontal, motion.time_step))
    limits = (
        SHAKER_ACCELERATION_G * STANDARD_GRAVITY / motion.peak_ground_acceleration,
        SHAKER_VELOCITY / float(peak.max()),
    )
    return min(1.0, *limits)
