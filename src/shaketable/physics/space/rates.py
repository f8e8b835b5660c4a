"""How fast a state changes in the present mode, and how sure its contact is.

What a body does most of the time has its own short way (`short_ways`, `flat_slip`), and flight
another; what presses against a wall or an edge has `walled`. All else goes through `constraints`.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.cones import NO_CONE, limit, margin_of_two, spare
from shaketable.physics.space.constraints import ROUND_OFF, free_turning, react
from shaketable.physics.space.contacts import (
    arm,
    axes_at,
    closed_point,
    find_rim,
    flat_margin,
    on_rim,
    standing_margin,
)
from shaketable.physics.space.flat_slip import (
    is_upright,
    share_evenly,
    slide_and_turn,
    slide_straight,
    slides_straight,
)
from shaketable.physics.space.losses import loses
from shaketable.physics.space.short_ways import rock, roll, slip, slip_on_two
from shaketable.physics.space.straps import add_straps
from shaketable.physics.space.turning import write_turning
from shaketable.physics.space.vectors import ZERO, Axes, Vec, on_support, subtract
from shaketable.physics.space.walled import react_at_walls
from shaketable.physics.space.workspace import (
    CORNER,
    EDGE,
    FLAT,
    FLIGHT,
    PIVOTS,
    SLIPS,
    STICKS,
    WALLED,
    Floats,
    P,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)


@kernel
def write_rates(dy: Floats, y: Floats, linear: Vec, turn: Vec) -> None:
    """Write ẏ from the state and its accelerations."""
    put(dy, P, vec(y, V))
    put(dy, V, linear)
    write_turning(y, vec(y, W), turn, dy)


@routine
def slip_flat(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec, judge: bool, dy: Floats
) -> bool:
    """As `rates`, of a base that slips flat; False, without rates, where it would lift."""
    if slides_straight(shape, work, y):
        linear, press = slide_straight(shape, work, q, y, f)
        if press >= 0.0:
            write_rates(dy, y, linear, ZERO)
            if judge:
                work.judged.press, work.judged.cone = press, NO_CONE
                share_evenly(work, -f.z)
            return True
    linear, rate, found = slide_and_turn(shape, work, q, y, f)
    if found:
        write_rates(dy, y, linear, Vec(0.0, 0.0, rate))
        if judge:
            judge_contact(shape, work, q, y)
    return bool(found)


@routine
def stand(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec, dy: Floats) -> None:
    """As `rates`, of a base that stands flat on all its points and sticks; no shares are found."""
    write_rates(dy, y, ZERO, ZERO)
    work.judged.press = standing_margin(shape, work, q, f)
    size = math.sqrt(f.x * f.x + f.y * f.y)
    work.judged.cone = limit(shape.least_static, -f.z) - size


@routine
def rates(
    shape: SolidParameters, work: Workspace, y: Floats, f: Vec, judge: bool, dy: Floats
) -> None:
    """Write ẏ, and if asked for how sure the contact is (`judged`); straps pull as they do in y."""
    if shape.straps > 0:
        f = add_straps(shape, work, axes_at(y), y, f)
    q = axes_at(y)
    rank, hold = work.mode.kind, work.mode.grip
    if rank == FLIGHT:
        write_rates(dy, y, f, free_turning(shape, work, vec(y, W)))
        work.judged.press = NO_CONE
        work.judged.cone = NO_CONE
        return
    if rank == WALLED:
        linear, turn = react_at_walls(shape, work, q, y, f)
        write_rates(dy, y, linear, turn)
        return
    rolls = on_rim(work)
    upright = rank == FLAT and not rolls and is_upright(y)
    if upright and hold == STICKS and work.mode.closed == shape.contacts:
        stand(shape, work, q, y, f, dy)
        return
    if upright and hold == SLIPS and slip_flat(shape, work, q, y, f, judge, dy):
        return
    if rolls:
        find_rim(shape, work, q.z, vec(y, W))
    rocks = False
    if rank == CORNER and hold == STICKS and not loses(shape):
        linear, turn = roll(shape, work, q, y, f)
    elif rank == EDGE and hold == STICKS and not rolls and not loses(shape):
        rocks = True
        linear, turn = rock(shape, work, q, y, f)
    elif rank == CORNER and hold == SLIPS:
        linear, turn = slip(shape, work, q, y, f)
    elif rank == EDGE and hold == SLIPS and work.mode.closed == EDGE:
        linear, turn = slip_on_two(shape, work, q, y, f)
    else:
        linear, turn = react(shape, work, q, y, f)
    write_rates(dy, y, linear, turn)
    if judge:
        if hold == STICKS and rank == EDGE:
            if not rocks:
                write_side(shape, work, q)
            judge_side(work)
        else:
            judge_contact(shape, work, q, y)


@routine
def write_side(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Write what each end of a side that sticks bears, from what `react` has found.

    Its first and its last corner get the reaction, but for the force along the side, of which only
    the sum is known (`judged.along`).
    """
    first, last = work.touches[work.mode.first], work.touches[work.mode.last]
    a = on_support(q, arm(shape, work, first.point))
    side = subtract(on_support(q, arm(shape, work, last.point)), a)
    length = math.sqrt(side.x * side.x + side.y * side.y)
    e_x, e_y = side.x / length, side.y / length
    total, moment = 0.0, 0.0  # the pressure, and its moment about the first corner
    for k in range(work.mode.closed):
        touch = work.touches[work.closed[k]]
        r = on_support(q, arm(shape, work, touch.point))
        total += touch.share[2]
        moment += touch.share[2] * (e_x * (r.x - a.x) + e_y * (r.y - a.y))
    f_x, f_y, torque = work.solved[EDGE], work.solved[EDGE + 1], work.solved[EDGE + 2]
    origin = on_support(q, arm(shape, work, closed_point(work, 0)))
    off = e_x * (origin.x - a.x) + e_y * (origin.y - a.y)
    across = e_x * f_y - e_y * f_x
    of_last = (torque + off * across) / length
    of_first = across - of_last
    put(first.share, 0, Vec(-e_y * of_first, e_x * of_first, total - moment / length))
    put(last.share, 0, Vec(-e_y * of_last, e_x * of_last, moment / length))
    work.judged.along = e_x * f_x + e_y * f_y


