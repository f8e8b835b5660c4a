"""What runs tell of their surroundings, after the numbers of their RunSummary."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.models.model import Held, Model
from shaketable.simulate.result_fields import Part
from shaketable.solid import Solid
from shaketable.surroundings import Surroundings

log = logging.getLogger(__name__)

MOST_AT_NO_GAP = 0.3  # restitution of a wall that a body touches: from more on falls jump at gap 0
Around = Surroundings | Sequence[Surroundings | None] | None  # of all, or of each


def listed_surroundings(surroundings: Around) -> list[Surroundings | None]:
    """One, which is of all, or those of each.

    Raises:
        InputError: anything else.
    """
    given = surroundings if isinstance(surroundings, (list, tuple)) else [surroundings]
    around: list[Surroundings | None] = []
    for each in given:
        if each is not None and not isinstance(each, Surroundings):
            raise InputError(f"surroundings= must be Surroundings(...), got {each!r:.100}")
        around.append(each)
    return around


def warn_of(around: Sequence[Surroundings | None], model: Model) -> None:
    """Log what is weak about some surroundings: walls at gap 0 that give back much.

    Args:
        around: of all bodies, or of each.
        model: of the contacts.
    """
    walls = {wall for each in around if each for wall in each.walls if wall.gap == 0.0}
    back = [w.restitution for w in walls if isinstance(w.restitution, float)]
    if model.slides and max(back, default=0.0) > MOST_AT_NO_GAP:
        log.warning(
            "a wall at gap 0 with a restitution of %g is singular: the whole back strikes it at "
            "once, and the share of falls is not that of any small gap. Give it a gap of some "
            "millimetres, or average over gaps of 0 to 5 mm",
            max(back),
        )


def columns_of(surroundings: Surroundings | None) -> int:
    """How many numbers a run of a solid in such surroundings tells."""
    from shaketable.physics.space.landing import EDGE
    from shaketable.physics.space.run import SUMMARY

    if not surroundings:
        return SUMMARY
    return SUMMARY + 1 + 2 * len(surroundings.straps) + (EDGE if surroundings.edge else 0)


def held_of(found: NDArray[np.float64], surroundings: Surroundings, solid: Solid) -> Held:
    """What surroundings did, by what runs of a solid have found, (run, column)."""
    from shaketable.physics.space import landing
    from shaketable.physics.space.run import SUMMARY

    straps = len(surroundings.straps)
    each = found[:, SUMMARY + 1 : SUMMARY + 1 + 2 * straps].reshape(len(found), straps, 2)
    held = Held(
        held_up=found[:, SUMMARY] > 0.5,
        strap_force=(solid.mass or np.nan) * each[..., 0],
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


def with_held(part: Part, held: Held) -> Part:
    """Results of members with what their surroundings did."""
    own = {name: found for name, found in held._asdict().items() if found is not None}
    return part._replace(results={**part.results, **own})


def held_by(held: Held | None) -> dict[str, Any]:
    """What surroundings did in one run, by the names of a `Response`."""
    if held is None:
        return {}
    told = {name: value[0] for name, value in held._asdict().items() if value is not None}
    straps = {name: tuple(told.pop(name).tolist()) for name in ("strap_force", "strap_broke_at")}
    return {**{name: value.item() for name, value in told.items()}, **straps}
