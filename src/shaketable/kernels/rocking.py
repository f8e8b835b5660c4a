"""Rocking without sliding of a non-symmetric body on a tilted support (physics.md sections 1, 2).

| symbol    | word                                            | unit   | equation                       |
|-----------|-------------------------------------------------|--------|--------------------------------|
| θ         | rotation relative to the support, + toward +x   | rad    | θ'' = -k (g_e sin φ + a cos φ) |
| s         | side: +1 pivot R, -1 pivot L, 0 at rest         | -      | s = sign θ                     |
| φ         | s α_s - θ + β                                   | rad    | A eq. 2, B, C eq. 3            |
| k_s       | r_s / (i² + r_s²); k g = p² for a rectangle     | 1/m    |                                |
| g_e, a    | g + a_y (effective gravity), a_x (push)         | m/s²   | linear within an interval      |
| e_s       | θ' kept at the impact that ends rocking on s    | -      | B eq. 34, or Support's η       |

An interval is one time step of the motion. `step` crosses it where nothing happens, without a
branch; where it reports that something may, `cross_interval` starts again from the same state
and takes uplift, impacts, rest and overturning one by one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.kernels.compiled import kernel, routine
from shaketable.kernels.taylor import (
    MAX_ADVANCE,
    NO_ROOT,
    Series,
    first_root,
    negative_part,
    positive_part,
    small_sin_cos,
    value,
    velocity_series,
    without_leading_zeros,
)
from shaketable.units import STANDARD_GRAVITY

RIGHT_ANGLE = math.pi / 2
SETTLE_INTERVALS = 32  # how far ahead the end of a bounce sequence is looked for
SETTLE_MARGIN = 2.0  # the sequence must end within its estimated duration times this
SETTLE_ROTATION = 1e-5  # rad: larger rotations are followed, whatever comes after
RESTING_SPEED = 1e-10  # rad/s: a slower body is at rest
EVENT_BUDGET = 1_000_000  # events in one interval; then the body counts as at rest

# Series coefficients of the rotation from those of the velocity: q_{n+1} = w_n / (n + 1).
_HALF, _THIRD, _QUARTER, _FIFTH = 1 / 2, 1 / 3, 1 / 4, 1 / 5
_SIXTH, _SEVENTH, _EIGHTH, _NINTH = 1 / 6, 1 / 7, 1 / 8, 1 / 9


class Block(NamedTuple):
    """A body on its support, as the kernels need it."""

    k_right: float  # 1/m
    k_left: float
    phase_right: float  # α_R + β, φ at θ = 0+
    phase_left: float  # -α_L + β, φ at θ = 0-
    sin_right: float
    cos_right: float
    sin_left: float
    cos_left: float
    keep_right: float  # e_R: of the impact that ends rocking on R
    keep_left: float


class State(NamedTuple):
    side: float  # +1 on pivot R, -1 on pivot L, 0 at rest
    theta: float  # rad
    omega: float  # rad/s
    sine: float  # sin φ, carried along so that an interval needs no sin/cos call
    cosine: float


class Push(NamedTuple):
    """Ground acceleration in an interval: at its start, and its change until its end [m/s²]."""

    gravity: float  # g + a_y
    gravity_change: float
    push: float  # a_x
    push_change: float


class Passage(NamedTuple):
    """What became of a body in an interval."""

    state: State
    peak: float  # rad, the largest |θ| so far
    impacts: int  # so far
    fallen_at: float  # fraction of the interval at which |θ| reached π/2, or -1


@kernel
def make_block(
    width: float, cg_height: float, left: float, gyration_radius: float, tilt: float, kept: float
) -> Block:
    """A body on a support; `kept` is η, or NaN for an impact that keeps angular momentum."""
    right = width - left
    i2 = gyration_radius * gyration_radius
    h2 = cg_height * cg_height
    phase_right = math.atan2(right, cg_height) + tilt
    phase_left = tilt - math.atan2(left, cg_height)
    through = i2 + h2 - left * right
    given = kept == kept
    return Block(
        math.sqrt(h2 + right * right) / (i2 + h2 + right * right),
        math.sqrt(h2 + left * left) / (i2 + h2 + left * left),
        phase_right,
        phase_left,
        math.sin(phase_right),
        math.cos(phase_right),
        math.sin(phase_left),
        math.cos(phase_left),
        kept if given else through / (i2 + h2 + left * left),
        kept if given else through / (i2 + h2 + right * right),
    )


AT_REST = State(0.0, 0.0, 0.0, 0.0, 1.0)


@kernel
def push_at(
    push: NDArray[np.float64], gravity: NDArray[np.float64], polarity: float, i: int
) -> Push:
    """The forcing in interval i; gravity alone once the record has ended."""
    if i + 1 >= push.size:
        return Push(STANDARD_GRAVITY, 0.0, 0.0, 0.0)
    return Push(
        gravity[i],
        gravity[i + 1] - gravity[i],
        polarity * push[i],
        polarity * push[i + 1] - polarity * push[i],
    )


@kernel
def step(
    theta: float,
    omega: float,
    sine: float,
    cosine: float,
    side: float,
    k: float,
    peak: float,
    h: float,
    force: Push,
) -> tuple[float, float, float, float, bool]:
    """(θ, θ', sin φ, cos φ) after an interval of length h, and whether anything may happen in it.

    That is: s θ may reach zero (its smallest partial sum does), it overturns, it turns back
    above its largest rotation so far, or it turns too far for `small_sin_cos`.
    """
    kh2 = k * h * h
    w0 = omega * h
    w1, w2, w3, w4, w5, w6, w7, w8 = velocity_series(
        w0,
        sine,
        cosine,
        kh2 * force.gravity,
        kh2 * force.gravity_change,
        kh2 * force.push,
        kh2 * force.push_change,
    )
    q2, q3, q4, q5 = w1 * _HALF, w2 * _THIRD, w3 * _QUARTER, w4 * _FIFTH
    q6, q7, q8, q9 = w5 * _SIXTH, w6 * _SEVENTH, w7 * _EIGHTH, w8 * _NINTH
    advance = w0 + (q2 + (q3 + (q4 + (q5 + (q6 + (q7 + (q8 + q9)))))))
    w_end = w0 + (w1 + (w2 + (w3 + (w4 + (w5 + (w6 + (w7 + w8)))))))
    fall_back = (
        negative_part(side * w0)
        + negative_part(side * q2)
        + negative_part(side * q3)
        + negative_part(side * q4)
        + negative_part(side * q5)
        + negative_part(side * q6)
        + negative_part(side * q7)
        + negative_part(side * q8)
        + negative_part(side * q9)
    )
    height = side * theta
    climb = side * advance - fall_back
    eventful = (
        (height + fall_back <= 0.0)
        | (height + side * advance >= RIGHT_ANGLE)
        | ((side * w0 > 0.0) & (side * w_end <= 0.0) & (height + climb > peak))
        | (advance > MAX_ADVANCE)
        | (advance < -MAX_ADVANCE)
    )
    turn_sine, turn_cosine = small_sin_cos(advance)
    return (
        theta + advance,
        w_end * (1.0 / h),
        sine * turn_cosine - cosine * turn_sine,
        cosine * turn_cosine + sine * turn_sine,
        eventful,
    )


@kernel
def phase_of(block: Block, side: float) -> float:
    return block.phase_right if side > 0.0 else block.phase_left


@kernel
def upright(block: Block, side: float) -> tuple[float, float]:
    """sin φ and cos φ at θ = 0."""
    if side > 0.0:
        return block.sin_right, block.cos_right
    return block.sin_left, block.cos_left


@kernel
def lift_right(block: Block, gravity: float, push: float) -> float:
    """Angular acceleration toward +x of a resting body about R over k_R; > 0: it lifts."""
    return -(gravity * block.sin_right + push * block.cos_right)


@kernel
def lift_left(block: Block, gravity: float, push: float) -> float:
    """The same toward -x about L (A eq. 1)."""
    return gravity * block.sin_left + push * block.cos_left


@kernel
def first_positive(start: float, change: float) -> float:
    """The first u in [0, 1] from which start + change u is positive, or NO_ROOT."""
    if start > 0.0:
        return 0.0
    if start + change > 0.0:
        return -start / change
    return NO_ROOT


@routine
def uplift(block: Block, force: Push) -> tuple[float, float]:
    """(u, side) at which a resting body lifts within the forcing's interval, or (NO_ROOT, 0)."""
    right = lift_right(block, force.gravity, force.push)
    left = lift_left(block, force.gravity, force.push)
    right_at = first_positive(right, lift_right(block, force.gravity_change, force.push_change))
    left_at = first_positive(left, lift_left(block, force.gravity_change, force.push_change))
    if right_at == NO_ROOT and left_at == NO_ROOT:
        return NO_ROOT, 0.0
    if right_at == left_at:  # both at once: only where g + a_y < 0, the harder push wins
        return right_at, 1.0 if block.k_right * right >= block.k_left * left else -1.0
    return (right_at, 1.0) if right_at < left_at else (left_at, -1.0)


@kernel
def bounce_time(speed: float, here: float, there: float, keep: float, back: float) -> float:
    """Duration of all bounces that begin with `speed` on a side with restoring acceleration `here`.

    Flights last 2 v / A in turn; of the speed `keep` and `back` are left at the impacts.
    """
    return 2.0 * speed * (1.0 / here + keep / there) / (1.0 - keep * back)


@routine
def settles(
    speed: float,
    side: float,
    block: Block,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    polarity: float,
    i: int,
    u: float,
    h: float,
) -> bool:
    """Whether the bounces that start on `side` with `speed` die out before anything lifts the body.

    The infinitely many bounces that are left are summed as a geometric series (`bounce_time`).
    They are taken as done if they end within SETTLE_MARGIN times the time they take under the
    present forcing, even with the smallest restoring accelerations in that time and with every
    flight gaining the most that a changing acceleration can give it: v'/v <= √(1 + |A'| t / A)
    in a flight of duration t. What is given up are rotations below SETTLE_ROTATION.
    """
    if speed < RESTING_SPEED:
        return True
    now = push_at(push, gravity, polarity, i)
    g_now = now.gravity + u * now.gravity_change
    a_now = now.push + u * now.push_change
    right = -block.k_right * lift_right(block, g_now, a_now)
    left = -block.k_left * lift_left(block, g_now, a_now)
    if right <= 0.0 or left <= 0.0 or speed * speed > 2.0 * SETTLE_ROTATION * min(right, left):
        return False
    keep, back = block.keep_right, block.keep_left
    if side < 0.0:
        keep, back = back, keep
    here, there = (right, left) if side > 0.0 else (left, right)
    allowed = SETTLE_MARGIN * bounce_time(speed, here, there, keep, back)
    last = i + math.ceil(u + allowed / h)
    if last > i + SETTLE_INTERVALS:
        return False
    least_right, least_left, steepest = right, left, 0.0
    for j in range(i, last):
        later = push_at(push, gravity, polarity, j)
        right_change = block.k_right * lift_right(
            block, later.gravity_change, later.push_change
        )
        left_change = block.k_left * lift_left(block, later.gravity_change, later.push_change)
        steepest = max(steepest, abs(right_change), abs(left_change))
        g_later = later.gravity + later.gravity_change
        a_later = later.push + later.push_change
        least_right = min(least_right, -block.k_right * lift_right(block, g_later, a_later))
        least_left = min(least_left, -block.k_left * lift_left(block, g_later, a_later))
    least = min(least_right, least_left)
    if least <= 0.0:
        return False
    growth = math.sqrt(1.0 + (steepest / least) * (2.0 * speed / least) / h)
    if keep * back * growth * growth >= 1.0:
        return False
    here, there = (least_right, least_left) if side > 0.0 else (least_left, least_right)
    return bounce_time(speed, here, there, growth * keep, growth * back) <= allowed


@routine
def peak_within(q: Series, until: float, peak: float) -> float:
    """The larger of `peak` and the maximum of q(u) on [0, until]."""
    reachable = q.c0 + (
        positive_part(q.c1)
        + positive_part(q.c2)
        + positive_part(q.c3)
        + positive_part(q.c4)
        + positive_part(q.c5)
        + positive_part(q.c6)
        + positive_part(q.c7)
        + positive_part(q.c8)
        + positive_part(q.c9)
    )
    if reachable <= peak:
        return peak
    top = max(peak, value(q, until))
    turning = Series(
        q.c1, 2 * q.c2, 3 * q.c3, 4 * q.c4, 5 * q.c5, 6 * q.c6, 7 * q.c7, 8 * q.c8, 9 * q.c9, 0.0
    )
    zeros = 0
    if turning.c0 == 0.0:
        zeros = 1 if turning.c1 != 0.0 else 2
    u = first_root(without_leading_zeros(turning, zeros))
    if 0.0 < u <= until:
        top = max(top, value(q, u))
    return top


@routine
def cross_interval(
    state: State,
    block: Block,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    polarity: float,
    i: int,
    start: float,
    h: float,
    peak: float,
    impacts: int,
    impact_times: NDArray[np.float64],
) -> Passage:
    """Take a body through interval i of the motion, event by event.

    The interval begins at time `start` and lasts h. The time of impact number n is written to
    impact_times[n] while it fits.
    """
    side, theta, omega, sine, cosine = state
    elapsed = 0.0
    for _ in range(EVENT_BUDGET):
        whole = push_at(push, gravity, polarity, i)
        left = 1.0 - elapsed
        force = Push(
            whole.gravity + elapsed * whole.gravity_change,
            left * whole.gravity_change,
            whole.push + elapsed * whole.push_change,
            left * whole.push_change,
        )
        from_zero_moment = False
        if side == 0.0:
            u, side = uplift(block, force)
            if side == 0.0:
                break
            from_zero_moment = u > 0.0
            elapsed += u * left
            left = 1.0 - elapsed
            force = Push(
                whole.gravity + elapsed * whole.gravity_change,
                left * whole.gravity_change,
                whole.push + elapsed * whole.push_change,
                left * whole.push_change,
            )
            theta, omega = 0.0, 0.0
            sine, cosine = upright(block, side)
        span = left * h
        kh2 = (block.k_right if side > 0.0 else block.k_left) * span * span
        w0 = omega * span
        w1, w2, w3, w4, w5, w6, w7, w8 = velocity_series(
            w0,
            sine,
            cosine,
            kh2 * force.gravity,
            kh2 * force.gravity_change,
            kh2 * force.push,
            kh2 * force.push_change,
        )
        if from_zero_moment:  # the body lifts where the moment passes zero: exactly so
            w1 = 0.0
        q = Series(
            side * theta,
            side * w0,
            side * w1 * _HALF,
            side * w2 * _THIRD,
            side * w3 * _QUARTER,
            side * w4 * _FIFTH,
            side * w5 * _SIXTH,
            side * w6 * _SEVENTH,
            side * w7 * _EIGHTH,
            side * w8 * _NINTH,
        )
        zeros = 0
        if q.c0 == 0.0:
            zeros = 1
            if q.c1 == 0.0:
                zeros = 3 if from_zero_moment else 2
        ahead = without_leading_zeros(q, zeros)
        if zeros >= 2 and ahead.c0 <= 0.0:  # no moment to lift it after all, to round-off
            side, theta, omega = 0.0, 0.0, 0.0
            break
        until = first_root(ahead)
        hits = until != NO_ROOT
        if not hits:
            until = 1.0
        peak = peak_within(q, until, peak)
        velocity = Series(w0, w1, w2, w3, w4, w5, w6, w7, w8, 0.0)
        if peak >= RIGHT_ANGLE:
            to_floor = Series(
                RIGHT_ANGLE - q.c0,
                -q.c1,
                -q.c2,
                -q.c3,
                -q.c4,
                -q.c5,
                -q.c6,
                -q.c7,
                -q.c8,
                -q.c9,
            )
            u = min(first_root(to_floor), 1.0)
            fallen = State(side, side * RIGHT_ANGLE, value(velocity, u) / span, 0.0, 0.0)
            return Passage(fallen, RIGHT_ANGLE, impacts, elapsed + u * left)
        if not hits:
            theta = side * value(q, 1.0)
            omega = value(velocity, 1.0) / span
            phase = phase_of(block, side) - theta
            return Passage(
                State(side, theta, omega, math.sin(phase), math.cos(phase)), peak, impacts, -1.0
            )
        elapsed += until * left
        keep = block.keep_right if side > 0.0 else block.keep_left
        omega = keep * value(velocity, until) / span
        if impacts < impact_times.size:
            impact_times[impacts] = start + elapsed * h
        impacts += 1
        theta = 0.0
        side = -side
        if (
            keep <= 0.0
            or omega * side <= 0.0
            or settles(abs(omega), side, block, push, gravity, polarity, i, elapsed, h)
        ):
            side, omega = 0.0, 0.0
        else:
            sine, cosine = upright(block, side)
        if elapsed >= 1.0:
            break
    else:
        side = 0.0
    if side == 0.0:
        return Passage(AT_REST, peak, impacts, -1.0)
    return Passage(State(side, theta, omega, sine, cosine), peak, impacts, -1.0)
