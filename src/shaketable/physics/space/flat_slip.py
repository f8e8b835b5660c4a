"""Accelerations of a base that lies flat and slips with all of its points.

It has three degrees of freedom; where it does not turn and all points have the same friction two,
and needs no reactions: they all point one way, whoever bears how much of the weight. The reactions
are those of `react` of `constraints`, found by three equations: that it neither rises nor tips.
"""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.space.constraints import carried, carry_all, pulls, share_pressure
from shaketable.physics.space.contacts import arm, flat_margin, slip_direction
from shaketable.physics.space.linear import solve
from shaketable.physics.space.losses import resistance
from shaketable.physics.space.vectors import Axes, Vec, add, cross
from shaketable.physics.space.workspace import (
    Floats,
    Q,
    SolidParameters,
    V,
    W,
    Workspace,
    vec,
)

# What `effects` holds of a unit of pressure at a place: the rows of the three equations, the
# friction along x and y of the support, and the torque about the normal.
RISES, TIPS, TIPS_ASIDE, FRICTION, FRICTION_ASIDE, TURNS = range(6)
EQUATIONS = 3


@kernel
def is_upright(y: Floats) -> bool:
    """Whether a body stands upright and turns about the normal alone."""
    return bool(y[Q + 1] == 0.0 and y[Q + 2] == 0.0 and y[W] == 0.0 and y[W + 1] == 0.0)


@routine
def slides_straight(shape: SolidParameters, work: Workspace, y: Floats) -> bool:
    """Whether the points of a flat base that slips are alike: one friction, one velocity."""
    alone = shape.uniform and shape.straps == 0 and work.mode.closed == shape.contacts
    if not alone or y[W + 2] != 0.0:
        return False
    if y[V] * y[V] + y[V + 1] * y[V + 1] > shape.limits.turning * shape.limits.turning:
        return True
    first, same = work.touches[work.closed[0]], True  # friction opposes the slip that each began
    for k in range(1, work.mode.closed):
        touch = work.touches[work.closed[k]]
        same = same and touch.slip_x == first.slip_x and touch.slip_y == first.slip_y
    return same


@routine
def slide_straight(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec
) -> tuple[Vec, float]:
    """v̇ of a base that slides without turning, and how sure its contact is [m/s²].

    It is negative where the base does not stay flat.
    """
    place, total = work.closed[0], -f.z
    mu = work.touches[place].kinetic
    x, z = slip_direction(shape, work, place, vec(y, V))
    linear = Vec(f.x - mu * total * x, f.y - mu * total * z, 0.0)
    if shape.h * mu <= shape.inscribed:  # it cannot tip, whatever the direction
        return linear, min(total, total * (shape.inscribed - shape.h * mu) / shape.reach)
    size = shape.h * mu * total  # the middle of the pressures is ahead of the foot
    along, across = q.x.x * x + q.y.x * z, q.x.y * x + q.y.y * z
    return linear, flat_margin(shape, work, total, size * along, size * across)


@routine
def share_evenly(work: Workspace, total: float) -> None:
    """Write some pressures of a base that slides without turning: none is pulled."""
    share = total / work.mode.closed
    for k in range(work.mode.closed):
        work.touches[work.closed[k]].share[2] = share


@routine
def slide_and_turn(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec
) -> tuple[Vec, float, bool]:
    """v̇ and ω̇ about the normal, and whether pressures without a pull were found.

    They are written to the shares.
    """
    n, inertia, spin = work.mode.closed, shape.inertia, y[W + 2]
    write_wrenches(shape, work, q, y)
    # the moments that turn it about the normal alone are those of inertia: I ω̇ + ω × I ω
    tips, aside = -spin * spin * inertia.yz, spin * spin * inertia.xz
    pulled = 0.0
    if shape.straps > 0:
        pulled = work.torque[2]
        tips -= work.torque[0] - inertia.xz / inertia.zz * pulled
        aside -= work.torque[1] - inertia.yz / inertia.zz * pulled
    found = False
    carry_all(work)
    for _ in range(n + 1):
        sum_effects(work)
        work.system[RISES, 3], work.system[TIPS, 3], work.system[TIPS_ASIDE, 3] = -f.z, tips, aside
        if not solve(work.system, EQUATIONS, work.solved):
            break
        if not share_pressure(work):
            found = not pulls(work)
            break
        if not carried(work):
            break
    linear_x, linear_y, torque = f.x, f.y, pulled
    for k in range(n):
        share = work.touches[work.closed[k]].share[2]
        linear_x += share * work.effects[k, FRICTION]
        linear_y += share * work.effects[k, FRICTION_ASIDE]
        torque += share * work.effects[k, TURNS]
    return Vec(linear_x, linear_y, 0.0), torque / inertia.zz, found


@kernel
def sum_effects(work: Workspace) -> None:
    """Write to `system` what each of the three ways to share pressure does to each equation.

    In nine sums at once: loops over rows and columns would read each touch nine times.
    """
    rise_0 = rise_1 = rise_2 = tip_0 = tip_1 = tip_2 = lean_0 = lean_1 = lean_2 = 0.0
    for k in range(work.mode.closed):
        touch, effect = work.touches[work.closed[k]], work.effects[k]
        if touch.active:
            rise, tip, lean = effect[RISES], effect[TIPS], effect[TIPS_ASIDE]
            a, b, c = touch.basis[0], touch.basis[1], touch.basis[2]
            rise_0, rise_1, rise_2 = rise_0 + rise * a, rise_1 + rise * b, rise_2 + rise * c
            tip_0, tip_1, tip_2 = tip_0 + tip * a, tip_1 + tip * b, tip_2 + tip * c
            lean_0, lean_1, lean_2 = (
                lean_0 + lean * a,
                lean_1 + lean * b,
                lean_2 + lean * c,
            )
    system = work.system
    system[RISES, 0], system[RISES, 1], system[RISES, 2] = rise_0, rise_1, rise_2
    system[TIPS, 0], system[TIPS, 1], system[TIPS, 2] = tip_0, tip_1, tip_2
    system[TIPS_ASIDE, 0], system[TIPS_ASIDE, 1], system[TIPS_ASIDE, 2] = lean_0, lean_1, lean_2


@routine
def write_wrenches(shape: SolidParameters, work: Workspace, q: Axes, y: Floats) -> None:
    """Write to `effects` what a unit of pressure does at each closed touch."""
    inertia, resists, spin = shape.inertia, resistance(shape, q, vec(y, W)), y[W + 2]
    for k in range(work.mode.closed):
        place = work.closed[k]
        point, mu = work.touches[place].point, work.touches[place].kinetic
        r = arm(shape, work, point)
        across, along = -spin * r.y, spin * r.x  # it turns about the normal alone
        u = Vec(
            y[V] + (q.x.x * across + q.x.y * along),
            y[V + 1] + (q.y.x * across + q.y.y * along),
            0.0,
        )
        x, z = slip_direction(shape, work, place, u)
        rubs_x, rubs_y = -mu * x, -mu * z
        ahead = rubs_x * q.x.x + rubs_y * q.y.x
        aside = rubs_x * q.x.y + rubs_y * q.y.y
        torque = add(cross(r, Vec(ahead, aside, 1.0)), resists)
        effect = work.effects[k]
        effect[RISES] = 1.0
        effect[TIPS] = torque.x - inertia.xz / inertia.zz * torque.z
        effect[TIPS_ASIDE] = torque.y - inertia.yz / inertia.zz * torque.z
        effect[FRICTION], effect[FRICTION_ASIDE] = rubs_x, rubs_y
        effect[TURNS] = torque.z
