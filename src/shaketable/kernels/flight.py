"""A rocking body from where it is to its next impact, or to the interval's end, without a branch.

It is what happens in nearly all eventful intervals: a body turns at a peak, or falls on its other
side once, twice, three times. Impact by impact it is taken through an interval; where a flight is
not as it is looked for here (`Flight.plain`), `events` crosses the interval instead. Symbols as in
`rocking`. Most flights are arches, q'' < 0: then q has one maximum, is nowhere lower than at both
ends, and has one root where it ends below zero.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel
from shaketable.kernels.forcing import Forcing
from shaketable.kernels.rocking import (
    RIGHT_ANGLE,
    SETTLE_ROTATION,
    Side,
    State,
    height_over,
    turned,
    velocity_over,
)
from shaketable.kernels.taylor import (
    MAX_ADVANCE,
    bend_down,
    highest,
    most_curved,
    newton,
    positive_part,
    steepest_rise,
    value,
)

MOST_FLIGHTS = 4  # in an interval; the fourth must not land
RESIDUE = 1e-15  # of the terms of q: an impact is found to round-off
NEAR = 1e-4  # of the interval, in the last step to a turn: q there is then found to round-off


class Flight(NamedTuple):
    """How a flight ends."""

    state: State  # at the interval's end, or just after the impact, on the other side
    until: float  # when, as a fraction of what was left of the interval
    fall: float  # q' then, before the impact [rad/s]
    peak: float  # rad, the largest |θ| so far
    landed: bool
    plain: bool  # whether all of this is right


@kernel
def fly(
    state: State, here: Side, there: Side, keep: float, peak: float, span: float, force: Forcing
) -> Flight:
    """The flight of a body that is above the ground, or has just left it at an impact.

    Args:
        state: q >= 0; where q = 0 it moves off with q' > 0.
        here, there: the side that it rocks on, and the other one.
        keep: share of q' that an impact leaves.
        span: what is left of the interval [s].
        force: in what is left, as seen from `here`.
    """
    w = velocity_over(state.rate, state.sine, state.cosine, here.k, span, force)
    q = height_over(state.height, w)
    end, w_end = value(q, 1.0), value(w, 1.0)
    landed = end < 0.0
    arch = most_curved(q) < 0.0
    # Newton's method begins at the root of a parabola: of q, or of q/u where it leaves the ground
    grounded = q.c0 <= 0.0
    a, b, c = (q.c1, q.c2, q.c3) if grounded else (q.c0, q.c1, q.c2)
    reach = math.sqrt(positive_part(b * b - 4.0 * a * c))
    first = (b + reach) / (-2.0 * c) if b > 0.0 else 2.0 * a / (reach - b)
    u = newton(q, newton(q, newton(q, first)))
    near_turn = newton(w, newton(w, -0.5 * q.c1 / q.c2))
    turn = newton(w, near_turn)
    found = (
        (u > 0.0)
        & (u < 1.0)
        & (abs(value(q, u)) <= RESIDUE * (q.c0 + abs(q.c1) + abs(q.c2)))
        & (arch | (q.c1 + steepest_rise(q) < 0.0))
    )
    down = q.c1 + bend_down(q)
    above = (down > 0.0) | (q.c0 + down > 0.0)
    stays = (
        (end > 0.0)
        & (end < RIGHT_ANGLE)
        & (abs(end - q.c0) <= MAX_ADVANCE)
        & (arch | (above & (highest(q) <= peak)))
    )
    turns = arch & (q.c1 > 0.0) & (w_end < 0.0)
    top = value(q, turn) if turns else (q.c0 if q.c0 > end else end)
    fall = (value(w, u) if landed else w_end) * (1.0 / span)
    speed = -keep * fall
    settling = grounded & (q.c1 * q.c1 <= -4.0 * SETTLE_ROTATION * q.c2)
    plain = (
        (not settling)
        & (q.c0 + positive_part(q.c1) > 0.0)
        & ((found & (speed > 0.0)) if landed else stays)
        & ((not turns) | ((turn > 0.0) & (turn < 1.0) & (abs(turn - near_turn) <= NEAR)))
    )
    sine, cosine = turned(state.sine, state.cosine, end - q.c0)
    ends = State(
        -state.side if landed else state.side,
        0.0 if landed else end,
        speed if landed else fall,
        there.sine if landed else sine,
        there.cosine if landed else cosine,
    )
    return Flight(ends, u if landed else 1.0, fall, top if top > peak else peak, landed, plain)
