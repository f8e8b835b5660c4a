"""Which mode follows: forces decide which of the points on the support stay, stick or slip.

Simple modes are tried first, those that stick before those that slip and large contacts before
small ones: the whole base, a side, a point. One is admissible where it presses, keeps to its
friction cone and lets no other point sink. Where none is, all points are solved together
(`complementarity`).
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.solids.closing import (
    close_all,
    close_side,
    close_with_rim,
    is_closed,
    rim_is_near,
)
from shaketable.solids.complementarity import balance, summed
from shaketable.solids.contacts import (
    acceleration,
    arm,
    axes_at,
    drift,
    lies_on_rim,
    side_direction,
    velocity,
)
from shaketable.solids.grip import TURNS, flat_grip, slip_with_grip
from shaketable.solids.losses import resistance
from shaketable.solids.modes import arrange, enter, stand_on_rim, take_rim
from shaketable.solids.rates import limit, rates
from shaketable.solids.room import (
    CLOSED,
    CONE,
    CORNER,
    FALLBACKS,
    FLAT,
    FLIGHT,
    HOLD,
    KINETIC,
    NEAR,
    PIVOTS,
    PRESS,
    RANK,
    SLIPS,
    STATIC,
    STICKS,
    Room,
    Shape,
    V,
    W,
    vec,
)
from shaketable.solids.vectors import Axes, Vec, add, applied, cross, on_support, times

SLACK = 1e-10  # m/s²: a reaction or an acceleration may miss its sign by this much
HARDLY = 1e-6  # m/s²: a point that begins to slip may be accelerated back by this much


@routine
def note_slip(shape: Shape, room: Room, q: Axes, least: float) -> int:
    """Write which of the points on the support slip faster, and along what; return how many."""
    moving = 0
    for k in range(room.mode[NEAR]):
        point = room.near[k]
        u = velocity(shape, room, q, room.state, point)
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        room.moving[point] = speed > least and room.points[point, STATIC] < math.inf
        if room.moving[point]:
            moving += 1
            room.slip[point, 0] = u.x / speed
            room.slip[point, 1] = u.y / speed
    return moving


@routine
def admissible(shape: Shape, room: Room, q: Axes, f: Vec) -> bool:
    """Whether the mode that is written presses, holds, and lets no other point sink."""
    dy = room.stages[0]
    rates(shape, room, room.state, f, True, dy)
    if not (room.judged[PRESS] >= -SLACK and room.judged[CONE] >= -SLACK):
        return False
    for k in range(room.mode[NEAR]):
        point = room.near[k]
        if is_closed(room, point):
            continue
        if acceleration(shape, room, q, room.state, dy, point).z < -SLACK:
            return False
    return True


@routine
def hold_of(room: Room) -> int:
    """What the closed points do: all slip, one sticks, or all stick; the first one that sticks."""
    stuck, first = 0, -1
    for place in range(room.mode[CLOSED]):
        if not room.moving[room.closed[place]]:
            stuck += 1
            if first < 0:
                first = room.closed[place]
    if stuck == 0:
        return -1
    return first if stuck == 1 and room.mode[CLOSED] > 1 else -2


@routine
def arrange_moving(shape: Shape, room: Room) -> None:
    """Write the mode of the closed points as they move."""
    pivot = hold_of(room)
    if pivot >= 0:
        arrange(shape, room, PIVOTS, pivot)
    else:
        arrange(shape, room, SLIPS if pivot == -1 else STICKS, 0)


@routine
def try_simple(shape: Shape, room: Room, q: Axes, f: Vec) -> bool:
    """Look for an admissible mode of points that move as they do."""
    close_all(room)
    arrange_moving(shape, room)
    if admissible(shape, room, q, f):
        return True
    if lies_on_rim(shape) and room.mode[RANK] == FLAT:
        return try_rim(shape, room, q, f)
    if room.mode[NEAR] > 2:
        for k in range(shape.hull):
            if close_side(shape, room, k):
                arrange_moving(shape, room)
                if admissible(shape, room, q, f):
                    return True
    if room.mode[NEAR] > 2 and rim_is_near(shape, room):
        for k in range(room.mode[NEAR] - 1):
            close_with_rim(shape, room, k)
            arrange_moving(shape, room)
            if admissible(shape, room, q, f):
                return True
    if room.mode[NEAR] > 1:
        for k in range(room.mode[NEAR]):
            room.closed[0] = room.near[k]
            room.mode[CLOSED] = 1
            arrange_moving(shape, room)
            if admissible(shape, room, q, f):
                return True
    return False


@routine
def try_rim(shape: Shape, room: Room, q: Axes, f: Vec) -> bool:
    """Whether a circle tips over its rim, where the resultant of the forces leaves the base."""
    if room.mode[HOLD] == STICKS:
        back = Vec(f.x, f.y, 0.0)
    else:
        mu = room.points[shape.contacts, KINETIC]
        first = room.near[0]
        back = Vec(mu * room.slip[first, 0], mu * room.slip[first, 1], 0.0)
    along = q.x.x * back.x + q.y.x * back.y
    across = q.x.y * back.x + q.y.y * back.y
    size = math.sqrt(along * along + across * across)
    if size == 0.0:
        return False
    last, first = shape.contacts, room.near[0]
    room.moving[last] = room.moving[first]
    room.slip[last, 0], room.slip[last, 1] = room.slip[first, 0], room.slip[first, 1]
    stand_on_rim(shape, room, along / size, across / size)
    arrange_moving(shape, room)
    return admissible(shape, room, q, f)


@routine
def try_slide(shape: Shape, room: Room, q: Axes, f: Vec) -> bool:
    """Whether a body at rest begins to slide with its whole base, without turning."""
    size = math.sqrt(f.x * f.x + f.y * f.y)
    close_all(room)
    if size == 0.0 or not shape.uniform:
        return False
    for k in range(room.mode[NEAR]):
        point = room.near[k]
        room.moving[point] = 1
        room.slip[point, 0] = f.x / size
        room.slip[point, 1] = f.y / size
    arrange(shape, room, SLIPS, 0)
    found = (
        room.mode[RANK] == FLAT
        and admissible(shape, room, q, f)
        and room.stages[0, V] * f.x + room.stages[0, V + 1] * f.y >= 0.0
    )
    if not found:
        for k in range(room.mode[NEAR]):
            room.moving[room.near[k]] = 0
    return found


@routine
def try_side_slip(shape: Shape, room: Room, q: Axes, f: Vec, moving: int) -> bool:
    """Whether a side on which a body rocks begins to slip: at both corners, or at one of them."""
    close_all(room)
    first, second = room.closed[0], room.closed[1]
    if moving == 1:  # one slips already
        begins = second if room.moving[first] else first
        arrange_moving(shape, room)
        rates(shape, room, room.state, f, True, room.stages[0])
        opposes_share(room, 0 if begins == first else 1)
        return begin_slip(shape, room, q, f, begins, -1)
    arrange(shape, room, STICKS, 0)
    rates(shape, room, room.state, f, True, room.stages[0])
    slipping = split_along(shape, room, q)
    opposes_share(room, 0)
    opposes_share(room, 1)
    if begin_slip(shape, room, q, f, first, second):
        return True
    begins = room.closed[slipping]  # the one that has less friction left, or the other
    stays = room.closed[1 - slipping]
    return begin_slip(shape, room, q, f, begins, -1) or begin_slip(shape, room, q, f, stays, -1)


@kernel
def opposes_share(room: Room, place: int) -> None:
    """Aim the slip of a closed place against the friction that it would need to stick."""
    point, x, y = room.closed[place], room.shares[place, 0], room.shares[place, 1]
    size = math.sqrt(x * x + y * y)
    if size > 0.0:
        room.slip[point, 0], room.slip[point, 1] = -x / size, -y / size
    else:
        room.slip[point, 0], room.slip[point, 1] = 1.0, 0.0


@routine
def begin_slip(shape: Shape, room: Room, q: Axes, f: Vec, first: int, second: int) -> bool:
    """Whether one point, or two, may begin to slip; nothing moves that did not if they may not."""
    room.moving[first] = 1
    if second >= 0:
        room.moving[second] = 1
    arrange_moving(shape, room)
    if admissible(shape, room, q, f) and sets_off(shape, room, q, first, second):
        return True
    room.moving[first] = 0
    if second >= 0:
        room.moving[second] = 0
    return False


@routine
def split_along(shape: Shape, room: Room, q: Axes) -> int:
    """Add to the shares of a side's corners their parts of the force along it.

    The parts are as the friction that each corner has left; returns the place of the one with less.
    """
    e = on_support(q, side_direction(shape, room))
    first, last = spare_along(room, 0), spare_along(room, 1)
    part = first / (first + last) if first + last > 0.0 else 0.5
    for place in range(2):
        own = room.shares[2, 0] * (part if place == 0 else 1.0 - part)
        room.shares[place, 0] += own * e.x
        room.shares[place, 1] += own * e.y
    return 1 if last < first else 0


@kernel
def spare_along(room: Room, place: int) -> float:
    """Friction that a side's corner has left for a force along the side."""
    share = room.shares[place]
    most = limit(room.points[room.closed[place], STATIC], max(share[2], 0.0))
    return math.sqrt(max(most * most - share[0] * share[0] - share[1] * share[1], 0.0))


