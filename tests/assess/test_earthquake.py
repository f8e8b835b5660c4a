"""Falls in one earthquake by simulation, beside those by fragility functions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shaketable import Body, Motion
from shaketable.assess import assess
from shaketable.assess.earthquake import EarthquakeFalls, compared
from shaketable.hazard import FallProbability, ShakeMap
from shaketable.hazard.earthquake import (
    Location,
    Shaken,
    motions_of_map,
    object_chances,
    shaken_places,
)
from shaketable.hazard.falls import probabilities
from shaketable.inventory import Item
from shaketable.report.earthquake import Quake
from shaketable.report.words.earthquake import lead
from shaketable.signal import measure_named
from shaketable.signal.intensity import Record
from shaketable.simulate import simulate_many

HERE = Location("", None)
PLACES = {HERE: Shaken(float(np.log(0.4)), 0.4)}
ITEMS = [
    Item(
        body=Body.rectangle(0.32, 1.8, name="shelf"),
        sideways=Body.rectangle(0.9, 1.8, name="shelf"),
        height=1.8,
        quantity=5,
    ),
    Item(body=Body.rectangle(0.3, 0.6, name="bolted"), height=0.6, anchored=True),
    Item(body=Body.rectangle(0.23, 1.5, name="cylinder"), height=1.5, quantity=2),
    Item(body=Body.rectangle(0.9, 0.5, name="chest"), height=0.5, quantity=7),
]


@pytest.fixture(scope="module")
def motions(p695: list[Motion]) -> list[Motion]:
    return p695[:44]


@pytest.fixture(scope="module")
def ground(motions: list[Motion]) -> list[Motion]:
    return motions_of_map(motions, "PGV", PLACES)[HERE]


@pytest.fixture(scope="module")
def found(motions: list[Motion], ground: list[Motion]) -> EarthquakeFalls:
    chances = object_chances(ITEMS, PLACES, motions, "PGV")
    return compared(
        "made", measure_named("PGV"), chances, PLACES,
        assessment=assess(ITEMS, ground, progress=False), ground={HERE: ground},
    )  # fmt: skip


def test_three_numbers_of_an_object(found: EarthquakeFalls, ground: list[Motion]) -> None:
    """The simulated share, the function over the simulated motions, and by the function."""
    shelf = next(one for one in found.falls if one.chance.number == 1)
    assert shelf.simulated is not None
    runs = simulate_many([ITEMS[0].body], ground)
    assert shelf.simulated.value == pytest.approx(float((runs["outcome"] != 0).mean()))
    curve, pgv = shelf.chance.curve, measure_named("PGV")
    levels = np.array([pgv.of(Record(m.horizontal, m.time_step)) for m in ground])
    assert shelf.through == pytest.approx(curve.probability(levels).mean(), rel=1e-9)
    assert shelf.chance.chance.value == pytest.approx(
        float(probabilities(curve.median, curve.beta, *PLACES[HERE]))
    )
    # the levels were spread evenly over the map's distribution: the last two nearly agree
    assert shelf.through == pytest.approx(shelf.chance.chance.value, abs=0.01)


def test_objects_lead_with_their_worse_direction(found: EarthquakeFalls) -> None:
    assert [one.chance.number for one in found.leading] == [1, 3, 4]  # 2 is anchored
    assert found.leading[0].chance.direction == "front to back"
    assert found.ranked()[-1].chance.number == 4


def test_totals_leave_out_what_has_no_function(found: EarthquakeFalls) -> None:
    """Nothing overturns the chest, of which no function is known."""
    told = found.totals()
    assert told.pieces == 7
    one, two, chest = found.leading
    assert np.isnan(chest.chance.chance.value)
    assert told.by_function == pytest.approx(
        5 * one.chance.chance.value + 2 * two.chance.chance.value
    )
    assert one.simulated is not None
    assert two.simulated is not None
    assert told.simulated == pytest.approx(5 * one.simulated.value + 2 * two.simulated.value)
    low, high = found.interval
    assert 0.0 <= low <= told.by_function <= high <= 7.0


def test_tables(found: EarthquakeFalls) -> None:
    table = found.table()
    assert table["number"].tolist() == [1, 1, 3, 4]
    assert table["simulated_share"].notna().all()
    assert "overturns" in table["problem"].iloc[-1]
    place = found.place_table().iloc[0]
    assert place["pieces"] == 14
    assert place["pieces_with_function"] == 7
    assert place["expected_falls"] == pytest.approx(found.totals().by_function)
    assert place["shaking_median"] == pytest.approx(0.4)


def test_without_simulation(motions: list[Motion]) -> None:
    """A direction without a function never leads one that has it."""
    items = [replace(ITEMS[0], sideways=Body.rectangle(1.5, 1.0, name="shelf"))]
    chances = object_chances(items, PLACES, motions, "PGV")
    found = compared("made", measure_named("PGV"), chances, PLACES)
    assert found.leading[0].chance.direction == "front to back"
    assert np.isnan(found.totals().simulated)
    assert found.totals().pieces == 5


def test_what_always_falls_is_not_counted_as_none(motions: list[Motion]) -> None:
    """No function is told of it, in the tables, the words and the map: not known is not zero."""
    site = (8.0, 47.0)
    needle = Item(body=Body.rectangle(0.02, 3.0, name="needle"), height=3.0, quantity=10,
                  building="Wards", site=site)  # fmt: skip
    x, y = np.array([7.9, 8.1]), np.array([46.9, 47.1])
    grid = np.full((2, 2), np.log(0.5))
    quake = ShakeMap(
        name="made", magnitude=7.0, longitudes=x, latitudes=y, ln_median={"PGV": grid},
        sigma={"PGV": np.full((2, 2), 0.2)},
    )  # fmt: skip
    places = shaken_places([needle], quake, "PGV")
    chances = object_chances([needle], places, motions, "PGV")
    chances = [replace(one, chance=FallProbability(np.nan, np.nan, np.nan)) for one in chances]
    ground = motions_of_map(motions, "PGV", places)
    found = compared(
        "made", measure_named("PGV"), chances, places,
        assessment=assess([needle], next(iter(ground.values())), progress=False),
        ground=ground,
    )  # fmt: skip
    row = found.place_table().iloc[0]
    assert np.isnan(row["expected_falls"])
    assert row["expected_falls_simulated"] == pytest.approx(10.0)
    shown = Quake(found=found, source=quake).shown()
    (place,) = shown["places"]  # type: ignore[misc]
    assert (place["falls"], place["simulated"]) == ("–", "10")
    said = " ".join(lead(found, quake))
    assert "Of 10 more pieces no fragility function can be told" in said
    assert "by simulation 10 of them fall" in said
