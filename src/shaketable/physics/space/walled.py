"""The mode of a solid that presses against a wall: its rows, its accelerations, and what ends it.

Of the constraints that the touches set, at most six are independent: `kept` names them, first the
pressures, then what holds from slipping on each plane (two forces at one touch, and a torque about
the normal where more of them carry and stick). The pressures of the others follow from these: with
r_c = Σ_i C_ci r_i for the row of each touch that presses, N = C z is of all pressures with the same
resultant the one of least ΣN², as under a flat base (`constraints`); C is `spread`.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.bracing import brace, sticks
from shaketable.physics.space.cones import NO_CONE, margin_of_two, spare, split_along
from shaketable.physics.space.constraints import add_to, fill, free_turning, measured
from shaketable.physics.space.contacts import axes_at, slip_direction, turn_in_body
from shaketable.physics.space.edge import has_edge, line_plane
from shaketable.physics.space.linear import solve
from shaketable.physics.space.losses import resistance
from shaketable.physics.space.touches import (
    frame_of,
    lever_of,
    look_at_touches,
    plane_of,
    touch_gap,
    touch_velocity,
)
from shaketable.physics.space.vectors import (
    ZERO,
    Axes,
    Vec,
    add,
    applied,
    cross,
    dot,
    on_body,
    on_support,
    subtract,
    times,
)
from shaketable.physics.space.workspace import (
    DEPENDENT,
    MAY_PRESS,
    PRESSES,
    PULLS,
    Floats,
    P,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)

# Components of a row: along the two tangents, the normal, and the turn about the normal.
FIRST_TANGENT, SECOND_TANGENT, PRESSURE, TURN = range(4)
INDEPENDENT = 1e-6  # square of what of a row must not follow from the others, by that of the row
MOST_SHIFT = (
    100.0  # times the largest gap: rows that would move a body farther are all but dependent
)
LIKE_LEAST = 0.5  # of the largest pull: what pulls by more lets go together with it


@routine
def row_of(work: Workspace, place: int, component: int) -> tuple[Vec, Vec]:
    """A row: what it takes of a velocity and of a turn, both in the body's frame."""
    frame = frame_of(work, place)
    if component == TURN:
        return Vec(0.0, 0.0, 0.0), frame.z
    along = frame.z
    if component == FIRST_TANGENT:
        along = frame.x
    elif component == SECOND_TANGENT:
        along = frame.y
    return along, cross(lever_of(work, place), along)


@routine
def write_row(work: Workspace, i: int, place: int, component: int) -> None:
    force, torque = row_of(work, place, component)
    for j in range(6):
        work.rows[i, j] = 0.0
    add_to(work.rows, i, 1.0, force, torque)


@routine
def keep_row(shape: SolidParameters, work: Workspace, place: int, component: int) -> bool:
    """Add a constraint to those that are kept, if it does not follow from them.

    `independent` holds the rows made orthogonal to one another in the body's mobility.
    """
    k = work.mode.rows
    if k == 6:
        return False
    force, torque = row_of(work, place, component)
    size = dot(force, force) + dot(torque, applied(shape.mobility, torque))
    for i in range(k):
        work.parts[i] = part_along(shape, work, i, force, torque)
        other, turns = vec(work.independent[i], 0), vec(work.independent[i], 3)
        force = add(force, times(-work.parts[i], other))
        torque = add(torque, times(-work.parts[i], turns))
    left = dot(force, force) + dot(torque, applied(shape.mobility, torque))
    if left <= INDEPENDENT * size:
        return False
    one = 1.0 / math.sqrt(left)
    for j in range(6):
        own = 1.0 if j == k else 0.0
        for i in range(k):
            own -= work.parts[i] * work.made_of[i, j]
        work.made_of[k, j] = one * own
    put(work.independent[k], 0, times(one, force))
    put(work.independent[k], 3, times(one, torque))
    work.kept[k, 0], work.kept[k, 1] = place, component
    work.mode.rows = k + 1
    return True


@kernel
def part_along(shape: SolidParameters, work: Workspace, i: int, force: Vec, torque: Vec) -> float:
    """The part of a row along one of those that are made orthogonal."""
    other, turns = vec(work.independent[i], 0), vec(work.independent[i], 3)
    return dot(other, force) + dot(turns, applied(shape.mobility, torque))


