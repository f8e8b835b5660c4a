"""Rocking without sliding of a non-symmetric body on a tilted support (physics.md sections 1, 2).

| symbol | word                                         | unit | equation                         |
|--------|----------------------------------------------|------|----------------------------------|
| s      | +1 on pivot R, -1 on pivot L, 0 at rest      | -    | sign θ                           |
| q      | height: s θ, rotation on that side           | rad  | q'' = -k (g_e sin ψ + s a cos ψ) |
| ψ      | α_s - q + s β                                | rad  | A eq. 2, B, C eq. 3, mirrored    |
| k      | r_s / (i² + r_s²); k g = p² for a rectangle  | 1/m  |                                  |
| g_e, a | g + a_y, a_x                                 | m/s² | linear within an interval        |
| e_s    | share of q' kept when side s ends            | -    | B eq. 34, or the support's η     |

Everything is seen from the side that the body rocks on: a body on pivot L is the mirrored body
on pivot R with a_x and β reversed, so that one set of formulas does for both.

An interval is one time step of the motion. `step` crosses it where nothing happens and `bounce`
where there is one plain impact, both without a branch; each says whether it was right.
Where not, `cross_interval` starts again from the same state and takes uplift, impacts, rest and
overturning one by one.
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
    highest,
    lowest,
    newton,
    small_sin_cos,
    stays_above,
    steepest_rise,
    value,
    velocity_series,
    without_leading_zeros,
)
from shaketable.units import STANDARD_GRAVITY

RIGHT_ANGLE = math.pi / 2
NO_LIFT = 3.0  # in place of the time of a contact
NEWTON_RESIDUE = 1e-14  # of the height at the interval's start: an impact found to round-off
SETTLE_INTERVALS = 32  # how far ahead the end of a bounce sequence is looked for
SETTLE_MARGIN = 2.0  # the sequence must end within its estimated duration times this
SETTLE_ROTATION = 1e-5  # rad: larger rotations are followed, whatever comes after
MOST_TURNS = 6  # of a body in one interval that are looked at for its peak
PAST_A_ROOT = 1e-7  # of the interval: from there the next root is looked for
ZERO_MOMENT = 1e-11  # m/s²: a moment over k that is zero to the round-off of g
RESTING_SPEED = 1e-10  # rad/s: a slower body is at rest
EVENT_BUDGET = 1_000_000  # events in one interval; then the body counts as at rest


class Side(NamedTuple):
    """What rocking on one side needs."""

    sign: float  # s
    k: float  # 1/m
    phase: float  # ψ at q = 0 [rad]
    sine: float  # of it
    cosine: float
    keep: float  # e: of the impact that ends rocking on this side


class Block(NamedTuple):
    """A body on its support, as the kernels need it."""

    right: Side
    left: Side


class State(NamedTuple):
    """A body's state, seen from its side."""

    side: float  # +1 on pivot R, -1 on pivot L, 0 at rest
    height: float  # q [rad]
    rate: float  # q' [rad/s]
    sine: float  # sin ψ, carried along so that an interval needs no sin/cos call
    cosine: float


class Push(NamedTuple):
    """Ground acceleration in an interval: at its start, and its change until its end [m/s²]."""

    gravity: float  # g + a_y
    gravity_change: float
    push: float  # s a_x, or a_x for a body at rest
    push_change: float


class Passage(NamedTuple):
    """What became of a body in an interval."""

    state: State
    peak: float  # rad, the largest |θ| so far
    impacts: int  # so far
    fallen_at: float  # fraction of the interval at which |θ| reached π/2, or -1


AT_REST = State(0.0, 0.0, 0.0, 0.0, 1.0)


@routine
def make_side(
    sign: float, h: float, own: float, other: float, i2: float, tilt: float, kept: float
) -> Side:
    """Rocking on the corner `own` from the centre of gravity's foot; `other` is the other one."""
    phase = math.atan2(own, h) + sign * tilt
    keep = kept if kept == kept else (i2 + h * h - own * other) / (i2 + h * h + other * other)
    k = math.sqrt(h * h + own * own) / (i2 + h * h + own * own)
    return Side(sign, k, phase, math.sin(phase), math.cos(phase), keep)


@routine
def make_block(
    width: float, cg_height: float, left: float, gyration_radius: float, tilt: float, kept: float
) -> Block:
    """A body on a support; `kept` is η, or NaN for an impact that keeps angular momentum."""
    right = width - left
    i2 = gyration_radius * gyration_radius
    return Block(
        make_side(1.0, cg_height, right, left, i2, tilt, kept),
        make_side(-1.0, cg_height, left, right, i2, tilt, kept),
    )


