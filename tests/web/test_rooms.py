"""What a worker does with a room: the same as the package."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from shaketable import InputError, Motion
from shaketable.language import LANGUAGES
from shaketable.rooms import assess_room as assessed
from shaketable.rooms import design_room, read_room
from shaketable.rooms.plain import plain
from shaketable.rooms.shapes import own_angle
from shaketable.web import rooms
from shaketable.web.budget import LeftError, answer
from shaketable.web.limits import MOST_THINGS
from shaketable.web.questions import Pulse
from shaketable.web.room_answers import AssessRoom, RoomAssessed, ShakeRoom
from shaketable.web.shaking import pairs_of
from tests.support.imports import PACKAGE

EXAMPLE = PACKAGE.parents[1] / "examples" / "hospital_room.toml"
ROOM = """
name = "Study"
outline_m = [[0, 0], [3, 0], [3, 3], [0, 3]]
[[door]]
name = "door"
at_m = [2, 0]
swing = "sliding"
[[place]]
name = "desk"
kind = "desk"
at_m = [1.2, 1.2]
size_m = [1.2, 0.7]
people = 0.5
[[thing]]
name = "shelf"
at_m = [0.9, 2.82]
facing_deg = 180
depth_m = 0.3
width_m = 0.9
height_m = 1.8
[[thing]]
name = "vase"
at_m = [0.9, 2.82]
depth_m = 0.1
width_m = 0.1
height_m = 0.4
on = "shelf"
"""
PULSE = Pulse(period_s=0.8, peak_g=0.6)


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> list[Motion]:
    """Twelve short pairs in place of 48."""
    some = sorted(pairs_of("fema-p695-both-directions"), key=lambda motion: motion.duration)[:12]
    monkeypatch.setattr(rooms, "pairs_of", lambda name: some)
    return some


def test_the_example_reads_as_it_is() -> None:
    read = rooms.understand("hospital_room.toml", EXAMPLE.read_bytes())
    assert read.faults == []
    assert [each["name"] for each in read.room["thing"]][:2] == ["wardrobe", "bookcase"]
    assert read.room["thing"][0]["depth_m"] == 0.58


def test_columns_of_any_name_and_unit_have_one_spelling() -> None:
    told = plain({"thing": [{"Name": "a", "Höhe [cm]": 180, "Tiefe cm": 30.0, "weight": 90,
                             "front azimuth": 90, "at_m": [1, 2], "colour": "red"}]})  # fmt: skip
    assert told["thing"] == [
        {"name": "a", "height_m": 1.8, "depth_m": 0.3, "mass_kg": 90.0, "facing_deg": 90,
         "at_m": [1, 2], "colour": "red"}
    ]  # fmt: skip


def test_texts_of_cells_are_given_as_numbers_and_one_word() -> None:
    """So that the page draws "30 cm", and does not take "nein" for anchored."""
    text = ROOM.replace("depth_m = 0.3", 'depth_m = "30 cm"\nanchored = "nein"')
    text = text.replace("facing_deg = 180", 'facing_deg = "180"').replace('name = "door"', "")
    read = rooms.understand("room.toml", text.encode())
    assert read.faults == []
    shelf = read.room["thing"][0]
    assert (shelf["depth_m"], shelf["facing_deg"], shelf["anchored"]) == (0.3, 180.0, "no")
    assert read.room["door"][0]["name"] == read_room_of(text).doors[0].name == "door 1"


def test_a_film_is_no_larger_than_a_page_takes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fewer pictures a second of many things; what has come to rest has no more of them."""
    whole = rooms.shake(ShakeRoom(text=ROOM, shaking=PULSE))
    monkeypatch.setattr(rooms, "MOST_POSES", 40)
    some = rooms.shake(ShakeRoom(text=ROOM, shaking=PULSE))
    assert some.pictures <= 41
    assert some.pictures / some.rate_hz == pytest.approx(whole.pictures / whole.rate_hz, rel=0.1)


def test_judging_obeys_its_limits(tmp_path: Path) -> None:
    """Each run that is judged asks whether somebody still waits."""
    (tmp_path / "left").touch()
    with pytest.raises(LeftError):
        answer(
            rooms.assess_room, (AssessRoom(text=ROOM), str(tmp_path)), {}, 60.0, tmp_path / "left"
        )


@pytest.mark.parametrize("language", LANGUAGES)
def test_faults_name_what_they_are_about(language: str) -> None:
    wrong = ROOM.replace("height_m = 0.4", 'height_m = "high"').replace('"sliding"', '"open"')
    read = rooms.understand("room.toml", wrong.encode(), language)  # type: ignore[arg-type]
    assert {(each.section, each.number) for each in read.faults} == {("door", 0), ("thing", 1)}
    inside = ROOM.replace("[0.9, 2.82]\nfacing", "[1.2, 1.2]\nfacing")
    read = rooms.understand("room.toml", inside.encode(), language)  # type: ignore[arg-type]
    (fault,) = read.faults
    assert (fault.name, fault.at_m) == ("shelf", (1.2, 1.2))
    assert "desk" in fault.text


def test_no_room_is_too_large_for_the_page() -> None:
    many = ROOM + "".join(
        f'[[place]]\nname = "p{k}"\nkind = "turning"\nat_m = [1, 1]\nsize_m = [1, 1]\n'
        for k in range(MOST_THINGS)
    )
    with pytest.raises(InputError, match=f"at most {MOST_THINGS}"):
        rooms.understand("room.toml", many.encode())
    with pytest.raises(InputError, match="at most 40 m"):
        rooms.understand("room.toml", ROOM.replace("[3, 0], [3, 3]", "[300, 0], [3, 3]").encode())
    with pytest.raises(InputError, match="not a TOML file"):
        rooms.understand("room.toml", b"outline = [")


