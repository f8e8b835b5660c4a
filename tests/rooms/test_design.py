"""What to change in a room: single changes, and pairs put together from their runs."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from shaketable import InputError, Motion
from shaketable.assess import MitigationKind
from shaketable.records import suite
from shaketable.rooms import Place, PlaceKind, RoomDesign, assess_room, design_room
from shaketable.rooms.changes import STEP, Placed
from shaketable.rooms.faults import faults_of
from tests.rooms.test_assessment import MODEL, slim
from tests.rooms.test_plan import room

DESK = Place(name="desk", kind=PlaceKind.DESK, at=(2.4, 1.9), size=(1.0, 0.7), people=0.5)
ROOM = room(
    slim("left", (0.76, 1.3), 90.0), slim("right", (3.4, 2.0), 270.0), north=0.0, places=(DESK,)
)


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    known = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None]
    return [m.scaled(2.0) for m in sorted(known, key=lambda m: m.duration)[:5]]


@pytest.fixture(scope="module")
def designed(pairs: list[Motion]) -> RoomDesign:
    return design_room(ROOM, pairs, model=MODEL, frictions=(), progress=False)


def changed(designed: RoomDesign, number: int):  # type: ignore[no-untyped-def]
    """The room after the changes of a pair."""
    after = {each.thing: each.after for each in designed.pairs[number].changes}
    return replace(ROOM, things=tuple(after.get(each.name, each) for each in ROOM.things))


def test_as_it_is_it_is_the_assessment(designed: RoomDesign, pairs: list[Motion]) -> None:
    found = assess_room(ROOM, pairs, model=MODEL, frictions=(), progress=False)
    (desk,) = found.places
    (way,) = found.ways
    assert designed.now.hit == desk.hit
    assert designed.now.shut_in == way.closed
    # somebody is hit, or shut in, or both in the same run
    half = desk.place.people
    assert designed.now.people <= half * (desk.hit.value + way.closed.value) + 1e-12
    assert designed.now.people >= half * max(desk.hit.value, way.closed.value) - 1e-12
    assert designed.now.people > 0.0


def test_a_pair_is_what_the_changed_room_does(designed: RoomDesign, pairs: list[Motion]) -> None:
    """Of things that are turned or moved; what holds them is no part of a plan."""
    placed = [
        k
        for k, each in enumerate(designed.pairs)
        if all(isinstance(one.kind, Placed) for one in each.changes)
    ]
    for k in placed[:2]:
        found = assess_room(changed(designed, k), pairs, model=MODEL, frictions=(), progress=False)
        assert found.places[0].hit == designed.pairs[k].left.hit
        assert found.ways[0].closed == designed.pairs[k].left.shut_in
    singles = [each for each in designed.singles if each.changes[0].kind is Placed.TURN]
    (turn,) = singles[0].changes
    things = tuple(turn.after if each.name == turn.thing else each for each in ROOM.things)
    found = assess_room(
        replace(ROOM, things=things), pairs, model=MODEL, frictions=(), progress=False
    )
    assert found.places[0].hit == singles[0].left.hit


def test_they_are_told_by_what_they_save(designed: RoomDesign) -> None:
    saves = [each.saves for each in designed.singles]
    assert saves == sorted(saves, reverse=True)
    assert saves[0] > 0.0
    for each in (*designed.singles, *designed.pairs):
        assert each.saves == pytest.approx(designed.now.people - each.left.people)
    assert designed.pairs[0].saves >= saves[0] - 1e-12
    assert all(len({one.thing for one in each.changes}) == 2 for each in designed.pairs)


def test_every_change_leaves_a_plan_without_faults(designed: RoomDesign) -> None:
    things = {each.name: each for each in ROOM.things}
    kinds = set()
    for tried in designed.singles:
        (change,) = tried.changes
        before = things[change.thing]
        things_then = tuple(change.after if each is before else each for each in ROOM.things)
        assert not faults_of(replace(ROOM, things=things_then))
        kinds.add(change.kind)
        if change.kind is Placed.MOVE:
            assert math.dist(change.after.at, before.at) == pytest.approx(STEP)
        if change.kind is MitigationKind.STRAP:
            assert change.stood.around is not None
            assert len(change.stood.around.straps) == 1
    assert kinds == {
        MitigationKind.STRAP, MitigationKind.PAD, MitigationKind.LOWER, Placed.TURN, Placed.MOVE
    }  # fmt: skip


def test_a_room_where_nobody_is_needs_no_change() -> None:
    with pytest.raises(InputError, match="has no places"):
        design_room(replace(ROOM, places=()), progress=False)
