"""Reactions of all touches together, on the support and on walls: forces, and impulses.

As `complementarity` does for points on the support: one touch after the other until nothing changes
(a nonlinear block Gauss-Seidel), each exactly. Accelerations and velocities are in the body's frame
here, in which the levers stand still.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.complementarity import (
    FEWER_SWEEPS,
    MAX_UNCONVERGED,
    SWEEPS,
    one_reaction,
    own_response,
    slipping,
)
from shaketable.physics.space.constraints import measured
from shaketable.physics.space.contacts import axes_at
from shaketable.physics.space.impact import ENERGY_SLACK, HALVINGS, kinetic_energy
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
    Sym,
    Vec,
    add,
    applied,
    cross,
    inverse,
    on_body,
    on_support,
    subtract,
    times,
)
from shaketable.physics.space.walled import (
    DEPENDENT,
    PRESSES,
    PRESSURE,
    impelled,
    judge_touches,
    write_mode,
    write_row,
)
from shaketable.physics.space.workspace import (
    STATE,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)

# Of the largest acceleration or velocity. A solve for forces only selects a mode.
CONVERGED_FORCES, CONVERGED = 1e-8, 1e-10
CREEP_SWEEPS = 30  # in each step of the time stepping
SOON = 24  # sweeps, after which each touch is solved exactly
HOLD_SWEEPS = 200
STUCK = 1e-4  # of the largest acceleration: reactions that change by less have come to an end


@routine
def balance_touches(
    shape: SolidParameters, work: Workspace, forces: bool, resists: Vec, sweeps: int
) -> bool:
    """Find the reactions of all touches; return whether they converged.

    Takes `free` and `goal` of each touch, as `complementarity.balance` does, begins with the
    reactions in `shares` and leaves them there, along each touch's frame. Their effect on v and ω
    (body frame) is written to `change`.

    Args:
        forces: as there.
        resists: the torque against rolling and drilling for a unit of pressure on the support.
        sweeps: at most so many.
    """
    n = work.mode.touches
    largest = 0.0
    linear, turn = Vec(0.0, 0.0, 0.0), Vec(0.0, 0.0, 0.0)
    for place in range(n):
        write_own(shape, work, place)
        linear, turn = with_reaction(
            shape, work, place, vec(work.shares[place], 0), resists, linear, turn
        )
        for j in range(3):
            largest = max(largest, abs(work.free[place, j]))
    close = (CONVERGED_FORCES if forces else CONVERGED) * largest
    found = False
    for sweep in range(sweeps):
        change = 0.0
        for place in range(n):
            local, touch = work.local[place], work.touches[place]
            own = Sym(local[0], local[1], local[2], local[3], local[4], local[5])
            before = vec(work.shares[place], 0)
            moved = add(linear, cross(turn, lever_of(work, place)))
            now = add(vec(work.free[place], 0), on_support(frame_of(work, place), moved))
            free = subtract(now, applied(own, before))
            goal, kinetic = work.goal[place], touch.kinetic
            if forces and touch.moves > 0:
                after = Vec(0.0, 0.0, 0.0)
                if free.z < goal:
                    x, y = touch.slip_x, touch.slip_y
                    after = slipping(own, free, goal, kinetic, x, y)
                    if after.z < 0.0:  # Painlevé: take the frictionless one
                        after = slipping(own, free, goal, 0.0, 1.0, 0.0)
            else:
                static = touch.static
                after = soon_reaction(own, free, goal, static, kinetic, before)
                if after.z < 0.0 or sweep >= SOON:
                    after = one_reaction(own, free, goal, static, kinetic, before)
            put(work.shares[place], 0, after)
            difference = subtract(after, before)
            linear, turn = with_reaction(shape, work, place, difference, resists, linear, turn)
            effect = applied(own, difference)
            change = max(change, abs(effect.x), abs(effect.y), abs(effect.z))
        if change <= close:
            found = True
            break
    put(work.change, 0, linear)
    put(work.change, 3, turn)
    return found


@routine
def write_own(shape: SolidParameters, work: Workspace, place: int) -> None:
    """Write the response of a touch to its own reaction, along its frame."""
    own = own_response(shape, frame_of(work, place), lever_of(work, place))
    local = work.local[place]
    local[0], local[1], local[2] = own.xx, own.yy, own.zz
    local[3], local[4], local[5] = own.xy, own.xz, own.yz


@routine
def soon_reaction(
    own: Sym, free: Vec, goal: float, static: float, kinetic: float, before: Vec
) -> Vec:
    """Nearly what `one_reaction` finds, and it where nothing changes any more; N < 0 for none.

    A slip's direction is halfway between the one before and that of the slip which follows from
    friction against it; this twice.
    """
    if free.z >= goal:
        return Vec(0.0, 0.0, 0.0)
    held = applied(inverse(own), Vec(-free.x, -free.y, goal - free.z))
    size = math.sqrt(held.x * held.x + held.y * held.y)
    if held.z >= 0.0 and (static == math.inf or size <= static * held.z):
        return held
    x, y = -before.x, -before.y
    size = math.sqrt(x * x + y * y)
    if size == 0.0:
        x, y = free.x, free.y
        size = math.sqrt(x * x + y * y)
    after = Vec(0.0, 0.0, -1.0)
    if kinetic == math.inf:
        return after
    for _ in range(2):
        if size == 0.0:
            return Vec(0.0, 0.0, -1.0)
        after = slipping(own, free, goal, kinetic, x / size, y / size)
        if after.z < 0.0:
            return after
        u = add(free, applied(own, after))
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        if speed == 0.0:
            return Vec(0.0, 0.0, -1.0)
        x, y = x / size + u.x / speed, y / size + u.y / speed  # halfway: it might alternate
        size = math.sqrt(x * x + y * y)
    return after


@routine
def with_reaction(
    shape: SolidParameters,
    work: Workspace,
    place: int,
    reaction: Vec,
    resists: Vec,
    linear: Vec,
    turn: Vec,
) -> tuple[Vec, Vec]:
    """Changes of v and ω (body frame) with those from one more reaction, along a touch's frame."""
    force = on_body(frame_of(work, place), reaction)
    torque = cross(lever_of(work, place), force)
    if plane_of(work, place) == 0:
        torque = add(torque, times(reaction.z, resists))
    return add(linear, force), add(turn, applied(shape.mobility, torque))


