"""Runs of planar bodies among their surroundings that begin in any state."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable import Body, General, Surroundings
from shaketable.models.deep import ground_of
from shaketable.models.deep import move as move_deep
from shaketable.models.model import Held
from shaketable.models.planar_history import planar_states
from shaketable.models.scene import Place, let_go, scenes_of
from shaketable.models.surrounded import told_of
from shaketable.physics.plane.forcing import Shaking
from shaketable.physics.space.found import make_trace, numbers_of
from shaketable.units import STANDARD_GRAVITY

Floats = NDArray[np.float64]


class End(NamedTuple):
    """How a run ended, by the names of `ManyRuns` and `Held`; NaN or False without an edge."""

    ending: int
    direction: float
    peak: float
    impacts: float
    slip: float
    fallbacks: float
    held_up: bool
    off_edge: bool
    left_at: float
    landing_time: float
    landing_x: float
    landing_speed: float
    landing_rotation: float


class Moved(NamedTuple):
    """What became of a body."""

    end: End
    held: Held
    state: Floats  # (n, 6): x, z, θ and their rates at the samples


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
    """One body from a state on (x, z, θ and their rates), or let go at a rotation [rad]."""
    scene = scenes_of([body], np.array([tilt]), [around], model)[0]
    shaking = Shaking(acceleration, np.full(acceleration.size, STANDARD_GRAVITY), step)
    place, rates = let_go(body, rotation) if rotation else None, (0.0, 0.0, 0.0)
    if state is not None:
        x, z, theta, *rates = state
        place = Place(x, z, theta)
    trace = make_trace(samples)
    moved = move_deep(scene, ground_of(shaking), np.ones(1), trace, place, rates)
    found = numbers_of(moved.found)
    told, held = told_of(found, acceleration.size), moved.held

    def one(values: NDArray[np.generic] | None) -> float:
        return math.nan if values is None else float(values[0])

    end = End(
        ending=int(told["ending"]),
        direction=told["direction"],
        peak=found.peak,
        impacts=found.impacts,
        slip=told["slip"],
        fallbacks=found.fallbacks,
        held_up=bool(held.held_up is not None and held.held_up[0]),
        off_edge=bool(held.off_edge is not None and held.off_edge[0]),
        left_at=one(held.left_support_at),
        landing_time=one(held.landing_time),
        landing_x=one(held.landing_x),
        landing_speed=one(held.landing_speed),
        landing_rotation=one(held.landing_rotation),
    )
    return Moved(end, held, planar_states(trace.state[: found.samples]))
