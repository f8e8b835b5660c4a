"""The exact motion of a linear oscillator under an acceleration linear between its samples.

| symbol | meaning | unit |
|---|---|---|
| u, v | displacement and velocity relative to the support | m, m/s |
| w, z | undamped angular frequency, damping ratio | rad/s, - |
| wd | w √(1 - z²) | rad/s |
| a, s | acceleration of the support at the step's start, and its slope | m/s², m/s³ |
| h | length of a step | s |

Equation: u'' + 2 z w u' + w² u = -(a + s t). Nigam and Jennings (1969) Calculation of response
spectra from strong-motion earthquake records, BSSA 59(2), 909-922.

Its particular solution is P + Q t with Q = -s/w² and P = -a/w² + 2 z s/w³; the homogeneous one is
a decaying sine. A step is a matrix. u has an extreme inside a step where v changes its sign.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine

LONGEST_PHASE = 0.5  # rad of the oscillator in one step: see `extreme`


class Step(NamedTuple):
    """u1 = uu u + uv v + ua a + us s; v1 = vu u + vv v + va a + vs s."""

    uu: float
    uv: float
    ua: float
    us: float
    vu: float
    vv: float
    va: float
    vs: float


@kernel
def step_of(w: float, z: float, h: float) -> Step:
    """The matrix of a step of length h."""
    wd = w * math.sqrt(1.0 - z * z)
    decay = math.exp(-z * w * h)
    c, s = decay * math.cos(wd * h), decay * math.sin(wd * h)
    uu, uv = c + z * w / wd * s, s / wd
    vu, vv = -w * w / wd * s, c - z * w / wd * s
    w2 = w * w
    p = 2.0 * z / (w2 * w)
    return Step(
        uu,
        uv,
        (uu - 1.0) / w2,
        p - h / w2 - p * uu + uv / w2,
        vu,
        vv,
        vu / w2,
        -1.0 / w2 - p * vu + vv / w2,
    )


@kernel
def advance(to: Step, u: float, v: float, a: float, s: float) -> tuple[float, float]:
    """u and v at a step's end."""
    return (
        (to.uu * u + to.uv * v) + (to.ua * a + to.us * s),
        (to.vu * u + to.vv * v) + (to.va * a + to.vs * s),
    )


class GroundSeries(NamedTuple):
    """Acceleration of the support in a step."""

    a: float  # at its start [m/s²]
    s: float  # slope [m/s³]


@kernel
def highest(
    w: float, z: float, h: float, u: float, v: float, u1: float, v1: float, ground: GroundSeries
) -> float:
    """An upper bound of |u| within a step: an extreme is at most h/2 from a sample, and exceeds it
    by |u''| (h/2)²/2 at most; 1.1 allows for the rise of u and v themselves."""
    u_most = abs(u) if abs(u) > abs(u1) else abs(u1)
    v_most = abs(v) if abs(v) > abs(v1) else abs(v1)
    pull = w * w * u_most + 2.0 * z * w * v_most + abs(ground.a) + abs(ground.s * h)
    return u_most + 1.1 * h * h / 8.0 * pull


@kernel
def free_extreme(w: float, z: float, u: float, v: float) -> tuple[float, float]:
    """The first extreme of u in free vibration, the largest as it decays, and its time.

    v(t) = e^{-zwt} (v cos wd t - (w² u + z w v)/wd sin wd t) is zero there.
    """
    wd = w * math.sqrt(1.0 - z * z)
    phase = math.atan2(v * wd, w * w * u + z * w * v)
    t = (phase if phase > 0.0 else phase + math.pi) / wd
    return advance(step_of(w, z, t), u, v, 0.0, 0.0)[0], t


@routine
def extreme(
    w: float, z: float, h: float, u: float, v: float, u1: float, v1: float, ground: GroundSeries
) -> float:
    """u where v changes its sign within a step from (u, v) to (u1, v1).

    The time is a root of the cubic that has v's values and slopes at both ends: for wh below
    LONGEST_PHASE it is off by (wh)⁴/384 = 2e-4 of a radian at most, and u, which is level there,
    by the square of that, 1e-8.
    """
    a, s = ground
    slope = -(a + 2.0 * z * w * v + w * w * u)
    slope1 = -(a + s * h + 2.0 * z * w * v1 + w * w * u1)
    # Newton on the Hermite cubic of x = t/h, kept in the bracket by bisection
    below, above = 0.0, 1.0
    x = v / (v - v1)
    for _ in range(30):
        y = 1.0 - x
        cubic = y * y * ((1.0 + 2.0 * x) * v + x * h * slope) + x * x * (
            (1.0 + 2.0 * y) * v1 - y * h * slope1
        )
        if cubic == 0.0:
            break
        if (cubic > 0.0) == (v > 0.0):
            below = x
        else:
            above = x
        steep = (
            6.0 * x * y * (v1 - v)
            + y * (1.0 - 3.0 * x) * h * slope
            - x * (2.0 - 3.0 * x) * h * slope1
        )
        tried = x - cubic / steep if steep != 0.0 else -1.0
        if not below < tried < above:
            tried = 0.5 * (below + above)
        if abs(tried - x) < 1e-9:
            x = tried
            break
        x = tried
    to = step_of(w, z, x * h)
    return advance(to, u, v, a, s)[0]
