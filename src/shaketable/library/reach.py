"""How far from the wall behind it a thing reaches once it stands again or lies."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.library.case import Case
from shaketable.solid import Solid

ROUND = 32  # corners that stand for a circle


def wall_behind(case: Case) -> float:
    """From the back of the base of a case's thing to the wall [m]; 0 where there is none.

    The gap is that of the nearest point: on a tilt toward the wall, the upper edge of the back.
    """
    if case.held.wall_gap is None:
        return 0.0
    return case.held.wall_gap + case.thing.height * math.sin(case.tilt)


def reach_from_wall(
    solid: Solid,
    orientation: float,
    gap: float,
    fell: NDArray[np.bool_],
    shift: NDArray[np.float64],
    yaw: NDArray[np.float64],
    toward: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The distance from the wall to the farthest point of what a thing covers [m], (run,).

    A thing that fell covers a rectangle as long as it is high and as wide as its base is across the
    fall, from its foot on: the same ground as that of `rooms`.

    Args:
        solid: its back is toward its own +x.
        orientation: by which it is turned at the start [rad]; the wall stands toward it.
        gap: from the back of its base to the wall [m].
        fell: whether it fell, (run,).
        shift: how far its foot came along x and y, (run, 2) [m].
        yaw: by which it turned [rad], (run,).
        toward: azimuth of the fall [rad], (run,); not used where it stands.
    """
    corners = _corners(solid)
    away = -np.array([math.cos(orientation), math.sin(orientation)])
    behind = float(corners[:, 0].max()) + gap
    moved = shift @ away
    standing = (_turned(corners, orientation + yaw) @ away).max(axis=1)
    # as it falls toward +x: how wide it is across
    across = _turned(corners, orientation + yaw - toward)[..., 1]
    height = solid.height or 2.0 * solid.cg_height
    length = np.cos(toward) * away[0] + np.sin(toward) * away[1]  # of the fall, away from the wall
    aside = -np.sin(toward) * away[0] + np.cos(toward) * away[1]
    ends = np.maximum(across.max(axis=1) * aside, across.min(axis=1) * aside)
    lying = np.maximum(height * length, 0.0) + ends
    return np.asarray(behind + moved + np.where(fell, lying, standing))


def _corners(solid: Solid) -> NDArray[np.float64]:
    """Corners of the base in its own frame, (corner, 2)."""
    if solid.points is not None:
        return solid.points
    angle = 2.0 * math.pi * np.arange(ROUND) / ROUND
    return np.asarray((solid.diameter or 0.0) / 2 * np.column_stack([np.cos(angle), np.sin(angle)]))


def _turned(corners: NDArray[np.float64], angle: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners turned from x toward y, (run, corner, 2)."""
    cosine, sine = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = corners.T
    return np.stack([x * cosine - y * sine, x * sine + y * cosine], axis=-1)
