"""Friction cones: how much friction touches have left."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.workspace import Workspace

NO_CONE = 1e9  # m/s²: margin of a contact without a cone to leave


@kernel
def limit(mu: float, pressure: float) -> float:
    """The most friction that a pressure gives."""
    return NO_CONE if mu > NO_CONE else mu * pressure


@kernel
def spare(work: Workspace, place: int) -> float:
    """μ_s N less the friction of a touch."""
    touch = work.touches[place]
    x, y = touch.share[0], touch.share[1]
    return limit(touch.static, touch.share[2]) - math.sqrt(x * x + y * y)


@kernel
def spare_along(work: Workspace, place: int) -> float:
    """Friction that one end of a line has left for a force along it."""
    touch = work.touches[place]
    x, y = touch.share[0], touch.share[1]
    most = max(limit(touch.static, touch.share[2]), 0.0)
    return math.sqrt(max(most * most - x * x - y * y, 0.0))


@kernel
def excess_across(work: Workspace, place: int) -> float:
    """How much more friction one end of a line needs across it than it can have."""
    touch = work.touches[place]
    x, y = touch.share[0], touch.share[1]
    return math.sqrt(x * x + y * y) - max(limit(touch.static, touch.share[2]), 0.0)


@routine
def margin_of_two(work: Workspace, first: int, last: int, along: float) -> float:
    """The friction that two touches which stick have left: some split of what is along them holds.

    Args:
        along: the force along their line; their shares have that across it.
    """
    excess = max(excess_across(work, first), excess_across(work, last))
    if excess > 0.0:
        return -excess
    return spare_along(work, first) + spare_along(work, last) - abs(along)


@routine
def split_along(work: Workspace, first: int, last: int, along: float, x: float, y: float) -> int:
    """Add to the shares of two touches their parts of the force along (x, y), their line.

    The parts are as the friction that each has left; returns the one with less.
    """
    at_first, at_last = spare_along(work, first), spare_along(work, last)
    part = at_first / (at_first + at_last) if at_first + at_last > 0.0 else 0.5
    for place in (first, last):
        own = along * (part if place == first else 1.0 - part)
        work.touches[place].share[0] += own * x
        work.touches[place].share[1] += own * y
    return last if at_last < at_first else first


@kernel
def in_cone(reaction: Vec, mu: float) -> bool:
    size = math.sqrt(reaction.x * reaction.x + reaction.y * reaction.y)
    return reaction.z >= 0.0 and (mu == math.inf or size <= mu * reaction.z)


@routine
def to_cone(a: Vec, mu: float) -> Vec:
    """The nearest reaction within Coulomb's cone."""
    if in_cone(a, mu):
        return a
    if mu == math.inf:
        return Vec(a.x, a.y, 0.0)
    size = math.sqrt(a.x * a.x + a.y * a.y)
    if mu * size <= -a.z:
        return Vec(0.0, 0.0, 0.0)
    normal = (a.z + mu * size) / (1.0 + mu * mu)
    along = mu * normal / size if size > 0.0 else 0.0
    return Vec(along * a.x, along * a.y, normal)
