"""Rates of the objects of an inventory."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import Body, Motion, fragility
from shaketable.hazard import Hazard
from shaketable.hazard.objects import object_rates
from shaketable.hazard.rates import rate_of
from shaketable.inventory import Item
from shaketable.report.words.hazard import of_inventory
from shaketable.signal.intensity import measure_named

SHELF = Body.rectangle(0.3, 1.8, name="shelf")


@pytest.mark.parametrize(
    ("given", "of", "said"),
    [
        ({}, "geometric mean", "the geometric mean of both"),
        ({"components": "own"}, "own", "any one horizontal component"),
    ],
)
def test_functions_are_of_the_component_that_the_curve_is_of(
    p695: list[Motion], given: dict[str, str], of: str, said: str
) -> None:
    """Ground-motion models, and the curves made of them, tell the geometric mean of both."""
    levels = np.geomspace(0.02, 3.0, 30)
    curve = Hazard(measure=measure_named("PGV"), levels=levels, rates=1e-3 * levels**-2.0)
    found = object_rates([Item(body=SHELF, height=1.8)], p695[:24], curve, draws=50, **given)
    rates = {
        each: rate_of(
            fragility(SHELF, p695[:24], components=each, draws=50, progress=False).curve, curve
        ).rate
        for each in ("own", "geometric mean")
    }
    assert rates["own"] != rates["geometric mean"]
    assert found.rates[0].found.rate == rates[of]
    assert any(said in sentence for sentence in of_inventory(found, 50.0))
