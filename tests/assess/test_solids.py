"""Objects in three dimensions."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, Rocking, simulate
from shaketable.assess import Assessment, CastorFriction, assess
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.shares import share_of
from shaketable.assess.solid_runs import run_solids
from shaketable.assess.solids import ShakingInSpace, sides_of
from shaketable.assess.stood import Stood, halves, in_turn, one_of_each
from shaketable.building import Building
from shaketable.campaign.as_json import from_json, to_json
from shaketable.inventory import BaseShape, Castors, Item, solid_of
from shaketable.origin import Origin
from shaketable.records import suite
from shaketable.simulate import ShakingSet, kinds
from shaketable.tilting import TURNS


def item(depth: float, width: float, height: float, name: str = "box", **given: object) -> Item:
    body = Body.rectangle(depth, height, name=name)
    return Item(
        body=body, sideways=Body.rectangle(width, height, name=name), height=height,
        **given,  # type: ignore[arg-type]
    )  # fmt: skip


@pytest.fixture(scope="module")
def motions(p695: list[Motion]) -> list[Motion]:
    return p695[:24]


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    return [m for m in suite("fema-p695", pairs=True)[:12] if m.transverse is not None]


ITEMS = [
    item(0.2, 0.2, 1.0, "square"),
    item(0.2, 0.2, 1.0, "round", shape=BaseShape.CYLINDER),
    item(0.2, 0.6, 1.0, "oblong"),
    item(0.4, 0.4, 1.0, "cart", castors=Castors.FREE),
    Item(body=Body.rectangle(0.2, 1.0, name="no width"), height=1.0),
    replace(
        item(0.2, 0.6, 1.0, "ahead"),
        body=Body.rectangle(0.2, 1.0, eccentricity=0.3, name="ahead"),
    ),
]


@pytest.fixture(scope="module")
def result(pairs: list[Motion]) -> Assessment:
    return assess(ITEMS, pairs, leading=0, progress=False)


def test_round_bases_fall_most(result: Assessment) -> None:
    """As Boroschek & Iruretagoyena's bodies do in the study of solids: 1.4 times as often."""
    square, round_one = (each.solid for each in result.results[:2])
    assert square is not None
    assert round_one is not None
    assert round_one.fall.value > 1.15 * square.fall.value > 0.0
    assert result.results[1].risk == "very high"


def test_turns_that_differ(result: Assessment, pairs: list[Motion]) -> None:
    """A circle looks the same from all sides: it needs one turn, everything else TURNS."""
    counts = [len(each.solid.turned) if each.solid else 0 for each in result.results]
    assert counts == [TURNS, 1, TURNS, TURNS, 0, TURNS]
    for each in result.solids:
        assert each.solid is not None
        ways = 1 if each.item.shape is BaseShape.CYLINDER else 2 * TURNS
        assert each.solid.simulations == ways * len(pairs)
        assert np.mean([share.value for share in each.solid.turned]) == pytest.approx(
            each.solid.fall.value
        )


def test_half_a_turn_is_the_reversed_motion(pairs: list[Motion]) -> None:
    """So TURNS angles over half a turn, in both polarities, are spread over a full one."""
    box = Stood(ITEMS[5], solid_of(ITEMS[5], 0.0), 0.0)  # type: ignore[arg-type]
    assert np.diff(box.turns(pairs)[0]) == pytest.approx([math.pi / TURNS] * (TURNS - 1))
    motion = pairs[0].scaled(1.5)
    ahead = simulate(box.solid, motion, orientation=math.pi)
    turned = simulate(box.solid, motion.reversed())
    assert ahead.peak_rotation == pytest.approx(turned.peak_rotation, rel=1e-6)


def test_ways_in_turn_are_all_ways(pairs: list[Motion]) -> None:
    """Each has all motions and polarities in one turn, which is another one for the next."""
    ways = Stood(ITEMS[2], solid_of(ITEMS[2], 0.0), 0.0).ways(pairs)  # type: ignore[arg-type]
    parts = in_turn(ways)
    assert len(parts) == ways.shape[2] == TURNS
    assert all(each.shape == (*ways.shape[:2], 1) for each in parts)
    np.testing.assert_array_equal(np.sort(np.concatenate(parts, axis=2)), np.sort(ways))
    assert len(np.unique(parts[0][:TURNS])) == TURNS


