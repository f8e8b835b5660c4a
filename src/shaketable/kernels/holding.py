"""Whether a rocking corner sticks throughout an interval, without a branch.

Where it does, the general model is the rocking model, and its short ways through an interval
(`rocking.step`, `rocking.bounce`) hold. Forces are those on the pivot in the level frame, seen
from the side that the body rocks on (symbols of `rocking`, reaction R per unit mass):

    R = r (q'' (cos ψ, sin ψ) + q'² (sin ψ, -cos ψ)) + (a, g_e)

The two edges of the friction cone, a N ± b T >= 0 (symbols of `contact`), are lines in that
frame: their smaller value is the margin. Between the ends of the interval a margin exceeds the
smaller of the two by no less than -|c''|/8, and `sag` bounds that.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.kernels.codes import BOTH, LEFT, REST, RIGHT, contact_of, phase_of, side_sign
from shaketable.kernels.compiled import kernel, routine
from shaketable.kernels.contact import Pose, Stand, corner, on_corner
from shaketable.kernels.impact import collide
from shaketable.kernels.rocking import Block, Push, Side, State, rest_of, seen_from, side_of

LEAST = 1e-12  # of a sine


class Grip(NamedTuple):
    """Friction at the corner that a body rocks on, and its plain impact."""

    radius: float  # r [m]
    first_x: float  # edges of the friction cone
    first_y: float
    second_x: float
    second_y: float
    keep: float  # e of the impact that ends rocking on this side, 0 if it is not plain


@routine
def plain_keep(stand: Stand, side: float) -> float:
    """e where the impact that ends rocking on `side` is without slip, bounce or rest; else 0."""
    X, Y = corner(stand, side, 0.0)
    spin = -side  # it comes down
    falling = Pose(0, 0.0, stand.h, 0.0, -spin * Y, spin * X, spin)
    after = collide(stand, falling, BOTH)
    other = LEFT if side > 0.0 else RIGHT
    if stand.restitution > 0.0 or not after.found or after.contact != other or not after.sticks:
        return 0.0
    return after.spin / spin


@routine
def make_grip(stand: Stand, side: float) -> Grip:
    a, b = stand.a_stick, stand.b_stick
    sine, cosine = side * stand.tilt_sine, stand.tilt_cosine
    X, Y = corner(stand, side, 0.0)
    return Grip(
        (X * X + Y * Y) ** 0.5,
        -a * sine + b * cosine,
        a * cosine + b * sine,
        -a * sine - b * cosine,
        a * cosine - b * sine,
        plain_keep(stand, side),
    )


@kernel
def margin(
    grip: Grip, k: float, rate: float, sine: float, cosine: float, gravity: float, push: float
) -> float:
    """The smaller of a N ± b T [m/s²]."""
    turn = -k * (gravity * sine + push * cosine)
    along = grip.radius * (turn * cosine + rate * rate * sine) + push
    up = grip.radius * (turn * sine - rate * rate * cosine) + gravity
    first = grip.first_x * along + grip.first_y * up
    second = grip.second_x * along + grip.second_y * up
    return first if first < second else second


@kernel
def sag(radius: float, k: float, rate: float, h: float, force: Push) -> float:
    """A bound of |c''|/8 of a margin c over an interval that begins with the rate q'.

    Derivatives by u. F is the largest |f|, ΔF its change, φ = h² k F >= |w'| bounds the growth of
    w = h |q'|, and r k <= 1. The rotation: |r q''| <= F, |(r q'')'| <= ΔF + F w and
    |(r q'')''| <= 2 ΔF w + F (w² + φ); its direction turns by w and w² + φ. That makes
    |(r q'' e)''| <= 4 ΔF w + 4 F w² + 2 F φ. The centripetal part, with (q'²)' = 2 q' h q'', adds
    2 F φ + 2 ΔF w + 7 F w² + r q'² w². (A test compares the whole with the true forces.)
    """
    change = abs(force.push_change) + abs(force.gravity_change)
    strength = abs(force.push) + abs(force.gravity) + change
    phi = h * h * k * strength
    w = h * abs(rate) + phi
    centripetal = radius * (w / h) * (w / h)
    return (
        6.0 * change * w + 11.0 * strength * w * w + 4.0 * strength * phi + centripetal * w * w
    ) * (1 / 8)


@kernel
def holds(before: float, after: float, drop: float) -> bool:
    """Whether a margin stays positive between two values of it."""
    return (before if before < after else after) > drop


@kernel
def calm_on(
    grip: Grip, side: Side, height: float, rate: float, h: float, force: Push, strength: float
) -> bool:
    """`calm` for one of the corners; `force` as seen from its side."""
    last = rest_of(force, 1.0)
    w = h * rate + h * h * side.k * strength
    drop = 2.0 * strength * (height + w) + grip.radius * (w / h) * (w / h)
    still = min(
        min(
            grip.first_x * force.push + grip.first_y * force.gravity,
            grip.second_x * force.push + grip.second_y * force.gravity,
        ),
        min(
            grip.first_x * last.push + grip.first_y * last.gravity,
            grip.second_x * last.push + grip.second_y * last.gravity,
        ),
    )
    return still > 0.0 and holds(
        margin(grip, side.k, 0.0, side.sine, side.cosine, force.gravity, force.push),
        margin(grip, side.k, 0.0, side.sine, side.cosine, last.gravity, last.push),
        drop,
    )


@routine
def calm(
    block: Block, right: Grip, left: Grip, height: float, rate: float, h: float, force: Push
) -> bool:
    """Whether no corner slips or lifts off for an interval, whatever uplifts and impacts there are.

    At q = 0 and q' = 0 a margin is linear in the forces and so smallest at an end of the interval.
    Up to the largest q and q' that can be reached it changes by at most 2 F q + r q'²; a body at
    rest needs its friction too. Impacts must be plain.
    """
    if right.keep <= 0.0 or left.keep <= 0.0:
        return False
    change = abs(force.push_change) + abs(force.gravity_change)
    strength = abs(force.push) + abs(force.gravity) + change
    return calm_on(right, block.right, height, abs(rate), h, force, strength) and calm_on(
        left, block.left, height, abs(rate), h, seen_from(force, -1.0), strength
    )


@kernel
def resting_side(side: Side, stand: Stand) -> Side:
    """The side as a body at rest meets it: it tips, or its friction gives way, whichever first."""
    sine = stand.a_stick * stand.tilt_cosine + side.sign * stand.b_stick * stand.tilt_sine
    cosine = stand.b_stick * stand.tilt_cosine - side.sign * stand.a_stick * stand.tilt_sine
    if 0.0 <= sine < LEAST:  # without friction: so that a support that drops away is seen
        sine = LEAST
    if sine * side.cosine < cosine * side.sine:
        return Side(side.sign, side.k, side.phase, sine, cosine, side.keep)
    return side


@routine
def resting_block(stand: Stand) -> Block:
    """What `rocking.lift` needs to tell when a body at rest begins to move."""
    return Block(
        resting_side(side_of(stand.block, 1.0), stand),
        resting_side(side_of(stand.block, -1.0), stand),
    )


@routine
def pose_of(stand: Stand, state: State, slip: float) -> Pose:
    """The pose of a body that rests or rocks without slip."""
    if state.side == 0.0:
        return Pose(REST, slip, stand.h, 0.0, 0.0, 0.0, 0.0)
    contact = RIGHT if state.side > 0.0 else LEFT
    rotation, spin = state.side * state.height, state.side * state.rate
    X, Y = corner(stand, state.side, rotation)
    x = slip + corner(stand, state.side, 0.0)[0] - X
    pose = Pose(phase_of(contact, 0.0), x, 0.0, rotation, -spin * Y, 0.0, spin)
    return on_corner(stand, pose, state.side)


@routine
def state_of(stand: Stand, pose: Pose) -> State:
    side = side_sign(contact_of(pose.phase))
    height = side * pose.rotation
    phase = side_of(stand.block, side).phase - height
    return State(side, height, side * pose.spin, math.sin(phase), math.cos(phase))
