"""The mode of a solid that presses against a wall: its rows, its accelerations, and what ends it.

Of the constraints that the touches set, at most six are independent: `kept` names them, first the
pressures, then what holds from slipping on each plane (two forces at one touch, and a torque about
the normal where more of them carry and stick). The others follow from these, and carry nothing: of
many ways to share the reactions this is one, and the motion is the same for all.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.constraints import add_to, fill, free_turning, measured
from shaketable.physics.space.contacts import axes_at, turn_in_body
from shaketable.physics.space.linear import solve
from shaketable.physics.space.losses import resistance
from shaketable.physics.space.touches import (
    frame_of,
    lever_of,
    look_at_touches,
    plane_of,
    touch_gap,
    touch_slip,
    touch_velocity,
)
from shaketable.physics.space.vectors import (
    Axes,
    Vec,
    add,
    applied,
    cross,
    dot,
    on_body,
    on_support,
    times,
)
from shaketable.physics.space.workspace import (
    ALONG,
    CARRIES,
    CONE,
    KINETIC_AT,
    MOVES,
    PRESS,
    ROWS,
    STATIC_AT,
    TOUCHES,
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
# What a touch's CARRIES says: it carries, it may if it is independent of those that do, it follows
# from them, or it would pull.
PRESSES, MAY_PRESS, FOLLOWS, PULLS = 1.0, 0.5, 0.0, -1.0
INDEPENDENT = 1e-6  # square of what of a row must not follow from the others, by that of the row
MOST_SHIFT = (
    100.0  # times the largest gap: rows that would move a body farther are all but dependent
)
NO_CONE = 1e9  # m/s²


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

    `columns` holds the rows made orthogonal to one another in the body's mobility.
    """
    k = work.mode[ROWS]
    if k == 6:
        return False
    force, torque = row_of(work, place, component)
    size = dot(force, force) + dot(torque, applied(shape.mobility, torque))
    for i in range(k):
        other, turns = vec(work.columns[i], 0), vec(work.columns[i], 3)
        part = dot(other, force) + dot(turns, applied(shape.mobility, torque))
        force, torque = add(force, times(-part, other)), add(torque, times(-part, turns))
    left = dot(force, force) + dot(torque, applied(shape.mobility, torque))
    if left <= INDEPENDENT * size:
        return False
    one = 1.0 / math.sqrt(left)
    put(work.columns[k], 0, times(one, force))
    put(work.columns[k], 3, times(one, torque))
    work.kept[k, 0], work.kept[k, 1] = place, component
    work.mode[ROWS] = k + 1
    return True


@routine
def keep_sticking(shape: SolidParameters, work: Workspace) -> None:
    """Keep what holds the touches that carry and do not slip, plane by plane."""
    for plane in range(shape.walls + 1):
        first, count = -1, 0
        for place in range(work.mode[TOUCHES]):
            row = work.touches[place]
            if plane_of(work, place) == plane and row[CARRIES] > 0.0 and row[MOVES] == 0.0:
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
    n = work.mode[TOUCHES]
    work.mode[ROWS] = 0
    look_at_touches(shape, work, q, work.state)
    for first in (PRESSES, MAY_PRESS):
        for place in range(n):
            if work.touches[place, CARRIES] == first:
                kept = keep_row(shape, work, place, PRESSURE)
                work.touches[place, CARRIES] = PRESSES if kept else FOLLOWS
    keep_sticking(shape, work)


