"""Forces on a body that may rest, slide, rock or fly on a tilted support (physics.md section 3).

| symbol   | word                                                     | unit  | equation           |
|----------|----------------------------------------------------------|-------|--------------------|
| x, y     | centre of gravity along the support (uphill), normal     | m     |                    |
| θ, ω     | rotation relative to the support, + toward +x; its rate  | rad(/s) |                  |
| h        | height of the centre of gravity over the base            | m     |                    |
| X, Y     | a corner's offset from the centre of gravity             | m     | X' = ωY, Y' = -ωX  |
| f_t, f_n | apparent body force per unit mass, along and normal      | m/s²  | physics.md 1       |
| T, N     | contact force per unit mass, along (uphill) and normal   | m/s²  | N >= 0             |
| i²       | radius of gyration squared                               | m²    | i² ω' = Σ(YT - XN) |
| a, b     | μ/(1 + μ), 1/(1 + μ): Coulomb's |T| <= μN is b|T| <= aN  | -     | finite for μ = ∞   |
| σ, v     | direction of slip, velocity of the corner along          | m/s   | v = x' + ωY        |
| λ        | N = bλ, T = -aσλ of a slipping contact                   | m/s²  |                    |
| A        | bX + aσY: i² ω' = -Aλ                                    | m     | A eq. 9            |

Departures from the print of A (physics.md section 5): f_n carries +a_x sin β where A eqs. 3, 8, 9
and 10 have the other sign, and eq. 5 likewise; θ > 0 is uphill throughout, A eq. 6 has it
mirrored. `tests/kernels/test_contact.py` shows that only these signs keep eq. 2 and eq. 6 alike.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.kernels.compiled import kernel, routine
from shaketable.kernels.rocking import Block, Push

JAMMED = 1e-3  # of the sizes of its terms: with a smaller b + X A / i² a slip jams (Painlevé)


class Stand(NamedTuple):
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
    restitution: float  # e_n
    bounce_speed: float  # m/s: slower landings do not bounce
    settle_speed: float  # m/s: a slower rocking corner of a sliding body stays down
    block: Block  # the same body to the rocking model


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
    """Forces at one corner and what they do."""

    along: float  # T [m/s²]
    normal: float  # N
    spin_rate: float  # ω' [rad/s²]
    slip_rate: float  # v' [m/s²]


@kernel
def force_of(stand: Stand, push: Push) -> Force:
    """f_t, f_n from the ground's accelerations (physics.md section 1)."""
    sine, cosine = stand.tilt_sine, stand.tilt_cosine
    return Force(
        -push.push * cosine - push.gravity * sine,
        -push.push_change * cosine - push.gravity_change * sine,
        push.push * sine - push.gravity * cosine,
        push.push_change * sine - push.gravity_change * cosine,
    )


@kernel
def corner(stand: Stand, side: float, rotation: float) -> tuple[float, float]:
    """X, Y of the right (side +1) or left (-1) corner."""
    along = stand.right if side > 0.0 else -stand.left
    if rotation == 0.0:
        return along, -stand.h
    sine, cosine = math.sin(rotation), math.cos(rotation)
    return along * cosine - stand.h * sine, -along * sine - stand.h * cosine


@kernel
def corner_speeds(pose: Pose, X: float, Y: float) -> tuple[float, float]:
    """Velocities of a corner along and normal to the support."""
    return pose.x_rate + pose.spin * Y, pose.y_rate - pose.spin * X


@routine
def stick(stand: Stand, X: float, Y: float, spin: float, f_t: float, f_n: float) -> Reaction:
    """Reaction of a corner that stays where it is."""
    spin_rate = (X * f_n - Y * f_t) / (stand.i2 + X * X + Y * Y)
    return Reaction(
        -spin_rate * Y + spin * spin * X - f_t,
        spin_rate * X + spin * spin * Y - f_n,
        spin_rate,
        0.0,
    )


@kernel
def slip_arm(stand: Stand, X: float, Y: float, sigma: float) -> tuple[float, float]:
    """A, and b + X A / i², the denominator of A eq. 9 over (1 + μ) i²."""
    arm = stand.b_slip * X + stand.a_slip * sigma * Y
    return arm, stand.b_slip + X * arm / stand.i2


@kernel
def jam_limit(stand: Stand, X: float, Y: float) -> float:
    """The value of that denominator at and below which the contact counts as jammed."""
    size = stand.b_slip + abs(X) * (stand.b_slip * abs(X) + stand.a_slip * abs(Y)) / stand.i2
    return JAMMED * size


@routine
def slip(
    stand: Stand, X: float, Y: float, spin: float, sigma: float, f_t: float, f_n: float
) -> Reaction:
    """Reaction of a corner that slips in the direction sigma (A eqs. 9, 10)."""
    arm, denominator = slip_arm(stand, X, Y, sigma)
    size = (spin * spin * Y - f_n) / denominator
    along = -stand.a_slip * sigma * size
    spin_rate = -arm * size / stand.i2
    return Reaction(
        along,
        stand.b_slip * size,
        spin_rate,
        f_t + along + spin_rate * Y - spin * spin * X,
    )


@kernel
def flat_pressures(stand: Stand, along: float, normal: float) -> tuple[float, float]:
    """N_R, N_L of a body flat on its support that does not turn, from the whole T and N."""
    width = stand.right + stand.left
    return (
        (stand.left * normal - stand.h * along) / width,
        (stand.right * normal + stand.h * along) / width,
    )


@kernel
def on_corner(stand: Stand, pose: Pose, side: float) -> Pose:
    """The pose with its y and y' such that the corner is on the support and stays there."""
    X, Y = corner(stand, side, pose.rotation)
    return Pose(pose.phase, pose.x, -Y, pose.rotation, pose.x_rate, pose.spin * X, pose.spin)
