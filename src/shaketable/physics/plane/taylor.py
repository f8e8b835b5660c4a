"""Taylor series of the rocking equation over one interval, and the first root of a polynomial.

Within an interval the ground acceleration is linear in time, so that with the dimensionless
time u ∈ [0, 1] the rocking equation (theory, section 2) reads

    w' = -(P(u) sin ψ + Q(u) cos ψ),    ψ' = -w,    P = P0 + P1 u,    Q = Q0 + Q1 u

| symbol | what                                                          | unit |
|--------|---------------------------------------------------------------|------|
| u      | time from the start of the interval over its length h         | -    |
| q      | s θ, rotation on the side the body rocks on, >= 0             | rad  |
| w      | h q', rotation per interval                                   | rad  |
| ψ      | s φ = α_s - q + s β                                           | rad  |
| P, Q   | h² k (g + a_y), h² k s a_x, k = r/(i² + r²)                   | -    |

The series of sin ψ and cos ψ follow from the products ψ' cos ψ and -ψ' sin ψ, so that one
sin/cos pair at u = 0 is all that an interval needs (Moore's automatic differentiation).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine

ORDER = 8  # of the velocity series; the rotation has one more
MAX_PHASE = 0.1  # rad: the largest √(k |f|) h at which order 8 is at round-off, 0.1⁹/9!
MAX_ADVANCE = 0.15  # rad: the largest rotation in an interval that small_sin_cos is exact for
NO_ROOT = 2.0  # lies outside [0, 1]
CONVERGED = 1e-9  # of the interval: convergence is quadratic, the next step would be 1e-18
MAX_ROOT_STEPS = 10_000  # few suffice, but c0 - u⁹ from 1e-8 takes 9,000; a double root 30 halvings


class Series(NamedTuple):
    """Coefficients 0 to 9 of a polynomial on [0, 1]."""

    c0: float
    c1: float
    c2: float
    c3: float
    c4: float
    c5: float
    c6: float
    c7: float
    c8: float
    c9: float


@kernel
def velocity_series(
    w0: float, s0: float, c0: float, P0: float, P1: float, Q0: float, Q1: float
) -> tuple[float, float, float, float, float, float, float, float]:
    """Coefficients w_1 to w_8 of w(u), from w_0, sin ψ and cos ψ at u = 0.

    In each sum the coefficients found last are added last, so that the sum waits least for them.
    """
    w1 = -(P0 * s0 + Q0 * c0)
    s1 = -w0 * c0
    c1 = w0 * s0
    w2 = -(1 / 2) * ((P1 * s0 + Q1 * c0) + (P0 * s1 + Q0 * c1))
    s2 = -(1 / 2) * (w0 * c1 + w1 * c0)
    c2 = (1 / 2) * (w0 * s1 + w1 * s0)
    w3 = -(1 / 3) * ((P1 * s1 + Q1 * c1) + (P0 * s2 + Q0 * c2))
    s3 = -(1 / 3) * ((w1 * c1 + w0 * c2) + w2 * c0)
    c3 = (1 / 3) * ((w1 * s1 + w0 * s2) + w2 * s0)
    w4 = -(1 / 4) * ((P1 * s2 + Q1 * c2) + (P0 * s3 + Q0 * c3))
    s4 = -(1 / 4) * (((w1 * c2 + w2 * c1) + w0 * c3) + w3 * c0)
    c4 = (1 / 4) * (((w1 * s2 + w2 * s1) + w0 * s3) + w3 * s0)
    w5 = -(1 / 5) * ((P1 * s3 + Q1 * c3) + (P0 * s4 + Q0 * c4))
    s5 = -(1 / 5) * (((w1 * c3 + (w2 * c2 + w3 * c1)) + w0 * c4) + w4 * c0)
    c5 = (1 / 5) * (((w1 * s3 + (w2 * s2 + w3 * s1)) + w0 * s4) + w4 * s0)
    w6 = -(1 / 6) * ((P1 * s4 + Q1 * c4) + (P0 * s5 + Q0 * c5))
    s6 = -(1 / 6) * ((((w1 * c4 + w2 * c3) + (w3 * c2 + w4 * c1)) + w0 * c5) + w5 * c0)
    c6 = (1 / 6) * ((((w1 * s4 + w2 * s3) + (w3 * s2 + w4 * s1)) + w0 * s5) + w5 * s0)
    w7 = -(1 / 7) * ((P1 * s5 + Q1 * c5) + (P0 * s6 + Q0 * c6))
    s7 = -(1 / 7) * ((((w1 * c5 + w2 * c4) + (w3 * c3 + (w4 * c2 + w5 * c1))) + w0 * c6) + w6 * c0)
    c7 = (1 / 7) * ((((w1 * s5 + w2 * s4) + (w3 * s3 + (w4 * s2 + w5 * s1))) + w0 * s6) + w6 * s0)
    w8 = -(1 / 8) * ((P1 * s6 + Q1 * c6) + (P0 * s7 + Q0 * c7))
    return w1, w2, w3, w4, w5, w6, w7, w8


@kernel
def small_sin_cos(x: float) -> tuple[float, float]:
    """sin x and cos x to round-off for |x| <= MAX_ADVANCE, without a branch."""
    y = x * x
    sine = x + x * y * (-1 / 6 + y * (1 / 120 + y * (-1 / 5040 + y * (1 / 362880))))
    cosine = 1 + y * (-1 / 2 + y * (1 / 24 + y * (-1 / 720 + y * (1 / 40320 + y * (-1 / 3628800)))))
    return sine, cosine


@kernel
def negative_part(x: float) -> float:
    return x if x < 0.0 else 0.0


@kernel
def positive_part(x: float) -> float:
    return x if x > 0.0 else 0.0


@kernel
def bend_down(q: Series) -> float:
    """The most that the terms beyond c1 can take from q on [0, 1], divided by u (u^k <= u)."""
    high = negative_part(q.c6) + negative_part(q.c7) + negative_part(q.c8) + negative_part(q.c9)
    low = negative_part(q.c3) + negative_part(q.c4) + negative_part(q.c5)
    return negative_part(q.c2) + (low + high)


@kernel
def lowest(q: Series) -> float:
    """A lower bound of q on [0, 1]."""
    return q.c0 + negative_part(q.c1 + bend_down(q))


@kernel
def highest(q: Series) -> float:
    """An upper bound of q on [0, 1]."""
    high = positive_part(q.c6) + positive_part(q.c7) + positive_part(q.c8) + positive_part(q.c9)
    low = positive_part(q.c3) + positive_part(q.c4) + positive_part(q.c5)
    return q.c0 + positive_part(q.c1 + (positive_part(q.c2) + (low + high)))


@kernel
def stays_above(q: Series) -> bool:
    """Whether q, which is 0 at u = 0, is positive on (0, 1]."""
    return q.c1 + bend_down(q) > 0.0


@kernel
def steepest_rise(q: Series) -> float:
    """An upper bound on [0, 1] of q'(u) - q'(0)."""
    high = 6 * positive_part(q.c6) + 7 * positive_part(q.c7) + 8 * positive_part(q.c8)
    low = 3 * positive_part(q.c3) + 4 * positive_part(q.c4) + 5 * positive_part(q.c5)
    return 2 * positive_part(q.c2) + (low + (high + 9 * positive_part(q.c9)))


@kernel
def value(q: Series, u: float) -> float:
    """q(u) by Estrin's scheme: pairs first, for they do not wait for each other."""
    u2 = u * u
    low = (q.c0 + u * q.c1) + u2 * (q.c2 + u * q.c3)
    high = (q.c4 + u * q.c5) + u2 * (q.c6 + u * q.c7)
    u4 = u2 * u2
    return low + u4 * (high + u4 * (q.c8 + u * q.c9))


