"""How points of different friction hold a base that lies flat, castors beside locked feet.

The pressures are those of least ΣN², as where the base slides, so that rest ends where sliding
begins. With them given, who slips is a convex question: the acceleration of the base in its plane
(two components and the turn, a) makes

    ½ (a - a_free)ᵀ M (a - a_free) + Σ μ_i N_i |a_i|

least, a_i being that of point i (Moreau 1966; Gauss's principle with friction). Its kinks, where a
point does not move, are rounded off, |a_i| → √(|a_i|² + ε²), and Newton's method follows the least
value as ε goes to EPSILON. Friction is -μ_i N_i a_i/√(|a_i|² + ε²). The pressures follow from the
total friction, and both are found in turn.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.closing import close_all
from shaketable.physics.space.cones import limit
from shaketable.physics.space.constraints import ROUND_OFF, react
from shaketable.physics.space.contacts import arm, closed_point, flat_margin
from shaketable.physics.space.modes import arrange
from shaketable.physics.space.vectors import Axes, Sym, Vec, on_support
from shaketable.physics.space.workspace import (
    FLAT,
    STICKS,
    SolidParameters,
    W,
    Workspace,
)

ITERATIONS = 20  # of pressures and friction, where points slip; at rest the first one suffices
EDGE_OF_BASE = 1e-13  # of the pressure: a resultant that is outside by less is on the edge
EPSILON, NARROWER = 1e-13, 0.05  # m/s²: of the last rounding, and the factor from one to the next
NEWTON, BACK = 30, 40  # most steps for one rounding, and most halvings of a step
CLOSE_ENOUGH = 1e-3  # of the rounding: a step that is shorter has converged
LEAST_STIFFNESS = 1e-15  # of what round-off may have taken from it
#: Of the largest acceleration, and in m/s²: a point that accelerates by less stays, where others
#: begin to move.
BEGINS, BEGINS_AT_LEAST = 1e-3, 1e-11


@kernel
def pressed(shape: SolidParameters, work: Workspace, total: float) -> bool:
    """Whether the pressures that are written have their resultant inside the base."""
    along, across, found = 0.0, 0.0, 0.0
    for place in range(work.mode.closed):
        touch = work.touches[place]
        share = touch.share[2]
        found += share
        along += share * work.points[touch.point].x
        across += share * work.points[touch.point].y
    inside = flat_margin(shape, work, found, along, across) >= -EDGE_OF_BASE * total
    return inside and abs(found - total) <= ROUND_OFF * total


@routine
def flat_grip(shape: SolidParameters, work: Workspace, q: Axes, f: Vec, iterations: int) -> float:
    """Find the friction of all points of a flat base, which slip on as they do; -1 if it lifts.

    Writes of each touch the friction and the pressure per unit mass to `share`, and its
    acceleration to `free` [m/s²]. The first iteration uses the pressures at rest; the others run
    only if a point slips.

    Returns: the largest acceleration of a point that does not slip yet [m/s²].
    """
    n = work.mode.near
    close_all(shape, work)
    arrange(shape, work, STICKS, 0)
    if work.mode.kind != FLAT or f.z >= 0.0:
        return -1.0
    pull_x, pull_y, left, moving = -f.x, -f.y, 0.0, 0
    for place in range(n):
        moving += work.touches[place].moves
    # a base that sticks is turned about its first point by the spin: what that takes is left out
    spin2, r = work.state[W + 2] ** 2, on_support(q, arm(shape, work, closed_point(work, 0)))
    for iteration in range(iterations):
        react(shape, work, q, work.state, Vec(spin2 * r.x - pull_x, spin2 * r.y - pull_y, f.z))
        if not pressed(shape, work, -f.z):
            return -1.0
        left = share_friction(shape, work, q, f)
        # the body stays at rest under these pressures
        if moving == 0 and iteration == 0 and left <= shape.limits.starting:
            break
        before_x, before_y = pull_x, pull_y
        pull_x, pull_y = 0.0, 0.0
        for place in range(n):
            pull_x += work.touches[place].share[0]
            pull_y += work.touches[place].share[1]
        if abs(pull_x - before_x) + abs(pull_y - before_y) <= ROUND_OFF * -f.z:
            break
    return left


@kernel
def most(work: Workspace, place: int) -> float:
    """The friction that a touch can hold."""
    touch = work.touches[place]
    return limit(touch.static, max(touch.share[2], 0.0))


@routine
def share_friction(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> float:
    """Find the friction under given pressures; return the largest acceleration that is left.

    The unknowns are the acceleration of the point with the largest limit of friction, which is the
    origin, and the angular acceleration: about another origin, the stiff term of that point would
    hide all else in round-off.
    """
    n, spin2, inertia = work.mode.closed, work.state[W + 2] ** 2, shape.inertia.zz
    # without the friction of points that stay: `away` is the acceleration, `torque` per unit mass
    away_x, away_y, torque, origin = f.x, f.y, 0.0, 0
    if shape.straps > 0:
        torque = work.torque[2]
    for place in range(n):
        touch = work.touches[place]
        r = on_support(q, arm(shape, work, touch.point))
        if touch.moves:
            size = touch.kinetic * max(touch.share[2], 0.0)
            x, y = -size * touch.slip_x, -size * touch.slip_y
            touch.share[0], touch.share[1] = x, y
            away_x += x
            away_y += y
            torque += r.x * y - r.y * x
        elif work.touches[origin].moves or most(work, place) > most(work, origin):
            origin = place
    o = on_support(q, arm(shape, work, work.touches[origin].point))
    # a: of the origin, and angular [rad/s²]; begun as if nothing held
    angular = torque / inertia
    a_x, a_y = away_x - angular * o.y - spin2 * o.x, away_y + angular * o.x - spin2 * o.y
    epsilon = max(1.0, abs(a_x), abs(a_y))
    while True:
        epsilon = max(EPSILON, NARROWER * epsilon)
        for _ in range(NEWTON):
            g_x, g_y, g_t, k = slopes(shape, work, q, o, away_x, away_y, torque, a_x, a_y, angular,
                                      epsilon)  # fmt: skip
            d_x, d_y, d_t = newton_step(k, g_x, g_y, g_t)
            first = g_x * d_x + g_y * d_y + g_t * d_t
            part = 1.0
            for _ in range(BACK):
                h_x, h_y, h_t, _k = slopes(
                    shape, work, q, o, away_x, away_y, torque,
                    a_x + part * d_x, a_y + part * d_y, angular + part * d_t, epsilon,
                )  # fmt: skip
                # past the least value along the step the slope is positive
                if h_x * d_x + h_y * d_y + h_t * d_t <= -0.5 * first:
                    break
                part *= 0.5
            a_x, a_y, angular = a_x + part * d_x, a_y + part * d_y, angular + part * d_t
            moved = part * max(abs(d_x), abs(d_y), shape.reach * abs(d_t))
            if moved <= CLOSE_ENOUGH * epsilon:
                break
        if epsilon <= EPSILON:
            break
    left = 0.0
    for place in range(n):
        touch = work.touches[place]
        r = on_support(q, arm(shape, work, touch.point))
        u_x = a_x - angular * (r.y - o.y) - spin2 * (r.x - o.x)
        u_y = a_y + angular * (r.x - o.x) - spin2 * (r.y - o.y)
        touch.free[0], touch.free[1] = u_x, u_y
        if not touch.moves:
            size = math.sqrt(u_x * u_x + u_y * u_y)
            part = most(work, place) / math.sqrt(size * size + epsilon * epsilon)
            touch.share[0], touch.share[1] = -part * u_x, -part * u_y
            left = max(left, size)
    return left


@routine
def slopes(
    shape: SolidParameters,
    work: Workspace,
    q: Axes,
    o: Vec,
    away_x: float,
    away_y: float,
    torque: float,
    a_x: float,
    a_y: float,
    angular: float,
    epsilon: float,
) -> tuple[float, float, float, Sym]:
    """Gradient and second derivatives of what is to be least, for its three unknowns."""
    spin2, inertia = work.state[W + 2] ** 2, shape.inertia.zz
    # of the centre of gravity, from that of the origin
    c_x, c_y = (
        a_x + angular * o.y + spin2 * o.x - away_x,
        a_y - angular * o.x + spin2 * o.y - away_y,
    )
    g_x, g_y = c_x, c_y
    g_t = c_x * o.y - c_y * o.x + inertia * angular - torque
    xx, yy, tt = 1.0, 1.0, inertia + o.x * o.x + o.y * o.y
    xy, xt, yt = 0.0, o.y, -o.x
    for place in range(work.mode.closed):
        touch = work.touches[place]
        if touch.moves:
            continue
        r = on_support(q, arm(shape, work, touch.point))
        x, y = r.x - o.x, r.y - o.y
        u_x, u_y = a_x - angular * y - spin2 * x, a_y + angular * x - spin2 * y
        size = math.sqrt(u_x * u_x + u_y * u_y + epsilon * epsilon)
        weight = most(work, place) / size
        g_x += weight * u_x
        g_y += weight * u_y
        g_t += weight * (x * u_y - y * u_x)
        u_x, u_y = u_x / size, u_y / size
        p, s, w = weight * (1.0 - u_x * u_x), weight * (1.0 - u_y * u_y), -weight * u_x * u_y
        xx += p
        yy += s
        xy += w
        xt += -p * y + w * x
        yt += -w * y + s * x
        tt += p * y * y + s * x * x - 2.0 * w * x * y
    return g_x, g_y, g_t, Sym(xx, yy, tt, xy, xt, yt)


@kernel
def newton_step(k: Sym, g_x: float, g_y: float, g_t: float) -> tuple[float, float, float]:
    """-K⁻¹ g by Cholesky's method, of the turn last: K is positive definite."""
    xy, xt = k.xy / k.xx, k.xz / k.xx
    yy = k.yy - xy * k.xy
    yt = (k.yz - xy * k.xz) / yy
    tt = max(k.zz - xt * k.xz - yt * yt * yy, LEAST_STIFFNESS * k.zz)
    b_x, b_y = -g_x, -g_y + xy * g_x
    b_t = -g_t - xt * b_x - yt * b_y
    d_t = b_t / tt
    d_y = b_y / yy - yt * d_t
    d_x = b_x / k.xx - xy * d_y - xt * d_t
    return d_x, d_y, d_t


@routine
def slip_with_grip(shape: SolidParameters, work: Workspace, left: float) -> None:
    """Mark as slipping every point that `flat_grip` accelerates above the threshold."""
    for place in range(work.mode.closed):
        touch = work.touches[place]
        x, y = touch.free[0], touch.free[1]
        size = math.sqrt(x * x + y * y)
        if not touch.moves and size > max(BEGINS * left, BEGINS_AT_LEAST):
            touch.moves = 1
            touch.slip_x, touch.slip_y = x / size, y / size
