"""What happens to a rocking body within an interval, event by event (theory, section 2).

Uplift from rest, impacts, the end of a bounce sequence, new peaks and overturning, in the
symbols of `rocking`. `cross_interval` is the long way through an interval: it is right for any
number of events in any order, and starts again from the state before the short ways were tried.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.forcing import (
    Forcing,
    Instant,
    Interval,
    Shaking,
    forcing_at,
    forcing_from,
    rest_of,
    seen_from,
)
from shaketable.physics.plane.rocking import (
    AT_REST,
    RIGHT_ANGLE,
    SETTLE_ROTATION,
    Block,
    Passage,
    Side,
    State,
    height_over,
    side_of,
    tipping,
    velocity_over,
)
from shaketable.physics.plane.taylor import (
    NO_ROOT,
    Series,
    first_root,
    highest,
    value,
    without_leading_zeros,
)

NO_LIFT = 3.0  # returned in place of the time of a contact
SETTLE_INTERVALS = 32  # intervals ahead in which the end of a bounce sequence is looked for
SETTLE_MARGIN = 2.0  # the sequence must end within its estimated duration times this
MOST_TURNS = 6  # turns of a body in one interval that are searched for its peak
PAST_A_ROOT = 1e-7  # of the interval: the next root is looked for this far past a root
ZERO_MOMENT = 1e-11  # m/s²: a moment over k that is zero to the round-off of g
RESTING_SPEED = 1e-10  # rad/s: a slower body is at rest
EVENT_BUDGET = 1_000_000  # events in one interval; after them a rocking body counts as at rest


@kernel
def first_positive(start: float, change: float) -> float:
    """The first u in [0, 1] from which start + change u is positive, or NO_ROOT."""
    if start > 0.0:
        return 0.0
    if start + change > 0.0:
        return -start / change
    return NO_ROOT


@routine
def uplift(block: Block, force: Forcing) -> tuple[float, float]:
    """(u, s) at which a resting body lifts within the forcing's interval, or (NO_ROOT, 0)."""
    right = tipping(block.right, force.g_effective, force.a_x)
    left = tipping(block.left, force.g_effective, force.a_x)
    right_at = first_positive(
        right, tipping(block.right, force.g_effective_change, force.a_x_change)
    )
    left_at = first_positive(left, tipping(block.left, force.g_effective_change, force.a_x_change))
    if right_at == NO_ROOT and left_at == NO_ROOT:
        return NO_ROOT, 0.0
    if right_at == left_at:  # both at once: only where g + a_y < 0; the larger moment wins
        return right_at, 1.0 if right >= left else -1.0
    return (right_at, 1.0) if right_at < left_at else (left_at, -1.0)


@kernel
def bounce_time(speed: float, here: float, there: float, keep: float, back: float) -> float:
    """Duration of all bounces that begin with `speed` on a side with restoring acceleration `here`.

    Each flight lasts 2 v / A; the impacts leave in turn the shares `keep` and `back` of the speed.
    """
    return 2.0 * speed * (1.0 / here + keep / there) / (1.0 - keep * back)


@routine
def settles(
    speed: float, here: Side, there: Side, shaking: Shaking, at: Instant, peak: float
) -> bool:
    """Whether the bounces that start on side `here` with `speed` die out before the body lifts.

    The infinitely many bounces still to come are summed as a geometric series (`bounce_time`).
    They are taken as done if they end within SETTLE_MARGIN times the time they take under the
    present forcing, even with the smallest restoring accelerations in that time and with every
    flight gaining the most that a changing acceleration can give it: v'/v <= √(1 + |A'| t / A)
    in a flight of duration t. Only rotations below SETTLE_ROTATION and `peak` are neglected.
    """
    if speed < RESTING_SPEED:
        return True
    now = forcing_from(shaking, at)
    least_here = -tipping(here, now.g_effective, now.a_x)
    least_there = -tipping(there, now.g_effective, now.a_x)
    least = min(least_here, least_there)
    if least <= 0.0 or speed * speed > 2.0 * SETTLE_ROTATION * least:
        return False
    h = shaking.time_step
    allowed = SETTLE_MARGIN * bounce_time(
        speed, least_here, least_there, here.velocity_ratio, there.velocity_ratio
    )
    last = at.i + int(math.ceil(at.u + allowed / h))  # noqa: RUF046  a float on a GPU
    if last > at.i + SETTLE_INTERVALS:
        return False
    steepest = 0.0
    for j in range(at.i, last):
        then = forcing_at(shaking, j, at.polarity)
        here_change = tipping(here, then.g_effective_change, then.a_x_change)
        there_change = tipping(there, then.g_effective_change, then.a_x_change)
        steepest = max(steepest, abs(here_change), abs(there_change))
        least_here = min(least_here, -tipping(here, then.g_effective, then.a_x) - here_change)
        least_there = min(least_there, -tipping(there, then.g_effective, then.a_x) - there_change)
    least = min(least_here, least_there)
    if least <= 0.0 or speed * speed > 2.0 * peak * least:
        return False
    growth = math.sqrt(1.0 + (steepest / least) * (2.0 * speed / least) / h)
    keep, back = growth * here.velocity_ratio, growth * there.velocity_ratio
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

    A body that is on the ground at u = 0 has a root there, which is left out: a simple one just
    after an impact, a double one where a moment lifts the body, a triple one where that moment
    passes zero. NO_LIFT means that, to round-off, what seemed to lift the body does not.
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
    state: State, side: Side, h: float, force: Forcing, from_zero_moment: bool
) -> tuple[Series, Series]:
    """Series of w and of q for a body in motion."""
    own = seen_from(force, state.side)
    w = velocity_over(state.rate, state.sine, state.cosine, side.k, h, own)
    if from_zero_moment:  # it lifts where the moment passes zero, which is made exact
        w = Series(w.c0, 0.0, w.c2, w.c3, w.c4, w.c5, w.c6, w.c7, w.c8, w.c9)
    return w, height_over(state.rotation, w)


@kernel
def on_ground(side: Side, rate: float) -> State:
    """A body at q = 0 that moves off on `side`."""
    return State(side.sign, 0.0, rate, side.sine, side.cosine)


@routine
def cross_interval(
    passage: Passage,
    block: Block,
    shaking: Shaking,
    interval: Interval,
    impact_times: NDArray[np.float64],
) -> Passage:
    """Take a body through an interval of the motion, event by event.

    The time of impact number n is written to impact_times[n] while it fits.
    """
    state, peak, impacts, _ = passage
    i, start, polarity = interval
    whole, h = forcing_at(shaking, i, polarity), shaking.time_step
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
            moment = tipping(side_of(block, sign), now.g_effective, now.a_x)
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
        speed = -side.velocity_ratio * value(w, contact) / span
        other = side_of(block, side.onward * state.side)
        if speed <= 0.0 or settles(
            speed, other, side, shaking, Instant(i, elapsed, polarity), peak
        ):
            state = AT_REST
        else:
            state = on_ground(other, speed)
        if elapsed >= 1.0:
            break
    else:
        state = AT_REST
    return Passage(state, peak, impacts, -1.0)
