"""The exposure of a site: the objects whose losses can be computed, and what they are worth."""

from __future__ import annotations

from dataclasses import dataclass

from shaketable.errors import InputError
from shaketable.hazard.objects import ObjectRate, ObjectRates


@dataclass(frozen=True, kw_only=True, eq=False)
class Exposure:
    """The objects whose losses can be computed, and those that are left out.

    Attributes:
        objects: those with a function and, where any of these has a cost, with a cost; each in the
            direction in which it falls more often.
        in_cost: whether losses are in the list's currency; otherwise they are pieces that fall.
        without_cost, without_function: those that are left out.
    """

    objects: tuple[ObjectRate, ...]
    in_cost: bool
    without_cost: tuple[ObjectRate, ...]
    without_function: tuple[ObjectRate, ...]

    def value(self, one: ObjectRate) -> float:
        """What a piece of an object is worth: its cost, or 1."""
        return (one.item.cost or 0.0) if self.in_cost else 1.0


def exposure_of(rates: ObjectRates) -> Exposure:
    """The objects of a site whose losses can be computed.

    Raises:
        InputError: no object has a fragility function.
    """
    every = list(rates.of_objects().values())
    known = [one for one in every if not one.curve.problem]
    if not known:
        raise InputError("no object has a fragility function: its losses cannot be computed")
    in_cost = any(one.item.cost is not None for one in known)
    return Exposure(
        objects=tuple(one for one in known if not in_cost or one.item.cost is not None),
        in_cost=in_cost,
        without_cost=tuple(one for one in known if in_cost and one.item.cost is None),
        without_function=tuple(one for one in every if one.curve.problem),
    )
