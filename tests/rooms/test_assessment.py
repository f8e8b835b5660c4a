"""Rooms that are shaken: shares, maps, joint events."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from shapely import Polygon

from shaketable import General, InputError, Motion, Outcome, simulate_many
from shaketable.inventory import solid_of
from shaketable.records import suite
from shaketable.report.words.room import why_not
from shaketable.resampling import wilson_interval
from shaketable.rooms import Place, PlaceKind, RoomAssessment, assess_room
from shaketable.rooms.grid import Grid
from shaketable.rooms.grounds import Ground, ground_of
from shaketable.rooms.judged import Judge
from shaketable.rooms.shaken import Fate, at_walls, directions
from shaketable.rooms.shapes import fallen, footprint, own_angle
from tests.rooms.test_plan import cabinet, room

MODEL = General(static_friction=0.5)


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    """Short and strong ones, of which the azimuths are known."""
    known = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None]
    return [m.scaled(1.5) for m in sorted(known, key=lambda m: m.duration)[:6]]


def slim(name: str, at: tuple[float, float], facing_deg: float):  # type: ignore[no-untyped-def]
    """A cabinet that falls more easily."""
    thing = cabinet(at, facing_deg, name)
    front = thing.item.body.rectangle(0.3, 1.8, name=name)
    return replace(thing, item=replace(thing.item, body=front, height=1.8))


ROOM = room(
    slim("left", (0.45, 0.8), 60.0),  # its back to the wall at x = 0, as north is turned
    slim("right", (3.4, 2.0), 250.0),
    north=math.radians(30.0),
    places=(Place(name="desk", kind=PlaceKind.DESK, at=(1.5, 2.5), size=(1.2, 0.7), people=0.5),),
)


@pytest.fixture(scope="module")
def shaken(pairs: list[Motion]) -> RoomAssessment:
    return assess_room(ROOM, pairs, model=MODEL, progress=False)


def test_shares_are_those_of_the_same_solids(pairs: list[Motion]) -> None:
    """Turned to each motion as the room stands to north, beside the walls of the room."""
    shaken = assess_room(ROOM, pairs, model=MODEL, frictions=(), progress=False)
    assert (shaken.runs, shaken.recordings) == (12, 6)
    for thing, found in zip(ROOM.things, shaken.things, strict=True):
        item = at_walls(ROOM, thing)
        solid = solid_of(item, 0.0)
        assert solid is not None
        fell = []
        for motion in pairs:
            assert motion.origin is not None
            assert motion.origin.azimuth is not None
            assert thing.item.facing is not None
            turn = math.radians(motion.origin.azimuth) - thing.item.facing - math.pi
            turn = float(np.remainder(turn, 2 * math.pi))
            around = item.surroundings and item.surroundings.turned(turn)
            runs = simulate_many(
                [solid], [motion], orientations=[turn], model=MODEL, surroundings=around,
                progress=False,
            )  # fmt: skip
            fell += (runs.outcome.values.ravel() != Outcome.STANDING).tolist()
        assert found.falls.value == np.mean(fell)
    assert shaken.things[1].falls.value > 0.0  # it tells something


def test_what_stands_before_a_wall_falls_forward(pairs: list[Motion]) -> None:
    """Its back is 1 cm from a wall, so that it cannot fall over that side."""
    back = slim("shelf", (0.16, 1.5), 90.0)
    found = assess_room(
        replace(ROOM, things=(back,), north=0.0), pairs, model=MODEL, progress=False
    )
    (thing,) = found.things
    assert thing.falls.value > 0.0
    assert sum(thing.sides) == pytest.approx(1.0)
    assert (thing.sides.forward, thing.sides.backward) == (1.0, 0.0)


def test_directions_of_all_motions_lie_between_each_other(pairs: list[Motion]) -> None:
    """Without north, over half a turn: of six motions no gap is wider than a third of a step."""
    for turns in (1, 4):
        along = directions(pairs, replace(ROOM, north=None), turns)
        assert along.shape == (6, turns)
        step = math.pi / turns
        np.testing.assert_allclose(np.diff(along, axis=1), step)
        offsets = np.sort(np.remainder(along[:, 0], step))
        gaps = np.diff(np.append(offsets, offsets[0] + step))
        assert gaps.max() < 0.34 * step


def test_the_map_sums_to_the_expected_area(shaken: RoomAssessment) -> None:
    """One thing alone: nothing lies on another, and the sums are of the same cells."""
    alone = assess_room(
        replace(ROOM, things=ROOM.things[1:]),
        [m.scaled(1.5) for m in suite("fema-p695", pairs=True)[:4] if m.transverse is not None],
        model=MODEL, frictions=(), progress=False,
    )  # fmt: skip
    assert alone.covered.sum() * alone.grid.area == pytest.approx(alone.things[0].covers, rel=1e-12)
    assert alone.things[0].covers > 0.0
    assert shaken.covered.max() <= 1.0


def test_the_same_room_twice_gives_the_same(shaken: RoomAssessment, pairs: list[Motion]) -> None:
    again = assess_room(ROOM, pairs, model=MODEL, progress=False)
    assert again.things == shaken.things
    assert again.places == shaken.places
    assert again.ways == shaken.ways
    assert (again.covered == shaken.covered).all()


def test_a_room_turned_with_its_north_is_the_same_room(
    shaken: RoomAssessment, pairs: list[Motion]
) -> None:
    """A quarter of a turn of the plan, counterclockwise: north turns with it, azimuths stay."""
    turn = replace(
        ROOM,
        outline=tuple((-y, x) for x, y in ROOM.outline),
        things=tuple(replace(each, at=(-each.at[1], each.at[0])) for each in ROOM.things),
        doors=tuple(replace(each, at=(-each.at[1], each.at[0])) for each in ROOM.doors),
        places=tuple(
            replace(each, at=(-each.at[1], each.at[0]), size=each.size[::-1])
            for each in ROOM.places
        ),
        north=math.radians(30.0 - 90.0),
    )
    found = assess_room(turn, pairs, model=MODEL, progress=False)
    assert [each.falls for each in found.things] == [each.falls for each in shaken.things]
    assert [each.closed for each in found.ways] == [each.closed for each in shaken.ways]
    # cells lie otherwise, and a cell's middle may be on the other side of a line
    assert found.covered.sum() == pytest.approx(shaken.covered.sum(), rel=0.02)


def test_without_north_a_room_is_turned_in_several_ways(pairs: list[Motion]) -> None:
    found = assess_room(replace(ROOM, north=None), pairs[:2], model=MODEL, progress=False)
    assert found.runs == 2 * 2 * 4


def test_two_things_that_fall_apart_from_each_other() -> None:
    """A way that either closes is closed in 1 - (1 - p)(1 - q), where all pairs of falls occur."""
    things = (cabinet((0.3, 0.55), 90.0, "left"), cabinet((3.7, 0.55), 270.0, "right"))
    bed = Place(name="bed", kind=PlaceKind.BED, at=(2.0, 2.4), size=(2.0, 1.0), people=0.8)
    where = room(*things, places=(bed,))
    grid = Grid.of(where)
    p, q = (1, 4), (2, 5)  # of so many
    falls = np.array(
        list(product(np.arange(p[1]) < p[0], np.arange(q[1]) < q[0]))
    )  # every fall of one with every fall of the other
    grounds = []
    for k, thing in enumerate(things):
        toward = own_angle(thing, where) + math.pi
        shift = 0.2 * np.array([math.cos(toward), math.sin(toward)])
        rest = grid.covered(footprint(thing, where))
        lies = grid.covered(fallen(thing, where, toward, shift))
        after = tuple(lies if fell else rest for fell in falls[:, k])
        grounds.append(Ground(rest, after, falls[:, k]))
    judged = Judge(where, grid).judged(grounds)
    assert judged.closed.mean() == pytest.approx(1 - (1 - p[0] / p[1]) * (1 - q[0] / q[1]))
    # each alone closes it where the other does not
    alone = judged.by[0, 0].mean(axis=1)
    assert alone == pytest.approx([p[0] / p[1] * 3 / 5, 3 / 4 * q[0] / q[1]])


def test_what_is_not_simulated_is_told() -> None:
    left, right = ROOM.things
    shelf = replace(right, on="left", item=replace(right.item, body=right.item.body))
    held = replace(left, item=replace(left.item, anchored=True))
    flat = replace(left, item=replace(left.item, sideways=None))
    for things, told in (((held, shelf), "stands on left"), ((flat,), "is not known")):
        with pytest.raises(InputError, match="nothing in"):
            assess_room(replace(ROOM, things=things), progress=False)
        assert any(told in why_not(thing) for thing in things)


def test_motions_need_both_components(p695: list[Motion]) -> None:
    with pytest.raises(InputError, match="both horizontal components"):
        assess_room(ROOM, p695[:4], progress=False)


def test_intervals_count_recordings_and_no_motions_or_runs(pairs: list[Motion]) -> None:
    """Three recordings, each at two strengths and both polarities: 12 runs of 3 experiments."""
    twice = [each.scaled(factor) for each in pairs[:3] for factor in (1.0, 1.3)]
    found = assess_room(ROOM, twice, model=MODEL, frictions=(), progress=False)
    assert (found.runs, found.recordings) == (12, 3)
    for share in (*(each.falls for each in found.things), *(each.hit for each in found.places)):
        low, high = wilson_interval(share.value, 3)
        assert (share.low, share.high) == pytest.approx((float(low), float(high)))
    assert 0.0 < found.things[1].falls.value < 1.0


@pytest.mark.parametrize("fell", [False, True])
def test_the_ground_turns_the_way_the_thing_does(fell: bool) -> None:
    """Counterclockwise by 0.4 rad, where the mirrored turn covers other cells; by hand."""
    where = room(slim("shelf", (2.0, 1.5), 0.0))
    (thing,), grid = where.things, Grid.of(where)
    one = np.array([True])
    fate = Fate(
        fell=one & fell, held_up=one & False, toward=np.array([0.4 if fell else np.nan]),
        shift=np.array([[0.12, -0.07]]), yaw=np.array([0.4]),
    )  # fmt: skip
    ground = ground_of(where, grid, thing, fate).after[0]
    angle = own_angle(thing, where) + 0.4
    if fell:
        expected = fallen(thing, where, 0.4, (0.12, -0.07), 0.4)
        mirrored = fallen(thing, where, 0.4, (0.12, -0.07), -0.4)
    else:
        half = np.array([(0.15, 0.5), (-0.15, 0.5), (-0.15, -0.5), (0.15, -0.5)])
        cosine, sine = math.cos(angle), math.sin(angle)
        corners = half @ np.array([[cosine, sine], [-sine, cosine]]) + [2.0 + 0.12, 1.5 - 0.07]
        expected = Polygon(corners)
        mirrored = footprint(thing, where, (0.12, -0.07), -0.4)
    assert ground.tolist() == grid.covered(expected).tolist()
    assert ground.tolist() != grid.covered(mirrored).tolist()
