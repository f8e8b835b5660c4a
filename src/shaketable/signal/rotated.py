"""Response spectra of a horizontal pair in all directions: RotD50 and RotD100.

At each angle the pair is one motion, whose oscillators' peaks are found as exactly as those of any
other. RotDnn is the percentile nn of the peaks over the angles.

Boore D.M. (2010) Orientation-independent, nongeometric-mean measures of seismic intensity from two
horizontal components of motion, Bull. Seismol. Soc. Am. 100(4):1830-1835.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError, require_damping
from shaketable.motion import Motion
from shaketable.signal.spectra import peak_responses

ANGLES = np.radians(np.arange(0.0, 180.0, 1.0))  # beyond them the same motions come reversed


def rotated_spectra(
    motion: Motion, periods: ArrayLike, *, damping: float = 0.05
) -> NDArray[np.float64]:
    """Pseudo-accelerations in every direction [m/s²], (angle, period); angles are ANGLES.

    Args:
        motion: with a transverse component.
        periods: [s], above zero.
        damping: ratio of critical damping.

    Raises:
        InputError: no transverse component, or values out of range.
    """
    if motion.transverse is None:
        raise InputError(f"the motion {motion.name!r} has no transverse component")
    require_damping(damping)
    wanted = np.atleast_1d(np.asarray(periods, np.float64))
    if wanted.ndim != 1 or not ((wanted > 0.0) & np.isfinite(wanted)).all():
        raise InputError(f"periods [s] must be above 0, got {periods!r:.100}")
    found = np.empty((ANGLES.size, wanted.size))
    for k, angle in enumerate(ANGLES):
        turned = math.cos(angle) * motion.horizontal - math.sin(angle) * motion.transverse
        peaks, _ = peak_responses(turned, motion.time_step, wanted, damping=damping)
        found[k] = np.abs(peaks)
    return found


def rotd(
    motion: Motion, periods: ArrayLike, percentile: float = 50.0, *, damping: float = 0.05
) -> NDArray[np.float64]:
    """RotD50, RotD100 or another percentile over all directions [m/s²], (period,).

    Args:
        motion, periods, damping: as for `rotated_spectra`.
        percentile: 50 for the median direction, 100 for the largest one.

    Raises:
        InputError: as for `rotated_spectra`, or a percentile that is not from 0 to 100.
    """
    if not 0.0 <= percentile <= 100.0:
        raise InputError(f"a percentile must lie between 0 and 100, got {percentile!r}")
    spectra = rotated_spectra(motion, periods, damping=damping)
    return np.asarray(np.percentile(spectra, percentile, axis=0))
