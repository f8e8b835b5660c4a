"""Rates of the objects of an inventory."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from shaketable import Body, General, Motion, Surroundings, Wall, assess, fragility
from shaketable.hazard import Hazard
from shaketable.hazard.objects import object_rates
from shaketable.hazard.rates import YEARS, rate_of
from shaketable.inventory import Item
from shaketable.report.assessment_folder import write_results
from shaketable.report.words.hazard import of_inventory, yearly
from shaketable.signal.intensity import measure_named
from tests.support.builders import RUN

SHELF = Body.rectangle(0.3, 1.8, name="shelf")
CHEST = Body.rectangle(0.4, 0.5, name="chest")


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


def test_a_wall_and_a_strap_lower_the_rate_of_what_they_hold(p695: list[Motion]) -> None:
    """As a fragility function with the same planar surroundings does; what is alone keeps its own.

    The rocking model becomes the general one that does the same.
    """
    levels = np.geomspace(0.02, 3.0, 30)
    curve = Hazard(measure=measure_named("PGV"), levels=levels, rates=1e-3 * levels**-2.0)
    shelf = Item(
        body=SHELF, sideways=Body.rectangle(0.9, 1.8, name="shelf"), height=1.8, mass=100.0
    )
    wall = Wall(gap=0.02, restitution=0.3)
    walled = replace(shelf, surroundings=Surroundings(walls=(wall,)))
    found = object_rates([shelf, walled], p695[:12], curve, draws=20, components="own")
    alone, _, held, side = found.rates
    assert alone.found.rate == object_rates(
        [shelf], p695[:12], curve, draws=20, components="own"
    ).rates[0].found.rate  # fmt: skip
    body = replace(SHELF, mass=100.0, height=1.8)
    known = fragility(
        body, p695[:12], components="own", draws=20, progress=False, model=General(),
        surroundings=Surroundings(walls=(wall,)),
    ).curve  # fmt: skip
    assert held.found.rate == rate_of(known, curve).rate
    assert held.found.rate < alone.found.rate
    assert side.direction == "side to side"  # the wall is behind it, and does nothing there


def test_rates_stand_beside_the_results_of_their_items(p695: list[Motion], tmp_path: Path) -> None:
    """By the item's number: of alike items, and of copies of those that were assessed."""
    shelf = Item(body=SHELF, height=1.8)
    items = [replace(shelf, anchored=True), shelf, replace(shelf, body=CHEST, height=0.5), shelf]
    levels = np.geomspace(0.02, 3.0, 30)
    curve = Hazard(measure=measure_named("PGV"), levels=levels, rates=1e-3 * levels**-2.0)
    rates = object_rates(deepcopy(items), p695[:24], curve, draws=50)
    found = assess(items, p695[:24], progress=False)
    write_results(found, RUN, tmp_path / "out", rates=rates)
    table = pd.read_csv(tmp_path / "out" / "results.csv")
    known = rates.of_objects()
    assert list(known) == [2, 3, 4]
    for number, told in zip((2, 3, 4), table["annual_falls"], strict=True):
        assert told == pytest.approx(known[number].found.rate, rel=1e-5, nan_ok=True)  # six digits
    page = (tmp_path / "out" / "report.html").read_text("utf-8")
    assert page.count(yearly(known[2].found, YEARS, rolls=False)) == 1  # alike, they share a card
