"""The friction with which objects rock without sliding, in the main job."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import Body, Item, Motion, assess, simulate
from shaketable.demand import largest_demand
from shaketable.inventory import Castors


def test_nine_of_ten_of_what_rocks(p695: list[Motion]) -> None:
    """More than b/h, and what single runs ask for."""
    body = Body.rectangle(0.4, 1.5, name="cupboard")
    items = [
        Item(body=body, height=1.5),
        Item(body=Body.rectangle(3.0, 1.0, name="slab"), height=1.0),
        Item(body=Body.rectangle(0.5, 1.1, name="cart"), height=1.1, castors=Castors.FREE),
    ]
    cupboard, slab, cart = assess(items, p695[:20], scale=1.2, progress=False).results
    runs = [simulate(body, motion.scaled(1.2)) for motion in p695[:20]]
    asked = [largest_demand(run) for run in runs if run.peak_rotation > 0]
    expected = np.quantile(asked, 0.9, method="higher")
    assert cupboard.rocking_friction == pytest.approx(expected)
    assert cupboard.rocking_friction > 0.4 / 1.5
    assert np.isnan(slab.rocking_friction)
    assert np.isnan(cart.rocking_friction)
