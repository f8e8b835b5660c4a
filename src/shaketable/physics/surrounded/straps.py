"""Straps from points of a planar body to anchors: `physics.space.straps` in the plane.

F = k δ + c δ̇ toward the anchor while δ > 0 and F > 0; gone once F has reached the strength.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.hermite import top_of
from shaketable.physics.surrounded.scene import (
    ANCHOR_X,
    ANCHOR_Y,
    BROKE,
    BROKEN,
    CLOCK,
    DAMPING,
    LENGTH,
    LOOSE,
    MOST_FORCE,
    PASSED,
    POINT_X,
    POINT_Y,
    RELAXED,
    SLACK,
    SPIN,
    STATE,
    STIFFNESS,
    STRENGTH,
    TAUT,
    TURN,
    USED,
    V_X,
    V_Y,
    Floats,
    Scene,
    Workspace,
    X,
    Y,
)

SHORT = 1e-8  # s: a pull that lasts less is none


class Stretch(NamedTuple):
    """A strap in a state."""

    q_x: float  # its point from the centre of gravity [m]
    q_y: float
    toward_x: float
    toward_y: float
    length: float  # m
    delta: float  # δ [m]
    rate: float  # δ̇ [m/s]
    force: float  # k δ + c δ̇ [m/s²]


@kernel
def stretch_of(work: Workspace, y: Floats, k: int) -> Stretch:
    """A strap in a state, whatever it does."""
    strap = work.strap[k]
    sine, cosine = math.sin(y[TURN]), math.cos(y[TURN])
    q_x = strap[POINT_X] * cosine + strap[POINT_Y] * sine
    q_y = strap[POINT_Y] * cosine - strap[POINT_X] * sine
    d_x, d_y = strap[ANCHOR_X] - y[X] - q_x, strap[ANCHOR_Y] - y[Y] - q_y
    length = math.sqrt(d_x * d_x + d_y * d_y)
    n_x, n_y = d_x / length, d_y / length
    rate = -n_x * (y[V_X] + y[SPIN] * q_y) - n_y * (y[V_Y] - y[SPIN] * q_x)
    delta = length - strap[LENGTH]
    force = strap[STIFFNESS] * delta + strap[DAMPING] * rate
    return Stretch(q_x, q_y, n_x, n_y, length, delta, rate, force)


@routine
def pull_straps(scene: Scene, work: Workspace, y: Floats) -> None:
    """Write the force of all straps in a state and their moment to `work.pull`."""
    pull = work.pull
    pull[0] = pull[1] = pull[2] = 0.0
    for k in range(scene.straps):
        if work.held[k] == TAUT:
            s = stretch_of(work, y, k)
            f_x, f_y = s.force * s.toward_x, s.force * s.toward_y
            pull[0] += f_x
            pull[1] += f_y
            pull[2] += s.q_y * f_x - s.q_x * f_y


@routine
def attach(scene: Scene, work: Workspace) -> None:
    """Measure all straps as they are where the body stands upright; none has pulled yet."""
    upright = work.kept
    for j in range(STATE):
        upright[j] = 0.0
    upright[Y] = scene.h
    for k in range(scene.straps):
        for j in range(work.strap.shape[1]):
            work.strap[k, j] = scene.strap[k, j]
        work.strap[k, LENGTH] = 0.0
        work.strap[k, LENGTH] = stretch_of(work, upright, k).length + work.strap[k, SLACK]
        work.strap[k, MOST_FORCE], work.strap[k, BROKE] = 0.0, math.nan
        work.held[k] = LOOSE


@routine
def pull_or_not(scene: Scene, work: Workspace) -> None:
    """Write what each strap does in the present state; one that bears its strength breaks."""
    for k in range(scene.straps):
        if work.held[k] == BROKEN:
            continue
        s = stretch_of(work, work.state, k)
        if s.delta <= 0.0:
            work.held[k] = LOOSE
        elif s.force <= 0.0:
            work.held[k] = RELAXED
            work.tally[USED] = 1.0
        else:
            work.held[k] = TAUT
            work.tally[USED] = 1.0
            if s.force >= work.strap[k, STRENGTH]:
                work.strap[k, MOST_FORCE] = work.strap[k, STRENGTH]
                work.held[k] = BROKEN
                work.strap[k, BROKE] = work.tally[CLOCK] + work.tally[PASSED]


@routine
def note_rest(scene: Scene, work: Workspace) -> None:
    """Note the forces of straps that hold a body at rest."""
    for k in range(scene.straps):
        if work.held[k] == TAUT:
            force = stretch_of(work, work.state, k).force
            work.strap[k, MOST_FORCE] = max(work.strap[k, MOST_FORCE], force)


@kernel
def force_rate(work: Workspace, y: Floats, dy: Floats, k: int, s: Stretch) -> float:
    """Ḟ of a strap that pulls [m/s³], from the state's rates."""
    u_x, u_y = y[V_X] + y[SPIN] * s.q_y, y[V_Y] - y[SPIN] * s.q_x
    a_x = dy[V_X] + dy[SPIN] * s.q_y - y[SPIN] * y[SPIN] * s.q_x
    a_y = dy[V_Y] - dy[SPIN] * s.q_x - y[SPIN] * y[SPIN] * s.q_y
    bends = (u_x * u_x + u_y * u_y - s.rate * s.rate) / s.length
    stretching = bends - s.toward_x * a_x - s.toward_y * a_y
    return float(work.strap[k, STIFFNESS] * s.rate + work.strap[k, DAMPING] * stretching)


@routine
def note_forces(scene: Scene, work: Workspace, h: float) -> None:
    """Note the largest force of each strap in a step of h [s] that ends on trial.

    From its ends, cubic in between; the first and the seventh stage hold the rates there.
    """
    if h < SHORT:
        return
    for k in range(scene.straps):
        if work.held[k] == TAUT:
            a, b = stretch_of(work, work.state, k), stretch_of(work, work.trial, k)
            rate_a = h * force_rate(work, work.state, work.stages[0], k, a)
            rate_b = h * force_rate(work, work.trial, work.stages[6], k, b)
            top = top_of(a.force, b.force, rate_a, rate_b)
            work.strap[k, MOST_FORCE] = min(
                max(work.strap[k, MOST_FORCE], top), work.strap[k, STRENGTH]
            )


@kernel
def holds_any(scene: Scene, work: Workspace) -> bool:
    """Whether a strap has not broken."""
    found = False
    for k in range(scene.straps):
        found = found or work.held[k] != BROKEN
    return found


@kernel
def pulls_any(scene: Scene, work: Workspace) -> bool:
    """Whether a strap pulls."""
    found = False
    for k in range(scene.straps):
        found = found or work.held[k] == TAUT
    return found


@routine
def strap_energy(scene: Scene, work: Workspace) -> float:
    """½ k δ² of all straps that are stretched, by the mass [m²/s²]."""
    energy = 0.0
    for k in range(scene.straps):
        if work.held[k] != BROKEN:
            delta = max(stretch_of(work, work.state, k).delta, 0.0)
            energy += 0.5 * work.strap[k, STIFFNESS] * delta * delta
    return energy
