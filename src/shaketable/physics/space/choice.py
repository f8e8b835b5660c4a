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
    close_one,
    close_side,
    close_with_rim,
    end_closed,
    is_place_closed,
    rim_is_near,
)
from shaketable.physics.space.complementarity import moved_at, push_together, sweeps_left
from shaketable.physics.space.cones import NO_CONE, split_along
from shaketable.physics.space.contacts import (
    acceleration,
    axes_at,
    lies_on_rim,
    on_rim,
    side_direction,
)
from shaketable.physics.space.grip import ITERATIONS, flat_grip, slip_with_grip
from shaketable.physics.space.modes import arrange, enter, fly, stand_on_rim, take_rim
from shaketable.physics.space.rates import rates
from shaketable.physics.space.straps import with_straps
from shaketable.physics.space.touches import look_at_touches, note_moving
from shaketable.physics.space.vectors import ZERO, Axes, Vec, on_support
from shaketable.physics.space.workspace import (
    CORNER,
    FLAT,
    FLIGHT,
    PIVOTS,
    SLIPS,
    STICKS,
    SolidParameters,
    V,
    Workspace,
    put,
    vec,
)

SLACK = 1e-10  # m/s²: a reaction or an acceleration may miss its sign by this much
#: M/s²: a point that begins to slip may be accelerated back by this much.
BACKWARD_SLIP_TOLERANCE = 1e-6
PULLED_ON = NO_CONE  # m/s²: a contact that stays whatever pulls it is past its end by less