def test_a_film_is_of_the_plan() -> None:
    """A pulse along +x and a shelf that faces -y: it stands over its foot, turned with the plan."""
    film = rooms.shake(ShakeRoom(text=ROOM, shaking=PULSE))
    (shelf,) = film.things
    assert film.left_out == ["vase"]
    assert shelf.base_m == pytest.approx((-0.15, 0.15, -0.45, 0.45))
    assert (shelf.below_m, shelf.height_m, shelf.round) == (0.9, 1.8, False)
    # it stands still until the pulse begins, and rounds to a tenth of a millimetre
    np.testing.assert_allclose(shelf.position_m[0], [0.9, 2.82, 0.9], atol=1e-4)
    room = read_room_of(ROOM)
    turn = Rotation.from_quat(shelf.quaternion[0]).as_rotvec()
    expected = math.remainder(own_angle(room.things[0], room), 2 * math.pi)
    np.testing.assert_allclose(turn, [0.0, 0.0, expected], atol=2e-4)
    assert film.pictures > 20
    assert len(film.ground_m) == film.pictures
    # the pulse pushes along x: the ground's y stays
    assert np.abs(np.array(film.ground_m)[:, 1]).max() < 1e-6
    assert np.abs(np.array(film.ground_m)[:, 0]).max() > 0.01


def test_a_shelf_at_a_wall_falls_into_the_room() -> None:
    """It faces +x and is shaken along x: it falls the way it faces, as a wall is behind it."""
    text = ROOM.replace("[0.9, 2.82]\nfacing_deg = 180", "[0.17, 1.6]\nfacing_deg = 90")
    text = text.replace("[1.2, 1.2]", "[2.2, 2.2]")
    film = rooms.shake(ShakeRoom(text=text, shaking=PULSE, scale=1.5))
    (shelf,) = film.things
    assert shelf.outcome == "falls"
    axis = Rotation.from_quat(shelf.quaternion[-1]).apply([0.0, 0.0, 1.0])
    assert axis[0] > 0.9
    other = rooms.shake(ShakeRoom(text=text, shaking=PULSE, scale=1.5, reverse=True))
    last = Rotation.from_quat(other.things[0].quaternion[-1]).apply([0.0, 0.0, 1.0])
    assert last[0] > -0.2  # behind it is the wall: it cannot lie there


def read_room_of(text: str):  # type: ignore[no-untyped-def]
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "room.toml"
        path.write_text(text, encoding="utf-8")
        return read_room(path)


def test_its_shares_are_those_of_the_package(tmp_path: Path, few: list[Motion]) -> None:
    answer(rooms.assess_room, (AssessRoom(text=ROOM, changes=True), str(tmp_path)), {}, 60.0, None)
    told = {
        each: RoomAssessed.model_validate_json((tmp_path / f"result.{each}.json").read_bytes())
        for each in LANGUAGES
    }
    room = read_room_of(ROOM)
    found = assessed(room, few, turns=1, progress=False)
    english = told["en"]
    assert (english.runs, english.recordings) == (24, 12) == (found.runs, found.recordings)
    assert english.things[0].share == found.things[0].falls.value > 0.0
    assert english.places[0].high == found.places[0].hit.high
    assert sum(share for _, share in english.covered) == pytest.approx(
        found.covered.sum(), abs=1e-4 * len(english.covered)
    )
    design = design_room(room, few, turns=1, progress=False)
    assert [each.saves for each in english.changes] == [each.saves for each in design.singles]
    assert english.changes[0].things == ["shelf"]
    # what is not simulated is told among the first lines, in each language
    for language, words in (("en", "stands on shelf"), ("es", "sobre shelf"), ("de", "auf shelf")):
        assert any("vase" in line and words in line for line in told[language].summary)
    assert len({each.summary[0] for each in told.values()}) == 3
    assert json.loads((tmp_path / "result.de.json").read_text("utf-8"))["changes"]


def test_a_room_without_places_has_nothing_to_change(tmp_path: Path) -> None:
    bare = ROOM[: ROOM.index("[[place]]")] + ROOM[ROOM.index("[[thing]]") :]
    with pytest.raises(InputError, match="no places"):
        rooms.assess_room(AssessRoom(text=bare, changes=True), str(tmp_path))


def test_a_film_has_the_sides_of_each_thing_where_they_are() -> None:
    """From its front to its back, then from left to right, seen from the centre of gravity."""
    text = ROOM.replace("depth_m = 0.3\n", "depth_m = 0.3\neccentricity = 0.3\n")
    film = rooms.shake(ShakeRoom(text=text, shaking=PULSE))
    (shelf,) = film.things
    assert shelf.base_m == pytest.approx((-0.09, 0.21, -0.45, 0.45))


def test_a_reversed_motion_is_shaken_the_other_way() -> None:
    """The ground moves by the negative."""
    asked = {"text": ROOM, "shaking": PULSE}
    ahead, back = (
        rooms.shake(ShakeRoom(**asked, reverse=reverse))  # type: ignore[arg-type]
        for reverse in (False, True)
    )
    count = min(len(ahead.ground_m), len(back.ground_m))
    one, other = (np.array(each.ground_m[:count]) for each in (ahead, back))
    assert np.abs(one).max() > 0.01
    np.testing.assert_allclose(one, -other, atol=2e-4)  # rounded to 0.1 mm
