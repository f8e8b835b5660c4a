"""How the closed points lie, and the change into a mode."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.solids.constraints import arrest
from shaketable.solids.contacts import (
    arm,
    axes_at,
    find_rim,
    lies_on_rim,
    on_rim,
    side_direction,
)
from shaketable.solids.room import (
    CLOSED,
    CORNER,
    EDGE,
    FIRST,
    FLAT,
    FLIGHT,
    HOLD,
    LAST,
    PIVOT,
    PIVOTS,
    RANK,
    SLIPS,
    P,
    Room,
    Shape,
    W,
    X,
    Y,
    vec,
)
from shaketable.solids.step import put_back
from shaketable.solids.vectors import Vec, on_support

IN_LINE = 1e-9  # of the farthest point's distance: points this near to a line are on it
HARDLY = 1e-6  # of the radius: points whose middle is nearer to the centre are opposite


@kernel
def distance2(room: Room, a: int, b: int) -> float:
    x, y = room.points[a, X] - room.points[b, X], room.points[a, Y] - room.points[b, Y]
    return float(x * x + y * y)


@routine
def farthest(room: Room, origin: int) -> int:
    """The place of the closed point that is farthest from a point."""
    best, most = 0, -1.0
    for place in range(room.mode[CLOSED]):
        d = distance2(room, origin, room.closed[place])
        if d > most:
            best, most = place, d
    return best


@routine
def arrange(shape: Shape, room: Room, hold: int, pivot: int) -> None:
    """Write the mode of the closed points: how they lie, and how they may share the pressure."""
    mode, n = room.mode, room.mode[CLOSED]
    mode[HOLD], mode[PIVOT] = hold, pivot
    mode[FIRST], mode[LAST] = 0, 0
    mode[RANK] = min(n, CORNER) if n > 0 else FLIGHT
    if n == 0:
        mode[HOLD] = SLIPS
    if n >= 2:
        mode[LAST] = farthest(room, room.closed[0])
        mode[FIRST] = farthest(room, room.closed[mode[LAST]])
        e = side_direction(shape, room)
        origin = room.closed[mode[FIRST]]
        off = 0.0
        for place in range(n):
            point = room.closed[place]
            across = e.x * (room.points[point, Y] - room.points[origin, Y])
            across -= e.y * (room.points[point, X] - room.points[origin, X])
            off = max(off, abs(across))
        mode[RANK] = EDGE if off <= IN_LINE * shape.reach else FLAT
    e = side_direction(shape, room) if mode[RANK] == EDGE else Vec(1.0, 0.0, 0.0)
    for place in range(n):
        point = room.closed[place]
        room.carries[place] = 1
        room.basis[place, 0] = 1.0
        # in parts of the reach: in metres those of a small body in a line would look singular
        along, across = room.points[point, X] / shape.reach, room.points[point, Y] / shape.reach
        room.basis[place, 1] = e.x * along + e.y * across if mode[RANK] == EDGE else along
        room.basis[place, 2] = across


@routine
def take_rim(shape: Shape, room: Room) -> None:
    """Let a circle that stands on one or two points of its ring stand on its rim there."""
    n = room.mode[CLOSED]
    if not lies_on_rim(shape) or n == 0 or room.mode[RANK] == FLAT:
        return
    x, y = 0.0, 0.0
    for place in range(n):
        x += room.points[room.closed[place], X]
        y += room.points[room.closed[place], Y]
    size = math.sqrt(x * x + y * y)
    if size < HARDLY * shape.radius:  # two points across from each other: either will do
        x, y = room.points[room.closed[0], X], room.points[room.closed[0], Y]
        size = math.sqrt(x * x + y * y)
    stand_on_rim(shape, room, x / size, y / size)


@routine
def stand_on_rim(shape: Shape, room: Room, x: float, y: float) -> None:
    """Close the rim at an azimuth (unit vector) alone."""
    last = shape.contacts
    room.rim[0] = room.rim[4] = x
    room.rim[1] = room.rim[5] = y
    room.rim[2] = room.rim[3] = 0.0
    room.points[last, X] = shape.radius * x
    room.points[last, Y] = shape.radius * y
    room.closed[0] = last
    room.mode[CLOSED] = 1


@routine
def keep_anchor(shape: Shape, room: Room) -> None:
    """Remember where a contact that sticks is."""
    if room.mode[HOLD] == SLIPS or room.mode[CLOSED] == 0:
        return
    point = room.mode[PIVOT] if room.mode[HOLD] == PIVOTS else room.closed[0]
    q = axes_at(room.state)
    place = on_support(q, arm(shape, room, point))
    room.anchor[0] = room.state[P] + place.x
    room.anchor[1] = room.state[P + 1] + place.y
    if room.mode[RANK] == EDGE:
        d = on_support(q, side_direction(shape, room))
        size = math.sqrt(d.x * d.x + d.y * d.y)
        room.anchor[2] = d.x / size
        room.anchor[3] = d.y / size


@routine
def enter(shape: Shape, room: Room) -> None:
    """Begin the mode that is written: end the velocities that it does not allow."""
    if room.mode[CLOSED] == 0:
        return
    y = room.state
    arrest(shape, room, axes_at(y), y, 0.0)
    if on_rim(shape, room):
        find_rim(shape, room, axes_at(y), vec(y, W))
    keep_anchor(shape, room)
    put_back(shape, room, y)
