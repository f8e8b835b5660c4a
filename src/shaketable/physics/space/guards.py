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
from shaketable.physics.space.contacts import (
    axes_at,
    find_rim,
    lies_on_rim,
    on_rim,
    rim_height,
    velocity,
)
from shaketable.physics.space.edge import (
    BACK,
    PAST,
    TIE,
    beyond,
    clearance,
    crossing,
    crossing_speed,
    has_edge,
    is_off,
    line_plane,
    lip_gap,
    lip_left,
    lip_plane,
    lowest_of_body,
    near_line,
    past_line,
    side_count,
    support_gap,
)
from shaketable.physics.space.straps import (
    BROKEN,
    LOOSE,
    RELAXED,
    force_rate,
    stretch_of,
)
from shaketable.physics.space.touches import (
    closed_on_support,
    is_closed,
    slip_acceleration,
    slip_velocity,
    slips_at,
    touches_more,
)
from shaketable.physics.space.vectors import Axes, cross
from shaketable.physics.space.walls import wall_gap, wall_speed
from shaketable.physics.space.workspace import (
    BEHIND_LIP,
    BEHIND_SIDES,
    FLAT,
    FLIGHT,
    WALLED,
    Floats,
    P,
    SolidParameters,
    V,
    W,
    Workspace,
    vec,
)

# What its surface or side ends under is a PASS; what has left its support ends with a LANDING.
NOTHING, GAP, FORCE, SLIP, FALL, HELD, WALL, PASS, LANDING = range(9)
# How far past its zero a guard acts, so that what has ended is seen to have ended [m/s², m/s].
FORCE_PAST, SLIP_PAST = 1e-9, 1e-9
# A gap that is below zero by the first is an event, which is then found where it is below zero by
# the second: what has just landed is no event again [m].
GAP_SEEN, GAP_FOUND = 1e-11, 1e-12
SHALLOW = 0.2  # of the landing threshold: so deep may be in a wall what is as good as at rest there
# m; m/s² or m/s: an event is found where its guard is below zero by less
GAP_WINDOW, OTHER_WINDOW = 1e-12, 1e-9


@kernel
def window(kind: int) -> float:
    """How far below zero a guard may be where its event is found."""
    return GAP_WINDOW if kind in (GAP, WALL, PASS, LANDING) else OTHER_WINDOW


@kernel
def sets_off_backward(shape: SolidParameters, ahead: float, rate: float) -> bool:
    """Whether a slip that begins still has a speed against its direction that is as good as none.

    Args:
        ahead: its speed along its direction [m/s].
        rate: how fast that grows [m/s²].
    """
    return -shape.limits.slipping < ahead < 0.0 < rate


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
    return float(min(work.judged.press, work.judged.cone) + work.judged.past)


@kernel
def force_guard_before(work: Workspace) -> float:
    """The same where it was judged before."""
    before = min(work.judged.press_before, work.judged.cone_before)
    return float(before + work.judged.past)


@routine
def least_guard(
    shape: SolidParameters, work: Workspace, y: Floats, dy: Floats, gap_past: float, h: float
) -> EventGuard:
    """The guards of a state; its rates, dy, have just been judged, and before that those h ago."""
    q = axes_at(y)
    spin = vec(y, W)
    rank = work.mode.kind
    found = EventGuard(math.inf, NOTHING, math.inf)
    if is_off(shape, y):
        least, rate = lowest_of_body(shape, work, y)
        found = nearer(found, LANDING, least + shape.drop, rate)
    else:
        found = nearer(found, FALL, q.z.z, cross(q.z, spin).z)
    if rank != FLIGHT:
        force, before = force_guard(work), force_guard_before(work)
        found = nearer(found, FORCE, force, min((force - before) / h, 0.0))
        found = slip_guards(shape, work, q, y, dy, found)
    for k in range(shape.straps):
        found = strap_guard(work, q, y, dy, k, found)
    if has_edge(shape):
        found = passing_guards(shape, work, q, y, found)
    if touches_more(shape):
        found = touch_guards(shape, work, q, y, gap_past, found)
    lies = rank == WALLED and lies_on_rim(shape) and closed_on_support(work) > 1
    if rank == FLAT or lies:
        return found
    rim = lies_on_rim(shape) or (shape.radius > 0.0 and not on_rim(work))
    if rim and clearance(shape, work, q, y) < math.inf:
        found = nearer(found, GAP, *rim_gap(shape, work, y, gap_past))
    if not lies_on_rim(shape):
        for point in range(shape.contacts):
            if not is_closed(work, 0, point):
                gap = support_gap(shape, work, q, y, point) + gap_past
                speed = velocity(shape, work, q, y, point).z
                hair = -shape.limits.landing < gap < 0.0 < speed
                if not (hair and rises_from_support(shape, work, point)):
                    found = nearer(found, GAP, gap, speed)
    return found


