"""Plane polygons and points of a rim: what a solid stands on."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError

HIGH_POINTS = (3, 8)  # of a rim
LEAST_GAP = 0.01  # rad, between two of them: nearer ones are one
IN_LINE = 1e-9  # of the size: a corner this near to the line of its neighbours is on it


def convex_hull(points: NDArray[np.float64]) -> list[int]:
    """Rows of the corners of the convex hull, counterclockwise (Andrew's monotone chain).

    Points on a side of the hull are left out.
    """
    order = np.lexsort((points[:, 1], points[:, 0])).tolist()
    size = float(np.ptp(points, axis=0).max())

    def chain(rows: list[int]) -> list[int]:
        kept: list[int] = []
        for row in rows:
            while len(kept) > 1 and _turn(points, kept[-2], kept[-1], row) <= IN_LINE * size**2:
                kept.pop()
            kept.append(row)
        return kept[:-1]

    return chain(order) + chain(order[::-1])


def _turn(points: NDArray[np.float64], a: int, b: int, c: int) -> float:
    """Twice the area of a triangle, positive if it is counterclockwise."""
    first, second = points[b] - points[a], points[c] - points[a]
    return float(first[0] * second[1] - first[1] * second[0])


def require_convex(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The corners of a convex polygon, counterclockwise, without those that lie on a side.

    Args:
        points: corners in order, in either sense, shape (m, 2).

    Raises:
        InputError: repeated corners, or a polygon that is not convex; it names the corner.
    """
    size = float(np.ptp(points, axis=0).max())
    for k, point in enumerate(points):
        near = np.flatnonzero(np.hypot(*(points[:k] - point).T) <= IN_LINE * size)
        if near.size:
            raise InputError(
                f"corner {k + 1}, {point.tolist()}, repeats corner {int(near[0]) + 1}: give each "
                "once, and do not close the polygon"
            )
    n = len(points)
    double = float(np.sum(points[:, 0] * np.roll(points[:, 1], -1)
                          - points[:, 1] * np.roll(points[:, 0], -1)))  # fmt: skip
    sense = 1.0 if double > 0.0 else -1.0
    turns = [sense * _turn(points, k - 1, k, (k + 1) % n) for k in range(n)]
    for k, turn in enumerate(turns):
        if turn < -IN_LINE * size**2:
            raise InputError(
                f"the base must be convex: at corner {k + 1}, {points[k].tolist()}, it turns inward"
            )
    kept = points[[k for k, turn in enumerate(turns) if turn > IN_LINE * size**2]]
    kept = kept if sense > 0.0 else kept[::-1]
    if len(kept) < 3 or len(convex_hull(kept)) != len(kept):
        raise InputError(
            "the base must be convex and its corners in order around it; they are not: "
            f"{points.round(6).tolist()}"
        )
    return kept


def nearest_side(corners: NDArray[np.float64]) -> float:
    """Distance of the origin from the nearest side of a polygon around it [m]."""
    sides = np.roll(corners, -1, axis=0) - corners
    inward = sides[:, 1] * corners[:, 0] - sides[:, 0] * corners[:, 1]
    return float((inward / np.hypot(*sides.T)).min())


def require_rim(azimuths: Sequence[float]) -> None:
    """InputError if a circle cannot stand on points of its rim at these azimuths [rad], sorted."""
    low, high = HIGH_POINTS
    if not low <= len(azimuths) <= high:
        raise InputError(f"a rim has {low} to {high} high points, got {len(azimuths)}")
    gaps = np.diff([*azimuths, azimuths[0] + 2 * math.pi])
    if gaps.max() >= math.pi or gaps.min() < LEAST_GAP:
        raise InputError(
            f"the high points of a rim must be {LEAST_GAP} rad apart or more, and less than half "
            "the rim from one to the next, for the body to stand on them; got "
            f"{np.degrees(azimuths).round(3).tolist()}°"
        )
