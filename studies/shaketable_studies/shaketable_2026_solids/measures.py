"""Which measure of a pair of components tells best what falls in three dimensions.

Peaks of acceleration and velocity, each of the stronger component, as the geometric mean of both,
and over all directions of the ground: the median one (RotD50) and the largest (RotD100).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.motion import Motion
from shaketable.resampling import interval
from shaketable.signal.integrate import velocity
from shaketable.signal.rotated import ANGLES
from shaketable_studies.shaketable_2026_solids.setting import SIZES, Pairs
from shaketable_studies.shaketable_2026_solids.shares import SCALES, FallsByCase, motion_of_each

OF_PAIR: dict[str, Callable[[NDArray[np.float64]], float]] = {
    "stronger component": lambda peaks: float(max(peaks[0], peaks[ANGLES.size // 2])),
    "geometric mean": lambda peaks: math.sqrt(peaks[0] * peaks[ANGLES.size // 2]),
    "RotD50": lambda peaks: float(np.median(peaks)),
    "RotD100": lambda peaks: float(peaks.max()),
}
OF_GROUND = ("PGA", "PGV")


def peaks_by_angle(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """The largest value in each direction of two series, (angle,)."""
    return np.array([np.abs(math.cos(a) * x - math.sin(a) * y).max() for a in ANGLES])


def measures_of(motion: Motion) -> dict[tuple[str, str], float]:
    """Every measure of a pair: (of the ground, of the pair)."""
    assert motion.transverse is not None
    series = {
        "PGA": (motion.horizontal, motion.transverse),
        "PGV": tuple(
            velocity(each, motion.time_step) for each in (motion.horizontal, motion.transverse)
        ),
    }
    found = {}
    for ground, (x, y) in series.items():
        peaks = peaks_by_angle(x, y)
        for name, reduce in OF_PAIR.items():
            found[ground, name] = reduce(peaks)
    return found


def areas(case: FallsByCase, pairs: Pairs) -> pd.DataFrame:
    """Area under the ROC curve of each measure, the mean over sizes, with its interval.

    1 is a measure that puts every shaking that overturns above every one that does not, 0.5 one
    that knows nothing. Shakings of which some directions and orientations overturn count in part.
    """
    of_each = [measures_of(pairs.motions[k]) for k in motion_of_each(pairs)]
    share = case.falls / case.simulations
    rows = []
    drawn: dict[tuple[str, str], NDArray[np.float64]] = {}
    for key in of_each[0]:
        values = np.array([each[key] for each in of_each])
        scaled = values[:, None] * np.array(SCALES)
        found = [_area(scaled, share[k], pairs.weights) for k in range(len(SIZES))]
        drawn[key] = np.nanmean(found, axis=0)
    for (ground, name), area in drawn.items():
        low, high = interval(area[1:])
        behind = area - drawn[ground, "RotD100"]
        less, more = interval(behind[1:])
        rows.append(
            {
                "of_the_ground": ground,
                "of_the_pair": name,
                "area": area[0],
                "low": float(low),
                "high": float(high),
                "more_than_rotd100": behind[0],
                "more_low": float(less),
                "more_high": float(more),
            }
        )
    return pd.DataFrame(rows)


def _area(
    values: NDArray[np.float64], share: NDArray[np.float64], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The area of every draw, (k,).

    Args:
        values: of each recording and scale, (recording, scale).
        share: that overturns, (recording, scale).
        weights: of the draws, (k, recording).
    """
    flat = values.ravel()
    fallen = share.ravel()
    above = (flat[:, None] > flat) + 0.5 * (flat[:, None] == flat)
    each = np.repeat(weights, values.shape[1], axis=1)
    positive, negative = each * fallen, each * (1.0 - fallen)
    ordered = ((positive @ above) * negative).sum(axis=1)
    # a shaking is not held against itself
    own = 0.5 * (positive * negative).sum(axis=1)
    pairs = positive.sum(axis=1) * negative.sum(axis=1) - (positive * negative).sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray((ordered - own) / pairs)
