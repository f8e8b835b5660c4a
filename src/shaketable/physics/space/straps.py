r"""Straps from points of a solid to anchors on its support.

| symbol | word | unit |
|---|---|---|
| r | the strap's point from the centre of gravity, body frame | m |
| A | its anchor, support frame | m |
| D = A - p, L = \|D\|, n = D/L | from the point p = P + Q r to the anchor | m |
| δ = L - L₀ | stretch; L₀ is the length at the start, and slack - pretension/k | m |
| F = k δ + c δ̇ | force while δ > 0 and F > 0, else none; k and c by the body's mass | m/s² |

A force F n at p is F n at the centre of gravity and the torque r × Qᵀ(F n) in the body's frame. A
strap is loose (δ ≤ 0), taut, relaxed (δ > 0, but its damping would push), or broken once F has
reached its strength. δ̇ = -n·ṗ, and δ̈ = -n·p̈ + (\|ṗ\|² - (n·ṗ)²)/L.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.hermite import top_of
from shaketable.physics.space.contacts import axes_at, point_velocity
from shaketable.physics.space.vectors import (
    Axes,
    Vec,
    add,
    cross,
    dot,
    on_body,
    on_support,
    subtract,
    times,
)
from shaketable.physics.space.workspace import (
    Floats,
    P,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)

SHORT = 1e-8  # s
# What a strap does.
LOOSE, TAUT, RELAXED, BROKEN = range(4)


class Stretch(NamedTuple):
    """A strap in a state."""

    toward: Vec  # n, support frame
    length: float  # L [m]
    delta: float  # δ [m]
    rate: float  # δ̇ [m/s]
    force: float  # k δ + c δ̇, by the body's mass [m/s²]


@kernel
def stretch_of(work: Workspace, q: Axes, y: Floats, k: int) -> Stretch:
    """A strap in a state, whatever it does."""
    strap = work.straps[k]
    r = vec(strap.arm, 0)
    apart = subtract(vec(strap.anchor, 0), add(vec(y, P), on_support(q, r)))
    length = math.sqrt(dot(apart, apart))
    toward = times(1.0 / length, apart)
    delta = length - strap.length
    rate = -dot(toward, point_velocity(q, y, r))
    return Stretch(toward, length, delta, rate, strap.stiffness * delta + strap.damping * rate)


@kernel
def force_rate(work: Workspace, q: Axes, y: Floats, dy: Floats, k: int, s: Stretch) -> float:
    """Ḟ of a strap that pulls [m/s³], from the state's rates."""
    strap = work.straps[k]
    r, spin = vec(strap.arm, 0), vec(y, W)
    own = add(cross(vec(dy, W), r), cross(spin, cross(spin, r)))
    change = add(vec(dy, V), on_support(q, own))
    u = point_velocity(q, y, r)
    bends = (dot(u, u) - s.rate * s.rate) / s.length
    return float(strap.stiffness * s.rate + strap.damping * (bends - dot(s.toward, change)))


@routine
def add_straps(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec) -> Vec:
    """Add the force of all straps in a state to a body force; write their torque to `torque`."""
    torque = Vec(0.0, 0.0, 0.0)
    for k in range(shape.straps):
        if work.held[k] == TAUT:
            s = stretch_of(work, q, y, k)
            pull = times(s.force, s.toward)
            f = add(f, pull)
            torque = add(torque, cross(vec(work.straps[k].arm, 0), on_body(q, pull)))
    put(work.torque, 0, torque)
    return f


@kernel
def with_straps(shape: SolidParameters, work: Workspace, f: Vec) -> Vec:
    """The body force and that of all straps in the present state."""
    if shape.straps > 0:
        return add_straps(shape, work, axes_at(work.state), work.state, f)
    return f


@routine
def attach(shape: SolidParameters, work: Workspace) -> None:
    """Measure all straps as a run begins; none has pulled or broken yet."""
    q, y = axes_at(work.state), work.state
    for k in range(shape.straps):
        work.straps[k].length = 0.0
        work.straps[k].length = stretch_of(work, q, y, k).length + work.straps[k].slack
        work.straps[k].force_peak = 0.0
        work.straps[k].broke_at = math.nan
        work.held[k] = LOOSE
    hold_on(shape, work)


@routine
def hold_on(shape: SolidParameters, work: Workspace) -> None:
    """Write what each strap does in a state that lasts, and note its force there."""
    pull_or_not(shape, work)
    for k in range(shape.straps):
        if work.held[k] == TAUT:
            force = stretch_of(work, axes_at(work.state), work.state, k).force
            work.straps[k].force_peak = max(work.straps[k].force_peak, force)


@routine
def pull_or_not(shape: SolidParameters, work: Workspace) -> None:
    """Write what each strap does in the present state; one that bears its strength breaks."""
    q, y = axes_at(work.state), work.state
    for k in range(shape.straps):
        if work.held[k] == BROKEN:
            continue
        s = stretch_of(work, q, y, k)
        if s.delta <= 0.0:
            work.held[k] = LOOSE
        elif s.force <= 0.0:
            work.held[k] = RELAXED
        else:
            work.held[k] = TAUT
            strength = work.straps[k].strength
            if s.force >= strength:
                work.straps[k].force_peak = strength
                work.held[k] = BROKEN
                work.straps[k].broke_at = work.clock.begun + work.clock.passed


@routine
def note_forces(shape: SolidParameters, work: Workspace, h: float) -> None:
    """Note the largest force of each strap in a step of h that ends on trial.

    From its ends, cubic in between; the first and the seventh stage hold the rates there. A step
    that is next to none does not count: where a strap that damps is as long as at the start just
    when the body lands, it pulls for no time.
    """
    if h < SHORT:
        return
    before, after = axes_at(work.state), axes_at(work.trial)
    for k in range(shape.straps):
        if work.held[k] == TAUT:
            a = stretch_of(work, before, work.state, k)
            b = stretch_of(work, after, work.trial, k)
            rate_a = h * force_rate(work, before, work.state, work.stages[0], k, a)
            rate_b = h * force_rate(work, after, work.trial, work.stages[6], k, b)
            top = top_of(a.force, b.force, rate_a, rate_b)
            peak = max(work.straps[k].force_peak, top)
            work.straps[k].force_peak = min(peak, work.straps[k].strength)


@routine
def strap_energy(shape: SolidParameters, work: Workspace) -> float:
    """½ k δ² of all straps that are stretched, by the body's mass [m²/s²]."""
    q, y, energy = axes_at(work.state), work.state, 0.0
    for k in range(shape.straps):
        if work.held[k] != BROKEN:
            delta = max(stretch_of(work, q, y, k).delta, 0.0)
            energy += 0.5 * work.straps[k].stiffness * delta * delta
    return energy


@kernel
def holds_any(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a strap has not broken."""
    found = False
    for k in range(shape.straps):
        found = found or work.held[k] != BROKEN
    return found


@kernel
def pulls_any(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a strap pulls."""
    found = False
    for k in range(shape.straps):
        found = found or work.held[k] == TAUT
    return found
