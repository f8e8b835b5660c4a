"""Which of the points on the support (`near`) are closed: all, a side, or one beside a rim."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.workspace import SolidParameters, Workspace

BESIDE = 3e-9  # of the reach: points this near to a side's line belong to it


@routine
def is_closed(work: Workspace, point: int) -> bool:
    found = False
    for place in range(work.mode.closed):
        found = found or work.closed[place] == point
    return found


@routine
def close_all(work: Workspace) -> None:
    n = work.mode.near
    for k in range(n):
        work.closed[k] = work.near[k]
    work.mode.closed = n


@routine
def close_side(shape: SolidParameters, work: Workspace, k: int) -> bool:
    """Close the points on the support that lie along side k of the hull; False if not both ends."""
    j = k + 1 if k + 1 < shape.hull else 0
    x, y = work.points[k].x, work.points[k].y
    dx, dy = work.points[j].x - x, work.points[j].y - y
    length = math.sqrt(dx * dx + dy * dy)
    n, ends = 0, 0
    for i in range(work.mode.near):
        point = work.near[i]
        off = (dx * (work.points[point].y - y) - dy * (work.points[point].x - x)) / length
        if abs(off) <= BESIDE * shape.reach:
            work.closed[n] = point
            n += 1
            if point in (k, j):
                ends += 1
    work.mode.closed = n
    return ends == 2


@kernel
def rim_is_near(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a rim's lowest point, which comes last, is among the points on the support."""
    n = work.mode.near
    return shape.radius > 0.0 and n > 0 and work.near[n - 1] == shape.contacts


@kernel
def close_with_rim(shape: SolidParameters, work: Workspace, k: int) -> None:
    """Close one of the points on the support, and the rim."""
    work.closed[0], work.closed[1] = work.near[k], shape.contacts
    work.mode.closed = 2
