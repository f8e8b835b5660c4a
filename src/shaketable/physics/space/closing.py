"""Which of the touches are closed: all on the support, a side, one beside a rim, what carries."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.workspace import SolidParameters, Workspace

BESIDE = 3e-9  # of the reach: points this near to a side's line belong to it


@routine
def end_closed(shape: SolidParameters, work: Workspace, n: int) -> None:
    """Let the places that are written end after n, and note whether a rim's lowest is closed."""
    work.mode.closed = n
    rolls = 0
    for k in range(n if shape.radius > 0.0 else 0):
        touch = work.touches[work.closed[k]]
        if touch.plane == 0 and touch.point == shape.contacts:
            rolls = 1
    work.mode.rolls = rolls


@routine
def is_place_closed(work: Workspace, place: int) -> bool:
    """Whether a touch of the list is closed."""
    found = False
    for k in range(work.mode.closed):
        found = found or work.closed[k] == place
    return found


@routine
def close_all(shape: SolidParameters, work: Workspace) -> None:
    """Close all points on the support."""
    for place in range(work.mode.near):
        work.closed[place] = place
    end_closed(shape, work, work.mode.near)


@kernel
def close_one(shape: SolidParameters, work: Workspace, place: int) -> None:
    """Close one touch."""
    work.closed[0] = place
    end_closed(shape, work, 1)


@routine
def close_carrying(shape: SolidParameters, work: Workspace) -> None:
    """Close what carries, on any plane."""
    n = 0
    for place in range(work.mode.touches):
        if work.touches[place].carries > 0:
            work.closed[n] = place
            n += 1
    end_closed(shape, work, n)


@routine
def close_side(shape: SolidParameters, work: Workspace, k: int) -> bool:
    """Close the points on the support that lie along side k of the hull; False if not both ends."""
    j = k + 1 if k + 1 < shape.hull else 0
    x, y = work.points[k].x, work.points[k].y
    dx, dy = work.points[j].x - x, work.points[j].y - y
    length = math.sqrt(dx * dx + dy * dy)
    n, ends = 0, 0
    for place in range(work.mode.near):
        point = work.touches[place].point
        off = (dx * (work.points[point].y - y) - dy * (work.points[point].x - x)) / length
        if abs(off) <= BESIDE * shape.reach:
            work.closed[n] = place
            n += 1
            if point in (k, j):
                ends += 1
    end_closed(shape, work, n)
    return ends == 2


@kernel
def rim_is_near(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a rim's lowest point, which comes last, is among the points on the support."""
    n = work.mode.near
    return shape.radius > 0.0 and n > 0 and work.touches[n - 1].point == shape.contacts


@kernel
def close_with_rim(shape: SolidParameters, work: Workspace, place: int) -> None:
    """Close one of the points on the support, and the rim."""
    work.closed[0], work.closed[1] = place, work.mode.near - 1
    end_closed(shape, work, 2)