@routine
def try_holding_touches(shape: SolidParameters, work: Workspace, small: float) -> bool:
    """Try whether reactions inside the touches' cones leave no acceleration.

    The least acceleration (in the metric of the mass) over a product of cones is a convex problem:
    one block after the other, exactly where its reaction sticks, else by a projected gradient.

    Args:
        small: an acceleration that is none [m/s²].
    """
    n = work.mode.touches
    linear, turn = Vec(0.0, 0.0, 0.0), Vec(0.0, 0.0, 0.0)
    for place in range(n):
        write_own(shape, work, place)
        put(work.shares[place], 0, ZERO)
    for _ in range(HOLD_SWEEPS):
        change, most = 0.0, 0.0
        for place in range(n):
            local, touch = work.local[place], work.touches[place]
            own = Sym(local[0], local[1], local[2], local[3], local[4], local[5])
            before = vec(work.shares[place], 0)
            moved = add(linear, cross(turn, lever_of(work, place)))
            now = add(vec(work.free[place], 0), on_support(frame_of(work, place), moved))
            most = max(most, abs(now.x), abs(now.y), abs(now.z))
            after = subtract(before, applied(inverse(own), now))
            if not in_cone(after, touch.static):
                step = 1.0 / (own.xx + own.yy + own.zz)
                after = to_cone(subtract(before, times(step, now)), touch.static)
            put(work.shares[place], 0, after)
            difference = subtract(after, before)
            linear, turn = with_reaction(shape, work, place, difference, ZERO, linear, turn)
            change = max(change, abs(difference.x), abs(difference.y), abs(difference.z))
        if most <= small or change <= STUCK * most:
            break
    return most <= small


@kernel
def in_cone(reaction: Vec, mu: float) -> bool:
    size = math.sqrt(reaction.x * reaction.x + reaction.y * reaction.y)
    return reaction.z >= 0.0 and (mu == math.inf or size <= mu * reaction.z)


