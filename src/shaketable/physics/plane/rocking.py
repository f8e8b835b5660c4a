"""Rocking without sliding of a non-symmetric body on a tilted support (theory, sections 1 and 2).

| symbol | word                                         | unit | equation                         |
|--------|----------------------------------------------|------|----------------------------------|
| s      | +1 on pivot R, -1 on pivot L, 0 at rest      | -    | sign θ                           |
| q      | height: s θ, rotation on that side           | rad  | q'' = -k (g_e sin ψ + s a cos ψ) |
| ψ      | α_s - q + s β                                | rad  | eq. 2, mirrored                  |
| k      | r_s / (i² + r_s²); k g = p² for a rectangle  | 1/m  |                                  |
| g_e, a | g + a_y, a_x                                 | m/s² | linear within an interval        |
| e_s    | share of q' left when rocking on s ends      | -    | eq. 34, or the model's η         |

Equations 1 and 2 are those of Boroschek and Iruretagoyena (2006), equation 34 that of Boroschek and
Romo (2004).

Where a wall stands at the body's back, it rocks on the far side alone: an impact, of its back
against the wall and its base against the support at once, sends it back to that side.

Everything is seen from the side that the body rocks on: a body on pivot L is the mirrored body on
pivot R with a_x and β reversed, so that one set of formulas does for both.

An interval is one time step of the motion. `step` crosses it where nothing happens and `bounce`
where there is one plain impact, both without a branch; each says whether it was right.
Where it was not, `events` starts again from the same state and takes uplift, impacts, rest and
overturning one by one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.forcing import Forcing, rest_of, seen_from
from shaketable.physics.plane.taylor import (
    MAX_ADVANCE,
    Series,
    highest,
    lowest,
    newton,
    small_sin_cos,
    stays_above,
    steepest_rise,
    value,
    velocity_series,
)
from shaketable.units import STANDARD_GRAVITY

RIGHT_ANGLE = math.pi / 2
NEWTON_RESIDUE = 1e-14  # of the height at the interval's start: the impact is found to round-off
SETTLE_ROTATION = 1e-5  # rad: larger rotations are always followed


class Size(NamedTuple):
    """A body's numbers that every model needs."""

    base: float  # B [m]
    cg_height: float  # h [m]
    left: float  # b_L [m]
    gyration_radius: float  # i [m]
    restitution_factor: float  # multiplies the angular velocity that a rocking impact leaves


class Side(NamedTuple):
    """What rocking on one side needs."""

    sign: float  # s
    k: float  # 1/m
    phase: float  # ψ at q = 0 [rad]
    sine: float  # of that ψ
    cosine: float
    velocity_ratio: float  # e: share of q' left by the impact that ends rocking on this side
    # s of the side on which it goes on then, by its own: -1 for the other, +1 where a wall sends it
    # back
    onward: float


class Block(NamedTuple):
    """A body on its support, as the kernels need it."""

    right: Side
    left: Side


class State(NamedTuple):
    """A body's state, seen from its side."""

    side: float  # +1 on pivot R, -1 on pivot L, 0 at rest
    rotation: float  # q, from the support up [rad]
    rate: float  # q' [rad/s]
    sine: float  # sin ψ, carried along so that an interval needs no sin/cos call
    cosine: float


class Passage(NamedTuple):
    """What became of a body in an interval."""

    state: State
    peak: float  # rad, the largest |θ| so far
    impacts: int  # so far
    fallen_at: float  # fraction of the interval at which |θ| reached π/2, or -1


class Impact(NamedTuple):
    """The only impact in an interval."""

    u: float  # its time, as a fraction of the interval
    speed: float  # q' just after it, on the other side [rad/s]


AT_REST = State(0.0, 0.0, 0.0, 0.0, 1.0)


@routine
def make_side(size: Size, sign: float, tilt: float, kept: float) -> Side:
    """Rocking on the right (sign +1) or left (-1) corner; `kept` as in `make_block`.

    An η that would add energy is lowered to the largest one that does not (theory, section 2).
    """
    h, right, i2 = size.cg_height, size.base - size.left, size.gyration_radius**2
    own, other = (right, size.left) if sign > 0.0 else (size.left, right)
    phase = math.atan2(own, h) + sign * tilt
    own_inertia, other_inertia = i2 + h * h + own * own, i2 + h * h + other * other
    keep = (i2 + h * h - own * other) / other_inertia
    if kept == kept:  # from a short arm to a long one a large η would add energy
        keep = min(kept, math.sqrt(own_inertia / other_inertia))
    k = math.sqrt(h * h + own * own) / own_inertia
    ratio = size.restitution_factor * keep
    return Side(sign, k, phase, math.sin(phase), math.cos(phase), ratio, -1.0)


