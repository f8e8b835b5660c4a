"""Whether the answer of a room hangs on friction: of several the worst leads, as for an object."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from shaketable.assess.shares import Share, is_worse
from shaketable.inventory import Castors
from shaketable.progress import Progress, meter
from shaketable.rooms.found import found_of
from shaketable.rooms.prepared import Prepared, with_friction_of
from shaketable.rooms.results import (
    PlaceResult,
    RoomAssessment,
    ThingResult,
    WayResult,
    WorstShaking,
)

Harmed = Callable[[Prepared], float]


class WithFriction(NamedTuple):
    """A room that was shaken with one friction, and what becomes of it."""

    prepared: Prepared
    found: RoomAssessment

    @classmethod
    def of(cls, prepared: Prepared) -> WithFriction:
        """What becomes of a room that was shaken."""
        return cls(prepared, found_of(prepared))


def with_other_frictions(
    prepared: Prepared, frictions: Sequence[float], progress: Progress
) -> list[WithFriction]:
    """A room with its own friction first, then with those with which more happens.

    Each motion is met in one of the ways with each: intervals are over recordings, and ask for no
    more. More happens, where each share lies outside the other's interval.

    Args:
        prepared: the room with its own friction.
        frictions: others, static and kinetic.
        progress: as for `assess`.
    """
    own = WithFriction.of(prepared)
    if all(thing.item.castors is Castors.FREE for thing in prepared.shaken):
        return [own]
    others = [each for each in frictions if each != prepared.friction]
    with meter(
        "simulations", len(others) * len(prepared.ways) * len(prepared.shaken), progress
    ) as done:
        once = [with_friction_of(prepared, each, done, once=True) for each in others]
    return [own, *map(WithFriction.of, once)]


def with_most_harm(shaken: Sequence[WithFriction], harm: Harmed, progress: Progress) -> Prepared:
    """Of a room with several frictions the one with which most is harmed, met in all ways.

    Args:
        shaken: as of `with_other_frictions`.
        harm: what a room's runs do.
        progress: as for `assess`.
    """
    own, worst = shaken[0].prepared, max((each.prepared for each in shaken), key=harm)
    if worst is own:
        return own
    with meter("simulations", own.runs * len(own.shaken), progress) as done:
        return max(own, with_friction_of(own, worst.friction, done), key=harm)


def leading(shaken: Sequence[WithFriction]) -> RoomAssessment:
    """A room of whose things, places and ways the worst is told.

    The map has in each cell the largest share of those frictions with which more happens anywhere.

    Args:
        shaken: as of `with_other_frictions`.
    """
    own = found = shaken[0].found
    for other in (each.found for each in shaken[1:]):
        now = replace(
            found,
            things=tuple(map(_worse_thing, own.things, found.things, other.things)),
            places=_worse(own.places, found.places, other.places),
            ways=_worse(own.ways, found.ways, other.ways),
            hits=max(found.hits, other.hits),
        )
        if other.friction in now.frictions:
            covered = np.maximum(found.covered, other.covered)
            now = replace(now, covered=covered, worst=max(found.worst, other.worst, key=_falls))
        found = now
    return replace(found, tried=tuple(each.prepared.friction for each in shaken[1:]))


Told = TypeVar("Told", PlaceResult, WayResult)


def _worse(own: Sequence[Told], found: Sequence[Told], other: Sequence[Told]) -> tuple[Told, ...]:
    """Of each the one that is found so far, or another that is worse than its own and than it."""
    return tuple(
        that if _leads(that.often, one.often, this.often) else this
        for one, this, that in zip(own, found, other, strict=True)
    )


def _worse_thing(own: ThingResult, found: ThingResult, other: ThingResult) -> ThingResult:
    """The same of a thing, by its falls, and by itself of how often it is held up."""
    told = other if _leads(other.falls, own.falls, found.falls) else found
    held = other if _leads(other.held_up, own.held_up, found.held_up) else found
    return replace(told, held_up=held.held_up, friction_held_up=held.friction_held_up)


def _leads(that: Share, own: Share, found: Share) -> bool:
    return is_worse(that, own) and that.value > found.value


def _falls(worst: WorstShaking) -> int:
    return worst.falls
