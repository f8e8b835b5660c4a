"""Rooms as files: what is read, and what is told of mistakes."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path

import pytest

from shaketable import InputError
from shaketable.inventory import BaseShape, Castors
from shaketable.rooms import PlaceKind, Swing, read_room
from shaketable.rooms.grid import Grid
from shaketable.rooms.plain import plain

EXAMPLE = Path(__file__).parents[2] / "examples" / "hospital_room.toml"
PLAIN = """
name = "Room"
outline_m = [[0, 0], [4, 0], [4, 3], [0, 3]]
[[door]]
at_m = [2, 0]
[[thing]]
name = "shelf"
at_m = [2, 2.8]
facing_deg = 180
depth_m = 0.3
width_m = 0.9
height_m = 1.8
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "room.toml"
    path.write_text(text)
    return path


@pytest.mark.parametrize("name", ["classroom", "hospital_room", "laboratory_room", "living_room"])
def test_every_example_is_a_room_without_faults(name: str) -> None:
    room = read_room(EXAMPLE.with_name(f"{name}.toml"))
    assert len(room.things) >= 5
    assert room.places
    assert any(door.exit for door in room.doors)


def test_the_example() -> None:
    room = read_room(EXAMPLE)
    assert (room.name, room.north, room.way) == ("Two-bed room", 0.0, 0.80)
    assert [thing.name for thing in room.things][:2] == ["wardrobe", "bookcase"]
    wardrobe, bookcase, locker, cylinder, monitor = (thing.item for thing in room.things)
    assert (wardrobe.body.base, wardrobe.sideways and wardrobe.sideways.base) == (0.58, 1.0)
    assert (bookcase.height, bookcase.facing, bookcase.mass) == (1.8, math.pi / 2, 90.0)
    assert locker.castors is Castors.LOCKED
    assert (cylinder.shape, monitor.shape) == (BaseShape.CYLINDER, BaseShape.FEET)
    assert room.doors[0].swing is Swing.OUTWARD
    assert [place.kind for place in room.places][1:] == [PlaceKind.BED, PlaceKind.TURNING]
    assert room.places[0].people == 0.9


def test_what_a_file_may_leave_out(tmp_path: Path) -> None:
    room = read_room(written(tmp_path, PLAIN))
    assert (room.north, room.floor, room.way, room.scatter) == (None, "", 0.80, 0.0)
    assert (room.doors[0].name, room.doors[0].width, room.doors[0].exit) == ("door 1", 0.9, True)


def test_units_of_headers_hold(tmp_path: Path) -> None:
    text = PLAIN.replace("depth_m = 0.3", "depth_cm = 30").replace("width_m", "Breite_m")
    item = read_room(written(tmp_path, text)).things[0].item
    assert (item.body.base, item.sideways and item.sideways.base) == (0.3, 0.9)


@pytest.mark.parametrize(
    ("before", "after", "told"),
    [
        ("[[0, 0], [4, 0]", "[[0, 0], [4]", r"line 3, outline_m: expected three corners"),
        ("at_m = [2, 0]", "at_m = 2", r"line 5, at_m: expected two numbers"),
        ("at_m = [2, 0]", 'at_m = [2, 0]\nswing = "up"', r"line 6, swing: expected one of inward"),
        ("at_m = [2, 0]", "at_m = [2, 0]\nwide = 1", r"line 6, wide: unknown; accepted: name"),
        ("facing_deg = 180", "facing_deg = 900", r"line 9, facing_deg: expected decimal degrees"),
        ("height_m = 1.8", "height_m = -1", r"line 12, height_m: expected a positive number"),
        ("height_m = 1.8", "", r"no column for the height"),
        ("height_m = 1.8", "height_m = 1.8\ncolour = 1", r"line 13, colour: unknown column"),
        ("height_m = 1.8", "height_m = 1.8\nwall_gap_mm = 5", r"the plan says where walls are"),
        ("height_m = 1.8", 'height_m = 1.8\non = "desk"', r"line 13, on: no other thing is called"),
        ('name = "shelf"', 'name = "door 1"', r"'door 1' is there twice"),
        ("[2, 2.8]", "[2, 2.9]", r"shelf: stands in a wall"),
        ("depth_m = 0.3", "depth_m = 300", r"must lie between|implausible|not to be expected"),
        ("[[door]]", "[door]", r"door: must be tables, each begun by \[\[door\]\]"),
        ('name = "Room"', "way_m = 9", r"line 2, way_m: expected a number from 0.3 to 3"),
        ('name = "Room"', "name = Room", r"not a TOML file"),
    ],
)
def test_mistakes_are_told_with_their_lines(
    tmp_path: Path, before: str, after: str, told: str
) -> None:
    assert before in PLAIN
    with pytest.raises(InputError, match=told):
        read_room(written(tmp_path, PLAIN.replace(before, after)))


def test_all_mistakes_are_told_at_once(tmp_path: Path) -> None:
    text = PLAIN.replace("at_m = [2, 0]", "at_m = 2").replace("height_m = 1.8", "height_m = -1")
    with pytest.raises(InputError) as error:
        read_room(written(tmp_path, text))
    assert len(str(error.value).splitlines()) == 2


def test_what_a_name_may_say_is_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """As of an inventory: nobody is told that a cart stands still whose castors are not known."""
    read_room(written(tmp_path, PLAIN.replace('name = "shelf"', 'name = "cart on a table"')))
    assert "may stand on castors" in caplog.text
    read_room(written(tmp_path, PLAIN.replace('name = "shelf"', 'name = "printer on a table"')))
    assert "stand on something else, or are stacked" in caplog.text


def test_a_plan_with_faults_can_be_drawn(tmp_path: Path) -> None:
    path = written(tmp_path, PLAIN.replace("[2, 2.8]", "[2, 2.9]"))
    assert read_room(path, check=False).things[0].at == (2.0, 2.9)


@pytest.mark.parametrize("word", ['"1.5"', "1.5", '"1,5"', '"1500 N"'])
def test_a_number_in_quotes_means_the_same_in_the_editor(tmp_path: Path, word: str) -> None:
    """1,500 N on the command line were 1.5 N on the page."""
    strap = f'mass_kg = 100\nstrap = "top:stiffness=50kN/m"\nstrap_strength_kn = {word}\n'
    path = written(tmp_path, PLAIN + strap)
    room = read_room(path)
    around = room.things[0].item.surroundings
    assert around is not None
    assert around.straps[0].strength == 1500.0
    told = plain(tomllib.loads(path.read_text()), room)
    assert told["thing"][0]["strap_strength_n"] == 1500.0


def test_a_plan_that_is_too_large_is_refused_at_once(tmp_path: Path) -> None:
    far = "[[0, 0], [4, 0], [900, 896], [900, 900], [896, 900], [0, 4]]"
    path = written(tmp_path, PLAIN.replace("[[0, 0], [4, 0], [4, 3], [0, 3]]", far))
    room = read_room(path, check=False)
    with pytest.raises(
        InputError, match=r"the plan spans 900 m × 900 m, which is 324,936,676 cells"
    ):
        Grid.of(room)
    assert Grid.of(room, 1.0).floor.size < 1_000_000
