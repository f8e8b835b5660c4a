"""What ends a mode: quantities that fall through zero.

A mode ends where a point of the base lands, a contact no longer presses or sticks, a slip ends, or
the body has fallen. Their least value is one continuous function of time, whose first zero is the
event; which of them it was is seen from the state there.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.solids.choice import is_closed
from shaketable.solids.contacts import axes_at, find_rim, height, velocity
from shaketable.solids.room import (
    CLOSED,
    CONE,
    CORNER,
    FLIGHT,
    HOLD,
    PAST,
    PIVOT,
    PIVOTS,
    PRESS,
    RANK,
    STICKS,
    Floats,
    Room,
    Shape,
    W,
    vec,
)
from shaketable.solids.vectors import cross

NOTHING, GAP, FORCE, SLIP, FALL = range(5)
# How far past its zero a guard acts, so that what has ended is seen to have ended [m/s², m/s].
FORCE_PAST, SLIP_PAST = 1e-9, 1e-9
# A gap that is below zero by the first is an event, which is then found where it is below zero by
# the second: what has just landed is no event again [m].
GAP_SEEN, GAP_FOUND = 1e-11, 1e-12


@kernel
def slips_at(room: Room, point: int) -> bool:
    hold = room.mode[HOLD]
    return hold != STICKS and not (hold == PIVOTS and point == room.mode[PIVOT])


@routine
def least_guard(shape: Shape, room: Room, y: Floats, gap_past: float) -> tuple[float, int]:
    """The least guard of a state and its kind; its rates must just have been judged."""
    q = axes_at(y)
    least, kind = q.z.z, FALL
    rank = room.mode[RANK]
    if rank != FLIGHT:
        force = min(room.judged[PRESS], room.judged[CONE]) + room.judged[PAST]
        if force < least:
            least, kind = force, FORCE
        for place in range(room.mode[CLOSED]):
            point = room.closed[place]
            if slips_at(room, point):
                u = velocity(shape, room, q, y, point)
                ahead = u.x * room.slip[point, 0] + u.y * room.slip[point, 1] + SLIP_PAST
                if ahead < least:
                    least, kind = ahead, SLIP
    if shape.radius > 0.0:
        if rank < 3:
            gap = rim_gap(shape, room, y) + gap_past
            if gap < least:
                least, kind = gap, GAP
        return least, kind
    if rank < 3:
        for point in range(shape.size):
            if not is_closed(room, point):
                gap = height(shape, room, q, y, point) + gap_past
                if gap < least:
                    least, kind = gap, GAP
    return least, kind


@routine
def rim_gap(shape: Shape, room: Room, y: Floats) -> float:
    """Height that a circle can still come down: of its lowest point, or of the one opposite."""
    q = axes_at(y)
    sine = find_rim(shape, room, q, vec(y, W))
    if room.mode[RANK] == CORNER:
        return 2.0 * shape.radius * sine
    return float(y[2] - shape.h * q.z.z - shape.radius * abs(sine))


@kernel
def lean_rate(y: Floats) -> float:
    """Rate of the square of the sine of the nutation [1/s]."""
    n = axes_at(y).z
    turn = cross(n, vec(y, W))
    return 2.0 * (n.x * turn.x + n.y * turn.y)


@kernel
def lean(y: Floats) -> float:
    """Square of the sine of the nutation."""
    n = axes_at(y).z
    return n.x * n.x + n.y * n.y


@routine
def peak_between(before: Floats, after: Floats, h: float) -> float:
    """The largest nutation [rad] in a step of duration h, from its ends (cubic in between)."""
    a, b = lean(before), lean(after)
    top = max(a, b)
    da, db = h * lean_rate(before), h * lean_rate(after)
    if da > 0.0 > db:  # Hermite's cubic, its stationary points
        c3, c2 = 2.0 * (a - b) + da + db, 3.0 * (b - a) - 2.0 * da - db
        inside = c2 * c2 - 3.0 * c3 * da
        if inside >= 0.0:
            root = math.sqrt(inside)
            u = da / (root - c2) if root - c2 != 0.0 else 0.0
            if 0.0 < u < 1.0:
                top = max(top, a + u * (da + u * (c2 + u * c3)))
    return math.asin(min(1.0, math.sqrt(max(top, 0.0))))
