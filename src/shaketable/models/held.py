"""What runs tell of their surroundings, after the numbers of their RunSummary."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.models.model import Held
from shaketable.surroundings import Surroundings


def columns_of(surroundings: Surroundings | None) -> int:
    """How many numbers a run in such surroundings tells, beside those of a body in the plane."""
    from shaketable.physics.space.landing import EDGE
    from shaketable.physics.space.run import SUMMARY

    around = surroundings or Surroundings()
    return SUMMARY + 1 + 2 * len(around.straps) + (EDGE if around.edge else 0)


def held_of(found: NDArray[np.float64], surroundings: Surroundings, mass: float | None) -> Held:
    """What surroundings did, by what runs have found, (run, column).

    Args:
        found: as `physics.space.drive.move_solid` writes it.
        surroundings: of these runs.
        mass: of the body [kg].
    """
    from shaketable.physics.space import landing
    from shaketable.physics.space.run import SUMMARY

    straps = len(surroundings.straps)
    each = found[:, SUMMARY + 1 : SUMMARY + 1 + 2 * straps].reshape(len(found), straps, 2)
    held = Held(
        held_up=found[:, SUMMARY] > 0.5,
        strap_force=(mass or np.nan) * each[..., 0],
        strap_broke_at=each[..., 1].copy(),
    )
    if not surroundings.edge:
        return held
    told = found[:, SUMMARY + 1 + 2 * straps :]
    return held._replace(
        off_edge=told[:, landing.OFF] > 0.5,
        left_support_at=told[:, landing.LEFT_AT].copy(),
        landing_time=told[:, landing.LANDING_TIME].copy(),
        landing_x=told[:, landing.LANDING_X].copy(),
        landing_y=told[:, landing.LANDING_Y].copy(),
        landing_speed=told[:, landing.LANDING_SPEED].copy(),
        landing_rotation=told[:, landing.LANDING_TURN].copy(),
    )


def nothing_held(surroundings: Sequence[Surroundings | None]) -> Held:
    """What surroundings do that planar bodies never meet; one entry for each."""
    n, straps = len(surroundings), max(len(each.straps) if each else 0 for each in surroundings)
    return Held(
        strap_force=np.zeros((n, straps)),
        strap_broke_at=np.full((n, straps), np.nan),
        held_up=np.zeros(n, np.bool_),
        off_edge=np.zeros(n, np.bool_),
        left_support_at=np.full(n, np.nan),
        landing_time=np.full(n, np.nan),
        landing_x=np.full(n, np.nan),
        landing_speed=np.full(n, np.nan),
        landing_rotation=np.full(n, np.nan),
    )