@routine
def judge_side(work: Workspace) -> None:
    """How sure a side whose corners stick is: some split of the force along it has to hold."""
    first, last = work.mode.first, work.mode.last
    work.judged.press = min(work.touches[first].share[2], work.touches[last].share[2])
    work.judged.cone = margin_of_two(work, first, last, work.judged.along)


@routine
def judge_contact(shape: SolidParameters, work: Workspace, q: Axes, y: Floats) -> None:
    """How sure any other contact is."""
    rank, hold, n = work.mode.kind, work.mode.grip, work.mode.closed
    total, along, across, least = 0.0, 0.0, 0.0, 0.0
    for k in range(n):
        touch = work.touches[work.closed[k]]
        share = touch.share[2]
        least = min(least, share)
        total += share
        along += share * work.points[touch.point].x
        across += share * work.points[touch.point].y
    work.judged.cone = NO_CONE
    if rank == CORNER:
        work.judged.press = total
        if hold == STICKS:
            work.judged.cone = spare(work, work.closed[0])
        return
    if rank == EDGE:
        a, b = work.touches[work.mode.first].point, work.touches[work.mode.last].point
        x, z = work.points[b].x - work.points[a].x, work.points[b].y - work.points[a].y
        length2 = x * x + z * z
        part = x * (along - total * work.points[a].x) + z * (across - total * work.points[a].y)
        work.judged.press = min(part / length2, total - part / length2)
    else:
        work.judged.press = flat_margin(shape, work, total, along, across)
        if on_rim(work):  # the three points of which one is the rim press or pull
            work.judged.press = math.inf
            for k in range(n):
                share = work.touches[work.closed[k]].share[2]
                work.judged.press = min(work.judged.press, share)
        if least < -ROUND_OFF * total:  # no pressures without a pull were found: it lifts
            work.judged.press = min(work.judged.press, least)
        if hold == STICKS:  # it does not turn: the resultant passes through the base as one force
            touch = work.touches[work.closed[0]]
            size = math.sqrt(touch.share[0] ** 2 + touch.share[1] ** 2)
            work.judged.cone = limit(shape.least_static, total) - size
    if hold == PIVOTS:
        work.judged.cone = spare(work, work.mode.pivot)