def test_two_halves_are_all_ways(pairs: list[Motion]) -> None:
    """Every motion, polarity and turn once, and each half has turns from all around."""
    box = Stood(ITEMS[2], solid_of(ITEMS[2], 0.0), 0.0)  # type: ignore[arg-type]
    ways = box.ways(pairs)
    assert ways.shape == (len(pairs), 2, TURNS)
    first, rest = halves(ways)
    np.testing.assert_array_equal(np.sort(np.concatenate([first, rest], axis=2)), ways)
    around = np.sort(np.concatenate([first[0, 0], first[0, 1] + math.pi]))
    assert np.diff(around) == pytest.approx([math.pi / 2] * 3)
    drum = Stood(ITEMS[1], solid_of(ITEMS[1], 0.0), 0.0)  # type: ignore[arg-type]
    (whole,) = halves(drum.ways(pairs))  # it has one turn alone
    np.testing.assert_array_equal(whole, drum.ways(pairs))


def test_one_way_of_each_motion(pairs: list[Motion]) -> None:
    """Each motion once, in another turn for the next; half of them as if they were reversed."""
    box = Stood(ITEMS[2], solid_of(ITEMS[2], 0.0))  # type: ignore[arg-type]
    ways = box.ways(pairs)
    one = one_of_each(ways)
    assert one.shape == (len(pairs), 1, 1)
    assert one[:TURNS, 0, 0].tolist() == ways[0, 0].tolist()
    assert one[TURNS : 2 * TURNS, 0, 0] == pytest.approx(ways[0, 1] + math.pi)
    drum = Stood(ITEMS[1], solid_of(ITEMS[1], 0.0))  # type: ignore[arg-type]
    np.testing.assert_array_equal(one_of_each(drum.ways(pairs)), drum.ways(pairs))


def test_half_a_turn_does_what_the_other_polarity_does(pairs: list[Motion]) -> None:
    """Whatever surrounds an object, which turns with it: here its support's tilt."""
    trial = ShakingSet(pairs, 0.7, General(static_friction=0.4))
    box = Stood(ITEMS[5], solid_of(ITEMS[5], 0.0), 0.03, 0.01)  # type: ignore[arg-type]
    ways = box.ways(pairs)
    (both,) = run_solids([box], [ways], trial, lambda _: None)
    (turned,) = run_solids([box], [ways[:, 1:] + math.pi], trial, lambda _: None)
    assert both.fell[1::2].tolist() == turned.fell.tolist()
    assert 0.1 < turned.fell.mean() < 0.9
    # to round-off, which grows as they rock
    np.testing.assert_allclose(both.toward[1::2], turned.toward, atol=0.01)


def test_what_is_alike_is_simulated_once(pairs: list[Motion], monkeypatch: Any) -> None:
    """Two desks of other names; not one that is wider, or stands tilted, turned or on ice."""
    trial, simulated, done = ShakingSet(pairs[:2], 1.3, General(static_friction=0.4)), [], []
    run = kinds.run

    def counted(tasks: Any, count: int, *rest: Any) -> Any:
        simulated.append(count)
        return run(tasks, count, *rest)

    monkeypatch.setattr(kinds, "run", counted)
    one, other = item(0.2, 0.6, 1.0, "a", location="here"), item(0.2, 0.6, 1.0, "b", floor="3")
    wide = item(0.2, 0.65, 1.0, "a", location="here")
    solid, wider = solid_of(one, 0.0), solid_of(wide, 0.0)
    assert solid is not None
    assert wider is not None
    stood = [
        Stood(one, solid), Stood(other, replace(solid, name="b")), Stood(wide, wider),
        Stood(one, solid, tilt=0.02), Stood(one, solid), Stood(one, solid, friction=0.3),
    ]  # fmt: skip
    ways = [each.ways(pairs[:2])[:, :1, :2] for each in stood]
    ways[4] = ways[4] + 0.1
    runs = run_solids(stood, ways, trial, done.append)
    assert simulated == [5 * 4]
    assert sum(done) == 6 * 4
    assert runs[0].along.tolist() == runs[1].along.tolist()
    for k in range(2, 6):
        assert runs[k].along.tolist() != runs[0].along.tolist()