@routine
def judge_mode(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Judge whether the mode that is written presses, holds, and lets no other point sink."""
    dy = work.stages[0]
    rates(shape, work, work.state, f, True, dy)
    if not (work.judged.press >= -SLACK and work.judged.cone >= -SLACK):
        return False
    for place in range(work.mode.near):
        if is_place_closed(work, place):
            continue
        sinks = -acceleration(shape, work, q, work.state, dy, work.touches[place].point).z
        if not sinks <= SLACK:  # nor if it is no number
            return False
    return True


@routine
def hold_of(work: Workspace) -> int:
    """What the closed points do: all slip, one sticks, or all stick; the first one that sticks."""
    stuck, first = 0, -1
    for k in range(work.mode.closed):
        if not work.touches[work.closed[k]].moves:
            stuck += 1
            if first < 0:
                first = work.closed[k]
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
    close_all(shape, work)
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
            close_one(shape, work, k)
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
        first = work.touches[0]
        mu = work.points[shape.contacts].kinetic
        back = Vec(mu * first.slip_x, mu * first.slip_y, 0.0)
    along = q.x.x * back.x + q.y.x * back.y
    across = q.x.y * back.x + q.y.y * back.y
    size = math.sqrt(along * along + across * across)
    if size == 0.0:
        return False
    stand_on_rim(shape, work, along / size, across / size)
    arrange_moving(shape, work)
    if judge_mode(shape, work, q, f):
        return True
    work.mode.touches -= 1  # the rim
    return False


@routine
def try_slide(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Try whether a body at rest begins to slide with its whole base, without turning."""
    pull = with_straps(shape, work, f)
    size = math.sqrt(pull.x * pull.x + pull.y * pull.y)
    close_all(shape, work)
    if size == 0.0 or not shape.uniform or shape.least_static == math.inf:
        return False
    for place in range(work.mode.near):
        touch = work.touches[place]
        touch.moves = 1
        touch.slip_x, touch.slip_y = pull.x / size, pull.y / size
    arrange(shape, work, SLIPS, 0)
    found = (
        work.mode.kind == FLAT
        and judge_mode(shape, work, q, f)
        and work.stages[0, V] * pull.x + work.stages[0, V + 1] * pull.y >= 0.0
    )
    if not found:
        for place in range(work.mode.near):
            work.touches[place].moves = 0
    return found


@routine
def try_side_slip(shape: SolidParameters, work: Workspace, q: Axes, f: Vec, moving: int) -> bool:
    """Try whether a side on which a body rocks begins to slip, at both corners or at one."""
    close_all(shape, work)
    first, second = work.closed[0], work.closed[1]
    if moving == 1:  # one slips already
        begins = second if work.touches[first].moves else first
        arrange_moving(shape, work)
        rates(shape, work, work.state, f, True, work.stages[0])
        oppose_share(work, begins)
        return try_slip_of_side(shape, work, q, f, begins, -1)
    arrange(shape, work, STICKS, 0)
    rates(shape, work, work.state, f, True, work.stages[0])
    e = on_support(q, side_direction(shape, work))
    begins = split_along(work, work.mode.first, work.mode.last, work.judged.along, e.x, e.y)
    oppose_share(work, first)
    oppose_share(work, second)
    if try_slip_of_side(shape, work, q, f, first, second):
        return True
    stays = first if begins == second else second
    # the one that has less friction left, or the other
    return try_slip_of_side(shape, work, q, f, begins, -1) or try_slip_of_side(
        shape, work, q, f, stays, -1
    )


@kernel
def oppose_share(work: Workspace, place: int) -> None:
    """Aim the slip of a touch against the friction that it would need to stick."""
    touch = work.touches[place]
    x, y = touch.share[0], touch.share[1]
    size = math.sqrt(x * x + y * y)
    touch.slip_x, touch.slip_y = (-x / size, -y / size) if size > 0.0 else (1.0, 0.0)


@routine
def try_slip_of_side(
    shape: SolidParameters, work: Workspace, q: Axes, f: Vec, first: int, second: int
) -> bool:
    """Whether one touch, or two, may begin to slip; nothing moves that did not if they may not.

    What has friction without limit never does.
    """
    held = work.touches[first].static == math.inf
    if held or (second >= 0 and work.touches[second].static == math.inf):
        return False
    work.touches[first].moves = 1
    if second >= 0:
        work.touches[second].moves = 1
    arrange_moving(shape, work)
    if judge_mode(shape, work, q, f) and sets_off(shape, work, q, first, second):
        return True
    work.touches[first].moves = 0
    if second >= 0:
        work.touches[second].moves = 0
    return False


@routine
def sets_off(shape: SolidParameters, work: Workspace, q: Axes, first: int, second: int) -> bool:
    """Whether touches that begin to slip are accelerated in the direction of their slip.

    As they begin their friction is all that they need to stick, and they are hardly accelerated.
    """
    for place in (first, second):
        if place >= 0:
            touch = work.touches[place]
            a = acceleration(shape, work, q, work.state, work.stages[0], touch.point)
            if a.x * touch.slip_x + a.y * touch.slip_y < -BACKWARD_SLIP_TOLERANCE:
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
    """Let all points on the support decide together; False if no reactions could be found."""
    look_at_touches(shape, work, q, work.state)
    for place in range(work.mode.near):
        put(work.touches[place].share, 0, ZERO)
    found = push_together(shape, work, q, f, work.mode.near, sweeps_left(work))
    linear, turn, kept = vec(work.change, 0), vec(work.change, 3), 0
    for place in range(work.mode.near):
        touch, a = work.touches[place], moved_at(work, place, linear, turn)
        if a.z > shape.limits.starting:
            continue
        work.closed[kept] = place
        kept += 1
        along = math.sqrt(a.x * a.x + a.y * a.y)
        if not touch.moves and along > shape.limits.starting and touch.static < math.inf:
            touch.moves = 1
            touch.slip_x, touch.slip_y = a.x / along, a.y / along
    end_closed(shape, work, kept)
    arrange_moving(shape, work)
    return found


@routine
def try_leaving_or_stay(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Try whether what cannot slip leaves; a corner or a side that would sink stays."""
    fly(shape, work)
    leaves = judge_mode(shape, work, q, f)
    if not leaves and work.mode.near < 3:
        stay(shape, work)
    return leaves or work.mode.near < 3


@routine
def stay(shape: SolidParameters, work: Workspace) -> None:
    """Let what can neither slip nor leave turn on about what it touches, though that pulls it."""
    close_all(shape, work)
    arrange(shape, work, STICKS, 0)
    work.judged.past = PULLED_ON


@routine
def choose_on_support(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Find and begin the mode that follows, for the points on the support (`near`)."""
    if work.mode.near == 0:
        fly(shape, work)
        return
    q = axes_at(work.state)
    moving = note_moving(shape, work, q, work.mode.near, shape.limits.slow)
    found = try_simple(shape, work, q, f)
    if not found:
        faster = moving
        moving = note_moving(shape, work, q, work.mode.near, shape.limits.slipping)
        found = moving > faster and try_simple(shape, work, q, f)
    if not found and moving == 0 and work.mode.near > 2:
        found = try_slide(shape, work, q, f)
    if not found and moving < 2 and work.mode.near == 2:
        found = try_side_slip(shape, work, q, f, moving)
    if not found and not shape.uniform and work.mode.near > 2:
        found = try_grip(shape, work, q, f)
    if not found and shape.least_static == math.inf:
        found = try_leaving_or_stay(shape, work, q, f)
    if not found and not solve_together(shape, work, q, f):
        work.tally.fallbacks += 1
        if shape.least_static == math.inf:
            stay(shape, work)
    rolls = work.mode.kind == CORNER and on_rim(work)
    if lies_on_rim(shape) and work.mode.kind not in (FLAT, FLIGHT) and not rolls:
        take_rim(shape, work)
        arrange_moving(shape, work)
    enter(shape, work)