@routine
def rises_from_support(shape: SolidParameters, work: Workspace, point: int) -> bool:
    """Whether a point that has left the support was a hair below it as the step began.

    What was left there by rounding, and goes away, does not land.
    """
    q, y = axes_at(work.state), work.state
    below = support_gap(shape, work, q, y, point) < 0.0
    return below and velocity(shape, work, q, y, point).z > 0.0


@routine
def rests_on_wall(shape: SolidParameters, work: Workspace, wall: int, point: int) -> bool:
    """Whether a point of the outline that a wall does not hold was there as the step began.

    Its speed is as good as none: feet that stick as it turns may leave it one that an impact would
    take in vain. It may go a hair deeper.
    """
    q, y = axes_at(work.state), work.state
    gap = wall_gap(shape, work, q, y, wall, point)
    near = -SHALLOW * shape.limits.landing < gap < GAP_SEEN
    return near and wall_speed(shape, work, q, y, wall, point) > -shape.limits.slipping


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
    return nearer(found, HELD, work.straps[k].strength - s.force, -rate)


@kernel
def slip_guards(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, dy: Floats, found: EventGuard
) -> EventGuard:
    """What is found after it was looked which closed touch ends its slip."""
    for k in range(work.mode.closed):
        place = work.closed[k]
        if slips_at(work, place):
            x, z = work.touches[place].slip_x, work.touches[place].slip_y
            u = slip_velocity(shape, work, q, y, place)
            change = slip_acceleration(shape, work, q, y, dy, place)
            ahead = u.x * x + u.y * z + SLIP_PAST
            rate = change.x * x + change.y * z
            if not sets_off_backward(shape, ahead, rate):
                found = nearer(found, SLIP, ahead, rate)
    return found


@routine
def touch_guards(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, gap_past: float, found: EventGuard
) -> EventGuard:
    """What is found after walls and edge were looked at."""
    for wall in range(1, shape.walls + 1):
        for point in range(shape.outline):
            if not is_closed(work, wall, point):
                gap = wall_gap(shape, work, q, y, wall, point) + gap_past
                speed = wall_speed(shape, work, q, y, wall, point)
                shallow = -SHALLOW * shape.limits.landing < gap < 0.0
                slow = shallow and speed > -shape.limits.slipping
                if not (slow and rests_on_wall(shape, work, wall, point)):
                    found = nearer(found, WALL, gap, speed)
    if has_edge(shape):
        found = edge_guards(shape, work, q, y, gap_past, found)
    return found


@routine
def passing_guards(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, found: EventGuard
) -> EventGuard:
    """What is found after it was looked which points of the base pass the edge.

    Those of a circle are looked at where they are touched alone: they roll on.
    """
    if beyond(shape, vec(y, P)) + shape.size < 0.0:
        return found
    for point in range(shape.contacts + 1):
        rolls = shape.radius > 0.0 or point == shape.contacts
        if rolls and not is_closed(work, 0, point):
            continue
        u = velocity(shape, work, q, y, point)
        off, rate = past_line(shape, work, q, y, point), shape.edge_x * u.x + shape.edge_y * u.y
        if work.past[point] == 0:
            found = nearer(found, PASS, PAST - off, -rate)
        else:
            found = nearer(found, PASS, off - BACK, rate)
    return found


@routine
def edge_guards(
    shape: SolidParameters,
    work: Workspace,
    q: Axes,
    y: Floats,
    gap_past: float,
    found: EventGuard,
) -> EventGuard:
    """What is found after the edge of the support was looked at."""
    for point in range(shape.outline if shape.lip > 0.0 else 0):
        if is_closed(work, lip_plane(shape), point):
            found = nearer(found, PASS, lip_left(shape, work, q, y, point), 0.0)
        elif work.behind[BEHIND_LIP + point] == 0:
            gap = lip_gap(shape, work, q, y, point) + gap_past
            speed = wall_speed(shape, work, q, y, lip_plane(shape), point)
            found = nearer(found, WALL, gap, speed)
    for side in range(side_count(shape) if near_line(shape, y) else 0):
        at = crossing(shape, work, q, y, side)
        if is_closed(work, line_plane(shape), side):
            found = nearer(found, PASS, at.left, at.rate)
        elif work.behind[BEHIND_SIDES + side] == 0 and at.left > TIE:
            found = nearer(found, WALL, at.gap + gap_past, crossing_speed(q, y, at))
    return found


@routine
def rim_gap(
    shape: SolidParameters, work: Workspace, y: Floats, gap_past: float
) -> tuple[float, float]:
    """How far a rim can still come down, at its lowest point or opposite, and at what rate."""
    q = axes_at(y)
    sine = find_rim(shape, work, q.z, vec(y, W))
    rate = 0.5 * lean_rate(y) / sine if sine != 0.0 else 0.0
    if on_rim(work):
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