@routine
def react_at_walls(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec
) -> tuple[Vec, Vec]:
    """v̇ and ω̇ in the present mode; the reactions are written to `shares` and judged."""
    look_at_touches(shape, work, q, y)
    spin, k = vec(y, W), work.mode[ROWS]
    free = free_turning(shape, work, spin)
    resists = resistance(shape, q, spin)
    here = on_body(q, f)
    for i in range(k):
        place, component = work.kept[i, 0], work.kept[i, 1]
        write_row(work, i, place, component)
        for j in range(6):
            work.columns[i, j] = work.rows[i, j]
        touch, r = work.touches[place], lever_of(work, place)
        if component == PRESSURE:
            frame = frame_of(work, place)
            if touch[MOVES] > 0.0:
                x, z = touch_slip(shape, work, place, touch_velocity(work, q, y, place))
                mu = touch[KINETIC_AT]
                drag = add(times(-mu * x, frame.x), times(-mu * z, frame.y))
                add_to(work.columns, i, 1.0, drag, cross(r, drag))
            if plane_of(work, place) == 0:
                add_to(work.columns, i, 1.0, Vec(0.0, 0.0, 0.0), resists)
        own = cross(spin, add(cross(spin, r), vec(touch, ALONG)))
        bias = 0.0 if component == TURN else dot(vec(work.rows[i], 0), own)
        work.system[i, k] = -measured(work.rows[i], here, free) - bias
        work.solved[i] = 0.0
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
    for place in range(work.mode[TOUCHES]):
        put(work.shares[place], 0, Vec(0.0, 0.0, 0.0))
    least = NO_CONE
    for i in range(work.mode[ROWS]):
        if work.kept[i, 1] == PRESSURE:
            work.shares[work.kept[i, 0], 2] = work.solved[i]
            least = min(least, work.solved[i])
    work.judged[PRESS], work.judged[CONE] = least, NO_CONE
    for plane in range(shape.walls + 1):
        work.judged[CONE] = min(work.judged[CONE], plane_margin(work, plane))


@routine
def plane_margin(work: Workspace, plane: int) -> float:
    """The friction that is left on a plane, at the touch that has least of it [m/s²]; writes all.

    The touches that stick share it as pressure times a rigid field about its centre, which is one
    way to do so.
    """
    first, f_x, f_y, torque = -1, 0.0, 0.0, 0.0
    for i in range(work.mode[ROWS]):
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
    total, x, y = 0.0, 0.0, 0.0
    for place in range(work.mode[TOUCHES]):
        if holds_at(work, place, plane):
            at = on_support(frame_of(work, place), lever_of(work, place))
            share = work.shares[place, 2]
            total, x, y = total + share, x + share * at.x, y + share * at.y
    if total <= 0.0:
        return total - math.sqrt(f_x * f_x + f_y * f_y)
    x, y, second = x / total, y / total, 0.0
    origin = on_support(frame_of(work, first), lever_of(work, first))
    torque += (origin.x - x) * f_y - (origin.y - y) * f_x
    for place in range(work.mode[TOUCHES]):
        if holds_at(work, place, plane):
            at = on_support(frame_of(work, place), lever_of(work, place))
            second += work.shares[place, 2] * ((at.x - x) ** 2 + (at.y - y) ** 2)
    twist = torque / second if second > 0.0 else 0.0
    least = NO_CONE
    for place in range(work.mode[TOUCHES]):
        if holds_at(work, place, plane):
            at = on_support(frame_of(work, place), lever_of(work, place))
            t_x, t_y = f_x / total - twist * (at.y - y), f_y / total + twist * (at.x - x)
            share = work.shares[place, 2]
            work.shares[place, 0], work.shares[place, 1] = share * t_x, share * t_y
            mu = min(work.touches[place, STATIC_AT], NO_CONE)
            least = min(least, (mu - math.sqrt(t_x * t_x + t_y * t_y)) * total)
    return least


@kernel
def holds_at(work: Workspace, place: int, plane: int) -> bool:
    """Whether a touch carries and sticks on a plane."""
    touch = work.touches[place]
    return plane_of(work, place) == plane and touch[CARRIES] > 0.0 and touch[MOVES] == 0.0


@routine
def put_back_at_walls(shape: SolidParameters, work: Workspace, y: Floats) -> None:
    """Put a state on its touches again, and end the velocities that they do not allow.

    Its rotation is a unit quaternion.
    """
    k, widest = work.mode[ROWS], 0.0
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
    q = axes_at(y)
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
    k = work.mode[ROWS]
    for i in range(k):
        work.solved[i] = 0.0
        for j in range(6):
            work.columns[i, j] = work.rows[i, j]
    fill(shape, work, k)
    solve(work.system, k, work.solved)
    linear, torque = Vec(0.0, 0.0, 0.0), Vec(0.0, 0.0, 0.0)
    for i in range(k):
        linear = add(linear, times(work.solved[i], vec(work.columns[i], 0)))
        torque = add(torque, times(work.solved[i], vec(work.columns[i], 3)))
    return linear, applied(shape.mobility, torque)
