"""What runs tell of their surroundings, after the numbers of their RunSummary."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.models.model import Held
from shaketable.simulate.result_fields import Part
from shaketable.solid import Solid
from shaketable.surroundings import Surroundings

Around = Surroundings | Sequence[Surroundings | None] | None  # of all, or of each


def listed_surroundings(surroundings: Around) -> list[Surroundings | None]:
    """One, which is of all, or those of each; with the same number of straps.

    Raises:
        InputError: anything else.
    """
    given = surroundings if isinstance(surroundings, (list, tuple)) else [surroundings]
    around: list[Surroundings | None] = []
    for each in given:
        if each is not None and not isinstance(each, Surroundings):
            raise InputError(f"surroundings= must be Surroundings(...), got {each!r:.100}")
        around.append(each)
    counts = sorted({straps_of(each) or 0 for each in around})
    if len(counts) != 1:
        raise InputError(f"surroundings= must have the same number of straps each, got {counts}")
    return around


def straps_of(surroundings: Surroundings | None) -> int | None:
    """How many straps surroundings have; None where there are no surroundings."""
    return len(surroundings.straps) if surroundings else None


def columns_of(straps: int | None) -> int:
    """How many numbers a run of a solid with so many straps tells."""
    from shaketable.physics.space.run import SUMMARY

    return SUMMARY + (0 if straps is None else 1 + 2 * straps)


def held_of(found: NDArray[np.float64], straps: int, solid: Solid) -> Held:
    """What so many straps did, by what runs of a solid have found, (run, column)."""
    from shaketable.physics.space.run import SUMMARY

    each = found[:, SUMMARY + 1 :].reshape(len(found), straps, 2)
    mass = solid.mass or np.nan
    return Held(found[:, SUMMARY] > 0.5, mass * each[..., 0], each[..., 1].copy())


def with_held(part: Part, held: Held) -> Part:
    """Results of members with what their surroundings did."""
    own = {name: found for name, found in held._asdict().items() if found is not None}
    return part._replace(results={**part.results, **own})
