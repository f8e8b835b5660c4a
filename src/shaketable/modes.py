"""The map of how a body at rest begins to move, by analysis and by simulation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.criteria.shenton_1996 import Mode, initial_mode, shape_of
from shaketable.errors import InputError
from shaketable.models import General
from shaketable.motion import Motion
from shaketable.physics.plane.phases import Phase
from shaketable.units import STANDARD_GRAVITY

MOST_FRICTION = 1000.0  # the map's axes go on past it; nothing of a size known here slides by then
FINE = 240  # points of the analytic map along an axis
COARSE = 22  # of the simulated one

_MODES = {"SLIDE_ROCK": Mode.SLIDE_ROCK, "SLIDE": Mode.SLIDE, "ROCK": Mode.ROCK, "REST": Mode.REST}


@dataclass(frozen=True, kw_only=True, eq=False)
class ModeMap:
    """How a body at rest begins to move toward one side, over acceleration and friction.

    Attributes:
        body: what stands on a level support.
        direction: 1 if it moves toward +x, -1 toward -x; the ground goes the other way.
        kinetic_ratio: μ_k/μ_s.
        acceleration, friction: A = |a_x|/g and μ_s of the analytic map, shapes (n,), (m,).
        modes: Mode there by Shenton's criteria, (m, n).
        tried_acceleration, tried_friction: of the simulations, (k,).
        simulated: Mode by simulation, (k,).
    """

    body: Body
    direction: int
    kinetic_ratio: float
    acceleration: NDArray[np.float64]
    friction: NDArray[np.float64]
    modes: NDArray[np.int8]
    tried_acceleration: NDArray[np.float64]
    tried_friction: NDArray[np.float64]
    simulated: NDArray[np.int8]


def map_modes(
    body: Body, direction: int, *, friction: float, kinetic_ratio: float = 1.0
) -> ModeMap:
    """The map around a friction of interest.

    Args:
        body: what stands on the level support.
        direction: 1 toward +x, -1 toward -x.
        friction: μ_s that the map must show.
        kinetic_ratio: μ_k/μ_s in [0, 1].

    Raises:
        InputError: values out of range.
    """
    if direction not in (1, -1):
        raise InputError(f"direction must be 1 or -1, got {direction!r}")
    if not 0.0 < friction <= MOST_FRICTION:
        raise InputError(
            f"friction must be a positive number of at most {MOST_FRICTION:g}, got {friction!r}; "
            "with more nothing slides"
        )
    if not 0.0 <= kinetic_ratio <= 1.0:
        raise InputError(f"kinetic over static friction must lie in [0, 1], got {kinetic_ratio!r}")
    gamma, kappa = shape_of(body, direction)
    # room for all four areas: slide-rock begins at some 1/γ in both directions
    strongest, most = max(1.6 * friction, 5.0 / gamma), max(1.6 * friction, 2.2 / gamma)
    acceleration, up = np.linspace(0.0, strongest, FINE), np.linspace(0.0, most, FINE)
    tried = (np.arange(COARSE) + 0.5) / COARSE
    a, mu = (grid.ravel() for grid in np.meshgrid(strongest * tried, most * tried))
    return ModeMap(
        body=body,
        direction=direction,
        kinetic_ratio=kinetic_ratio,
        acceleration=acceleration,
        friction=up,
        modes=initial_mode(
            acceleration[None, :], up[:, None], kinetic_ratio * up[:, None], gamma, kappa
        ),
        tried_acceleration=a,
        tried_friction=mu,
        simulated=np.array(
            [
                simulated_mode(body, direction, each, static, kinetic_ratio * static)
                for each, static in zip(a, mu, strict=True)
            ],
            np.int8,
        ),
    )


def simulated_mode(
    body: Body, direction: int, acceleration: float, static: float, kinetic: float
) -> Mode:
    """How a body begins to move in the general model when the ground suddenly accelerates at A g.

    Args:
        body: what rests on a level support.
        direction: 1 or -1, the side that it moves to; the ground goes the other way.
        acceleration: A = |a_x|/g [-].
        static, kinetic: friction μ_s, μ_k.
    """
    a_x = -direction * acceleration * STANDARD_GRAVITY
    model = General(static_friction=static, kinetic_friction=kinetic)
    return mode_of(model.first_phase(body, 0.0, Motion(np.full(2, a_x), 1e-4)))


def mode_of(phase: Phase) -> Mode:
    """The mode that a first phase shows; a level body that g holds down never begins to fly."""
    return next(mode for name, mode in _MODES.items() if phase.name.startswith(name))
