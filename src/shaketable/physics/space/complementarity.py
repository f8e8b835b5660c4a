"""Reactions of all closed points together, where no simple mode is admissible.

Signorini's condition and Coulomb's disc at each point, solved one point after the other until
nothing changes (a nonlinear block Gauss-Seidel; Jourdan, Alart & Jean 1998), each point exactly.
The same for forces, where `free` is what the accelerations of the points would be without
reactions, and for impulses, where it is their velocities.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import arm
from shaketable.physics.space.vectors import (
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
from shaketable.physics.space.workspace import (
    SolidParameters,
    Workspace,
    put,
    vec,
)

# A solve for forces only selects the mode (who slips, who leaves): the rates of that mode then give
# the accelerations exactly. Impulses are used as they are found.
SWEEPS = 500
#: After so many solves of a run that did not converge, limit later ones to so many sweeps.
MAX_UNCONVERGED, FEWER_SWEEPS = 100.0, 50
CONVERGED_FORCES, CONVERGED = 1e-9, 1e-11  # of the largest acceleration or velocity
DIRECTIONS = 24  # tried for the slip of a point, before the best are refined
REFINEMENTS = 60
TURN = 2.0 * math.pi / DIRECTIONS


@kernel
def response(shape: SolidParameters, q: Axes, r: Vec, at: Vec, reaction: Vec) -> Vec:
    """The change at the point `at` from a reaction per unit mass at r, both in the support's frame.

    It is an acceleration [m/s²] for a force, and a velocity [m/s] for an impulse.
    """
    turn = applied(shape.mobility, cross(r, on_body(q, reaction)))
    return add(reaction, on_support(q, cross(turn, at)))


@kernel
def own_response(shape: SolidParameters, q: Axes, r: Vec) -> Sym:
    x = response(shape, q, r, r, Vec(1.0, 0.0, 0.0))
    y = response(shape, q, r, r, Vec(0.0, 1.0, 0.0))
    z = response(shape, q, r, r, Vec(0.0, 0.0, 1.0))
    return Sym(x.x, y.y, z.z, x.y, x.z, y.z)


@kernel
def slipping(own: Sym, free: Vec, goal: float, mu: float, x: float, y: float) -> Vec:
    """The reaction of a point that slips along (x, y), N < 0 where there is none."""
    per = own.zz - mu * (own.xz * x + own.yz * y)
    if per <= 0.0:
        return Vec(0.0, 0.0, -1.0)
    n = (goal - free.z) / per
    return Vec(-mu * n * x, -mu * n * y, n)


@kernel
def askew(own: Sym, free: Vec, goal: float, mu: float, angle: float) -> tuple[float, float]:
    """Across and along a direction: the slip that follows if friction opposes that direction."""
    x, y = math.cos(angle), math.sin(angle)
    reaction = slipping(own, free, goal, mu, x, y)
    if reaction.z < 0.0:
        return 1.0, -1.0
    u = add(free, applied(own, reaction))
    return x * u.y - y * u.x, x * u.x + y * u.y


@routine
def slip_angle(own: Sym, free: Vec, goal: float, mu: float, guess: float) -> tuple[float, bool]:
    """The direction along which a point slips against its own friction, nearest to a guess."""
    for k in range(DIRECTIONS // 2 + 1):
        for sign in (1.0, -1.0):
            low, high = guess + sign * (k - 0.5) * TURN, guess + sign * (k + 0.5) * TURN
            at_low = askew(own, free, goal, mu, low)[0]
            at_high = askew(own, free, goal, mu, high)[0]
            if at_low * at_high > 0.0:
                continue
            kept = 0
            for _ in range(REFINEMENTS):  # regula falsi (Illinois)
                middle = (
                    high - at_high * (high - low) / (at_high - at_low)
                    if (at_high != at_low)
                    else 0.5 * (low + high)
                )
                here = askew(own, free, goal, mu, middle)[0]
                if here == 0.0 or abs(high - low) < 1e-15:
                    low = high = middle
                    break
                if here * at_low > 0.0:
                    low, at_low = middle, here
                    if kept == 1:
                        at_high *= 0.5
                    kept = 1
                else:
                    high, at_high = middle, here
                    if kept == -1:
                        at_low *= 0.5
                    kept = -1
            angle = high if abs(at_high) < abs(at_low) else low
            across, along = askew(own, free, goal, mu, angle)
            if along >= 0.0 and abs(across) <= 1e-6 * (abs(along) + abs(free.x) + abs(free.y)):
                return angle, True
    return guess, False


@routine
def one_reaction(
    own: Sym, free: Vec, goal: float, static: float, kinetic: float, before: Vec
) -> Vec:
    """The reaction of one point: none, one that sticks, or one that slips."""
    if free.z >= goal:
        return Vec(0.0, 0.0, 0.0)
    held = applied(inverse(own), Vec(-free.x, -free.y, goal - free.z))
    size = math.sqrt(held.x * held.x + held.y * held.y)
    if held.z >= 0.0 and (static == math.inf or size <= static * held.z):
        return held
    if kinetic == math.inf:
        return Vec(0.0, 0.0, max(0.0, (goal - free.z) / own.zz))
    if kinetic == 0.0:
        return Vec(0.0, 0.0, (goal - free.z) / own.zz)
    if before.x != 0.0 or before.y != 0.0:
        guess = math.atan2(-before.y, -before.x)
    else:
        guess = math.atan2(-held.y, -held.x) if size > 0.0 else 0.0
    angle, found = slip_angle(own, free, goal, kinetic, guess)
    if found:
        return slipping(own, free, goal, kinetic, math.cos(angle), math.sin(angle))
    if held.z > 0.0:  # between static and kinetic friction: scale the sticking force to μ_k N
        share = kinetic * held.z / size
        return Vec(share * held.x, share * held.y, held.z)
    return Vec(0.0, 0.0, max(0.0, (goal - free.z) / own.zz))


@routine
def balance(shape: SolidParameters, work: Workspace, q: Axes, forces: bool, resists: Vec) -> bool:
    """Find the reactions of all closed points; return whether they converged.

    Takes `free`, the change without reactions, and `goal`, the least normal component afterwards,
    of each closed place; writes the reactions to `shares`.

    Args:
        forces: True for accelerations [m/s²], where a point that already slips keeps its
            direction; False for velocities [m/s].
        resists: the torque against rolling and drilling for a unit of pressure. A point's is found
            with the pressure that it had in the sweep before: the torque is small beside it.
    """
    n = work.mode.closed
    largest = 0.0
    for place in range(n):
        r = arm(shape, work, work.closed[place])
        own = own_response(shape, q, r)
        local = work.local[place]
        local[0], local[1], local[2] = own.xx, own.yy, own.zz
        local[3], local[4], local[5] = own.xy, own.xz, own.yz
        put(work.shares[place], 0, Vec(0.0, 0.0, 0.0))
        for j in range(3):
            largest = max(largest, abs(work.free[place, j]))
    linear, turn = Vec(0.0, 0.0, 0.0), Vec(0.0, 0.0, 0.0)
    close = (CONVERGED_FORCES if forces else CONVERGED) * largest
    for _ in range(SWEEPS if work.tally.fallbacks < MAX_UNCONVERGED else FEWER_SWEEPS):
        change = 0.0
        for place in range(n):
            point = work.closed[place]
            r = arm(shape, work, point)
            local = work.local[place]
            own = Sym(local[0], local[1], local[2], local[3], local[4], local[5])
            before = vec(work.shares[place], 0)
            now = add(vec(work.free[place], 0), add(linear, on_support(q, cross(turn, r))))
            free = subtract(now, applied(own, before))
            goal = work.goal[place]
            static, kinetic = work.points[point].static, work.points[point].kinetic
            if forces and work.moving[point]:
                after = Vec(0.0, 0.0, 0.0)
                if free.z < goal:
                    after = slipping(
                        own, free, goal, kinetic, work.slip[point, 0], work.slip[point, 1]
                    )
                    if (
                        after.z < 0.0
                    ):  # no sliding reaction presses (Painlevé): take the frictionless one
                        after = slipping(own, free, goal, 0.0, 1.0, 0.0)
            else:
                after = one_reaction(own, free, goal, static, kinetic, before)
            put(work.shares[place], 0, after)
            difference = subtract(after, before)
            linear = add(linear, difference)
            torque = add(cross(r, on_body(q, difference)), times(difference.z, resists))
            turn = add(turn, applied(shape.mobility, torque))
            effect = applied(own, difference)
            change = max(change, abs(effect.x), abs(effect.y), abs(effect.z))
        if change <= close:
            return True
    return False


@kernel
def summed(shape: SolidParameters, work: Workspace, q: Axes, resists: Vec) -> tuple[Vec, Vec]:
    """The total change of the linear (support's frame) and angular (body's frame) velocity.

    For forces it is the change of the acceleration.
    """
    linear, torque = Vec(0.0, 0.0, 0.0), Vec(0.0, 0.0, 0.0)
    for place in range(work.mode.closed):
        share = vec(work.shares[place], 0)
        linear = add(linear, share)
        torque = add(torque, cross(arm(shape, work, work.closed[place]), on_body(q, share)))
        torque = add(torque, times(share.z, resists))
    return linear, applied(shape.mobility, torque)