@kernel
def push_at(push: NDArray[np.float64], gravity: NDArray[np.float64], sign: float, i: int) -> Push:
    """The forcing in interval i; gravity alone once the record has ended."""
    if i + 1 >= push.size:
        return Push(STANDARD_GRAVITY, 0.0, 0.0, 0.0)
    return Push(
        gravity[i],
        gravity[i + 1] - gravity[i],
        sign * push[i],
        sign * (push[i + 1] - push[i]),
    )


@kernel
def seen_from(force: Push, sign: float) -> Push:
    """The forcing with its push times `sign`."""
    return Push(force.gravity, force.gravity_change, sign * force.push, sign * force.push_change)


@kernel
def rest_of(force: Push, u: float) -> Push:
    """The forcing in what is left of its interval after the fraction u."""
    left = 1.0 - u
    return Push(
        force.gravity + u * force.gravity_change,
        left * force.gravity_change,
        force.push + u * force.push_change,
        left * force.push_change,
    )


@kernel
def velocity_over(
    rate: float, sine: float, cosine: float, k: float, h: float, force: Push
) -> Series:
    """Series of w = h q' over an interval of length h."""
    kh2 = k * h * h
    w0 = rate * h
    w1, w2, w3, w4, w5, w6, w7, w8 = velocity_series(
        w0,
        sine,
        cosine,
        kh2 * force.gravity,
        kh2 * force.gravity_change,
        kh2 * force.push,
        kh2 * force.push_change,
    )
    return Series(w0, w1, w2, w3, w4, w5, w6, w7, w8, 0.0)


@kernel
def height_over(height: float, w: Series) -> Series:
    """Series of q from that of w."""
    return Series(
        height,
        w.c0,
        w.c1 * (1 / 2),
        w.c2 * (1 / 3),
        w.c3 * (1 / 4),
        w.c4 * (1 / 5),
        w.c5 * (1 / 6),
        w.c6 * (1 / 7),
        w.c7 * (1 / 8),
        w.c8 * (1 / 9),
    )


@kernel
def turned(sine: float, cosine: float, advance: float) -> tuple[float, float]:
    """sin and cos of ψ - advance, from those of ψ."""
    turn_sine, turn_cosine = small_sin_cos(advance)
    return sine * turn_cosine - cosine * turn_sine, cosine * turn_cosine + sine * turn_sine


@kernel
def step(
    height: float,
    rate: float,
    sine: float,
    cosine: float,
    k: float,
    peak: float,
    h: float,
    force: Push,
) -> tuple[float, float, float, float, bool]:
    """(q, q', sin ψ, cos ψ) after an interval of length h, and whether anything may happen in it.

    That is: q may reach zero, it overturns, it may turn back above its peak so far, or it turns
    too far for `small_sin_cos`. A body that turns back has w <= 0 at the end or, if it turns
    twice, had w0 + w1 <= 0 (with w0 > -w1 a parabola that curves up stays positive).
    """
    w = velocity_over(rate, sine, cosine, k, h, force)
    q = height_over(height, w)
    end = value(q, 1.0)
    w_end = value(w, 1.0)
    advance = end - q.c0
    eventful = (
        (lowest(q) <= 0.0)
        | (end >= RIGHT_ANGLE)
        | ((highest(q) > peak) & ((w_end <= 0.0) | (w.c0 + w.c1 <= 0.0)))
        | (abs(advance) > MAX_ADVANCE)
    )
    new_sine, new_cosine = turned(sine, cosine, advance)
    return end, w_end * (1.0 / h), new_sine, new_cosine, eventful


