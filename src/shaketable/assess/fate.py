"""What becomes of all pieces of a place: a room, a floor, a building."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from shaketable.assess.classes import CLASSES, FEW_FALLS, LOW, NOT_CLASSED
from shaketable.assess.item_result import ItemResult
from shaketable.assess.shares import UNKNOWN, Share
from shaketable.resampling import wilson_interval


def worst_class(results: Sequence[ItemResult]) -> str:
    """The worst class of some objects; where it is a good one, none while one has none."""
    found = {each.risk for each in results}
    classed = [name for name in CLASSES if name in found]
    if not classed or (NOT_CLASSED in found and classed[-1] in (LOW, FEW_FALLS)):
        return NOT_CLASSED
    return classed[-1]


class PlaceFate(NamedTuple):
    """What becomes of all pieces of a place, on average over the motions."""

    pieces: int
    falls: Share  # of the pieces
    rolling: int  # pieces on castors
    rolls_far: Share  # of the pieces: on castors, upright, and farther than ROLLS_FAR; NaN if none
    risk: str  # as `worst_class` says


def fate_of(results: Sequence[ItemResult]) -> PlaceFate:
    """What becomes of the pieces of some objects.

    The intervals are Wilson's, with the fewest recordings of any object: the share of the pieces
    that one recording overturns lies between 0 and 1, and such a share varies at most as much as an
    event that happens or not (Bhatia and Davis 2000).
    """
    pieces = sum(each.item.quantity for each in results)
    recordings = min((each.by for each in results), default=0)
    rolling = [each for each in results if each.item.rolls and (each.solid or each.sliding)]

    def share(shares: Sequence[tuple[int, float]]) -> Share:
        value = sum(quantity * each for quantity, each in shares) / pieces
        return Share(value, *map(float, wilson_interval(value, recordings)))

    falls = [(each.item.quantity, each.overturns.value) for each in results]
    far = [(each.item.quantity, each.goes_far) for each in rolling]
    return PlaceFate(
        pieces=pieces,
        falls=share(falls) if pieces else UNKNOWN,
        rolling=sum(each.item.quantity for each in rolling),
        rolls_far=share(far) if rolling else UNKNOWN,
        risk=worst_class(results),
    )
