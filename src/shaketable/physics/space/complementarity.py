"""Reactions of all touches together: forces, and impulses.

Signorini's condition and Coulomb's disc at each touch, solved one touch after the other until
nothing changes (a nonlinear block Gauss-Seidel; Jourdan, Alart & Jean 1998), each exactly. The same
for forces, where `free` is what the accelerations of the touches would be without reactions, and
for impulses, where it is their velocities. Both are along each touch's frame; sums are in the
body's frame, in which the levers stand still.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.space.constraints import free_turning
from shaketable.physics.space.losses import resistance
from shaketable.physics.space.straps import with_straps
from shaketable.physics.space.touches import frame_of, lever_of, plane_of, touch_acceleration
from shaketable.physics.space.vectors import (
    Axes,
    Sym,
    Vec,
    add,
    applied,
    cross,
    dot,
    inverse,
    on_body,
    on_support,
    subtract,
    times,
)
from shaketable.physics.space.workspace import (
    SolidParameters,
    W,
    Workspace,
    put,
    vec,
)

# A solve for forces only selects the mode (who slips, who leaves): the rates of that mode then give
# the accelerations exactly. It is solved until what is left is no acceleration that `Thresholds`
# call a start: ten times as far off, one corner of a side that slips would leave. Impulses are used
# as they are found.
SWEEPS = 500
#: After so many solves of a run that did not converge, limit later ones to so many sweeps.
MAX_UNCONVERGED, FEWER_SWEEPS = 100, 50
SOON = 24  # sweeps beside walls, before each touch is solved exactly
CONVERGED_FORCES, CONVERGED = 1e-9, 1e-11  # of the largest acceleration or velocity
AGAIN, STEADY = 32, 0.5  # after so many sweeps, to see whether changes fall to less than a share
DIRECTIONS = 24  # tried for the slip of a touch, before the best are refined
REFINEMENTS = 60
TURN = 2.0 * math.pi / DIRECTIONS
ROUND_OFF = 2e-15  # rad: two numbers near a whole turn are 9e-16 apart


@kernel
def own_response(shape: SolidParameters, frame: Axes, r: Vec) -> Sym:
    """The change at a touch from its own reaction per unit mass, along its frame.

    It is an acceleration [m/s²] for a force, and a velocity [m/s] for an impulse.
    """
    x, y, z = response(shape, frame.x, r), response(shape, frame.y, r), response(shape, frame.z, r)
    return Sym(
        dot(frame.x, x), dot(frame.y, y), dot(frame.z, z),
        dot(frame.x, y), dot(frame.x, z), dot(frame.y, z),
    )  # fmt: skip


@kernel
def response(shape: SolidParameters, reaction: Vec, r: Vec) -> Vec:
    """The change at r from a reaction per unit mass there, all in the body's frame."""
    return add(reaction, cross(applied(shape.mobility, cross(r, reaction)), r))


@kernel
def slipping(own: Sym, free: Vec, goal: float, mu: float, x: float, y: float) -> Vec:
    """The reaction of a point that slips along (x, y), N < 0 where there is none."""
    per = own.zz - mu * (own.xz * x + own.yz * y)
    if per <= 0.0:
        return Vec(0.0, 0.0, -1.0)
    n = (goal - free.z) / per
    return Vec(-mu * n * x, -mu * n * y, n)


class Askew(NamedTuple):
    """The slip across a direction θ, if friction opposes that direction, as a function of it.

    c + c₁ cos θ + s₁ sin θ + c₂ cos 2θ + s₂ sin 2θ, times what `slipping` divides by.
    """

    c: float
    c_1: float
    s_1: float
    c_2: float
    s_2: float


@kernel
def askew(own: Sym, free: Vec, goal: float, mu: float) -> Askew:
    push, half = goal - free.z, 0.5 * mu
    return Askew(
        -half * (own.xz * free.y - own.yz * free.x),
        own.zz * free.y + push * own.yz,
        -own.zz * free.x - push * own.xz,
        -half * (own.xz * free.y + own.yz * free.x) - mu * push * own.xy,
        -half * (own.yz * free.y - own.xz * free.x) - half * push * (own.yy - own.xx),
    )


@kernel
def across(a: Askew, x: float, y: float) -> float:
    """Across a direction (x, y)."""
    return a.c + a.c_1 * x + a.s_1 * y + a.c_2 * (x * x - y * y) + 2.0 * a.s_2 * x * y