@routine
def sets_off(shape: Shape, room: Room, q: Axes, first: int, second: int) -> bool:
    """Whether points that begin to slip are accelerated in the direction of their slip.

    As they begin their friction is all that they need to stick, and they are hardly accelerated.
    """
    for point in (first, second):
        if point >= 0:
            a = acceleration(shape, room, q, room.state, room.stages[0], point)
            if a.x * room.slip[point, 0] + a.y * room.slip[point, 1] < -HARDLY:
                return False
    return True


@routine
def try_grip(shape: Shape, room: Room, q: Axes, f: Vec) -> bool:
    """Whether a flat base on points of different friction stays flat; some of them may slip."""
    left = flat_grip(shape, room, q, f, TURNS)
    if left < 0.0:
        return False
    if left > shape.limits.starting:
        slip_with_grip(shape, room, left)
    arrange_moving(shape, room)
    return True


@routine
def solve_together(shape: Shape, room: Room, q: Axes, f: Vec) -> bool:
    """Let all points decide together; False if no reactions could be found."""
    close_all(room)
    spin = vec(room.state, W)
    free_turn = applied(shape.mobility, times(-1.0, cross(spin, applied(shape.inertia, spin))))
    n = room.mode[CLOSED]
    for place in range(n):
        r = arm(shape, room, room.closed[place])
        own = add(cross(spin, r), drift(shape, room, room.closed[place]))
        a = add(f, on_support(q, add(cross(free_turn, r), cross(spin, own))))
        room.free[place, 0], room.free[place, 1], room.free[place, 2] = a.x, a.y, a.z
        room.goal[place] = 0.0
    resists = resistance(shape, q, spin)
    found = balance(shape, room, q, True, resists)
    linear, turn = summed(shape, room, q, resists)
    kept = 0
    for place in range(n):
        point = room.near[place]
        r = arm(shape, room, point)
        a = add(vec(room.free[place], 0), add(linear, on_support(q, cross(turn, r))))
        if a.z > shape.limits.starting:
            continue
        room.closed[kept] = point
        kept += 1
        along = math.sqrt(a.x * a.x + a.y * a.y)
        if (
            not room.moving[point]
            and along > shape.limits.starting
            and room.points[point, STATIC] < math.inf
        ):
            room.moving[point] = 1
            room.slip[point, 0], room.slip[point, 1] = a.x / along, a.y / along
    room.mode[CLOSED] = kept
    arrange_moving(shape, room)
    return found


