"""Sizes that a list leaves out, from the catalogue of common things."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from shaketable import InputError, read_inventory
from shaketable.inventory import BaseShape, Castors, Item
from shaketable.inventory.catalogue import LANGUAGES, catalogue, common_thing
from shaketable.inventory.vocabulary import heading
from shaketable.language import speaking
from shaketable.report.words.assumed import what_is_assumed


def read(folder: Path, text: str, *, catalogue: bool = True) -> list[Item]:
    (folder / "list.csv").write_text(text, encoding="utf-8")
    return read_inventory(folder / "list.csv", catalogue=catalogue)


def test_its_ranges_are_those_of_things() -> None:
    """Sizes of furniture, densities between an empty crate and solid stone, names of one thing."""
    things = catalogue()
    assert len(things) >= 150
    owners: dict[str, str] = {}
    for key, thing in things.items():
        for each in (thing.depth, thing.width, thing.height, thing.cg, thing.mass, thing.friction):
            assert 0.0 < each.least <= each.most, key
        assert thing.depth.least >= 0.05, key
        assert thing.height.most <= 6.0, key
        assert thing.cg.most < 1.0, key
        assert thing.friction.most <= 1.0, key
        least = thing.mass.least / (thing.depth.least * thing.width.least * thing.height.least)
        most = thing.mass.most / (thing.depth.most * thing.width.most * thing.height.most)
        assert least > 5.0, key
        assert most < 3000.0, key
        assert thing.castors in ("", "free", "locked"), key
        assert thing.shape is not BaseShape.CYLINDER or thing.width == thing.depth, key
        for language in LANGUAGES:
            for name in thing.names[language]:
                assert name == name.strip() != "", key
                assert owners.setdefault(heading(name), key) == key, name


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("Bücherregal Flur", "bookcase"),
        ("BOOKCASES (8)", "bookcase"),
        ("Wandregal", "bookcase"),
        ("oak bookcase, 2.06 m", "bookcase"),
        ("Printer shelf", "bookcase"),
        ("Microscope cabinet", "cupboard"),
        ("Armario de impresora", "cupboard"),
        ("CO2-Inkubator", "incubator"),
        # what is another thing, or of another thing
        ("Bookcase with television", ""),
        ("Regal für Drucker", ""),
        ("プリンター棚", ""),
        ("Desk lamp", ""),
        ("MRI compatible injector", ""),
        ("CT contrast injector", ""),
        ("Shoe rack", ""),
        ("Lichtschranke", ""),
        ("Automatisches Blutdruckmessgerät", ""),
        ("Desk pedestal", ""),
        ("Sauerstoffflaschen", "gas cylinder large"),
        ("Armario de reactivos", "chemical cabinet"),
        ("Armario", "cupboard"),
        ("laboratory refrigerators", "laboratory refrigerator"),
        ("薬品棚A", "chemical cabinet"),
        ("bombola di ossigeno", "gas cylinder large"),
        ("cat", ""),
        ("vegetable box", ""),
        ("", ""),
    ],
)
def test_a_name_is_that_of_a_thing(name: str, key: str) -> None:
    found = common_thing(name)
    assert (found.key if found else "") == key


def test_what_is_left_out_is_what_tips_most_easily(tmp_path: Path) -> None:
    """The smaller base, the larger height and height of the centre of gravity, the larger mass."""
    (shelf,) = read(tmp_path, "name,quantity\nbookcase,3\n")
    thing = catalogue()["bookcase"]
    assert shelf.height == thing.height.most == 2.2
    assert shelf.body.base == thing.depth.least == 0.25
    assert shelf.sideways is not None
    assert shelf.sideways.base == thing.width.least == 0.6
    assert math.isclose(shelf.body.cg_height, 0.6 * 2.2)  # 0.45 to 0.6 of the height
    assert shelf.mass == 250.0
    assert shelf.quantity == 3
    assert shelf.assumed_as == "bookcase"
    assert {each.what for each in shelf.assumed} == {
        "depth", "width", "height", "cg_height", "mass",
    }  # fmt: skip


def test_what_is_given_stays(tmp_path: Path) -> None:
    text = "name,depth_m,width_m,height_m,cg_height_m,mass_kg\nbookcase,0.3,0.9,1.8,,\n"
    (whole,) = read(tmp_path, text)
    assert (whole.assumed, whole.mass, whole.body.cg_height) == ((), None, 0.9)
    (part,) = read(tmp_path, text.replace("0.3,0.9,1.8,,", "0.3,,1.8,0.5,40"))
    assert [each.what for each in part.assumed] == ["width"]
    assert (part.body.base, part.height, part.body.cg_height, part.mass) == (0.3, 1.8, 0.5, 40.0)
    (round_one,) = read(tmp_path, "name,diameter_m,height_m\nvase,0.2,\n")
    assert round_one.shape is BaseShape.CYLINDER
    assert (round_one.body.base, round_one.height) == (0.2, 0.5)


def test_what_it_commonly_is_counts(tmp_path: Path) -> None:
    """What is round is simulated so; what commonly rolls gets no class before that is answered."""
    cylinder, stand, locked = read(
        tmp_path, "name,castors\nGasflasche,\nMessgerät Infusomat,\ncrash cart,locked\n"
    )
    assert cylinder.shape is BaseShape.CYLINDER
    assert not cylinder.may_be_round
    assert (stand.shape, stand.castors) == (BaseShape.FEET, Castors.UNKNOWN)
    assert locked.castors is Castors.LOCKED


def test_what_a_name_says_is_round_stays_so(tmp_path: Path) -> None:
    """Until a shape is said it gets no class, whatever the catalogue takes it for."""
    (table,) = read(tmp_path, "name,width_m,height_m\nRound table,,\n")
    assert (table.assumed_as, table.may_be_round) == ("table", True)
    (drum,) = read(tmp_path, "name,diameter_m,height_m\nbookcase,0.5,\n")
    assert (drum.shape, drum.height) == (BaseShape.CYLINDER, 2.2)


def test_it_is_asked_for(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    with pytest.raises(
        InputError, match=r"line 1: I found no column for the height.*--catalogue takes"
    ):
        read(tmp_path, "name,quantity\nbookcase,3\n", catalogue=False)
    text = "name,depth_m,height_m\nbookcase,0.3,1.8\noak bookcase,0.3,\nthing,0.3,\n"
    assert [item.name for item in read(tmp_path, text, catalogue=False)] == ["bookcase"]
    assert "not assessed, as the list does not give their sizes: 'oak bookcase' (line 3)" in (
        caplog.text
    )
    assert "the catalogue has usual sizes of 'bookcase': --catalogue takes them" in caplog.text
    caplog.clear()
    assert [item.name for item in read(tmp_path, text)] == ["bookcase", "oak bookcase"]
    assert "1 not assessed, as the list does not give their sizes: 'thing' (line 4)" in caplog.text


def test_it_is_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (item,) = read(tmp_path, "name\nGasflasche Labor\n")
    assert "'Gasflasche Labor' as 'gas cylinder large'" in caplog.text
    (said,) = what_is_assumed(item)
    assert "diameter 20 cm (of 20 to 26), height 165 cm (of 130 to 165)" in said
    assert "mass 95 kg (of 55 to 95)" in said
    assert "assumed, and were not read in a source" in said
    with speaking("de"):
        (said,) = what_is_assumed(item)
    assert "“Gasflasche”" in said
    assert "Durchmesser 20 cm (von 20 bis 26)" in said
