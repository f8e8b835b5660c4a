"""Rooms with several frictions: of each thing, place and way the worst leads, and is named."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import General, Motion, Outcome
from shaketable.assess.shares import is_worse
from shaketable.records import suite
from shaketable.report.room import tables_of
from shaketable.report.words.room import frictions, not_considered, often, tried_with
from shaketable.rooms import RoomAssessment, assess_room, design_room, shake_once
from tests.rooms.test_assessment import ROOM

SLIPPERY = General(static_friction=0.1)  # less than the slimness of what stands there: it slides
ROUGH = 0.7


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    known = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None]
    return [m.scaled(1.5) for m in sorted(known, key=lambda m: m.duration)[:8]]


@pytest.fixture(scope="module")
def slippery(pairs: list[Motion]) -> RoomAssessment:
    return assess_room(ROOM, pairs, model=SLIPPERY, frictions=(0.1, ROUGH), progress=False)


def test_the_worst_of_several_frictions_leads(
    slippery: RoomAssessment, pairs: list[Motion]
) -> None:
    """What slides on 0.1 falls on 0.7, in one way of each motion, as it is shaken by itself."""
    own = assess_room(ROOM, pairs, model=SLIPPERY, frictions=(), progress=False)
    both = assess_room(
        ROOM, pairs, model=General(static_friction=ROUGH), frictions=(), progress=False
    )
    assert slippery.tried == (ROUGH,)  # its own is not another
    led = 0
    for mine, one, all_ways in zip(slippery.results, own.results, both.results, strict=True):
        assert mine.often.value >= one.often.value
        if mine.friction == ROUGH:
            led += 1
            assert is_worse(mine.often, one.often)
            # half of the runs: each motion as recorded or reversed, never twice
            assert abs(mine.often.value - all_ways.often.value) <= 0.5
        else:
            assert mine == one
    assert led >= 2
    once = [run for k, motion in enumerate(pairs) for run in [_fell(motion, k % 2 == 1)]]
    for k, thing in enumerate(slippery.things):
        assert thing.friction == ROUGH
        assert thing.falls.value == np.mean([fell[k] for fell in once])
    assert (slippery.covered >= own.covered).all()
    assert slippery.covered.max() > own.covered.max()


def _fell(motion: Motion, reverse: bool) -> list[bool]:
    """Which things fall, by one shaking of the room; half of the motions are reversed."""
    shaken = shake_once(
        ROOM, motion.reversed() if reverse else motion, model=SLIPPERY, friction=ROUGH
    )
    return [each.response.outcome is not Outcome.STANDING for each in shaken.things]


def test_the_worst_shaking_has_its_friction(slippery: RoomAssessment, pairs: list[Motion]) -> None:
    worst = slippery.worst
    assert (worst.friction, worst.falls) == (ROUGH, 2)
    motion = next(each for each in pairs if each.name == worst.motion)
    motion = motion.reversed() if worst.reversed else motion
    once = shake_once(ROOM, motion, along=worst.along, model=SLIPPERY, friction=worst.friction)
    fell = [each.response.outcome is not Outcome.STANDING for each in once.things]
    assert sum(fell) == worst.falls


def test_a_friction_that_leads_is_named_wherever_its_share_stands(slippery: RoomAssessment) -> None:
    thing = slippery.things[0]
    assert often(thing, slippery).endswith(", with friction 0.7")
    assert often(thing, replace(slippery, friction=ROUGH)).endswith(")")  # the room's own
    assert "that is told, and the friction named" in frictions([slippery])
    tables = tables_of(slippery)
    for name in ("things", "places", "ways"):
        assert ROUGH in set(tables[name]["friction"])


def test_without_a_worse_one_that_is_told(pairs: list[Motion]) -> None:
    usual = assess_room(ROOM, pairs[:1], frictions=(), progress=False)
    assert usual.friction == math.inf
    assert frictions([usual]) == "Nothing on feet can slide here."
    assert not_considered(usual)[0].startswith("Other frictions")
    # so little that nothing rocks: it cannot be worse
    tried = assess_room(ROOM, pairs[:2], frictions=(0.05,), progress=False)
    assert {each.friction for each in tried.results} == {math.inf}
    assert frictions([tried]).endswith("With none of them does more happen.")
    assert "others than those named" in not_considered(tried)[0]


def test_changes_are_tried_with_the_friction_of_most_harm(pairs: list[Motion]) -> None:
    few = pairs[:3]
    rough = design_room(
        ROOM, few, model=General(static_friction=ROUGH), frictions=(), progress=False
    )
    found = design_room(ROOM, few, model=SLIPPERY, frictions=(ROUGH,), progress=False)
    alone = design_room(ROOM, few, model=SLIPPERY, frictions=(), progress=False)
    assert alone.now.people < found.now.people == rough.now.people
    assert (alone.friction, found.friction) == (0.1, ROUGH)
    assert found.runs == rough.runs  # in all ways
    assert [each.saves for each in found.singles] == [each.saves for each in rough.singles]
    assert "friction 0.7" in tried_with(found)