@kernel
def bounce(
    height: float,
    rate: float,
    sine: float,
    cosine: float,
    k: float,
    keep: float,
    k_other: float,
    sine_other: float,
    cosine_other: float,
    peak: float,
    h: float,
    force: Push,
) -> tuple[float, float, float, float, float, bool]:
    """(q, q', sin ψ, cos ψ) on the other side after an interval with exactly one impact, its u,
    and whether it is so.

    It is if q falls throughout to below zero, and if on the other side the body then stays off
    the ground, does not rise above its peak and is not about to settle (`settles`: the apex of
    its flight, q1²/(-4 q2), is higher). Like `step` without a branch: it is what happens in most
    eventful intervals.
    """
    w = velocity_over(rate, sine, cosine, k, h, force)
    q = height_over(height, w)
    end = value(q, 1.0)
    u = newton(q, newton(q, newton(q, newton(q, q.c0 / (q.c0 - end)))))
    single = (
        (q.c0 > 0.0)
        & (end < 0.0)
        & (q.c1 + steepest_rise(q) < 0.0)
        & (u > 0.0)
        & (u < 1.0)
        & (abs(value(q, u)) <= NEWTON_RESIDUE * q.c0)
    )
    left = 1.0 - u
    span = left * h
    w = velocity_over(
        -keep * (value(w, u) * (1.0 / h)),
        sine_other,
        cosine_other,
        k_other,
        span,
        seen_from(rest_of(force, u), -1.0),
    )
    q = height_over(0.0, w)
    end = value(q, 1.0)
    clean = (
        single
        & (keep > 0.0)
        & stays_above(q)
        & (highest(q) <= peak)
        & (q.c1 * q.c1 > -4.0 * SETTLE_ROTATION * q.c2)
        & (end < MAX_ADVANCE)
    )
    new_sine, new_cosine = turned(sine_other, cosine_other, end)
    return end, value(w, 1.0) / span, new_sine, new_cosine, u, clean


@kernel
def side_of(block: Block, sign: float) -> Side:
    return block.right if sign > 0.0 else block.left


@kernel
def lift(side: Side, gravity: float, push: float) -> float:
    """Angular acceleration of a resting body about the side's pivot; > 0: it lifts (A eq. 1)."""
    return -side.k * (gravity * side.sine + side.sign * push * side.cosine)


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
    """(u, s) at which a resting body lifts within the forcing's interval, or (NO_ROOT, 0)."""
    right = lift(block.right, force.gravity, force.push)
    left = lift(block.left, force.gravity, force.push)
    right_at = first_positive(right, lift(block.right, force.gravity_change, force.push_change))
    left_at = first_positive(left, lift(block.left, force.gravity_change, force.push_change))
    if right_at == NO_ROOT and left_at == NO_ROOT:
        return NO_ROOT, 0.0
    if right_at == left_at:  # both at once: only where g + a_y < 0, the harder push wins
        return right_at, 1.0 if right >= left else -1.0
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
    here: Side,
    there: Side,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    polarity: float,
    i: int,
    u: float,
    h: float,
    peak: float,
) -> bool:
    """Whether the bounces that start on side `here` with `speed` die out before anything lifts it.

    The infinitely many bounces that are left are summed as a geometric series (`bounce_time`).
    They are taken as done if they end within SETTLE_MARGIN times the time they take under the
    present forcing, even with the smallest restoring accelerations in that time and with every
    flight gaining the most that a changing acceleration can give it: v'/v <= √(1 + |A'| t / A)
    in a flight of duration t. What is given up are rotations below SETTLE_ROTATION and `peak`.
    """
    if speed < RESTING_SPEED:
        return True
    now = rest_of(push_at(push, gravity, polarity, i), u)
    least_here = -lift(here, now.gravity, now.push)
    least_there = -lift(there, now.gravity, now.push)
    least = min(least_here, least_there)
    if least <= 0.0 or speed * speed > 2.0 * SETTLE_ROTATION * least:
        return False
    allowed = SETTLE_MARGIN * bounce_time(speed, least_here, least_there, here.keep, there.keep)
    last = i + math.ceil(u + allowed / h)
    if last > i + SETTLE_INTERVALS:
        return False
    steepest = 0.0
    for j in range(i, last):
        then = push_at(push, gravity, polarity, j)
        here_change = lift(here, then.gravity_change, then.push_change)
        there_change = lift(there, then.gravity_change, then.push_change)
        steepest = max(steepest, abs(here_change), abs(there_change))
        least_here = min(least_here, -lift(here, then.gravity, then.push) - here_change)
        least_there = min(least_there, -lift(there, then.gravity, then.push) - there_change)
    least = min(least_here, least_there)
    if least <= 0.0 or speed * speed > 2.0 * peak * least:
        return False
    growth = math.sqrt(1.0 + (steepest / least) * (2.0 * speed / least) / h)
    keep, back = growth * here.keep, growth * there.keep
    return keep * back < 1.0 and bounce_time(speed, least_here, least_there, keep, back) <= allowed


