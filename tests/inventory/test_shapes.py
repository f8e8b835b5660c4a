"""What an inventory says of the shape of an object, and its solid."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from shaketable import Body, InputError, Solid
from shaketable.inventory import BaseShape, Item, read_inventory, solid_of

HEADER = "name,depth_m,width_m,diameter_m,height_m,shape,eccentricity,facing_deg,castors"


def read(tmp_path: Path, *rows: str) -> list[Item]:
    path = tmp_path / "room.csv"
    path.write_text("\n".join([HEADER, *rows]) + "\n")
    return read_inventory(path)


def test_shapes(tmp_path: Path) -> None:
    items = read(
        tmp_path,
        "shelf,0.3,0.9,,1.8,,,,",
        "table,0.6,0.9,,0.7,Feet,,270,",
        "bottle,,,0.2,1.4,,,,",
        "vase,0.3,,,1.0,round,,,",
        "cart,0.5,0.7,,1.0,,,,free",
    )
    shapes = [BaseShape.BOX, BaseShape.FEET, BaseShape.CYLINDER, BaseShape.CYLINDER, BaseShape.BOX]
    assert [each.shape for each in items] == shapes
    assert items[1].facing == pytest.approx(math.radians(270.0))
    assert items[3].sideways == items[3].body  # one size of a circle tells the other
    solids = [solid_of(each, 0.02) for each in items]
    shelf, table, bottle, vase, cart = solids
    assert shelf is not None
    assert shelf.extent == pytest.approx((0.3, 0.9))
    # a homogeneous box, as the planar bodies are: its planes see the same radii of gyration
    assert shelf.inertia == pytest.approx(Solid.box(0.3, 0.9, 1.8).inertia)
    assert table is not None
    assert table.feet
    assert not any(table.castors)
    assert bottle is not None
    assert bottle.diameter == 0.2
    assert vase is not None
    assert vase.diameter == 0.3
    assert cart is not None
    assert cart.castors == (True,) * 4
    assert cart.rolling_resistance == 0.02


def test_what_hangs_over_its_front(tmp_path: Path) -> None:
    """Eccentricity is from the front, which is toward -x."""
    (item,) = read(tmp_path, "screen,0.5,0.8,,1.0,,0.3,,")
    solid = solid_of(item, 0.02)
    assert solid is not None
    assert solid.corners[:, 0].min() == pytest.approx(-0.15)
    assert solid.corners[:, 0].max() == pytest.approx(0.35)
    assert np.abs(solid.corners[:, 1]) == pytest.approx(0.4)


@pytest.mark.parametrize("radius", [0.02, 0.9])
def test_any_radius_of_gyration_gives_a_body(radius: float) -> None:
    """That of the plane is kept, and about its axis the body has what it can have with it."""
    body = Body(base=0.6, cg_height=0.5, left=0.3, gyration_radius=radius)
    item = Item(body=body, sideways=Body.rectangle(0.8, 1.0), height=1.0)
    solid = solid_of(item, 0.02)
    assert solid is not None
    assert solid.inertia[1, 1] == pytest.approx(radius**2)
    x, y, z = np.diag(solid.inertia)
    assert abs(x - y) <= z + 1e-12 <= x + y + 2e-12


def test_bases_that_are_not_known(tmp_path: Path) -> None:
    items = read(tmp_path, "deep,0.3,,,1.8,,,,", "drum off centre,,,0.6,0.9,,0.4,,")
    assert [solid_of(each, 0.02) for each in items] == [None] * 2
    path = tmp_path / "wide.csv"
    path.write_text("name,width_m,height_m\nwide,0.9,1.8\n")
    assert solid_of(read_inventory(path)[0], 0.02) is None


def test_a_width_alone_says_nothing_where_others_have_a_depth(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """A partition of 0.9 m is not as stable as it is wide; a bottle is as deep as it is wide."""
    deep, bottle = read(
        tmp_path, "deep,0.3,0.9,,1.8,,,,", "partition,,0.9,,1.8,,,,", "gas bottle,,0.3,,0.6,,,,"
    )
    assert (deep.name, bottle.shape, bottle.body.base) == ("deep", BaseShape.CYLINDER, 0.3)
    assert "1 not assessed, as the list does not give their sizes: 'partition'" in caplog.text
    assert "gives one size across of something round" in caplog.text


@pytest.mark.parametrize(
    ("row", "says"),
    [
        ("x,0.3,0.9,,1.8,cylinder,,,", "found cylinder, with a depth of 0.3 m and a width of 0.9"),
        ("x,,,0.3,1.8,box,,,", "found box, with a diameter: give depth and width, or cylinder"),
        ("x,0.3,0.3,,1.8,round,0.4,,", "eccentricity: of a cylinder it is 0.5, found 0.4"),
        ("x,0.3,0.9,,1.8,,,north,", "facing_deg: expected decimal degrees from -360 to 360"),
    ],
)
def test_shapes_that_are_none(tmp_path: Path, row: str, says: str) -> None:
    with pytest.raises(InputError) as caught:
        read(tmp_path, row)
    assert says in str(caught.value)


@pytest.mark.parametrize(
    "name",
    ["Marble bust (round)", "Mesa redonda", "Runder Tisch", "Büste (rund)", "Cylindrical tank",
     "Bust, circular base", "Depósito cilíndrico", "Zylindrischer Behälter"],
)  # fmt: skip
def test_names_of_round_things_in_three_languages(tmp_path: Path, name: str) -> None:
    """Those that are as wide as deep, and whose shape is not said, may be round."""
    said, unsaid, oblong = read(
        tmp_path,
        f'"{name}",0.23,0.23,,1.5,box,,,',
        f'"{name} 2",0.23,0.23,,1.5,,,,',
        f'"{name} 3",0.23,0.6,,1.5,,,,',
    )
    assert (said.may_be_round, unsaid.may_be_round, oblong.may_be_round) == (False, True, False)


def test_what_may_be_round_is_asked_about(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    read(
        tmp_path,
        "Oxygen cylinder,0.23,0.23,,1.5,,,,",
        "Wine bottle rack,0.3,0.9,,1.5,,,,",
        "Square bin,0.3,0.3,,0.9,box,,,",
    )
    (asked,) = [each.message for each in caplog.records if "may be round" in each.message]
    assert "'Oxygen cylinder'" in asked
    assert "bottle" not in asked
    assert "bin" not in asked
