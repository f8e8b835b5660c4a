"""Rims as they are: no rim is flat, and a cylinder stands on a few high points of its own."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.footprint import HIGH_POINTS
from shaketable.solid import Solid

#: Narrower gaps between high points are drawn anew [rad]: two that are so near are one.
APART = 0.1


def uneven_rims(
    solid: Solid,
    count: int,
    *,
    seed: int,
    rise: tuple[float, float] = (1e-4, 1e-3),
    points: tuple[int, int] = (3, 5),
) -> tuple[Solid, ...]:
    """Return copies of a cylinder that stand on high points of their rims, drawn at random.

    An ideal rim tips under the same acceleration in all directions, and loses nothing as it rolls.
    One on high points tips under less over the side between two of them, and strikes each of them
    as it rolls. Baranyai and Várkonyi (2017, Phys. Rev. E 96, 033005) take imperfect discs for
    polygons; these points stand on a rim that is round between them.

    Args:
        solid: on a circular base.
        count: how many copies.
        seed: of the draws.
        rise: least and largest height of the points over the rest of the rim [m]; its logarithm is
            drawn uniformly.
        points: the least and the largest number of points; the number is drawn uniformly, then
            their azimuths, anew until the foot of the centre of gravity lies between them.

    Raises:
        InputError: a solid that is not round; bounds that are not in order or not possible.
    """
    if not solid.round:
        raise InputError(f"uneven_rims needs a solid on a plain circular base, got {solid!r}")
    low, high = rise
    if not 0.0 < low <= high < math.inf:
        raise InputError(f"rise must be two heights [m] in order, above zero: got {rise!r}")
    fewest, most = points
    if not HIGH_POINTS[0] <= fewest <= most <= HIGH_POINTS[1]:
        raise InputError(
            f"points must be two numbers in order from {HIGH_POINTS[0]} to {HIGH_POINTS[1]}, got "
            f"{points!r}"
        )
    rng = np.random.default_rng(seed)
    return tuple(
        replace(
            solid,
            high_points=tuple(_azimuths(int(rng.integers(fewest, most + 1)), rng).tolist()),
            rise=float(np.exp(rng.uniform(math.log(low), math.log(high)))),
        )
        for _ in range(count)
    )


def _azimuths(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Of points on which a circle stands [rad]."""
    while True:
        drawn = np.sort(rng.uniform(0.0, 2 * math.pi, count))
        gaps = np.diff([*drawn, drawn[0] + 2 * math.pi])
        if gaps.max() < math.pi and gaps.min() > APART:
            return drawn