@pytest.mark.parametrize(
    ("box", "scale", "present", "all_run", "fewer"),
    [
        (ITEMS[0], 1.0, 0.05, True, False),
        (ITEMS[0], 1.0, 1.0, False, False),
        (item(0.4, 0.4, 1.0), 3.0, 1.0, False, True),
    ],
)
def test_other_frictions_take_all_turns_where_more_fall(
    pairs: list[Motion], box: Item, scale: float, present: float, all_run: bool, fewer: bool
) -> None:
    """On ice hardly anything falls, so that each friction is worth all turns; on rubber none is.

    With a friction of 0.3 a stout box slides where it falls on rubber.
    """
    trial = ShakingSet(pairs, scale, General(static_friction=present))
    space = ShakingInSpace(trial, 0.0, CastorFriction())
    done: list[int] = []
    (found,) = space.results([box], [], done.append)
    assert found is not None
    count = 2 * TURNS * len(pairs)
    # as many as are announced, those included that were not needed
    assert sum(done) == count + len(FRICTIONS) * (len(pairs) + count)
    stood = Stood(box, solid_of(box, 0.0), 0.0)  # type: ignore[arg-type]
    ways = stood.ways(pairs)
    for told in found.result.frictions:
        rough = trial.changed(model=General(static_friction=told.friction))
        (runs,) = run_solids(
            [stood], [ways if all_run else one_of_each(ways)], rough, lambda _: None
        )
        assert told.fall == share_of(runs.fell, space.recordings)
    slippery = found.result.frictions[0].fall
    assert (slippery.high < found.result.level.fall.value) == fewer


def test_sides_of_falls(result: Assessment) -> None:
    oblong, ahead = result.results[2].solid, result.results[5].solid
    assert oblong is not None
    assert ahead is not None
    # over its long side, and as often forward as backward, as motions count reversed as well
    assert oblong.sides.forward == pytest.approx(oblong.sides.backward)
    assert oblong.sides.forward + oblong.sides.backward > 0.9
    # its centre of gravity is nearer to its front
    assert ahead.sides.forward > 0.7
    # its x goes from front to back: for somebody before its front, y is on the left
    quarter = math.pi / 2
    assert sides_of(np.array([2 * quarter, 2 * quarter, 0.1, quarter])) == (0.5, 0.25, 0.25, 0.0)
    assert sides_of(np.array([3 * quarter])).right == 1.0


def test_in_its_plane_it_does_what_the_planar_body_does(p695: list[Motion]) -> None:
    """Where its front looks against the motion and there is no other component."""
    here = [
        replace(motion, transverse=np.zeros_like(motion.horizontal))
        for motion in p695[:10]
        if motion.origin is not None
    ]
    assert len(here) == 10
    azimuths = [motion.origin.azimuth for motion in here]  # type: ignore[union-attr]
    for motion, azimuth in zip(here, azimuths, strict=True):
        assert azimuth is not None
        box = replace(ITEMS[5], facing=math.radians(azimuth) - math.pi)
        (found,) = assess([box], [motion], leading=0, progress=False).results
        front = found if found.profile.direction == "front to back" else found.other
        assert front is not None
        assert found.solid is not None
        assert found.solid.falls == front.falls
        assert len(found.solid.turned) == 1


def test_facing_is_a_compass_azimuth() -> None:
    """A component toward the east shakes front to back what looks to the east or west."""
    t = np.arange(200) * 0.01
    pulse = np.where(t < 0.5, 6.0 * np.sin(2 * math.pi * t / 0.5), 0.0)
    east = Motion(pulse, 0.01, transverse=np.zeros(200), origin=Origin(azimuth=90.0))
    shelf = item(0.2, 0.8, 1.2)
    falls = {}
    for facing in (0.0, 90.0, 270.0):
        looks = replace(shelf, facing=math.radians(facing))
        (found,) = assess([looks], [east], leading=0, progress=False).results
        assert found.solid is not None
        falls[facing] = found.solid.falls
    assert falls == {0.0: 0, 90.0: 2, 270.0: 2}


def test_castors_roll(result: Assessment) -> None:
    cart = result.results[3].solid
    assert cart is not None
    assert cart.frictions == ()  # theirs is the rolling resistance alone
    assert cart.moved.median > 0.02


def test_what_falls_in_all_is_told_of_three_dimensions(result: Assessment) -> None:
    falls = sum((each.solid or each).fall.value for each in result.results)
    assert result.floors[0].expected_falls == pytest.approx(falls)
    for each in result.solids:
        assert each.governing_share.value >= each.overturns.value


def test_the_table_tells_it(result: Assessment) -> None:
    table = result.table.set_index("name")
    assert table["shape"].to_list()[:4] == ["box", "cylinder", "box", "castors"]
    assert table.loc["no width", "dimensions"] == 2
    oblong = table.loc["oblong"]
    assert oblong["dimensions"] == 3
    assert oblong["fall_share_least_turn"] <= oblong["fall_share"]
    assert oblong["fall_share"] <= oblong["fall_share_most_turn"]


def test_results_can_be_kept(result: Assessment) -> None:
    kept = from_json(json.loads(json.dumps(to_json(result.results[2]))))
    assert kept.solid == result.results[2].solid
    assert kept.item == result.results[2].item


