"""How far items slide, and which of them walk off what they stand on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shaketable.assess.present import Present, observed_quartiles
from shaketable.assess.results import Sliding
from shaketable.inventory import Item
from shaketable.tilting import SLIDES


def sliding_of(items: Sequence[Item], now: Present) -> list[Sliding]:
    """Sliding of each item in the simulations in which it stays upright.

    An item that falls also slips as it falls, and that does not count.
    """
    assert now.slip_downhill is not None
    assert now.slip_uphill is not None
    farthest = np.maximum(now.slip_downhill, now.slip_uphill)
    found = []
    for k, item in enumerate(items):
        upright = now.stands[k]
        left, right = room(item)
        off = upright & ((now.slip_downhill[k] > left) | (now.slip_uphill[k] > right))
        found.append(
            Sliding(
                share=float((upright & (farthest[k] > SLIDES)).mean()),
                slip=observed_quartiles(farthest[k][upright]),
                walks_off=np.nan if np.isnan(left) else float(off.mean()),
            )
        )
    return found


def room(item: Item) -> tuple[float, float]:
    """How far it may slide downhill and uphill [m] before its centre of gravity passes the edge.

    Its base starts in the middle of the support. NaN where the support's length is not known.
    """
    if item.support_length is None:
        return np.nan, np.nan
    off_centre = item.body.left - item.body.width / 2
    return item.support_length / 2 + off_centre, item.support_length / 2 - off_centre