@routine
def peak_within(w: Series, q: Series, until: float, peak: float) -> float:
    """The larger of `peak` and the maximum of q(u), whose slope is w(u), on [0, until]."""
    if highest(q) <= peak:
        return peak
    top = max(peak, value(q, until))
    u = PAST_A_ROOT
    rising = value(w, u) > 0.0
    for _ in range(MOST_TURNS):
        u = first_root(w, u) if rising else first_root(negated(w), u)
        if u > until:
            break
        if rising:
            top = max(top, value(q, u))
        rising = not rising
        u += PAST_A_ROOT
    return top


@kernel
def negated(q: Series) -> Series:
    return Series(-q.c0, -q.c1, -q.c2, -q.c3, -q.c4, -q.c5, -q.c6, -q.c7, -q.c8, -q.c9)


@routine
def fall_at(q: Series) -> float:
    """The u at which q first reaches π/2."""
    to_floor = Series(
        RIGHT_ANGLE - q.c0, -q.c1, -q.c2, -q.c3, -q.c4, -q.c5, -q.c6, -q.c7, -q.c8, -q.c9
    )
    return min(first_root(to_floor, 0.0), 1.0)


@routine
def contact_at(q: Series, from_zero_moment: bool) -> float:
    """The u at which q returns to zero, NO_ROOT if it does not, or NO_LIFT.

    A body that is on the ground at u = 0 is there with a root of its own, which is left out:
    simple just after an impact, double where it lifts under a moment, triple where that moment
    passes zero. NO_LIFT: what seemed to lift it does not, to round-off.
    """
    zeros = 0
    if q.c0 == 0.0:
        zeros = 1
        if q.c1 == 0.0:
            zeros = 3 if from_zero_moment else 2
    ahead = without_leading_zeros(q, zeros)
    if zeros >= 2 and ahead.c0 <= 0.0:
        return NO_LIFT
    return first_root(ahead, 0.0)


@routine
def series_over(
    state: State, side: Side, h: float, force: Push, from_zero_moment: bool
) -> tuple[Series, Series]:
    """Series of w and of q for a body in motion."""
    own = seen_from(force, state.side)
    w = velocity_over(state.rate, state.sine, state.cosine, side.k, h, own)
    if from_zero_moment:  # it lifts where the moment passes zero: exactly so
        w = Series(w.c0, 0.0, w.c2, w.c3, w.c4, w.c5, w.c6, w.c7, w.c8, w.c9)
    return w, height_over(state.height, w)


@kernel
def on_ground(side: Side, rate: float) -> State:
    """A body at q = 0 that moves off on `side`."""
    return State(side.sign, 0.0, rate, side.sine, side.cosine)


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
    whole = push_at(push, gravity, polarity, i)
    elapsed = 0.0
    for _ in range(EVENT_BUDGET):
        from_zero_moment = False
        if state.side == 0.0:
            u, sign = uplift(block, rest_of(whole, elapsed))
            if sign == 0.0:
                break
            elapsed += u * (1.0 - elapsed)
            state = on_ground(side_of(block, sign), 0.0)
            now = rest_of(whole, elapsed)
            moment = lift(side_of(block, sign), now.gravity, now.push)
            from_zero_moment = moment <= ZERO_MOMENT * side_of(block, sign).k
        side = side_of(block, state.side)
        left = 1.0 - elapsed
        span = left * h
        w, q = series_over(state, side, span, rest_of(whole, elapsed), from_zero_moment)
        contact = contact_at(q, from_zero_moment)
        if contact == NO_LIFT:
            state = AT_REST
            break
        peak = peak_within(w, q, min(contact, 1.0), peak)
        if peak >= RIGHT_ANGLE:
            u = fall_at(q)
            down = State(state.side, RIGHT_ANGLE, value(w, u) / span, 0.0, 0.0)
            return Passage(down, RIGHT_ANGLE, impacts, elapsed + u * left)
        if contact == NO_ROOT:
            height = value(q, 1.0)
            phase = side.phase - height
            state = State(
                state.side, height, value(w, 1.0) / span, math.sin(phase), math.cos(phase)
            )
            return Passage(state, peak, impacts, -1.0)
        elapsed += contact * left
        if impacts < impact_times.size:
            impact_times[impacts] = start + elapsed * h
        impacts += 1
        speed = -side.keep * value(w, contact) / span
        other = side_of(block, -state.side)
        if speed <= 0.0 or settles(
            speed, other, side, push, gravity, polarity, i, elapsed, h, peak
        ):
            state = AT_REST
        else:
            state = on_ground(other, speed)
        if elapsed >= 1.0:
            break
    else:
        state = AT_REST
    return Passage(state, peak, impacts, -1.0)
