"""Which of the points on the support (`near`) are closed: all, a side, or one beside a rim."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.solids.room import CLOSED, NEAR, Room, Shape, X, Y

BESIDE = 3e-9  # of the reach: points this near to a side's line belong to it


@routine
def is_closed(room: Room, point: int) -> bool:
    found = False
    for place in range(room.mode[CLOSED]):
        found = found or room.closed[place] == point
    return found


@routine
def close_all(room: Room) -> None:
    n = room.mode[NEAR]
    for k in range(n):
        room.closed[k] = room.near[k]
    room.mode[CLOSED] = n


@routine
def close_side(shape: Shape, room: Room, k: int) -> bool:
    """Close the points on the support that lie along side k of the hull; False if not both ends."""
    j = k + 1 if k + 1 < shape.hull else 0
    x, y = room.points[k, X], room.points[k, Y]
    dx, dy = room.points[j, X] - x, room.points[j, Y] - y
    length = math.sqrt(dx * dx + dy * dy)
    n, ends = 0, 0
    for i in range(room.mode[NEAR]):
        point = room.near[i]
        off = (dx * (room.points[point, Y] - y) - dy * (room.points[point, X] - x)) / length
        if abs(off) <= BESIDE * shape.reach:
            room.closed[n] = point
            n += 1
            if point in (k, j):
                ends += 1
    room.mode[CLOSED] = n
    return ends == 2


@kernel
def rim_is_near(shape: Shape, room: Room) -> bool:
    """Whether a rim's lowest point, which comes last, is among the points on the support."""
    n = room.mode[NEAR]
    return shape.radius > 0.0 and n > 0 and room.near[n - 1] == shape.contacts


@kernel
def close_with_rim(shape: Shape, room: Room, k: int) -> None:
    """Close one of the points on the support, and the rim."""
    room.closed[0], room.closed[1] = room.near[k], shape.contacts
    room.mode[CLOSED] = 2
