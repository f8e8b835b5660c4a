"""Whether a rocking corner sticks throughout an interval, without a branch.

Where it does, the general model is the rocking model, and its short ways through an interval
(`rocking.step`, `rocking.bounce`) hold. Forces are those on the pivot in the level frame, seen
from the side that the body rocks on (symbols of `rocking`, reaction R per unit mass):

    R = r (q'' (cos ψ, sin ψ) + q'² (sin ψ, -cos ψ)) + (a, g_e)

The two edges of the friction cone, a N ± b T >= 0 (symbols of `contact`), are lines in that
frame: their smaller value is the margin. Within the interval a margin c falls below the smaller of
its values at the two ends by at most |c''|/8, and `sag` bounds that.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.codes import BOTH, LEFT, REST, RIGHT, contact_of, phase_of, side_sign
from shaketable.physics.plane.contact import ContactBody, Pose, corner, on_corner
from shaketable.physics.plane.forcing import Forcing, rest_of, seen_from
from shaketable.physics.plane.impact import collide, lossy
from shaketable.physics.plane.rocking import Block, Impact, Side, State, bounce, side_of, step

LEAST = 1e-12  # of a sine


class Cone(NamedTuple):
    """Friction at the corner that a body rocks on."""

    radius: float  # r [m]
    first_x: float  # edges of the friction cone
    first_y: float
    second_x: float
    second_y: float


class StickingCorner(NamedTuple):
    """What decides whether a corner that a body rocks on sticks, and its plain impact."""

    cone: Cone
    velocity_ratio: float  # e of the impact that ends rocking on this side, 0 if it is not plain


class StickingCorners(NamedTuple):
    """Both corners of a body."""

    right: StickingCorner
    left: StickingCorner


@routine
def plain_keep(body: ContactBody, side: float) -> float:
    """e where the impact that ends rocking on `side` is without slip, bounce or rest; else 0."""
    X, Y = corner(body, side, 0.0)
    spin = -side  # it comes down
    falling = Pose(0, 0.0, body.h, 0.0, -spin * Y, spin * X, spin)
    after = collide(body, falling, BOTH)
    other = LEFT if side > 0.0 else RIGHT
    if (
        body.normal_restitution > 0.0
        or not after.found
        or after.contact != other
        or not after.sticks
    ):
        return 0.0
    struck = Pose(0, 0.0, body.h, 0.0, after.x_rate, after.y_rate, after.spin)
    return lossy(body, struck, -side).spin / spin


@routine
def make_corners(body: ContactBody) -> StickingCorners:
    return StickingCorners(
        StickingCorner(make_cone(body, 1.0), plain_keep(body, 1.0)),
        StickingCorner(make_cone(body, -1.0), plain_keep(body, -1.0)),
    )


@routine
def make_cone(body: ContactBody, side: float) -> Cone:
    a, b = body.a_stick, body.b_stick
    sine, cosine = side * body.tilt_sine, body.tilt_cosine
    X, Y = corner(body, side, 0.0)
    return Cone(
        (X * X + Y * Y) ** 0.5,
        -a * sine + b * cosine,
        a * cosine + b * sine,
        -a * sine - b * cosine,
        a * cosine - b * sine,
    )


@kernel
def margin(
    cone: Cone, k: float, rate: float, sine: float, cosine: float, g_effective: float, a_x: float
) -> float:
    """The smaller of a N ± b T [m/s²]."""
    turn = -k * (g_effective * sine + a_x * cosine)
    along = cone.radius * (turn * cosine + rate * rate * sine) + a_x
    up = cone.radius * (turn * sine - rate * rate * cosine) + g_effective
    first = cone.first_x * along + cone.first_y * up
    second = cone.second_x * along + cone.second_y * up
    return first if first < second else second


@kernel
def sag(radius: float, k: float, rate: float, h: float, force: Forcing) -> float:
    """A bound on |c''|/8 of a margin c over an interval that begins with the rate q'.

    Derivatives are by u. F is the largest |f|, ΔF its change, φ = h² k F >= |w'| bounds the growth
    of w = h |q'|, and r k <= 1. The rotation: |r q''| <= F, |(r q'')'| <= ΔF + F w and
    |(r q'')''| <= 2 ΔF w + F (w² + φ); its direction turns by w and w² + φ. That makes
    |(r q'' e)''| <= 4 ΔF w + 4 F w² + 2 F φ. The centripetal part, with (q'²)' = 2 q' h q'', adds
    2 F φ + 2 ΔF w + 7 F w² + r q'² w². (A test compares the whole with the true forces.)
    """
    change = abs(force.a_x_change) + abs(force.g_effective_change)
    strength = abs(force.a_x) + abs(force.g_effective) + change
    phi = h * h * k * strength
    w = h * abs(rate) + phi
    centripetal = radius * (w / h) * (w / h)
    return (
        6.0 * change * w + 11.0 * strength * w * w + 4.0 * strength * phi + centripetal * w * w
    ) * (1 / 8)


@kernel
def holds(before: float, after: float, drop: float) -> bool:
    """Whether a margin stays positive if it falls below its two end values by at most `drop`."""
    return (before if before < after else after) > drop


@kernel
def sticks_on(
    cone: Cone, side: Side, height: float, rate: float, h: float, force: Forcing, strength: float
) -> bool:
    """`sticks_throughout` for one of the corners; `force` as seen from its side."""
    last = rest_of(force, 1.0)
    w = h * rate + h * h * side.k * strength
    drop = 2.0 * strength * (height + w) + cone.radius * (w / h) * (w / h)
    still = min(
        min(
            cone.first_x * force.a_x + cone.first_y * force.g_effective,
            cone.second_x * force.a_x + cone.second_y * force.g_effective,
        ),
        min(
            cone.first_x * last.a_x + cone.first_y * last.g_effective,
            cone.second_x * last.a_x + cone.second_y * last.g_effective,
        ),
    )
    return still > 0.0 and holds(
        margin(cone, side.k, 0.0, side.sine, side.cosine, force.g_effective, force.a_x),
        margin(cone, side.k, 0.0, side.sine, side.cosine, last.g_effective, last.a_x),
        drop,
    )


@kernel
def step_sticking(
    state: State, k: float, cone: Cone, peak: float, h: float, force: Forcing
) -> tuple[State, bool]:
    """`rocking.step` of a body whose corner has friction: that it may slip is an event, too."""
    new, eventful = step(state, k, peak, h, force)
    last = rest_of(force, 1.0)
    held = holds(
        margin(cone, k, state.rate, state.sine, state.cosine, force.g_effective, force.a_x),
        margin(cone, k, new.rate, new.sine, new.cosine, last.g_effective, last.a_x),
        sag(cone.radius, k, state.rate, h, force),
    )
    return new, eventful | (not held)


@kernel
def bounce_sticking(
    state: State,
    here: Side,
    here_corner: StickingCorner,
    there: Side,
    there_cone: Cone,
    peak: float,
    h: float,
    force: Forcing,
) -> tuple[State, Impact, bool]:
    """`rocking.bounce` of a body whose corners have friction; it is right if both stick."""
    keep, cone = here_corner.velocity_ratio, here_corner.cone
    after, impact, clean = bounce(state, here.k, keep, -1.0, there, peak, h, force)
    fall = -impact.speed / keep
    hit = rest_of(force, impact.u)
    back = seen_from(hit, -1.0)
    last = rest_of(back, 1.0)
    before_it = holds(
        margin(cone, here.k, state.rate, state.sine, state.cosine, force.g_effective, force.a_x),
        margin(cone, here.k, fall, here.sine, here.cosine, hit.g_effective, hit.a_x),
        sag(cone.radius, here.k, state.rate, h, force),
    )
    after_it = holds(
        margin(
            there_cone, there.k, impact.speed, there.sine, there.cosine, back.g_effective, back.a_x
        ),
        margin(
            there_cone, there.k, after.rate, after.sine, after.cosine, last.g_effective, last.a_x
        ),
        sag(there_cone.radius, there.k, impact.speed, h, seen_from(force, -1.0)),
    )
    return after, impact, clean & before_it & after_it


@routine
def sticks_throughout(
    block: Block, corners: StickingCorners, state: State, h: float, force: Forcing
) -> bool:
    """Whether no corner slips or lifts off for an interval, whatever uplifts and impacts there are.

    At q = 0 and q' = 0 a margin is linear in the forces and so smallest at an end of the interval.
    Up to the largest q and q' that can be reached it changes by at most 2 F q + r q'²; a body at
    rest needs its friction too. Impacts must be plain.
    """
    right, left = corners.right, corners.left
    if right.velocity_ratio <= 0.0 or left.velocity_ratio <= 0.0:
        return False
    height, rate = state.rotation, abs(state.rate)
    change = abs(force.a_x_change) + abs(force.g_effective_change)
    strength = abs(force.a_x) + abs(force.g_effective) + change
    return sticks_on(right.cone, block.right, height, rate, h, force, strength) and sticks_on(
        left.cone, block.left, height, rate, h, seen_from(force, -1.0), strength
    )


@kernel
def resting_side(side: Side, body: ContactBody) -> Side:
    """The side as a body at rest meets it: it tips or its friction gives way, whichever first."""
    sine = body.a_stick * body.tilt_cosine + side.sign * body.b_stick * body.tilt_sine
    cosine = body.b_stick * body.tilt_cosine - side.sign * body.a_stick * body.tilt_sine
    if 0.0 <= sine < LEAST:  # without friction, so that a support that drops away is noticed
        sine = LEAST
    if sine * side.cosine < cosine * side.sine:
        return Side(side.sign, side.k, side.phase, sine, cosine, side.velocity_ratio, -1.0)
    return side


@routine
def resting_block(body: ContactBody) -> Block:
    """What `rocking.tipping` needs to tell when a body at rest begins to move."""
    return Block(
        resting_side(side_of(body.block, 1.0), body),
        resting_side(side_of(body.block, -1.0), body),
    )


@routine
def pose_of(body: ContactBody, state: State, slip: float) -> Pose:
    """The pose of a body that rests or rocks without slip."""
    if state.side == 0.0:
        return Pose(REST, slip, body.h, 0.0, 0.0, 0.0, 0.0)
    contact = RIGHT if state.side > 0.0 else LEFT
    rotation, spin = state.side * state.rotation, state.side * state.rate
    X, Y = corner(body, state.side, rotation)
    x = slip + corner(body, state.side, 0.0)[0] - X
    pose = Pose(phase_of(contact, 0.0), x, 0.0, rotation, -spin * Y, 0.0, spin)
    return on_corner(body, pose, state.side)


@routine
def state_of(body: ContactBody, pose: Pose) -> State:
    side = side_sign(contact_of(pose.phase))
    height = side * pose.rotation
    phase = side_of(body.block, side).phase - height
    return State(side, height, side * pose.spin, math.sin(phase), math.cos(phase))


@kernel
def corner_of(corners: StickingCorners, side: float) -> StickingCorner:
    return corners.right if side > 0.0 else corners.left
