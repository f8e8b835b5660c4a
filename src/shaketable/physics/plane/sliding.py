"""A body that can only rest or slide: friction gives way before any corner can lift.

Friction is at most μ_s N. Its moment about a corner lifts a flat body where |T| h > N b, so that
with μ_s h < min(b_R, b_L), and N > 0 throughout, the base stays flat whatever the motion does
(Shenton 1996: such a body does not rock). What is left is one coordinate along the support, whose
acceleration is linear within an interval: velocities are quadratics, and rest and slip begin at
their roots.

The same motion is taken phase by phase in `crossing`; `tests/physics/plane/test_sliding.py` holds
the two together. Symbols as in `contact`; σ is the direction of slip, u the fraction of an interval
that has passed.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.contact import ContactBody, Force, force_of
from shaketable.physics.plane.forcing import Shaking, forcing_at

TIPPING_MARGIN = 1.0 - 1e-9  # of the friction that lifts a corner: round-off decides nothing below


class Slide(NamedTuple):
    """Where a sliding body is, and how far it went."""

    x: float  # m, + toward +x
    x_rate: float  # m/s, 0 at rest
    farthest_left: float  # m, <= 0
    farthest_right: float  # m, >= 0


@routine
def only_slides(body: ContactBody, shaking: Shaking, polarity: float) -> bool:
    """Whether no corner can lift under this motion, and friction stops the body at its end."""
    arm = min(body.right, body.left)
    if not body.a_stick * body.h < TIPPING_MARGIN * body.b_stick * arm:
        return False
    if not body.a_slip * body.tilt_cosine > body.b_slip * abs(body.tilt_sine):
        return False
    for i in range(shaking.a_x.size):
        a_x = polarity * shaking.a_x[i]
        if (
            not a_x * body.tilt_sine < shaking.g_effective[i] * body.tilt_cosine
        ):  # N <= 0: it would fly
            return False
    return True


@kernel
def grip(body: ContactBody, force: Force, u: float, sigma: float) -> float:
    """What friction has left toward sigma, times 1 + μ_s; negative where the body slips there."""
    along = force.along + u * force.along_change
    return -body.a_stick * (force.normal + u * force.normal_change) - body.b_stick * sigma * along


@kernel
def first_slip(body: ContactBody, force: Force, u: float, sigma: float) -> float:
    """When a body at rest at u starts to slip toward sigma; more than 1 if it does not."""
    now, at_end = grip(body, force, u, sigma), grip(body, force, 1.0, sigma)
    if now < 0.0:
        return u
    return u + (1.0 - u) * now / (now - at_end) if at_end < 0.0 else 2.0


@kernel
def first_stop(speed: float, pull: float, change: float) -> float:
    """The smallest s > 0 [s] at which a slip stops, or infinity.

    Its speed [m/s], >= 0, changes by `pull` [m/s²], and that by `change` [m/s³]:
    speed + pull s + change s²/2 = 0.
    """
    if speed == 0.0:
        return -2.0 * pull / change if change < 0.0 else math.inf
    root = pull * pull - 2.0 * change * speed
    if root < 0.0:
        return math.inf
    if pull <= 0.0:
        return 2.0 * speed / (math.sqrt(root) - pull)
    return -(pull + math.sqrt(root)) / change if change < 0.0 else math.inf


@kernel
def slip_forces(
    body: ContactBody, force: Force, duration: float, u: float, sigma: float
) -> tuple[float, float]:
    """Acceleration of a slip toward sigma at u [m/s²], seen in that direction, and its rate."""
    friction = body.a_slip / body.b_slip
    normal = force.normal + u * force.normal_change
    pull = sigma * (force.along + u * force.along_change) + friction * normal
    return pull, (sigma * force.along_change + friction * force.normal_change) / duration


@routine
def slide_through(body: ContactBody, force: Force, duration: float, slide: Slide) -> Slide:
    """Take a body that only slides through one interval of so many seconds."""
    x, rate, left, right = slide
    u = 0.0
    while u < 1.0:
        sigma = math.copysign(1.0, rate)
        starts = rate == 0.0
        if starts:
            toward_right = first_slip(body, force, u, 1.0)
            toward_left = first_slip(body, force, u, -1.0)
            sigma = 1.0 if toward_right <= toward_left else -1.0
            u, later = min(toward_right, toward_left), max(toward_right, toward_left)
            if u >= 1.0:
                break
        pull, change = slip_forces(body, force, duration, u, sigma)
        if starts and pull <= 0.0 and change <= 0.0:
            # at the very limit, and away from it again: it rests until the other side gives way
            if later >= 1.0 or later <= u:
                break
            sigma, u = -sigma, later
            pull, change = slip_forces(body, force, duration, u, sigma)
        pull = max(pull, 0.0) if starts else pull  # it slips, whatever round-off says
        speed, left_over = sigma * rate, (1.0 - u) * duration
        stop = first_stop(speed, pull, change)
        s = min(stop, left_over)
        if s <= 0.0:  # round-off alone: it rests
            break
        x += sigma * s * (speed + s * (pull / 2.0 + s * change / 6.0))
        left, right = min(left, x), max(right, x)
        if stop > left_over:
            rate = sigma * (speed + s * (pull + s * change / 2.0))
            break
        rate, u = 0.0, u + s / duration
    return Slide(x, rate, left, right)


@routine
def slide_all(body: ContactBody, shaking: Shaking, polarity: float, longest: float) -> Slide:
    """Take a body that only slides through a whole motion, from rest, and on until it stops.

    It is given up after `longest` seconds, with a rate left.
    """
    slide = Slide(0.0, 0.0, 0.0, 0.0)
    for i in range(shaking.a_x.size - 1):
        force = force_of(body, forcing_at(shaking, i, polarity))
        slide = slide_through(body, force, shaking.time_step, slide)
    x, rate, left, right = slide
    if rate != 0.0:
        force = force_of(body, forcing_at(shaking, shaking.a_x.size, polarity))
        sigma = math.copysign(1.0, rate)
        brake = -sigma * force.along - body.a_slip / body.b_slip * force.normal
        speed = sigma * rate
        s = min(speed / brake, longest)
        x += sigma * s * (speed - s * brake / 2.0)
        left, right = min(left, x), max(right, x)
        rate = 0.0 if s < longest else sigma * (speed - s * brake)
    return Slide(x, rate, left, right)
