"""What ends a mode: quantities that fall through zero.

A mode ends where a point of the base lands, a contact no longer presses or sticks, a slip ends, or
the body has fallen. Their least value is one continuous function of time, whose first zero is the
event; which of them it was is seen from the state there.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.hermite import top_of
from shaketable.physics.space.closing import is_closed
from shaketable.physics.space.contacts import (
    acceleration,
    axes_at,
    find_rim,
    height,
    lies_on_rim,
    on_rim,
    rim_height,
    velocity,
)
from shaketable.physics.space.straps import (
    BROKEN,
    LOOSE,
    RELAXED,
    force_rate,
    stretch_of,
)
from shaketable.physics.space.touches import is_carrying, touch_acceleration, touch_velocity
from shaketable.physics.space.vectors import Axes, cross
from shaketable.physics.space.walls import wall_gap, wall_speed
from shaketable.physics.space.workspace import (
    CARRIES,
    CLOSED,
    CONE,
    CONE_BEFORE,
    CONTACT_KIND,
    FLAT,
    FLIGHT,
    FRICTION_STATE,
    MOVES,
    PAST,
    PIVOT,
    PIVOTS,
    PRESS,
    PRESS_BEFORE,
    SLIP_DIRECTION,
    STICKS,
    STRENGTH,
    TOUCHES,
    WALLED,
    Floats,
    SolidParameters,
    V,
    W,
    Workspace,
    vec,
)

NOTHING, GAP, FORCE, SLIP, FALL, HELD, WALL = range(7)
# How far past its zero a guard acts, so that what has ended is seen to have ended [m/s², m/s].
FORCE_PAST, SLIP_PAST = 1e-9, 1e-9
# A gap that is below zero by the first is an event, which is then found where it is below zero by
# the second: what has just landed is no event again [m].
GAP_SEEN, GAP_FOUND = 1e-11, 1e-12
# m; m/s² or m/s: an event is found where its guard is below zero by less
GAP_WINDOW, OTHER_WINDOW = 1e-12, 1e-9


@kernel
def window(kind: int) -> float:
    """How far below zero a guard may be where its event is found."""
    return GAP_WINDOW if kind in (GAP, WALL) else OTHER_WINDOW


@kernel
def slips_at(work: Workspace, point: int) -> bool:
    hold = work.mode[FRICTION_STATE]
    return hold != STICKS and not (hold == PIVOTS and point == work.mode[PIVOT])


class EventGuard(NamedTuple):
    """The least guard of a state, and when the first one falls through zero."""

    least: float  # m/s², m/s, m or 1: below zero the mode has ended
    kind: int
    root: float  # s from the state to the first zero, by the guards' values and slopes


@kernel
def nearer(found: EventGuard, kind: int, value: float, slope: float) -> EventGuard:
    """What is found after one more guard was looked at."""
    root = found.root
    over = value + 0.5 * window(kind)
    if slope < 0.0:
        root = min(root, -over / slope)
    elif over < 0.0:
        root = -math.inf
    return (
        EventGuard(value, kind, root)
        if value < found.least
        else EventGuard(found.least, found.kind, root)
    )


@kernel
def force_guard(work: Workspace) -> float:
    return float(min(work.judged[PRESS], work.judged[CONE]) + work.judged[PAST])


@kernel
def force_guard_before(work: Workspace) -> float:
    """The same where it was judged before."""
    before = min(work.judged[PRESS_BEFORE], work.judged[CONE_BEFORE])
    return float(before + work.judged[PAST])


@routine
def least_guard(
    shape: SolidParameters, work: Workspace, y: Floats, dy: Floats, gap_past: float, h: float
) -> EventGuard:
    """The guards of a state; its rates, dy, have just been judged, and before that those h ago."""
    q = axes_at(y)
    spin = vec(y, W)
    rank = work.mode[CONTACT_KIND]
    found = nearer(EventGuard(math.inf, NOTHING, math.inf), FALL, q.z.z, cross(q.z, spin).z)
    if rank != FLIGHT:
        force, before = force_guard(work), force_guard_before(work)
        found = nearer(found, FORCE, force, min((force - before) / h, 0.0))
        for place in range(work.mode[CLOSED] if rank != WALLED else 0):
            point = work.closed[place]
            if slips_at(work, point):
                x, along = work.slip[point, 0], work.slip[point, 1]
                u = velocity(shape, work, q, y, point)
                change = acceleration(shape, work, q, y, dy, point)
                ahead = u.x * x + u.y * along + SLIP_PAST
                found = nearer(found, SLIP, ahead, change.x * x + change.y * along)
    for k in range(shape.straps):
        found = strap_guard(work, q, y, dy, k, found)
    if shape.walls > 0:
        found = wall_guards(shape, work, q, y, dy, gap_past, found)
    if rank == FLAT or (rank == WALLED and lies_on_rim(shape) and work.mode[CLOSED] > 1):
        return found
    if lies_on_rim(shape) or (shape.radius > 0.0 and not on_rim(shape, work)):
        found = nearer(found, GAP, *rim_gap(shape, work, y, gap_past))
    if not lies_on_rim(shape):
        for point in range(shape.contacts):
            if not (is_carrying(work, 0, point) if rank == WALLED else is_closed(work, point)):
                gap = height(shape, work, q, y, point) + gap_past
                found = nearer(found, GAP, gap, velocity(shape, work, q, y, point).z)
    return found


@routine
def strap_guard(
    work: Workspace, q: Axes, y: Floats, dy: Floats, k: int, found: EventGuard
) -> EventGuard:
    """What is found after a strap was looked at: when it does something else."""
    does = work.held[k]
    if does == BROKEN:
        return found
    s = stretch_of(work, q, y, k)
    if does == LOOSE:
        return nearer(found, HELD, -s.delta, -s.rate)
    rate = force_rate(work, q, y, dy, k, s)
    if does == RELAXED:
        return nearer(nearer(found, HELD, s.delta, s.rate), HELD, -s.force, -rate)
    found = nearer(found, HELD, s.force, rate)
    return nearer(found, HELD, work.straps[k, STRENGTH] - s.force, -rate)


@routine
def wall_guards(
    shape: SolidParameters,
    work: Workspace,
    q: Axes,
    y: Floats,
    dy: Floats,
    gap_past: float,
    found: EventGuard,
) -> EventGuard:
    """What is found after the walls were looked at: what meets one, and which touch ends its slip.

    Of a mode beside a wall the touches on the support are looked at, too.
    """
    pressed = work.mode[CONTACT_KIND] == WALLED
    for wall in range(1, shape.walls + 1):
        for point in range(shape.outline):
            if not (pressed and is_carrying(work, wall, point)):
                gap = wall_gap(shape, work, q, y, wall, point) + gap_past
                found = nearer(found, WALL, gap, wall_speed(shape, work, q, y, wall, point))
    if pressed:
        for place in range(work.mode[TOUCHES]):
            touch = work.touches[place]
            if touch[MOVES] > 0.0 and touch[CARRIES] > 0.0:
                x, z = touch[SLIP_DIRECTION], touch[SLIP_DIRECTION + 1]
                u = touch_velocity(work, q, y, place)
                change = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
                ahead = u.x * x + u.y * z + SLIP_PAST
                found = nearer(found, SLIP, ahead, change.x * x + change.y * z)
    return found


@routine
def rim_gap(
    shape: SolidParameters, work: Workspace, y: Floats, gap_past: float
) -> tuple[float, float]:
    """How far a rim can still come down, at its lowest point or opposite, and at what rate."""
    q = axes_at(y)
    sine = find_rim(shape, work, q, vec(y, W))
    rate = 0.5 * lean_rate(y) / sine if sine != 0.0 else 0.0
    if on_rim(shape, work):
        return 2.0 * shape.radius * sine + gap_past, 2.0 * shape.radius * rate
    falls = y[V + 2] + (shape.rise - shape.h) * cross(q.z, vec(y, W)).z
    return rim_height(shape, q, y, sine) + gap_past, falls - shape.radius * rate


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
    """The largest square of the sine of the nutation in a step of duration h.

    From its ends, cubic in between.
    """
    return top_of(lean(before), lean(after), h * lean_rate(before), h * lean_rate(after))
