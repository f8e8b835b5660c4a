"""Rooms with several frictions: of each thing, place and way the worst leads, and is named."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import General, Motion, Outcome
from shaketable.assess import Share
from shaketable.assess.results import Sides
from shaketable.assess.shares import is_worse
from shaketable.inventory import Castors
from shaketable.records import suite
from shaketable.report.room import tables_of
from shaketable.report.words.numbers import in_hundred
from shaketable.report.words.room import (
    frictions,
    not_considered,
    often,
    summary,
    tried_with,
)
from shaketable.rooms import (
    RoomAssessment,
    ThingResult,
    assess_room,
    design_room,
    shake_once,
)
from shaketable.rooms.frictions import _worse_thing
from tests.rooms.test_assessment import ROOM

SLIPPERY = General(static_friction=0.1)  # less than the slimness of what stands there: it slides
ROUGH = 0.7
NONE_FALL = Sides(*(math.nan,) * 4)


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
    for told, alone, rough in (
        *zip(slippery.places, own.places, both.places, strict=True),
        *zip(slippery.ways, own.ways, both.ways, strict=True),
    ):
        assert told.often.value >= alone.often.value
        if told.friction == ROUGH:
            led += 1
            assert is_worse(told.often, alone.often)
            # half of the runs: each motion as recorded or reversed, never twice
            assert abs(told.often.value - rough.often.value) <= 0.5
        else:
            assert told == alone
    assert led
    assert slippery.hits >= own.hits
    assert slippery.frictions == {0.1, ROUGH}
    once = [_fell(motion, k % 2 == 1) for k, motion in enumerate(pairs)]
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
    assert often(thing.falls, thing.friction, slippery).endswith(", with friction 0.7")
    rough = replace(slippery, friction=ROUGH)
    assert often(thing.falls, thing.friction, rough).endswith(")")  # the room's own
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
    assert tried.frictions == {math.inf}
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
    assert tried_with(found).startswith("Changes were tried with friction 0.7. This counts")
    assert tried_with(alone) == "Changes were tried with friction 0.1."


def test_what_is_held_up_more_is_told_beside_what_falls_more() -> None:
    """The friction with which it is held up more, and that with which it falls more."""

    def found(friction: float, falls: Share, held_up: Share) -> ThingResult:
        return ThingResult("shelf", falls, NONE_FALL, held_up, 0.1, friction, friction)

    few, many = Share(0.0, 0.0, 0.1), Share(0.5, 0.3, 0.7)
    own, falling, hanging = (
        found(math.inf, few, Share(0.3, 0.2, 0.4)), found(0.5, many, few), found(0.3, few, many)
    )  # fmt: skip
    told = _worse_thing(own, _worse_thing(own, own, falling), hanging)
    assert (told.falls, told.friction) == (many, 0.5)
    assert (told.held_up, told.friction_held_up) == (many, 0.3)
    alone = _worse_thing(own, own, falling)
    assert (alone.held_up, alone.friction_held_up) == (own.held_up, math.inf)


def test_where_everything_rolls_no_friction_is_tried(pairs: list[Motion]) -> None:
    item = replace(ROOM.things[0].item, castors=Castors.FREE)
    rolling = replace(ROOM, things=(replace(ROOM.things[0], item=item),))
    found = assess_room(rolling, pairs[:1], progress=False)
    assert found.tried == ()
    assert frictions([found]) == "Nothing on feet can slide here."


def test_what_must_not_fall_is_told_by_itself(slippery: RoomAssessment) -> None:
    kept = replace(ROOM.things[1].item, must_not_fall=True)
    things = (ROOM.things[0], replace(ROOM.things[1], item=kept))
    told = summary(replace(slippery, room=replace(ROOM, things=things)))
    said = [line for line in told if "must not fall" in line]
    falls = slippery.things[1].falls
    assert len(said) == 1
    assert said[0].startswith(f"right must not fall: it falls in {in_hundred(falls.value)} of 100")
    assert said[0].endswith(", with friction 0.7.")
    assert not any("must not fall" in line for line in summary(slippery))
