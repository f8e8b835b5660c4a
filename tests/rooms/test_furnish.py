"""Things of a room that stand in a list."""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from pathlib import Path

import pytest

from shaketable import InputError, read_inventory
from shaketable.assess.alike import as_simulated
from shaketable.rooms import faults_of
from shaketable.rooms.furnish import furnished
from shaketable.rooms.shapes import own_angle
from tests.rooms.test_plan import cabinet, room

ROOM = room(cabinet((3.0, 2.0)))
LIST = """name,room,x_m,y_m,facing_deg,depth_m,width_m,height_m,quantity
shelf,Room,1.0,0.2,0,0.3,0.9,1.8,1
shelf,Room,2.0,2.8,180,0.3,0.9,1.8,1
box,room,,,,0.3,0.4,0.5,2
desk,other,1.0,1.0,0,0.7,1.4,0.7,1
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "list.csv"
    path.write_text(text)
    return path


def test_rows_of_a_room_stand_in_its_plan(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    items = read_inventory(written(tmp_path, LIST))
    with caplog.at_level(logging.WARNING):
        found = furnished(ROOM, items)
    assert [(each.name, each.at) for each in found.things] == [
        ("cabinet", (3.0, 2.0)), ("shelf (row 2)", (1.0, 0.2)), ("shelf (row 3)", (2.0, 2.8)),
    ]  # fmt: skip
    assert not faults_of(found)
    assert "1 rows of this room have no place" in caplog.text
    assert "box" in caplog.text
    assert "desk" not in caplog.text


def test_a_list_without_places_and_pieces_at_one_place_are_refused(tmp_path: Path) -> None:
    once = LIST.replace("shelf,Room,2.0", "other shelf,Room,2.0")
    no_place = read_inventory(written(tmp_path, once.replace("x_m,y_m", "a,b")))
    with pytest.raises(InputError, match="no row of 'room' has a place"):
        furnished(ROOM, no_place)
    several = read_inventory(written(tmp_path, LIST.replace("0.9,1.8,1", "0.9,1.8,3", 1)))
    with pytest.raises(InputError, match="row 2, quantity: is of 3 pieces"):
        furnished(ROOM, several)
    with pytest.raises(InputError, match="x_m: is given alone"):
        read_inventory(written(tmp_path, LIST.replace(",1.0,0.2,", ",1.0,,")))
    with pytest.raises(InputError, match="another unit"):
        read_inventory(written(tmp_path, LIST.replace(",1.0,0.2,", ",1000,20,")))


def test_a_place_is_no_part_of_how_a_thing_moves(tmp_path: Path) -> None:
    """Nor is a column of one letter without a unit a place."""
    first, second, *_ = read_inventory(written(tmp_path, LIST.replace(",180,", ",0,")))
    assert first.position != second.position
    assert as_simulated(first) == as_simulated(second)
    bare = read_inventory(
        written(tmp_path, LIST.replace("x_m,y_m", "x,y").replace("shelf,Room,2", "two,Room,2"))
    )
    assert all(item.position is None for item in bare)


def test_units_are_those_of_the_header(tmp_path: Path) -> None:
    text = LIST.replace("x_m,y_m", "x [cm],y [cm]").replace(",1.0,0.2,", ",100,20,")
    assert read_inventory(written(tmp_path, text))[0].position == pytest.approx((1.0, 0.2))


@pytest.mark.parametrize("north", [None, 0.4])
def test_what_stands_before_a_wall_has_its_back_there(tmp_path: Path, north: float | None) -> None:
    """The room is 4 by 3 m; its second wall is that at x = 4, its third that at y = 3."""
    plan = replace(room(), north=north)
    rows = (
        "name,room,x_m,y_m,wall,wall_gap_mm,facing_deg,depth_m,width_m,height_m\n"
        "shelf,room,3.5,1.2,2,,,0.3,0.9,1.8\n"
        "locker,room,1.0,2.0,3,50,,0.5,0.6,1.8\n"
        "sideways,room,2.8,2.5,3,20,{facing},0.3,0.9,1.8\n"
    )
    along_wall = 90.0 - (0.0 if north is None else math.degrees(north))  # it looks along +x
    text = rows.format(facing=along_wall)
    shelf, locker, sideways = furnished(plan, read_inventory(written(tmp_path, text))).things
    assert shelf.at == pytest.approx((4.0 - 0.01 - 0.15, 1.2))
    assert locker.at == pytest.approx((1.0, 3.0 - 0.05 - 0.25))
    assert sideways.at == pytest.approx((2.8, 3.0 - 0.02 - 0.45))
    # fronts look away from their walls: its own x goes from its front to its back
    assert math.remainder(own_angle(shelf, plan), 2 * math.pi) == pytest.approx(0.0, abs=1e-12)
    assert math.remainder(own_angle(locker, plan), 2 * math.pi) == pytest.approx(math.pi / 2)
    for wrong in ("5", "0", "north"):
        bad = read_inventory(written(tmp_path, text.replace("1.2,2,", f"1.2,{wrong},")))
        with pytest.raises(InputError, match=f"row 2, wall: expected .* to 4, found '{wrong}'"):
            furnished(plan, bad, "list.csv")
    beyond = read_inventory(written(tmp_path, text.replace("3.5,1.2,2,", "3.5,4.2,2,")))
    with pytest.raises(InputError, match="row 2, wall: 2 ends before the place that x_m and y_m"):
        furnished(plan, beyond, "list.csv")
    sided = text.replace("wall_gap_mm,", "wall_gap_mm,wall_side,").replace("3,50,", "3,50,left,")
    aside = read_inventory(written(tmp_path, sided.replace("2,,,", "2,,,,").replace("20,", "20,,")))
    with pytest.raises(InputError, match=r"row 3, wall: stands with its back .* leave wall_side"):
        furnished(plan, aside, "list.csv")
    one, other, _ = read_inventory(written(tmp_path, text.replace("1.0,2.0,3,50", "3.5,1.2,1,")))
    assert as_simulated(replace(one, wall="7")) == as_simulated(one)
    assert one.wall != other.wall
