"""What to look at first: how often an object falls, times how much that matters."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass

from shaketable.assess.item_result import ItemResult
from shaketable.errors import InputError
from shaketable.inventory import Item


@dataclass(frozen=True, kw_only=True)
class Weights:
    """What is added to the priority 1 of an object, for what the inventory says of it.

    Raises:
        InputError: a weight below zero or not finite.
    """

    critical: float = 1.0  # for each of the steps 1 to 5
    blocks_exit: float = 3.0
    people_nearby: float = 3.0
    must_not_fall: float = 3.0

    def __post_init__(self) -> None:
        for name, value in asdict(self).items():
            if not 0.0 <= value < math.inf:
                raise InputError(f"the weight {name} must be a number from 0 on, got {value!r}")

    def of(self, item: Item) -> float:
        """The priority of an item."""
        return (
            1.0
            + self.critical * item.critical
            + self.blocks_exit * item.blocks_exit
            + self.people_nearby * item.people_nearby
            + self.must_not_fall * item.must_not_fall
        )


def ranked(results: Iterable[ItemResult], weights: Weights) -> list[ItemResult]:
    """The results by share, or probability where objects are uncertain too, times priority.

    The largest come first; ties are decided by the interval's upper end.
    """

    def key(result: ItemResult) -> tuple[float, float]:
        weight = weights.of(result.item)
        return -weight * result.ranking_share.value, -weight * result.ranking_share.high

    return sorted(results, key=key)