@routine
def choose(shape: Shape, room: Room, f: Vec) -> None:
    """Find and begin the mode that follows, for the points on the support (`near`)."""
    if room.mode[NEAR] == 0:
        room.mode[CLOSED] = 0
        arrange(shape, room, SLIPS, 0)
        return
    q = axes_at(room.state)
    moving = note_slip(shape, room, q, shape.limits.slow)
    found = try_simple(shape, room, q, f)
    if not found:
        faster, moving = moving, note_slip(shape, room, q, shape.limits.slipping)
        found = moving > faster and try_simple(shape, room, q, f)
    if not found and moving == 0 and room.mode[NEAR] > 2:
        found = try_slide(shape, room, q, f)
    if not found and moving < 2 and room.mode[NEAR] == 2:
        found = try_side_slip(shape, room, q, f, moving)
    if not found and not shape.uniform and room.mode[NEAR] > 2:
        found = try_grip(shape, room, q, f)
    if not found:
        found = solve_together(shape, room, q, f)
        if not found:
            room.tally[FALLBACKS] += 1.0
            if shape.least_static == math.inf:  # it can neither slip nor leave: it stays
                close_all(room)
                arrange(shape, room, STICKS, 0)
    if lies_on_rim(shape) and room.mode[RANK] not in (FLAT, FLIGHT):
        first = room.closed[0]
        if not (room.mode[RANK] == CORNER and first == shape.contacts):
            take_rim(shape, room)
            last = shape.contacts
            room.moving[last] = room.moving[first]
            room.slip[last, 0], room.slip[last, 1] = room.slip[first, 0], room.slip[first, 1]
            arrange_moving(shape, room)
    enter(shape, room)