@routine
def is_dependent(shape: SolidParameters, work: Workspace, place: int) -> bool:
    """Whether the pressure of a touch follows from the rows that are kept."""
    force, torque = row_of(work, place, PRESSURE)
    size = dot(force, force) + dot(torque, applied(shape.mobility, torque))
    for i in range(work.mode.rows):
        part = part_along(shape, work, i, force, torque)
        force = add(force, times(-part, vec(work.independent[i], 0)))
        torque = add(torque, times(-part, vec(work.independent[i], 3)))
    return dot(force, force) + dot(torque, applied(shape.mobility, torque)) <= INDEPENDENT * size


@kernel
def plane_count(shape: SolidParameters) -> int:
    """The support, walls, and of an edge the face of its lip and its line."""
    return line_plane(shape) + 1 if has_edge(shape) else shape.walls + 1


@routine
def keep_sticking(shape: SolidParameters, work: Workspace) -> None:
    """Keep what holds the touches that carry and do not slip, plane by plane."""
    for plane in range(plane_count(shape)):
        first, count = -1, 0
        for place in range(work.mode.touches):
            row = work.touches[place]
            if plane_of(work, place) == plane and row.carries > 0 and row.moves == 0:
                if first < 0:
                    first = place
                count += 1
        if first >= 0:
            keep_row(shape, work, first, FIRST_TANGENT)
            keep_row(shape, work, first, SECOND_TANGENT)
            if count > 1:
                keep_row(shape, work, first, TURN)


