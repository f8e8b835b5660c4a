"""The error of solids against the tolerance of their steps."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable import General, Motion, Solid
from shaketable.models.solid_input import ground_of, shapes_of
from shaketable.physics.space.drive import move_solid
from shaketable.physics.space.found import Found, make_found, make_trace, numbers_of

TRUTH = 1e-14
TOLERANCES = (1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12)
STEP = 0.02


class Case(NamedTuple):
    solid: Solid
    motion: Motion
    model: General


class Ended(NamedTuple):
    """A run's state at its last sample, and its numbers of a Found."""

    state: NDArray[np.float64]
    found: Found


def cases() -> dict[str, Case]:
    """What moves smoothly, what sticks and slips, what meets its support often."""
    t = np.arange(31) * STEP
    pulse = np.where(t < 0.4, np.sin(2 * math.pi * t / 0.4), 0.0)
    across = np.roll(pulse, 4)
    triangle = [[0.3, 0.0], [-0.1, 0.22], [-0.12, -0.2]]
    return {
        "rolls on its rim": Case(
            Solid.cylinder(0.3, 1.2), Motion(4.2 * pulse, STEP, transverse=3.3 * across), General()
        ),
        "sticks and slips": Case(
            Solid.box(0.6, 0.5, 0.4, eccentricity=(0.45, 0.5)),
            Motion(4.6 * np.sin(16 * t), STEP, transverse=2.0 * np.cos(11 * t)),
            General(static_friction=0.4, kinetic_friction=0.3),
        ),
        "impacts": Case(
            Solid.polygon(triangle, 0.9),
            Motion(4.5 * np.sin(16 * t), STEP, transverse=2.5 * np.sin(11 * t)),
            General(static_friction=0.8),
        ),
    }


def ended(case: Case, tolerance: float) -> Ended:
    """A case at the end of its motion, with a tolerance of its steps."""
    shapes, workspaces = shapes_of(case.solid, case.model)
    n = case.motion.horizontal.size
    trace = make_trace(n)
    found = make_found(1)
    stand = np.array([[0.0, 0.0, 0.0, 1.0, 1.0]])
    shapes["tolerance"] = tolerance
    move_solid(shapes, workspaces, ground_of(case.motion), stand, False, trace, found)
    return Ended(trace.state[n - 1], numbers_of(found))


def errors(case: Case) -> list[tuple[float, float, float]]:
    """Tolerance, largest error of the state [SI] and steps for each of TOLERANCES."""
    truth = ended(case, TRUTH).state
    runs = [(tolerance, ended(case, tolerance)) for tolerance in TOLERANCES]
    return [
        (tolerance, float(np.abs(run.state - truth).max()), run.found.steps)
        for tolerance, run in runs
    ]
