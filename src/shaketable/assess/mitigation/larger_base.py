"""A base on which few fall: a plane proposes one, and three dimensions halve the way to it.

The base grows by a share of what is proposed, in both directions at once, from 0 (as it is) on.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

from shaketable.assess.bases import widened
from shaketable.assess.item_result import ItemResult, ProfileResult
from shaketable.assess.mitigation.trials import Asked, Trial, with_item
from shaketable.assess.profiles import Direction
from shaketable.assess.results import MitigationKind
from shaketable.inventory import BaseShape, Item

MOST = 3.0  # times the growth that is proposed: a larger base is no measure
ROUNDS = 4
UNKNOWN = 0.25  # of the base: by how much it grows where a plane proposes nothing


class Search(NamedTuple):
    """The search for a base.

    Attributes:
        asked: for which object.
        depth, width: of the base that is proposed [m].
        fails, does: the largest share of the growth that was too little, and the smallest that
            was enough; inf where none was.
    """

    asked: Asked
    depth: float
    width: float
    fails: float = 0.0
    does: float = math.inf

    @property
    def share(self) -> float:
        """Which is tried next."""
        if math.isinf(self.does):
            return 1.0 if not self.fails else min(1.5 * self.fails, MOST)
        return 0.5 * (self.fails + self.does)

    def trial(self) -> Trial:
        """What is simulated next."""
        item, share = self.asked.item, self.share
        assert item.sideways is not None
        depth = item.body.base + share * (self.depth - item.body.base)
        width = item.sideways.base + share * (self.width - item.sideways.base)
        wider = replace(
            item, body=widened(item.body, depth), sideways=widened(item.sideways, width)
        )
        about = {"depth_m": depth, "width_m": width}
        return Trial(MitigationKind.BASE, about, with_item(self.asked, wider))

    def after(self, share: float, enough: bool) -> Search:
        """The search after a share was tried."""
        return self._replace(does=share) if enough else self._replace(fails=share)


def begin(asked: Asked) -> Search | None:
    """The search for a base; None of what rolls, and beside an edge, over which it would reach."""
    item, around = asked.item, asked.stood.around
    if item.rolls or item.sideways is None or (around and around.edge):
        return None
    depth = _proposed(asked.result, Direction.FRONT_TO_BACK, item.body.base)
    width = _proposed(asked.result, Direction.SIDE_TO_SIDE, item.sideways.base)
    if item.shape is BaseShape.CYLINDER:
        depth = width = max(depth, width)
    if depth <= item.body.base and width <= item.sideways.base:
        depth, width = ((1.0 + UNKNOWN) * each for each in _sizes(item))
    return Search(asked, depth, width)


def _sizes(item: Item) -> tuple[float, float]:
    assert item.sideways is not None
    return item.body.base, item.sideways.base


def _proposed(result: ItemResult | None, direction: Direction, now: float) -> float:
    """The base that does in a plane [m], and no smaller one than it has."""
    sides: list[ProfileResult | None] = [result, result.other] if result else []
    for side in sides:
        if side is None:
            continue
        alike = side.profile.alike or side.profile.direction is direction
        if alike and side.safe_base == side.safe_base:
            return max(now, side.safe_base)
    return now
