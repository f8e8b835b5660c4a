"""Solids from any state, and what is conserved."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from shaketable import General, Motion, Solid, SolidResponse, Surroundings
from shaketable.models.solid_input import ground_of, shapes_of
from shaketable.physics.space.found import Found
from shaketable.units import STANDARD_GRAVITY

Floats = NDArray[np.float64]


class Run(NamedTuple):
    """Samples of a solid from some state on."""

    time: Floats  # (n,)
    position: Floats  # (n, 3)
    rotation: Rotation  # n of them, body to support
    velocity: Floats  # (n, 3)
    spin: Floats  # (n, 3), body frame
    rank: NDArray[np.int8]
    found: Found


def moved(run: SolidResponse) -> Floats:
    """By how much along x and y at the end of a run [m]."""
    return np.array([run.displacement_x, run.displacement_y])


def released(
    solid: Solid,
    model: General,
    motion: Motion,
    *,
    position: ArrayLike,
    rotation: Rotation,
    velocity: ArrayLike = (0.0, 0.0, 0.0),
    spin: ArrayLike = (0.0, 0.0, 0.0),
    tilt: float = 0.0,
    azimuth: float = np.pi,
    surroundings: Surroundings | None = None,
) -> Run:
    """Let a solid go; spin in its own frame. The run ends with the motion or with a fall.

    The gap of a wall is from where the body is as it is let go.
    """
    from shaketable.physics.space.drive import move_solid
    from shaketable.physics.space.found import make_found, make_trace, numbers_of
    from shaketable.physics.space.workspace import P, Q, V, W

    shapes, workspaces = shapes_of(solid, model, surroundings)
    state = workspaces["state"][0]
    state[P : P + 3], state[V : V + 3], state[W : W + 3] = position, velocity, spin
    state[Q : Q + 4] = rotation.as_quat(scalar_first=True)
    samples = motion.horizontal.size
    trace = make_trace(samples)
    all_found = make_found(1)
    stands = np.array([[tilt, azimuth, 0.0, 1.0, 1.0]])
    move_solid(shapes, workspaces, ground_of(motion), stands, True, trace, all_found)
    found = numbers_of(all_found)
    n = min(found.samples, samples)
    state = trace.state[:n]
    time = np.arange(n) * motion.time_step
    if np.isfinite(found.time) and found.samples <= samples:
        time[-1] = found.time
    return Run(
        time,
        state[:, P : P + 3],
        Rotation.from_quat(state[:, Q : Q + 4], scalar_first=True),
        state[:, V : V + 3],
        state[:, W : W + 3],
        trace.rank[:n],
        found,
    )


def energy(solid: Solid, run: Run, force: ArrayLike = (0.0, 0.0, -STANDARD_GRAVITY)) -> Floats:
    """Total energy per unit mass under a constant force [m²/s²], (n,)."""
    kinetic = 0.5 * (run.velocity**2).sum(axis=1)
    kinetic += 0.5 * np.einsum("ni,ij,nj->n", run.spin, solid.inertia, run.spin)
    return np.asarray(kinetic - run.position @ np.asarray(force))


def quiet(seconds: float, time_step: float = 0.01) -> Motion:
    """No shaking."""
    return Motion(np.zeros(round(seconds / time_step) + 1), time_step)
