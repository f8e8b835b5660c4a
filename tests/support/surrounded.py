"""Runs of planar bodies among their surroundings that begin in any state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable import Body, General, Surroundings
from shaketable.models.model import Held
from shaketable.models.surrounded import Friction, held_of, scenes_of
from shaketable.physics.plane.forcing import Shaking
from shaketable.physics.surrounded.run import (
    SUMMARY,
    SurroundedSummary,
    SurroundedTrace,
    move_surrounded,
)
from shaketable.physics.surrounded.scene import STATE, make_workspace
from shaketable.units import STANDARD_GRAVITY

Floats = NDArray[np.float64]


class Moved(NamedTuple):
    """What became of a body."""

    end: SurroundedSummary
    held: Held
    state: Floats  # (n, 6): x, y, θ and their rates at the samples


def move(
    body: Body,
    acceleration: Floats,
    step: float,
    model: General,
    around: Surroundings,
    *,
    tilt: float = 0.0,
    state: Sequence[float] | None = None,
    rotation: float = 0.0,
    samples: int = 0,
) -> Moved:
    """One body from a state on (x, y, θ and their rates), or let go at a rotation [rad]."""
    friction = Friction(
        model.static_friction,
        model.sliding_friction,
        model.normal_restitution,
        model.restitution_factor,
    )
    scenes = scenes_of([body], np.array([tilt]), [around], friction)
    work = make_workspace()
    if state is not None:
        work[0].state[:] = state
    gravity = np.full(acceleration.size, STANDARD_GRAVITY)
    found = np.zeros((1, SUMMARY + 2 * len(around.straps)))
    trace = SurroundedTrace(
        np.full((samples, STATE), np.nan), np.empty(samples), np.empty(0), np.empty(0, np.int8),
        np.empty(0),
    )  # fmt: skip
    move_surrounded(
        scenes, work, Shaking(acceleration, gravity, step), np.ones(1), rotation,
        state is not None, trace, found,
    )  # fmt: skip
    end = SurroundedSummary(*found[0, :SUMMARY].tolist())
    return Moved(end, held_of(scenes, found), trace.state[: int(end.samples)])
