"""Impacts: the points on the support, struck together.

Newton's law at the points that close, complementary to their impulse, and Coulomb's disc. As with
forces, simple contacts that stick are tried first. Newton's law with friction can add energy (Kane
& Levinson 1985); e is then lowered to the largest value that adds none.
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
from shaketable.physics.space.constraints import arrest
from shaketable.physics.space.contacts import arm, axes_at, velocity
from shaketable.physics.space.modes import arrange
from shaketable.physics.space.rates import judge_side, limit, write_side
from shaketable.physics.space.vectors import (
    ZERO,
    Axes,
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
    CORNER,
    EDGE,
    STATE,
    STICKS,
    Floats,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)

ROUND_OFF = 1e-12  # of the largest speed
ENERGY_SLACK = 1e-12  # of the energy
HALVINGS = 40
SLIPS, STAYS, BOUNCES = range(3)  # what the points of an impact do


@kernel
def kinetic_energy(shape: SolidParameters, y: Floats) -> float:
    """Per unit mass [m²/s²]."""
    v, spin = vec(y, V), vec(y, W)
    return 0.5 * (dot(v, v) + dot(spin, applied(shape.inertia, spin)))


@kernel
def goal_of(shape: SolidParameters, speed: float, restitution: float) -> float:
    """Least normal velocity after the impact of a point with this one before."""
    return -restitution * speed if speed < -shape.limits.bounce else 0.0


@routine
def judge_impulses(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """Judge whether impulses where all sticks, in `solved`, press and keep to their cones."""
    z, n = work.solved, work.mode.closed
    rank = work.mode.kind
    if rank == CORNER:
        mu = work.points[work.closed[0]].static
        return z[0] >= 0.0 and math.sqrt(z[1] * z[1] + z[2] * z[2]) <= limit(mu, z[0])
    origin = work.closed[0]
    if rank == EDGE:
        return judge_side_impulses(shape, work, q)
    total, x, y = 0.0, 0.0, 0.0
    for place in range(n):
        share = 0.0
        for j in range(rank):
            share += work.basis[place, j] * z[j]
        if share < 0.0:
            return False
        work.shares[place, 2] = share
        point = work.closed[place]
        total += share
        x += share * work.points[point].x
        y += share * work.points[point].y
    if total <= 0.0:
        return False
    x, y = x / total, y / total
    # friction as a rigid field about the centre of the pressure, which is one way to share it
    to_x, to_y = work.points[origin].x - x, work.points[origin].y - y
    f_x = q.x.x * z[3] + q.y.x * z[4]  # in the body's frame
    f_y = q.x.y * z[3] + q.y.y * z[4]
    torque = z[5] + to_x * f_y - to_y * f_x
    second = 0.0
    for place in range(n):
        point = work.closed[place]
        dx, dy = work.points[point].x - x, work.points[point].y - y
        second += work.shares[place, 2] * (dx * dx + dy * dy)
    twist = torque / second
    for place in range(n):
        point = work.closed[place]
        dx, dy = work.points[point].x - x, work.points[point].y - y
        t_x, t_y = f_x / total - twist * dy, f_y / total + twist * dx
        if math.sqrt(t_x * t_x + t_y * t_y) > limit(work.points[point].static, 1.0):
            return False
    return True


@routine
def judge_side_impulses(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """Judge whether the impulses along a side press and keep to their cones."""
    z = work.solved
    for place in range(work.mode.closed):
        work.shares[place, 2] = z[0] + z[1] * work.basis[place, 1]
    write_side(shape, work, q)
    judge_side(work)
    return bool(min(work.judged.press, work.judged.cone) >= 0.0)


@routine
def try_impact(
    shape: SolidParameters,
    work: Workspace,
    q: Axes,
    before: Floats,
    restitution: float,
    slack: float,
) -> int:
    """Try an impact at the closed points alone, all of which stick; the state is left struck.

    Returns: STAYS or BOUNCES; 0 where it is no such impact.
    """
    y = work.state
    approaching, bouncing = False, 0
    for place in range(work.mode.closed):
        speed = velocity(shape, work, q, before, work.closed[place]).z
        approaching = approaching or speed < -slack
        bouncing += speed < -shape.limits.bounce
    if not approaching:
        return 0
    keep = restitution if bouncing == work.mode.closed else 0.0
    if restitution > 0.0 and 0 < bouncing < work.mode.closed:
        return 0
    for j in range(STATE):
        y[j] = before[j]
    arrange(shape, work, STICKS, 0)
    if not arrest(shape, work, q, y, keep) or not judge_impulses(shape, work, q):
        return 0
    for k in range(work.mode.near):
        point = work.near[k]
        if is_closed(work, point):
            continue
        least = goal_of(shape, velocity(shape, work, q, before, point).z, restitution)
        if velocity(shape, work, q, y, point).z < least - slack:
            return 0
    return BOUNCES if keep > 0.0 else STAYS


@routine
def strike(shape: SolidParameters, work: Workspace, before: Floats, restitution: float) -> int:
    """Change the state's velocities by the impact of all points on the support.

    Returns: SLIPS, STAYS or BOUNCES, what its points do.
    """
    q = axes_at(before)
    fastest = 0.0
    for k in range(work.mode.near):
        u = velocity(shape, work, q, before, work.near[k])
        fastest = max(fastest, abs(u.x), abs(u.y), abs(u.z))
    slack = ROUND_OFF * fastest
    close_all(work)
    how = try_impact(shape, work, q, before, restitution, slack)
    if how:
        return how
    if work.mode.near > 2:
        for k in range(shape.hull):
            if close_side(shape, work, k):
                how = try_impact(shape, work, q, before, restitution, slack)
                if how:
                    return how
    if work.mode.near > 2 and rim_is_near(shape, work):
        for k in range(work.mode.near - 1):
            close_with_rim(shape, work, k)
            how = try_impact(shape, work, q, before, restitution, slack)
            if how:
                return how
    if work.mode.near > 1:
        for k in range(work.mode.near):
            work.closed[0] = work.near[k]
            work.mode.closed = 1
            how = try_impact(shape, work, q, before, restitution, slack)
            if how:
                return how
    strike_together(shape, work, q, before, restitution)
    return SLIPS


@routine
def strike_together(
    shape: SolidParameters, work: Workspace, q: Axes, before: Floats, restitution: float
) -> None:
    """The impact where some point slips."""
    y = work.state
    for j in range(STATE):
        y[j] = before[j]
    close_all(work)
    for place in range(work.mode.closed):
        u = velocity(shape, work, q, before, work.closed[place])
        put(work.free[place], 0, u)
        work.goal[place] = goal_of(shape, u.z, restitution)
    if not balance(shape, work, q, False, ZERO):
        work.tally.fallbacks += 1.0
    linear, turn = summed(shape, work, q, ZERO)
    put(y, V, add(vec(y, V), linear))
    put(y, W, add(vec(y, W), turn))


@routine
def lose_spin(shape: SolidParameters, work: Workspace) -> None:
    """Multiply the spin that a rocking impact in the plane leaves by the restitution factor.

    As `plane.impact.lossy`: where some of the points on the support stay there and others leave,
    the middle of those that stay keeps its velocity u, and that of the centre of gravity follows.
    Where it slips, less spin would add energy below the share s = u·(ω × r)/(|ω × r|² + ω·I ω) of
    it: the factor is then raised to 2 s - 1.
    """
    if shape.factor == 1.0:
        return
    q, y, stay, middle = axes_at(work.state), work.state, 0, ZERO
    for k in range(work.mode.near):
        if velocity(shape, work, q, y, work.near[k]).z <= shape.limits.leaving:
            middle, stay = add(middle, arm(shape, work, work.near[k])), stay + 1
    if stay == 0 or stay == work.mode.near:
        return
    spin, r = vec(y, W), times(1.0 / stay, middle)
    turning = cross(spin, r)
    u = add(on_body(q, vec(y, V)), turning)
    size = dot(turning, turning) + dot(spin, applied(shape.inertia, spin))
    if size == 0.0:
        return
    factor = min(1.0, max(shape.factor, 2.0 * dot(u, turning) / size - 1.0))
    put(y, W, times(factor, spin))
    put(y, V, on_support(q, subtract(u, times(factor, turning))))


@routine
def collide(shape: SolidParameters, work: Workspace) -> None:
    """The impact of the points on the support, with the restitution that its energy allows."""
    before = work.trial
    for j in range(STATE):
        before[j] = work.state[j]
    how = strike(shape, work, before, shape.restitution)
    if (
        how == STAYS and shape.factor < 1.0 and not shape.planar
    ):  # the velocities that are left keep the contact
        for j in range(V, STATE):
            work.state[j] *= shape.factor
    if shape.restitution == 0.0:
        return
    allowed = kinetic_energy(shape, before) * (1.0 + ENERGY_SLACK)
    if kinetic_energy(shape, work.state) <= allowed:
        return
    work.tally.energy_cuts += 1.0
    low, high = 0.0, shape.restitution
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        strike(shape, work, before, middle)
        if kinetic_energy(shape, work.state) <= allowed:
            low = middle
        else:
            high = middle
    strike(shape, work, before, low)
