"""The history of a deep solid as that of the planar body for which it stands."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.physics.plane.phases import Phase, on_tilt
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from shaketable.physics.space.found import SolidTrace

CLOSED = 1e-8  # of the height: a corner that is so low is on the support
SLIPS = 1e-6  # of √(g h): a corner beside a wall or an edge that is slower sticks


def planar_states(states: NDArray[np.float64]) -> NDArray[np.float64]:
    """x, z, θ and their rates of the states of a deep solid, (n, 6)."""
    from shaketable.physics.space.workspace import P, Q, V, W

    theta = 2.0 * np.arctan2(states[:, Q + 2], states[:, Q])
    moves = states[:, [V, V + 2, W + 1]]
    return np.column_stack([states[:, P], states[:, P + 2], theta, moves])


def corner_of(
    body: Body, states: NDArray[np.float64], pivot: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Slip and height of the corner at `pivot`, + to the right [m], and its speed along x [m/s]."""
    x, z, theta, v_x, _, spin = states.T
    sine, cosine = np.sin(theta), np.cos(theta)
    along = pivot * cosine - body.cg_height * sine
    up = -pivot * sine - body.cg_height * cosine
    return x + along - pivot, z + up, v_x + spin * up


def slips_of(body: Body, states: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far the lower corner has moved along the support in planar states [m], (n,)."""
    return corner_of(body, states, np.where(states[:, 2] >= 0.0, body.right, -body.left))[0]


def phases_of(
    body: Body, tilt: float, trace: SolidTrace, samples: int, time: NDArray[np.float64]
) -> tuple[NDArray[np.float64], tuple[Phase, ...]]:
    """The phases of a history as they are seen at its samples, and when each begins [s].

    Args:
        body, tilt: the planar body, and how its support is tilted [rad].
        trace: of its deep solid.
        samples: how many of it there are.
        time: of each [s].
    """
    from shaketable.physics.space.workspace import FLAT, FLIGHT, STICKS, WALLED
    from shaketable.physics.space.workspace import SLIPS as SLIPPING

    states = planar_states(trace.state[:samples])
    rank, grip = trace.rank[:samples], trace.hold[:samples]
    right, left = (
        corner_of(body, states, np.full(samples, pivot)) for pivot in (body.right, -body.left)
    )
    beside = rank >= WALLED
    low = CLOSED * body.cg_height
    on_right = np.where(beside, right[1] <= low, (rank == FLAT) | (states[:, 2] >= 0.0))
    on_left = np.where(beside, left[1] <= low, (rank == FLAT) | (states[:, 2] < 0.0))
    speed = np.where(on_right, right[2], left[2])
    slow = SLIPS * math.sqrt(STANDARD_GRAVITY * body.cg_height)
    slips = np.where(beside, np.abs(speed) > slow, grip == SLIPPING)
    # both, right, left; and no slip, toward +x, toward -x: as `physics.plane.codes.phase_of`
    contact = np.where(on_right & on_left, 1, np.where(on_right, 2, 3))
    code = 3 * contact - 2 + np.where(~slips, 0, np.where(speed > 0.0, 1, 2))
    code = np.where((rank == FLIGHT) | ~(on_right | on_left), int(Phase.FLIGHT), code)
    code = np.where((rank != FLIGHT) & beside & (grip == STICKS), int(Phase.REST), code)
    first = np.r_[0, 1 + np.flatnonzero(np.diff(code))]
    return time[first], tuple(on_tilt(Phase(each), tilt) for each in code[first])
