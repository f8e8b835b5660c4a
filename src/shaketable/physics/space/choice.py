"""Which mode follows: forces decide which of the points on the support stay, stick or slip.

Simple modes are tried first, those that stick before those that slip and large contacts before
small ones: the whole base, a side, a point. One is admissible where it presses, keeps to its
friction cone and lets no other point sink. Where none is, all points are solved together
(`complementarity`).
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.closing import (
    close_all,
    close_side,
    close_with_rim,
    is_closed,
    rim_is_near,
)
from shaketable.physics.space.complementarity import balance, summed
from shaketable.physics.space.constraints import free_turning
from shaketable.physics.space.contacts import (
    acceleration,
    arm,
    axes_at,
    drift,
    lies_on_rim,
    side_direction,
    velocity,
)
from shaketable.physics.space.grip import ITERATIONS, flat_grip, slip_with_grip
from shaketable.physics.space.losses import resistance
from shaketable.physics.space.modes import arrange, enter, stand_on_rim, take_rim
from shaketable.physics.space.rates import limit, rates
from shaketable.physics.space.straps import with_straps
from shaketable.physics.space.vectors import Axes, Vec, add, cross, on_support
from shaketable.physics.space.workspace import (
    CORNER,
    FLAT,
    FLIGHT,
    PIVOTS,
    SLIPS,
    STICKS,
    SolidParameters,
    V,
    W,
    Workspace,
    vec,
)

SLACK = 1e-10  # m/s²: a reaction or an acceleration may miss its sign by this much
#: M/s²: a point that begins to slip may be accelerated back by this much.
BACKWARD_SLIP_TOLERANCE = 1e-6


@routine
def note_slip(shape: SolidParameters, work: Workspace, q: Axes, least: float) -> int:
    """Write which of the points on the support slip faster, and along what; return how many."""
    moving = 0
    for k in range(work.mode.near):
        point = work.near[k]
        u = velocity(shape, work, q, work.state, point)
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        work.moving[point] = speed > least and work.points[point].static < math.inf
        if work.moving[point]:
            moving += 1
            work.slip[point, 0] = u.x / speed
            work.slip[point, 1] = u.y / speed
    return moving


@routine
def judge_mode(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Judge whether the mode that is written presses, holds, and lets no other point sink."""
    dy = work.stages[0]
    rates(shape, work, work.state, f, True, dy)
    if not (work.judged.press >= -SLACK and work.judged.cone >= -SLACK):
        return False
    for k in range(work.mode.near):
        point = work.near[k]
        if is_closed(work, point):
            continue
        if acceleration(shape, work, q, work.state, dy, point).z < -SLACK:
            return False
    return True


@routine
def hold_of(work: Workspace) -> int:
    """What the closed points do: all slip, one sticks, or all stick; the first one that sticks."""
    stuck, first = 0, -1
    for place in range(work.mode.closed):
        if not work.moving[work.closed[place]]:
            stuck += 1
            if first < 0:
                first = work.closed[place]
    if stuck == 0:
        return -1
    return first if stuck == 1 and work.mode.closed > 1 else -2


@routine
def arrange_moving(shape: SolidParameters, work: Workspace) -> None:
    """Write the mode of the closed points as they move."""
    pivot = hold_of(work)
    if pivot >= 0:
        arrange(shape, work, PIVOTS, pivot)
    else:
        arrange(shape, work, SLIPS if pivot == -1 else STICKS, 0)


