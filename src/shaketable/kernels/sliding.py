"""A body that can only rest or slide: friction gives way before any corner can lift.

Friction is at most μ_s N. Its moment about a corner lifts a flat body where |T| h > N b, so that
with μ_s h < min(b_R, b_L), and N > 0 throughout, the base stays flat whatever the motion does
(Shenton 1996: such a body does not rock). What is left is one coordinate along the support, whose
acceleration is linear within an interval: velocities are quadratics, and rest and slip begin at
their roots.

Symbols as in `contact`; σ is the direction of slip, u the fraction of an interval that has passed.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.kernels.contact import ContactBody, Force, force_of
from shaketable.kernels.forcing import Shaking, forcing_at

SURE = 1.0 - 1e-9  # of the friction that lifts a corner: below it round-off decides nothing


class Slide(NamedTuple):
    """Where a sliding body is, and how far it went."""

    x: float  # m, + toward +x
    x_rate: float  # m/s, 0 at rest
    farthest_left: float  # m, <= 0
    farthest_right: float


@routine
def only_slides(body: ContactBody, shaking: Shaking, polarity: float) -> bool:
    """Whether no corner can lift under this motion, and friction stops the body at its end."""
    arm = min(body.right, body.left)
    if not body.a_stick * body.h < SURE * body.b_stick * arm:
        return False
    if not body.a_slip * body.tilt_cosine > body.b_slip * abs(body.tilt_sine):
        return False
    for i in range(shaking.push.size):
        push = polarity * shaking.push[i]
        if not push * body.tilt_sine < shaking.gravity[i] * body.tilt_cosine:  # N <= 0
            return False
    return True


@kernel
def grip(body: ContactBody, force: Force, u: float) -> tuple[float, float]:
    """What friction has left toward +x and toward -x, times 1 + μ_s; negative where it slips."""
    along = body.b_stick * (force.along + u * force.along_change)
    held = -body.a_stick * (force.normal + u * force.normal_change)
    return held - along, held + along


@kernel
def first_slip(body: ContactBody, force: Force, u: float) -> tuple[float, float]:
    """When a body at rest at u starts to slip, 1 or more if it does not, and the direction."""
    begin, sigma = 2.0, 0.0
    right, left = grip(body, force, u)
    right_end, left_end = grip(body, force, 1.0)
    if right < 0.0 or right_end < 0.0:
        begin = u if right <= 0.0 else u + (1.0 - u) * right / (right - right_end)
        sigma = 1.0
    if left < 0.0 or left_end < 0.0:
        at = u if left <= 0.0 else u + (1.0 - u) * left / (left - left_end)
        if at < begin:
            begin, sigma = at, -1.0
    return begin, sigma


@kernel
def first_stop(speed: float, pull: float, change: float) -> float:
    """The smallest s > 0 with speed + pull s + change s²/2 = 0 (speed >= 0), or infinity."""
    if speed == 0.0:
        return -2.0 * pull / change if change < 0.0 else math.inf
    root = pull * pull - 2.0 * change * speed
    if root < 0.0:
        return math.inf
    if pull <= 0.0:
        return 2.0 * speed / (math.sqrt(root) - pull)
    return -(pull + math.sqrt(root)) / change if change < 0.0 else math.inf


@routine
def slide_through(body: ContactBody, force: Force, h: float, slide: Slide) -> Slide:
    """Take a body that only slides through one interval of h seconds."""
    friction = body.a_slip / body.b_slip
    x, rate, left, right = slide
    u = 0.0
    while u < 1.0:
        sigma = math.copysign(1.0, rate)
        starts = rate == 0.0
        if starts:
            u, sigma = first_slip(body, force, u)
            if u >= 1.0:
                break
        # seen in the direction of slip: acceleration at u, and its change per second
        normal = force.normal + u * force.normal_change
        pull = sigma * (force.along + u * force.along_change) + friction * normal
        change = (sigma * force.along_change + friction * force.normal_change) / h
        if starts:
            pull = max(pull, 0.0)  # it slips, whatever round-off says
            if pull == 0.0 and change <= 0.0:
                break
        speed, left_over = sigma * rate, (1.0 - u) * h
        stop = first_stop(speed, pull, change)
        s = min(stop, left_over)
        x += sigma * s * (speed + s * (pull / 2.0 + s * change / 6.0))
        left, right = min(left, x), max(right, x)
        if stop > left_over:
            rate = sigma * (speed + s * (pull + s * change / 2.0))
            break
        rate, u = 0.0, u + s / h
    return Slide(x, rate, left, right)


@routine
def slide_all(body: ContactBody, shaking: Shaking, polarity: float) -> Slide:
    """Take a body that only slides through a whole motion, from rest, and on until it stops."""
    slide = Slide(0.0, 0.0, 0.0, 0.0)
    for i in range(shaking.push.size - 1):
        force = force_of(body, forcing_at(shaking, i, polarity))
        slide = slide_through(body, force, shaking.time_step, slide)
    x, rate, left, right = slide
    if rate != 0.0:
        force = force_of(body, forcing_at(shaking, shaking.push.size, polarity))
        sigma = math.copysign(1.0, rate)
        brake = -sigma * force.along - body.a_slip / body.b_slip * force.normal
        x += sigma * rate * rate / (2.0 * brake)
        left, right = min(left, x), max(right, x)
    return Slide(x, 0.0, left, right)
