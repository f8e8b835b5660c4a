"""Forces on a body that may rest, slide, rock or fly on a tilted support (theory, section 3).

| symbol   | word                                                     | unit  | equation           |
|----------|----------------------------------------------------------|-------|--------------------|
| x, y     | centre of gravity along the support, + toward +x; normal | m     |                    |
| θ, ω     | rotation relative to the support, + toward +x; its rate  | rad(/s) |                  |
| h        | height of the centre of gravity over the base            | m     |                    |
| X, Y     | a corner's offset from the centre of gravity             | m     | X' = ωY, Y' = -ωX  |
| f_t, f_n | apparent body force per unit mass, along and normal      | m/s²  | theory, section 1  |
| T, N     | contact force per unit mass, along and normal            | m/s²  | N >= 0             |
| i²       | radius of gyration squared                               | m²    | i² ω' = Σ(YT - XN) |
| a, b     | μ/(1 + μ), 1/(1 + μ): Coulomb's |T| <= μN is b|T| <= aN  | -     | finite for μ = ∞   |
| σ, v     | direction of slip, velocity of the corner along          | m/s   | v = x' + ωY        |
| λ        | N = bλ, T = -aσλ of a slipping contact                   | m/s²  |                    |
| A        | bX + aσY: i² ω' = -Aλ                                    | m     | eq. 9              |

Equations are those of Boroschek and Iruretagoyena (2006). Departures from the print (theory,
section 8): f_n carries +a_x sin β where eqs. 3, 8, 9 and 10 have the other sign, and eq. 5
likewise; θ > 0 is toward +x throughout, where eq. 6 has it mirrored.
`tests/physics/plane/test_contact.py` shows that only these signs keep eq. 2 and eq. 6 alike.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.forcing import Forcing
from shaketable.physics.plane.rocking import Block

JAMMED = 1e-3  # of the sizes of its terms: where b + X A / i² is smaller, a slip jams (Painlevé)


class ContactBody(NamedTuple):
    """A body on its support, as the general model needs it."""

    h: float  # height of the centre of gravity over the base [m]
    right: float  # b_R [m]
    left: float  # b_L
    i2: float  # i² [m²]
    tilt_sine: float
    tilt_cosine: float
    a_stick: float  # a, b with the static friction
    b_stick: float
    a_slip: float  # with the kinetic friction
    b_slip: float
    normal_restitution: float  # e_n
    bounce_speed: float  # m/s: slower landings do not bounce
    settle_speed: float  # m/s: a slower rocking corner of a sliding body stays down
    restitution_factor: float  # multiplies the angular velocity that a rocking impact leaves
    block: Block  # the same body for the rocking model


class Pose(NamedTuple):
    """Where a body is and how it moves."""

    phase: int
    x: float  # m
    y: float
    rotation: float  # θ [rad]
    x_rate: float  # m/s
    y_rate: float
    spin: float  # ω [rad/s]


class Force(NamedTuple):
    """Apparent body force in an interval: at its start, and its change until its end [m/s²]."""

    along: float  # f_t
    along_change: float
    normal: float  # f_n
    normal_change: float


class Reaction(NamedTuple):
    """Forces at one corner and the accelerations they cause."""

    along: float  # T [m/s²]
    normal: float  # N
    spin_rate: float  # ω' [rad/s²]
    slip_rate: float  # v' [m/s²]


@kernel
def force_of(body: ContactBody, forcing: Forcing) -> Force:
    """f_t, f_n from the ground's accelerations (theory, section 1)."""
    sine, cosine = body.tilt_sine, body.tilt_cosine
    return Force(
        -forcing.a_x * cosine - forcing.g_effective * sine,
        -forcing.a_x_change * cosine - forcing.g_effective_change * sine,
        forcing.a_x * sine - forcing.g_effective * cosine,
        forcing.a_x_change * sine - forcing.g_effective_change * cosine,
    )


@kernel
def corner(body: ContactBody, side: float, rotation: float) -> tuple[float, float]:
    """X, Y of the right (side +1) or left (-1) corner."""
    along = body.right if side > 0.0 else -body.left
    if rotation == 0.0:
        return along, -body.h
    sine, cosine = math.sin(rotation), math.cos(rotation)
    return along * cosine - body.h * sine, -along * sine - body.h * cosine


@kernel
def corner_speeds(pose: Pose, X: float, Y: float) -> tuple[float, float]:
    """Velocities of a corner along and normal to the support."""
    return pose.x_rate + pose.spin * Y, pose.y_rate - pose.spin * X


@routine
def stick(body: ContactBody, X: float, Y: float, spin: float, force: Force) -> Reaction:
    """Reaction of a corner that stays where it is."""
    spin_rate = (X * force.normal - Y * force.along) / (body.i2 + X * X + Y * Y)
    return Reaction(
        -spin_rate * Y + spin * spin * X - force.along,
        spin_rate * X + spin * spin * Y - force.normal,
        spin_rate,
        0.0,
    )


@kernel
def slip_arm(body: ContactBody, X: float, Y: float, sigma: float) -> tuple[float, float]:
    """A, and b + X A / i², the denominator of eq. 9 over (1 + μ) i²."""
    arm = body.b_slip * X + body.a_slip * sigma * Y
    return arm, body.b_slip + X * arm / body.i2


@kernel
def jam_limit(body: ContactBody, X: float, Y: float) -> float:
    """The value of that denominator at and below which the contact counts as jammed."""
    size = body.b_slip + abs(X) * (body.b_slip * abs(X) + body.a_slip * abs(Y)) / body.i2
    return JAMMED * size


@routine
def slip(
    body: ContactBody, X: float, Y: float, spin: float, sigma: float, force: Force
) -> Reaction:
    """Reaction of a corner that slips in the direction sigma (eqs. 9, 10)."""
    arm, denominator = slip_arm(body, X, Y, sigma)
    size = (spin * spin * Y - force.normal) / denominator
    along = -body.a_slip * sigma * size
    spin_rate = -arm * size / body.i2
    return Reaction(
        along,
        body.b_slip * size,
        spin_rate,
        force.along + along + spin_rate * Y - spin * spin * X,
    )


@kernel
def flat_pressures(body: ContactBody, along: float, normal: float) -> tuple[float, float]:
    """N_R, N_L of a body that is flat on its support and does not turn, from its total T and N."""
    base = body.right + body.left
    return (
        (body.left * normal - body.h * along) / base,
        (body.right * normal + body.h * along) / base,
    )


@kernel
def on_corner(body: ContactBody, pose: Pose, side: float) -> Pose:
    """The pose with y and y' set so that the corner is on the support and stays there."""
    X, Y = corner(body, side, pose.rotation)
    return Pose(pose.phase, pose.x, -Y, pose.rotation, pose.x_rate, pose.spin * X, pose.spin)