@routine
def slip_angle(own: Sym, free: Vec, goal: float, mu: float, guess: float) -> tuple[float, bool]:
    """The direction along which a point slips against its own friction, nearest to a guess."""
    a = askew(own, free, goal, mu)
    for k in range(DIRECTIONS // 2 + 1):
        for sign in (1.0, -1.0):
            low, high = guess + sign * (k - 0.5) * TURN, guess + sign * (k + 0.5) * TURN
            at_low = across(a, math.cos(low), math.sin(low))
            at_high = across(a, math.cos(high), math.sin(high))
            if at_low * at_high > 0.0:
                continue
            angle = refined(a, low, high, at_low)
            x, y = math.cos(angle), math.sin(angle)
            reaction = slipping(own, free, goal, mu, x, y)
            if reaction.z >= 0.0:
                u = add(free, applied(own, reaction))
                if x * u.x + y * u.y >= 0.0:
                    return angle, True
    return guess, False


@kernel
def refined(a: Askew, low: float, high: float, at_low: float) -> float:
    """Where the slip across a direction is none, between two of unlike sign, to round-off.

    Newton's steps, or halving where one would leave the bracket.
    """
    angle = 0.5 * (low + high)
    for _ in range(REFINEMENTS):
        x, y = math.cos(angle), math.sin(angle)
        here = across(a, x, y)
        slope = a.s_1 * x - a.c_1 * y + 2.0 * a.s_2 * (x * x - y * y) - 4.0 * a.c_2 * x * y
        if here * at_low > 0.0:
            low = angle
        else:
            high = angle
        step = -here / slope if slope != 0.0 else math.inf
        after = angle + step
        if abs(step) <= ROUND_OFF or here == 0.0:
            break
        inside = min(low, high) < after < max(low, high)
        angle = after if inside else 0.5 * (low + high)
    return angle


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
def write_own(shape: SolidParameters, work: Workspace, place: int) -> None:
    """Write the response of a touch to its own reaction."""
    found = own_response(shape, frame_of(work, place), lever_of(work, place))
    own = work.touches[place].own
    own[0], own[1], own[2] = found.xx, found.yy, found.zz
    own[3], own[4], own[5] = found.xy, found.xz, found.yz


@kernel
def own_of(work: Workspace, place: int) -> Sym:
    """The response of a touch that is written."""
    own = work.touches[place].own
    return Sym(own[0], own[1], own[2], own[3], own[4], own[5])


@kernel
def moved_at(work: Workspace, place: int, linear: Vec, turn: Vec) -> Vec:
    """The velocity or acceleration of a touch with a change of v and ω (body frame)."""
    moved = add(linear, cross(turn, lever_of(work, place)))
    return add(vec(work.touches[place].free, 0), on_support(frame_of(work, place), moved))


@routine
def write_free(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> None:
    """Write what the accelerations of the touches would be without reactions."""
    y = work.state
    f = with_straps(shape, work, f)
    free = free_turning(shape, work, vec(y, W))
    for place in range(work.mode.touches):
        put(work.touches[place].free, 0, touch_acceleration(work, q, y, f, free, place))
        work.touches[place].goal = 0.0


@routine
def push_together(
    shape: SolidParameters, work: Workspace, q: Axes, f: Vec, n: int, sweeps: int
) -> bool:
    """Find the forces of the first n touches in so many sweeps; they begin with what they were."""
    write_free(shape, work, q, f)
    resists = resistance(shape, q, vec(work.state, W))
    return balance(shape, work, n, True, resists, sweeps)


@kernel
def sweeps_left(work: Workspace) -> int:
    """How many sweeps a solve may take at the most."""
    return SWEEPS if work.tally.fallbacks < MAX_UNCONVERGED else FEWER_SWEEPS


@routine
def balance(
    shape: SolidParameters, work: Workspace, n: int, forces: bool, resists: Vec, sweeps: int
) -> bool:
    """Find the reactions of the first n touches; return whether they converged.

    Takes `free`, the change without reactions, and `goal`, the least normal component afterwards,
    of each touch, begins with the reactions in `share` and leaves them there. Their effect on v and
    ω (body frame) is written to `change`.

    Args:
        forces: True for accelerations [m/s²], where a touch that already slips keeps its
            direction; False for velocities [m/s].
        resists: the torque against rolling and drilling for a unit of pressure on the support.
        sweeps: at most so many.
    """
    largest = 0.0
    linear, turn = Vec(0.0, 0.0, 0.0), Vec(0.0, 0.0, 0.0)
    for place in range(n):
        write_own(shape, work, place)
        touch = work.touches[place]
        linear, turn = with_reaction(shape, work, place, vec(touch.share, 0), resists, linear, turn)
        for j in range(3):
            largest = max(largest, abs(touch.free[j]))
    close = (CONVERGED_FORCES if forces else CONVERGED) * largest
    found, quick, earlier = False, n > work.mode.near, 0.0
    none = shape.limits.slipping if quick and not forces else 0.0
    for sweep in range(sweeps):
        change = 0.0
        for place in range(n):
            touch, own = work.touches[place], own_of(work, place)
            before = vec(touch.share, 0)
            free = subtract(moved_at(work, place, linear, turn), applied(own, before))
            goal, static, kinetic = touch.goal, touch.static, touch.kinetic
            if forces and touch.moves > 0:
                after = Vec(0.0, 0.0, 0.0)
                if free.z < goal:
                    after = slipping(own, free, goal, kinetic, touch.slip_x, touch.slip_y)
                    if after.z < 0.0:  # no sliding reaction presses (Painlevé): the frictionless
                        after = slipping(own, free, goal, 0.0, 1.0, 0.0)
            else:
                after = Vec(0.0, 0.0, -1.0)
                if quick and sweep < SOON:
                    after = soon_reaction(own, free, goal, static, kinetic, before)
                if after.z < 0.0:
                    after = one_reaction(own, free, goal, static, kinetic, before)
            put(touch.share, 0, after)
            difference = subtract(after, before)
            linear, turn = with_reaction(shape, work, place, difference, resists, linear, turn)
            effect = applied(own, difference)
            change = max(change, abs(effect.x), abs(effect.y), abs(effect.z))
        found = change <= close
        if sweep % AGAIN == AGAIN - 1:  # it drifts, where touches all but follow from one another
            found = found or (change <= none and change > STEADY * earlier)
            earlier = change
        if found:
            break
    put(work.change, 0, linear)
    put(work.change, 3, turn)
    return found


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