@routine
def to_cone(a: Vec, mu: float) -> Vec:
    """The nearest reaction within Coulomb's cone."""
    if in_cone(a, mu):
        return a
    if mu == math.inf:
        return Vec(a.x, a.y, 0.0)
    size = math.sqrt(a.x * a.x + a.y * a.y)
    if mu * size <= -a.z:
        return Vec(0.0, 0.0, 0.0)
    normal = (a.z + mu * size) / (1.0 + mu * mu)
    along = mu * normal / size if size > 0.0 else 0.0
    return Vec(along * a.x, along * a.y, normal)


@routine
def strike_touches(shape: SolidParameters, work: Workspace, share: float, within: float) -> None:
    """Change the state's velocities by the impact of all touches; those before are in `trial`.

    Args:
        share: of each plane's restitution.
        within: time in which what has a gap may close it [s]; 0 where all are closed.
    """
    before, y = work.trial, work.state
    for j in range(STATE):
        y[j] = before[j]
    q = axes_at(before)
    look_at_touches(shape, work, q, before)
    for place in range(work.mode.touches):
        u = touch_velocity(work, q, before, place)
        put(work.free[place], 0, u)
        put(work.shares[place], 0, ZERO)
        restitution = share * work.planes[plane_of(work, place)].restitution
        work.goal[place] = -restitution * u.z if u.z < -shape.limits.bounce else 0.0
        if within > 0.0:
            work.goal[place] = -max(touch_gap(shape, work, q, before, place), 0.0) / within
    if within == 0.0 and try_sticking_impact(shape, work, q):
        return
    sweeps = SWEEPS if work.tally.fallbacks < MAX_UNCONVERGED else FEWER_SWEEPS
    sweeps = sweeps if within == 0.0 else CREEP_SWEEPS
    if not balance_touches(shape, work, False, ZERO, sweeps):
        work.tally.fallbacks += 1.0
    put(y, V, add(vec(y, V), on_support(q, vec(work.change, 0))))
    put(y, W, add(vec(y, W), vec(work.change, 3)))


@routine
def try_sticking_impact(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """Try an impact in which the touches that approach stick; the state is struck if it is one."""
    before, y, slowest = work.trial, work.state, 0.0
    for place in range(work.mode.touches):
        touch = work.touches[place]
        slowest = max(slowest, -work.free[place, 2])
        touch.moves = 0
        touch.carries = PRESSES if work.free[place, 2] < work.goal[place] else DEPENDENT
    slack = CONVERGED * slowest
    write_mode(shape, work, q)
    k = work.mode.rows
    for i in range(k):
        place, component = work.kept[i, 0], work.kept[i, 1]
        write_row(work, i, place, component)
        goal = work.goal[place] if component == PRESSURE else 0.0
        linear, spin = on_body(q, vec(before, V)), vec(before, W)
        work.system[i, k] = goal - measured(work.rows[i], linear, spin)
    change, turn = impelled(shape, work)
    judge_touches(shape, work)
    if work.judged.press < 0.0 or work.judged.cone < 0.0:
        for place in range(work.mode.touches):
            put(work.shares[place], 0, ZERO)
        return False
    put(y, V, add(vec(before, V), on_support(q, change)))
    put(y, W, add(vec(before, W), turn))
    found = True
    for place in range(work.mode.touches):
        u = touch_velocity(work, q, y, place)
        slips = max(abs(u.x), abs(u.y)) > slack and work.touches[place].carries > 0
        found = found and u.z >= work.goal[place] - slack and not slips
    if not found:
        for j in range(V, STATE):
            y[j] = before[j]
        for place in range(work.mode.touches):
            put(work.shares[place], 0, ZERO)
    return found


@routine
def collide_touches(shape: SolidParameters, work: Workspace) -> None:
    """The impact of all touches, with the share of the restitutions that its energy allows."""
    before = work.trial
    for j in range(STATE):
        before[j] = work.state[j]
    strike_touches(shape, work, 1.0, 0.0)
    allowed = kinetic_energy(shape, before) * (1.0 + ENERGY_SLACK)
    if kinetic_energy(shape, work.state) <= allowed:
        return
    work.tally.energy_cuts += 1.0
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        strike_touches(shape, work, middle, 0.0)
        if kinetic_energy(shape, work.state) <= allowed:
            low = middle
        else:
            high = middle
    strike_touches(shape, work, low, 0.0)
