"""What runs tell of their surroundings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shaketable.models.model import Held
from shaketable.surroundings import Surroundings

if TYPE_CHECKING:
    from shaketable.physics.space.found import FoundRecords


def held_of(found: FoundRecords, surroundings: Surroundings, mass: float | None) -> Held:
    """What surroundings did.

    Args:
        found: what is told of each run in them, (run,).
        surroundings: of these runs.
        mass: of the body [kg].
    """
    straps = len(surroundings.straps)
    held = Held(
        held_up=found["held_up"] > 0,
        strap_force=(mass or np.nan) * found["strap_force"][:, :straps],
        strap_broke_at=found["strap_broke_at"][:, :straps].copy(),
    )
    if not surroundings.edge:
        return held
    return held._replace(
        off_edge=found["off_edge"] > 0,
        left_support_at=found["left_at"].copy(),
        landing_time=found["landing_time"].copy(),
        landing_x=found["landing_x"].copy(),
        landing_y=found["landing_y"].copy(),
        landing_speed=found["landing_speed"].copy(),
        landing_rotation=found["landing_rotation"].copy(),
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
