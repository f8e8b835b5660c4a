"""What runs tell of their surroundings, after the numbers of their RunSummary."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import Any

from shaketable.errors import InputError
from shaketable.models.model import Held, Model
from shaketable.simulate.result_fields import Part
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