def test_levels_are_told_of_solids(pairs: list[Motion]) -> None:
    from shaketable.assess import Level

    levels = [Level(name="half", scale=0.5), Level(name="as recorded", scale=1.0)]
    found = assess(ITEMS[1:2], pairs, levels=levels, progress=False).results[0]
    assert found.solid is not None
    assert found.levels[1].fall == found.solid.fall
    assert found.levels[0].fall.value < found.levels[1].fall.value


def test_errors(motions: list[Motion], pairs: list[Motion]) -> None:
    with pytest.raises(InputError, match="restitution="):
        assess(ITEMS[:1], pairs, model=Rocking(restitution=0.9))
    # alone, a component is no pair, and nothing is simulated in three dimensions
    quick = assess(ITEMS[:1], motions, model=General(), progress=False)
    assert quick.solids == []
    flat = assess(ITEMS[:1], pairs, planar=True, progress=False)
    assert flat.solids == []


def test_a_factor_on_impacts_holds_for_solids_too(pairs: list[Motion]) -> None:
    """With less left after impacts fewer fall, in three dimensions as in a plane."""
    found = [
        assess(
            ITEMS[:1], pairs, model=Rocking(restitution_factor=factor), leading=0,
            progress=False,
        ).results[0]
        for factor in (1.0, 0.7)
    ]  # fmt: skip
    assert found[0].solid is not None
    assert found[1].solid is not None
    assert found[1].solid.falls < found[0].solid.falls


def test_a_circle_on_a_level_floor_is_shaken_once(pairs: list[Motion]) -> None:
    """Turned or reversed, a motion does the same to it: both would be one run counted again."""
    found = assess(ITEMS[:2], pairs, progress=False).results
    box, drum = (next(each for each in found if each.item == item) for item in ITEMS[:2])
    assert drum.item.shape is BaseShape.CYLINDER
    assert drum.solid is not None
    assert box.solid is not None
    assert drum.solid.simulations == len(pairs)
    assert box.solid.simulations == 2 * TURNS * len(pairs)


def test_every_floor_has_its_own_three_dimensions(pairs: list[Motion]) -> None:
    """On each floor an object does what it does under the same pairs of components anywhere."""
    loud = [motion.scaled(1.6) for motion in pairs]
    house = Building(name="house", floors={"0": pairs, "1": loud}, told="as computed")
    items = [replace(ITEMS[k], floor=label) for k in (1, 2) for label in house.floors]
    found = assess(items, house, leading=0, progress=False)
    for floor, motions in zip(found.floors, (pairs, loud), strict=True):
        alone = assess([ITEMS[k] for k in (1, 2)], motions, leading=0, progress=False)
        assert [each.solid for each in floor.results] == [each.solid for each in alone.results]
    # a vase is at least as dangerous upstairs
    below, above = (floor.results[0].overturns.value for floor in found.floors)
    assert above >= below > 0.0


def test_motions_with_one_component_are_left_out(
    pairs: list[Motion], motions: list[Motion], caplog: pytest.LogCaptureFixture
) -> None:
    """Solids and what is planar are shaken by the same recordings, or all by planes."""
    found = assess([*ITEMS[:1], ITEMS[4]], [*pairs, motions[0]], leading=0, progress=False)
    assert "1 motions are left out" in caplog.text
    flat = found.results[1]
    assert flat.recordings == found.results[0].by == len(pairs)
    assert flat.simulations == 2 * 2 * len(pairs)
    caplog.clear()
    few = assess(ITEMS[:1], [*pairs[:3], *motions[:20]], leading=0, progress=False)
    assert "both horizontal components are known of 3 of" in caplog.text
    assert few.solids == []


@pytest.mark.parametrize(
    ("recorded", "facing", "turn"),
    [
        # east is 90° from the south, where the back of what looks north is: 90° - 180° + 360°
        (90.0, 0.0, 270.0),
        # from 30° to the back at 280° it is 250° clockwise, 110° counterclockwise
        (30.0, 100.0, 110.0),
        (180.0, 0.0, 0.0),
    ],
)
def test_the_compass_turns_clockwise(recorded: float, facing: float, turn: float) -> None:
    """Angles of solids go counterclockwise, from the motion to the way from front to back."""
    motion = Motion(np.zeros(3), 0.01, origin=Origin(azimuth=recorded))
    looking = replace(ITEMS[2], facing=math.radians(facing))
    solid = solid_of(looking, 0.02)
    assert solid is not None
    (found,) = np.degrees(Stood(looking, solid, 0.0).turns([motion]))
    assert found.tolist() == pytest.approx([turn])