@routine
def write_mode(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Keep independent rows: of the touches that may carry, those that press before the others."""
    n = work.mode.touches
    work.mode.rows = 0
    look_at_touches(shape, work, q, work.state)
    for place in range(n):
        for j in range(6):
            work.touches[place].spread[j] = 0.0
    for first in (PRESSES, MAY_PRESS):
        for place in range(n):
            if work.touches[place].carries == first:
                k = work.mode.rows
                if keep_row(shape, work, place, PRESSURE):
                    work.touches[place].carries = PRESSES
                    work.touches[place].spread[k] = 1.0
                elif first == PRESSES:
                    spread_out(work, place)
                else:
                    work.touches[place].carries = DEPENDENT
    work.mode.pressures = work.mode.rows
    keep_sticking(shape, work)


@kernel
def spread_out(work: Workspace, place: int) -> None:
    """Write how the pressure of a touch that was just found to follow does so."""
    for j in range(work.mode.rows):
        for i in range(work.mode.rows):
            work.touches[place].spread[j] += work.parts[i] * work.made_of[i, j]


@routine
def add_pressures(
    shape: SolidParameters, work: Workspace, y: Floats, friction: bool, resists: Vec
) -> None:
    """Write the columns of the pressures: what a unit of each brings at all that press.

    Args:
        friction: with the friction of what slips, and the torque `resists` on the support.
    """
    k = work.mode.pressures
    for place in range(work.mode.touches):
        touch = work.touches[place]
        if touch.carries != PRESSES:
            continue
        frame, r = frame_of(work, place), lever_of(work, place)
        force = frame.z
        if friction and touch.moves > 0:
            x, z = slip_direction(shape, work, place, touch_velocity(work, axes_at(y), y, place))
            mu = touch.kinetic
            force = add(force, add(times(-mu * x, frame.x), times(-mu * z, frame.y)))
        torque = cross(r, force)
        if friction and plane_of(work, place) == 0:
            torque = add(torque, resists)
        for i in range(k):
            if touch.spread[i] != 0.0:
                add_to(work.columns, i, touch.spread[i], force, torque)


@routine
def react_at_walls(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec
) -> tuple[Vec, Vec]:
    """v̇ and ω̇ in the present mode; the reactions are written to `shares` and judged."""
    look_at_touches(shape, work, q, y)
    spin, k = vec(y, W), work.mode.rows
    free = free_turning(shape, work, spin)
    resists = resistance(shape, q, spin)
    here = on_body(q, f)
    for i in range(k):
        place, component = work.kept[i, 0], work.kept[i, 1]
        write_row(work, i, place, component)
        for j in range(6):
            work.columns[i, j] = work.rows[i, j] if component != PRESSURE else 0.0
        touch, r = work.touches[place], lever_of(work, place)
        own = cross(spin, add(cross(spin, r), vec(touch.along, 0)))
        bias = 0.0 if component == TURN else dot(vec(work.rows[i], 0), own)
        if component == PRESSURE:
            bias += touch.bend
        work.system[i, k] = -measured(work.rows[i], here, free) - bias
        work.solved[i] = 0.0
    add_pressures(shape, work, y, True, resists)
    fill(shape, work, k)
    solve(work.system, k, work.solved)
    linear, torque = here, Vec(0.0, 0.0, 0.0)
    for i in range(k):
        linear = add(linear, times(work.solved[i], vec(work.columns[i], 0)))
        torque = add(torque, times(work.solved[i], vec(work.columns[i], 3)))
    judge_touches(shape, work)
    return on_support(q, linear), add(free, applied(shape.mobility, torque))


@routine
def judge_touches(shape: SolidParameters, work: Workspace) -> None:
    """Write how sure the mode is: the least pressure, and the least margin to a friction cone."""
    least = NO_CONE
    for place in range(work.mode.touches):
        touch = work.touches[place]
        put(touch.share, 0, ZERO)
        if touch.carries == PRESSES:
            for i in range(work.mode.pressures):
                touch.share[2] += touch.spread[i] * work.solved[i]
            least = min(least, touch.share[2])
    work.judged.press, work.judged.cone = least, NO_CONE
    for plane in range(plane_count(shape)):
        work.judged.cone = min(work.judged.cone, plane_margin(work, plane))
    beside = work.mode.touches > work.mode.near  # on the support alone all is shared already
    if beside and min(work.judged.press, work.judged.cone) < 0.0:
        judge_braced(work)


@routine
def judge_braced(work: Workspace) -> None:
    """Judge touches again that would pull or slip, pressed against one another."""
    brace(work)
    work.judged.press, work.judged.cone = NO_CONE, NO_CONE
    for place in range(work.mode.touches):
        if work.touches[place].carries == PRESSES:
            work.judged.press = min(work.judged.press, work.touches[place].share[2])
        if sticks(work, place):
            work.judged.cone = min(work.judged.cone, spare(work, place))


@routine
def plane_margin(work: Workspace, plane: int) -> float:
    """The friction that is left on a plane, at the touch that has least of it [m/s²]; writes all.

    Two touches that stick share the force along their line as some split allows, more of them as
    pressure times a rigid field about its centre, which is one way to do so.
    """
    first, f_x, f_y, torque = -1, 0.0, 0.0, 0.0
    for i in range(work.mode.rows):
        place, component = work.kept[i, 0], work.kept[i, 1]
        if component != PRESSURE and plane_of(work, place) == plane:
            first = place
            if component == FIRST_TANGENT:
                f_x = work.solved[i]
            elif component == SECOND_TANGENT:
                f_y = work.solved[i]
            else:
                torque = work.solved[i]
    if first < 0:
        return NO_CONE
    total, x, y, count, last = 0.0, 0.0, 0.0, 0, first
    for place in range(work.mode.touches):
        if holds_at(work, place, plane):
            at = on_support(frame_of(work, place), lever_of(work, place))
            share = work.touches[place].share[2]
            total, x, y, count, last = (
                total + share, x + share * at.x, y + share * at.y, count + 1, place,
            )  # fmt: skip
    if count == 2:
        return pair_margin(work, first, last, f_x, f_y, torque)
    if total <= 0.0:
        return total - math.sqrt(f_x * f_x + f_y * f_y)
    x, y, second = x / total, y / total, 0.0
    origin = on_support(frame_of(work, first), lever_of(work, first))
    torque += (origin.x - x) * f_y - (origin.y - y) * f_x
    for place in range(work.mode.touches):
        if holds_at(work, place, plane):
            at = on_support(frame_of(work, place), lever_of(work, place))
            share = work.touches[place].share[2]
            second += share * ((at.x - x) ** 2 + (at.y - y) ** 2)
    twist = torque / second if count > 1 and second > 0.0 else 0.0  # of one, round-off alone
    least = NO_CONE
    for place in range(work.mode.touches):
        if holds_at(work, place, plane):
            at = on_support(frame_of(work, place), lever_of(work, place))
            t_x, t_y = f_x / total - twist * (at.y - y), f_y / total + twist * (at.x - x)
            touch = work.touches[place]
            touch.share[0], touch.share[1] = touch.share[2] * t_x, touch.share[2] * t_y
            mu = min(touch.static, NO_CONE)
            least = min(least, (mu - math.sqrt(t_x * t_x + t_y * t_y)) * total)
    return least


@routine
def pair_margin(
    work: Workspace, first: int, last: int, f_x: float, f_y: float, torque: float
) -> float:
    """As `plane_margin`, of two touches.

    Args:
        f_x, f_y: the force of both.
        torque: about the normal, at the first.
    """
    frame = frame_of(work, first)
    side = on_support(frame, subtract(lever_of(work, last), lever_of(work, first)))
    length = math.sqrt(side.x * side.x + side.y * side.y)
    if length == 0.0:
        return 0.0
    e_x, e_y = side.x / length, side.y / length
    of_last = torque / length
    of_first = e_x * f_y - e_y * f_x - of_last
    for place in (first, last):
        across = of_first if place == first else of_last
        touch = work.touches[place]
        touch.share[0], touch.share[1] = -e_y * across, e_x * across
    along = e_x * f_x + e_y * f_y
    margin = margin_of_two(work, first, last, along)
    split_along(work, first, last, along, e_x, e_y)
    return margin


@kernel
def holds_at(work: Workspace, place: int, plane: int) -> bool:
    """Whether a touch carries and sticks on a plane."""
    return plane_of(work, place) == plane and sticks(work, place)


@routine
def put_back_at_walls(shape: SolidParameters, work: Workspace, y: Floats) -> None:
    """Put a state on its touches again, and end the velocities that they do not allow.

    Its rotation is a unit quaternion.
    """
    k, widest = work.mode.rows, 0.0
    q = axes_at(y)
    look_at_touches(shape, work, q, y)
    for i in range(k):
        place, component = work.kept[i, 0], work.kept[i, 1]
        write_row(work, i, place, component)
        gap = touch_gap(shape, work, q, y, place) if component == PRESSURE else 0.0
        work.system[i, k] = -gap
        widest = max(widest, abs(gap))
    shift, turn = impelled(shape, work)
    size = max(abs(shift.x), abs(shift.y), abs(shift.z))
    turns = shape.reach * max(abs(turn.x), abs(turn.y), abs(turn.z))
    if max(size, turns) <= MOST_SHIFT * widest:
        put(y, P, add(vec(y, P), on_support(q, shift)))
        turn_in_body(y, turn)
    end_velocities(shape, work, y)


@routine
def let_closed_carry(work: Workspace) -> None:
    """Let those touches carry that are closed."""
    for place in range(work.mode.touches):
        work.touches[place].carries = PULLS
    for k in range(work.mode.closed):
        work.touches[work.closed[k]].carries = PRESSES


@routine
def end_velocities(shape: SolidParameters, work: Workspace, y: Floats) -> None:
    """End the velocities that the rows do not allow, by the least change."""
    q, k = axes_at(y), work.mode.rows
    look_at_touches(shape, work, q, y)
    linear, spin = on_body(q, vec(y, V)), vec(y, W)
    for i in range(k):
        write_row(work, i, work.kept[i, 0], work.kept[i, 1])
        work.system[i, k] = -measured(work.rows[i], linear, spin)
    change, turn = impelled(shape, work)
    put(y, V, add(vec(y, V), on_support(q, change)))
    put(y, W, add(spin, turn))


@routine
def impelled(shape: SolidParameters, work: Workspace) -> tuple[Vec, Vec]:
    """The least change of v and ω (body frame) that gives the rows what they are to get."""
    k = work.mode.rows
    for i in range(k):
        work.solved[i] = 0.0
        for j in range(6):
            work.columns[i, j] = work.rows[i, j] if work.kept[i, 1] != PRESSURE else 0.0
    add_pressures(shape, work, work.state, False, ZERO)
    fill(shape, work, k)
    solve(work.system, k, work.solved)
    linear, torque = Vec(0.0, 0.0, 0.0), Vec(0.0, 0.0, 0.0)
    for i in range(k):
        linear = add(linear, times(work.solved[i], vec(work.columns[i], 0)))
        torque = add(torque, times(work.solved[i], vec(work.columns[i], 3)))
    return linear, applied(shape.mobility, torque)