@routine
def try_simple(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Look for an admissible mode of points that move as they do."""
    close_all(work)
    arrange_moving(shape, work)
    if judge_mode(shape, work, q, f):
        return True
    if lies_on_rim(shape) and work.mode.kind == FLAT:
        return try_rim(shape, work, q, f)
    if work.mode.near > 2:
        for k in range(shape.hull):
            if close_side(shape, work, k):
                arrange_moving(shape, work)
                if judge_mode(shape, work, q, f):
                    return True
    if work.mode.near > 2 and rim_is_near(shape, work):
        for k in range(work.mode.near - 1):
            close_with_rim(shape, work, k)
            arrange_moving(shape, work)
            if judge_mode(shape, work, q, f):
                return True
    if work.mode.near > 1:
        for k in range(work.mode.near):
            work.closed[0] = work.near[k]
            work.mode.closed = 1
            arrange_moving(shape, work)
            if judge_mode(shape, work, q, f):
                return True
    return False


@routine
def try_rim(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Try whether a circle tips over its rim, where the resultant of the forces leaves the base."""
    if work.mode.grip == STICKS:
        pull = with_straps(shape, work, f)
        back = Vec(pull.x, pull.y, 0.0)
    else:
        mu = work.points[shape.contacts].kinetic
        first = work.near[0]
        back = Vec(mu * work.slip[first, 0], mu * work.slip[first, 1], 0.0)
    along = q.x.x * back.x + q.y.x * back.y
    across = q.x.y * back.x + q.y.y * back.y
    size = math.sqrt(along * along + across * across)
    if size == 0.0:
        return False
    last, first = shape.contacts, work.near[0]
    work.moving[last] = work.moving[first]
    work.slip[last, 0], work.slip[last, 1] = work.slip[first, 0], work.slip[first, 1]
    stand_on_rim(shape, work, along / size, across / size)
    arrange_moving(shape, work)
    return judge_mode(shape, work, q, f)


@routine
def try_slide(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Try whether a body at rest begins to slide with its whole base, without turning."""
    pull = with_straps(shape, work, f)
    size = math.sqrt(pull.x * pull.x + pull.y * pull.y)
    close_all(work)
    if size == 0.0 or not shape.uniform:
        return False
    for k in range(work.mode.near):
        point = work.near[k]
        work.moving[point] = 1
        work.slip[point, 0] = pull.x / size
        work.slip[point, 1] = pull.y / size
    arrange(shape, work, SLIPS, 0)
    found = (
        work.mode.kind == FLAT
        and judge_mode(shape, work, q, f)
        and work.stages[0, V] * pull.x + work.stages[0, V + 1] * pull.y >= 0.0
    )
    if not found:
        for k in range(work.mode.near):
            work.moving[work.near[k]] = 0
    return found


@routine
def try_side_slip(shape: SolidParameters, work: Workspace, q: Axes, f: Vec, moving: int) -> bool:
    """Try whether a side on which a body rocks begins to slip, at both corners or at one."""
    close_all(work)
    first, second = work.closed[0], work.closed[1]
    if moving == 1:  # one slips already
        begins = second if work.moving[first] else first
        arrange_moving(shape, work)
        rates(shape, work, work.state, f, True, work.stages[0])
        opposes_share(work, 0 if begins == first else 1)
        return try_slip_of_side(shape, work, q, f, begins, -1)
    arrange(shape, work, STICKS, 0)
    rates(shape, work, work.state, f, True, work.stages[0])
    slipping = split_along(shape, work, q)
    opposes_share(work, 0)
    opposes_share(work, 1)
    if try_slip_of_side(shape, work, q, f, first, second):
        return True
    begins = work.closed[slipping]  # the one that has less friction left, or the other
    stays = work.closed[1 - slipping]
    return try_slip_of_side(shape, work, q, f, begins, -1) or try_slip_of_side(
        shape, work, q, f, stays, -1
    )


@kernel
def opposes_share(work: Workspace, place: int) -> None:
    """Aim the slip of a closed place against the friction that it would need to stick."""
    point, x, y = work.closed[place], work.shares[place, 0], work.shares[place, 1]
    size = math.sqrt(x * x + y * y)
    if size > 0.0:
        work.slip[point, 0], work.slip[point, 1] = -x / size, -y / size
    else:
        work.slip[point, 0], work.slip[point, 1] = 1.0, 0.0


@routine
def try_slip_of_side(
    shape: SolidParameters, work: Workspace, q: Axes, f: Vec, first: int, second: int
) -> bool:
    """Whether one point, or two, may begin to slip; nothing moves that did not if they may not."""
    work.moving[first] = 1
    if second >= 0:
        work.moving[second] = 1
    arrange_moving(shape, work)
    if judge_mode(shape, work, q, f) and sets_off(shape, work, q, first, second):
        return True
    work.moving[first] = 0
    if second >= 0:
        work.moving[second] = 0
    return False


@routine
def split_along(shape: SolidParameters, work: Workspace, q: Axes) -> int:
    """Add to the shares of a side's corners their parts of the force along it.

    The parts are as the friction that each corner has left; returns the place of the one with less.
    """
    e = on_support(q, side_direction(shape, work))
    first, last = spare_along(work, 0), spare_along(work, 1)
    part = first / (first + last) if first + last > 0.0 else 0.5
    for place in range(2):
        own = work.shares[2, 0] * (part if place == 0 else 1.0 - part)
        work.shares[place, 0] += own * e.x
        work.shares[place, 1] += own * e.y
    return 1 if last < first else 0


@kernel
def spare_along(work: Workspace, place: int) -> float:
    """Friction that a side's corner has left for a force along the side."""
    share = work.shares[place]
    most = limit(work.points[work.closed[place]].static, max(share[2], 0.0))
    return math.sqrt(max(most * most - share[0] * share[0] - share[1] * share[1], 0.0))


@routine
def sets_off(shape: SolidParameters, work: Workspace, q: Axes, first: int, second: int) -> bool:
    """Whether points that begin to slip are accelerated in the direction of their slip.

    As they begin their friction is all that they need to stick, and they are hardly accelerated.
    """
    for point in (first, second):
        if point >= 0:
            a = acceleration(shape, work, q, work.state, work.stages[0], point)
            if a.x * work.slip[point, 0] + a.y * work.slip[point, 1] < -BACKWARD_SLIP_TOLERANCE:
                return False
    return True


@routine
def try_grip(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Try whether a flat base on points of different friction stays flat; some of them may slip."""
    left = flat_grip(shape, work, q, with_straps(shape, work, f), ITERATIONS)
    if left < 0.0:
        return False
    if left > shape.limits.starting:
        slip_with_grip(shape, work, left)
    arrange_moving(shape, work)
    return True


@routine
def solve_together(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Let all points decide together; False if no reactions could be found."""
    close_all(work)
    f = with_straps(shape, work, f)
    spin = vec(work.state, W)
    free_turn = free_turning(shape, work, spin)
    n = work.mode.closed
    for place in range(n):
        r = arm(shape, work, work.closed[place])
        own = add(cross(spin, r), drift(shape, work, work.closed[place]))
        a = add(f, on_support(q, add(cross(free_turn, r), cross(spin, own))))
        work.free[place, 0], work.free[place, 1], work.free[place, 2] = a.x, a.y, a.z
        work.goal[place] = 0.0
    resists = resistance(shape, q, spin)
    found = balance(shape, work, q, True, resists)
    linear, turn = summed(shape, work, q, resists)
    kept = 0
    for place in range(n):
        point = work.near[place]
        r = arm(shape, work, point)
        a = add(vec(work.free[place], 0), add(linear, on_support(q, cross(turn, r))))
        if a.z > shape.limits.starting:
            continue
        work.closed[kept] = point
        kept += 1
        along = math.sqrt(a.x * a.x + a.y * a.y)
        if (
            not work.moving[point]
            and along > shape.limits.starting
            and work.points[point].static < math.inf
        ):
            work.moving[point] = 1
            work.slip[point, 0], work.slip[point, 1] = a.x / along, a.y / along
    work.mode.closed = kept
    arrange_moving(shape, work)
    return found


@routine
def choose_on_support(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Find and begin the mode that follows, for the points on the support (`near`)."""
    if work.mode.near == 0:
        work.mode.closed = 0
        arrange(shape, work, SLIPS, 0)
        return
    q = axes_at(work.state)
    moving = note_slip(shape, work, q, shape.limits.slow)
    found = try_simple(shape, work, q, f)
    if not found:
        faster, moving = moving, note_slip(shape, work, q, shape.limits.slipping)
        found = moving > faster and try_simple(shape, work, q, f)
    if not found and moving == 0 and work.mode.near > 2:
        found = try_slide(shape, work, q, f)
    if not found and moving < 2 and work.mode.near == 2:
        found = try_side_slip(shape, work, q, f, moving)
    if not found and not shape.uniform and work.mode.near > 2:
        found = try_grip(shape, work, q, f)
    if not found:
        found = solve_together(shape, work, q, f)
        if not found:
            work.tally.fallbacks += 1.0
            if shape.least_static == math.inf:  # it can neither slip nor leave: it stays
                close_all(work)
                arrange(shape, work, STICKS, 0)
    if lies_on_rim(shape) and work.mode.kind not in (FLAT, FLIGHT):
        first = work.closed[0]
        if not (work.mode.kind == CORNER and first == shape.contacts):
            take_rim(shape, work)
            last = shape.contacts
            work.moving[last] = work.moving[first]
            work.slip[last, 0], work.slip[last, 1] = work.slip[first, 0], work.slip[first, 1]
            arrange_moving(shape, work)
    enter(shape, work)
