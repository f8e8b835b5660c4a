"""How a stack of two at rest begins to rock: the upper alone, the whole as one, or both.

Psycharis I.N. (1990) Dynamic behaviour of rocking two-block assemblies, Earthquake Engng Struct.
Dyn. 19(4):555-575 names the modes. The borders here are derived again, for two symmetric
rectangles whose centres stand over each other, that do not slip, under a horizontal acceleration A
that sets in on a level support. Indices 1 and 2 are the lower and the upper; b and h are half their
sizes (b₂ at most b₁), i² and j² their squared radii of gyration, y₂ = 2 h₁ + h₂.

    upper alone   A > g b₂/h₂
    whole         A > g M_b/M_h,  M_b = (m₁ + m₂) b₁,  M_h = m₁ h₁ + m₂ y₂

The second holds where the upper would not rock alone. Where it does, with
τ₂ = (A h₂ - g b₂)/(j² + b₂² + h₂²), its base pushes the lower less, and the lower begins later,
where

    m₁ A h₁ + m₂ (A - τ₂ h₂) 2h₁ > m₁ g b₁ + m₂ (g + τ₂ b₂) (b₁ - b₂)

As the whole turns with τ = (A M_h - g M_b)/I₀, I₀ = m₁ (i² + b₁² + h₁²) + m₂ (j² + b₁² + y₂²), the
upper is lifted, too,

    the same way  (A - τ y₂) h₂ - (g + τ b₁) b₂ - j² τ > 0
    against it    -(A - τ y₂) h₂ + j² τ - (g + τ b₁) b₂ > 0

More is not always worse: once the lower turns an upper that would rock alone may stand still on it
again. How a stack moves on is not simulated.
"""

from __future__ import annotations

import math
from enum import IntEnum
from typing import NamedTuple

from shaketable.body import Body
from shaketable.errors import InputError, require_not_negative
from shaketable.units import STANDARD_GRAVITY


class StackMode(IntEnum):
    """How a stack of two at rest begins to rock."""

    REST = 0
    UPPER = 1  # the upper alone
    WHOLE = 2  # both as one
    SAME_WAY = 3  # both, the upper on the lower and the same way
    AGAINST = 4  # both, the upper against the lower


class _Stack(NamedTuple):
    """What the borders need."""

    b1: float
    b2: float
    h2: float
    y2: float
    j2: float
    moment_b: float  # M_b [kg m]
    moment_h: float  # M_h [kg m]
    inertia: float  # I₀ [kg m²]
    m1: float
    m2: float
    top: float  # 2 h₁ [m]
    lower_moment: float  # m₁ h₁ [kg m]

    @property
    def upper_alone(self) -> float:
        """From which acceleration on the upper would rock alone [m/s²]."""
        return STANDARD_GRAVITY * self.b2 / self.h2

    @property
    def lower_begins(self) -> float:
        """From which acceleration on the lower turns [m/s²]; infinite if it never does."""
        g, whole = STANDARD_GRAVITY, STANDARD_GRAVITY * self.moment_b / self.moment_h
        if whole <= self.upper_alone:
            return whole
        squared = self.j2 + self.b2**2 + self.h2**2
        relief = self.m2 * (self.h2 * self.top + self.b2 * (self.b1 - self.b2)) / squared
        pushes = self.lower_moment + self.m2 * self.top - relief * self.h2
        holds = g * (self.m1 * self.b1 + self.m2 * (self.b1 - self.b2) - relief * self.b2)
        return holds / pushes if pushes > 0.0 else math.inf


def stack_mode(lower: Body, upper: Body, acceleration: float) -> StackMode:
    """How a stack begins to rock under an acceleration of the ground of either sign.

    Args:
        lower, upper: symmetric, with masses.
        acceleration: its size A [m/s²].

    Raises:
        InputError: bodies without a mass or off centre, or a negative acceleration.
    """
    require_not_negative("acceleration [m/s²]", acceleration)
    stack, g = _stack_of(lower, upper), STANDARD_GRAVITY
    if not acceleration > stack.lower_begins:
        return StackMode.UPPER if acceleration > stack.upper_alone else StackMode.REST
    turn = (acceleration * stack.moment_h - g * stack.moment_b) / stack.inertia
    pushes = (acceleration - turn * stack.y2) * stack.h2
    holds = (g + turn * stack.b1) * stack.b2
    if pushes - holds - stack.j2 * turn > 0.0:
        return StackMode.SAME_WAY
    return StackMode.AGAINST if stack.j2 * turn - pushes - holds > 0.0 else StackMode.WHOLE


def stack_borders(lower: Body, upper: Body) -> list[tuple[StackMode, float]]:
    """Each mode that follows another as the acceleration grows, and from where on [m/s²].

    Raises:
        InputError: as for `stack_mode`.
    """
    stack, g = _stack_of(lower, upper), STANDARD_GRAVITY
    at = {each for each in (stack.upper_alone, stack.lower_begins) if math.isfinite(each)}
    lever, per_turn = stack.y2 * stack.h2 + stack.j2, stack.moment_h / stack.inertia
    rest = g * stack.moment_b / stack.inertia
    for sign in (1.0, -1.0):  # where what lifts the upper, the same way or against, is none
        slope = sign * stack.h2 - (sign * lever + stack.b1 * stack.b2) * per_turn
        start = (sign * lever + stack.b1 * stack.b2) * rest - g * stack.b2
        if slope != 0.0 and -start / slope > 0.0:
            at.add(-start / slope)
    borders = sorted(at)
    found: list[tuple[StackMode, float]] = []
    mode = StackMode.REST
    for border, after in zip(borders, [*borders[1:], 2.0 * borders[-1]], strict=True):
        following = stack_mode(lower, upper, 0.5 * (border + after))
        if following != mode:
            found.append((following, border))
            mode = following
    return found


def _stack_of(lower: Body, upper: Body) -> _Stack:
    for name, body in (("lower", lower), ("upper", upper)):
        if body.mass is None:
            raise InputError(f"the {name} body of a stack needs a mass; give Body(mass=...) [kg]")
        if not math.isclose(body.left, body.base / 2, rel_tol=1e-9):
            raise InputError(f"the {name} body of a stack must be symmetric, got {body!r}")
    m1, m2 = float(lower.mass or 0.0), float(upper.mass or 0.0)
    b1, h1, h2 = lower.base / 2, lower.cg_height, upper.cg_height
    b2 = min(upper.base / 2, b1)  # what overhangs turns about the edge of the lower
    y2 = lower.whole_height + h2
    i2, j2 = lower.gyration_radius**2, upper.gyration_radius**2
    inertia = m1 * (i2 + b1**2 + h1**2) + m2 * (j2 + b1**2 + y2**2)
    return _Stack(
        b1, b2, h2, y2, j2, (m1 + m2) * b1, m1 * h1 + m2 * y2, inertia, m1, m2, y2 - h2, m1 * h1
    )