@kernel
def slope(q: Series, u: float) -> float:
    """q'(u), likewise."""
    u2 = u * u
    low = (q.c1 + u * (2 * q.c2)) + u2 * (3 * q.c3 + u * (4 * q.c4))
    high = (5 * q.c5 + u * (6 * q.c6)) + u2 * (7 * q.c7 + u * (8 * q.c8))
    u4 = u2 * u2
    return low + u4 * (high + u4 * (9 * q.c9))


@kernel
def newton(q: Series, u: float) -> float:
    """One step of Newton's method towards a root of q."""
    return u - value(q, u) / slope(q, u)


@routine
def first_root(q: Series, start: float) -> float:
    """The smallest root of q in [start, 1] coming from q > 0, or NO_ROOT; start if q <= 0 there.

    From a point left of the root q is never below the parabola with its value, its slope and
    the most negative curvature that its coefficients allow on [0, 1]; the parabola's own root
    is therefore never beyond q's. Stepping from root to root converges quadratically like
    Newton's method, but cannot miss a pair of roots or a graze.
    """
    bend = -(
        2 * negative_part(q.c2)
        + 6 * negative_part(q.c3)
        + 12 * negative_part(q.c4)
        + 20 * negative_part(q.c5)
        + 30 * negative_part(q.c6)
        + 42 * negative_part(q.c7)
        + 56 * negative_part(q.c8)
        + 72 * negative_part(q.c9)
    )
    u = start
    for _ in range(MAX_ROOT_STEPS):
        height = value(q, u)
        if height <= 0.0:
            return u
        rise = slope(q, u)
        reach = math.sqrt(rise * rise + 2.0 * bend * height)
        if rise < 0.0:
            step = 2.0 * height / (reach - rise)
        elif bend > 0.0:
            step = (rise + reach) / bend
        else:
            return NO_ROOT
        u += step
        if u > 1.0:
            return NO_ROOT
        if step < CONVERGED:
            return u
    return u


@routine
def without_leading_zeros(q: Series, zeros: int) -> Series:
    """q(u) / u^zeros for a q whose first `zeros` (0 to 3) coefficients vanish.

    It takes the known root at the start of an interval out of the search for the next one.
    """
    if zeros == 1:
        return Series(q.c1, q.c2, q.c3, q.c4, q.c5, q.c6, q.c7, q.c8, q.c9, 0.0)
    if zeros == 2:
        return Series(q.c2, q.c3, q.c4, q.c5, q.c6, q.c7, q.c8, q.c9, 0.0, 0.0)
    if zeros == 3:
        return Series(q.c3, q.c4, q.c5, q.c6, q.c7, q.c8, q.c9, 0.0, 0.0, 0.0)
    return q