@routine
def make_block(size: Size, tilt: float, kept: float) -> Block:
    """A body on a support; `kept` is η, or NaN for an impact that keeps angular momentum."""
    return Block(make_side(size, 1.0, tilt, kept), make_side(size, -1.0, tilt, kept))


@kernel
def velocity_over(
    rate: float, sine: float, cosine: float, k: float, h: float, force: Forcing
) -> Series:
    """Series of w = h q' over an interval of length h."""
    kh2 = k * h * h
    w0 = rate * h
    w1, w2, w3, w4, w5, w6, w7, w8 = velocity_series(
        w0,
        sine,
        cosine,
        kh2 * force.g_effective,
        kh2 * force.g_effective_change,
        kh2 * force.a_x,
        kh2 * force.a_x_change,
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
def step(state: State, k: float, peak: float, h: float, force: Forcing) -> tuple[State, bool]:
    """The state after an interval of length h, and whether anything may happen in it.

    Something may happen if q may reach zero, if the body overturns or may turn back above its peak
    so far, or if it turns too far for `small_sin_cos`. A body that turns back has w <= 0 at the end
    or, if it turns twice, had w0 + w1 <= 0 (with w0 > -w1 a parabola curving up stays positive).
    """
    w = velocity_over(state.rate, state.sine, state.cosine, k, h, force)
    q = height_over(state.rotation, w)
    end = value(q, 1.0)
    w_end = value(w, 1.0)
    advance = end - q.c0
    eventful = (
        (lowest(q) <= 0.0)
        | (end >= RIGHT_ANGLE)
        | ((highest(q) > peak) & ((w_end <= 0.0) | (w.c0 + w.c1 <= 0.0)))
        | (abs(advance) > MAX_ADVANCE)
    )
    sine, cosine = turned(state.sine, state.cosine, advance)
    return State(state.side, end, w_end * (1.0 / h), sine, cosine), eventful


@kernel
def bounce(
    state: State,
    k: float,
    keep: float,
    onward: float,
    other: Side,
    peak: float,
    h: float,
    force: Forcing,
) -> tuple[State, Impact, bool]:
    """The state after exactly one impact, that impact, and whether this is right.

    It is right if q falls to below zero throughout, and if on the side that it lands on (`other`,
    the other one unless a wall sends it back) the body then stays off the ground, does not rise
    above its peak and is not about to settle (`settles`: the apex of its flight, q1²/(-4 q2), is
    higher). Like `step` it has no branch, as this is what happens in most eventful intervals. k,
    keep and onward are those of the side that the body begins on.
    """
    w = velocity_over(state.rate, state.sine, state.cosine, k, h, force)
    q = height_over(state.rotation, w)
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
    speed = -keep * (value(w, u) * (1.0 / h))
    w = velocity_over(
        speed, other.sine, other.cosine, other.k, span, seen_from(rest_of(force, u), onward)
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
    sine, cosine = turned(other.sine, other.cosine, end)
    side = onward * state.side
    return State(side, end, value(w, 1.0) / span, sine, cosine), Impact(u, speed), clean


@kernel
def side_of(block: Block, sign: float) -> Side:
    return block.right if sign > 0.0 else block.left


@kernel
def tipping(side: Side, g_effective: float, a_x: float) -> float:
    """q'' that a body at rest would take up about the side's pivot; > 0: it tips (eq. 1)."""
    return -side.k * (g_effective * side.sine + side.sign * a_x * side.cosine)


@kernel
def released(block: Block, rotation: float) -> State:
    """The state of a body let go at `rotation`."""
    if rotation == 0.0:
        return AT_REST
    sign = 1.0 if rotation > 0.0 else -1.0
    phase = side_of(block, sign).phase - abs(rotation)
    return State(sign, abs(rotation), 0.0, math.sin(phase), math.cos(phase))


@kernel
def rocking_frequency(block: Block) -> float:
    """p of the quicker side under gravity alone [rad/s]."""
    return math.sqrt(STANDARD_GRAVITY * max(block.right.k, block.left.k))


@kernel
def least_demand(block: Block) -> float:
    """The smallest |a_x| / (g + a_y) at which a resting body can tip (eq. 1)."""
    right, left = block.right, block.left
    return min(abs(right.sine / right.cosine), abs(left.sine / left.cosine))
