"""What would help, simulated in three dimensions: each measure against the same solid by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import (
    Body,
    Edge,
    General,
    InputError,
    Motion,
    Pad,
    Surroundings,
    Wall,
    simulate_many,
)
from shaketable.assess import (
    ACCEPTED_FALLS,
    LEADING,
    MOST_TRIED,
    Mitigation,
    MitigationKind,
    assess,
)
from shaketable.assess.mitigation import PREMISES, kinds_of, premises_of
from shaketable.assess.stood import Stood, halves, in_turn
from shaketable.building import Building
from shaketable.inventory import BaseShape, Castors, Item, solid_of
from shaketable.outcome import Outcome
from shaketable.records import suite
from shaketable.solid import Solid
from shaketable.units import STANDARD_GRAVITY


def item(depth: float, width: float, height: float, name: str, **given: object) -> Item:
    front, side = (Body.rectangle(b, height, name=name) for b in (depth, width))
    return Item(body=front, sideways=side, height=height, **given)  # type: ignore[arg-type]


SHELF = item(0.3, 0.9, 1.8, "shelf")


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    return [m for m in suite("fema-p695", pairs=True)[:12] if m.transverse is not None]


def tried(pairs: list[Motion], what: Item, *kinds: str, **given: object) -> dict[str, Mitigation]:
    """The measures of one object, one of each kind."""
    (found,) = assess([what], pairs, mitigations=kinds, progress=False, **given).results  # type: ignore[arg-type]
    return {str(each.kind): each for each in found.tried}


def by_hand(
    solid: Solid,
    pairs: list[Motion],
    around: Surroundings | None = None,
    tilt: float = 0.0,
    backward: bool = False,
    like: Item = SHELF,
    first: bool = True,
) -> tuple[int, int]:
    """Falls and simulations in half of the turns of an object, one call for each.

    What does not come `first` of its measures is simulated in one turn a motion.
    """
    own = solid_of(like, 0.02)
    assert own is not None
    held = Surroundings(walls=(Wall(gap=0.01),)) if around or tilt else None
    ways = halves(Stood(like, own, tilt=tilt, around=held).ways(pairs))[0]
    ways = ways if first else in_turn(ways)[0]
    falls = count = 0
    for motion, of_motion in zip(pairs, ways, strict=True):
        for polarity, turns in zip((1, -1), of_motion, strict=True):
            for turn in turns.tolist():
                runs = simulate_many(
                    [solid], [motion], orientations=[turn], polarities=(polarity,), tilts=[tilt],
                    azimuth=turn + (0.0 if backward else math.pi), model=General(),
                    surroundings=around and around.turned(turn), progress=False,
                )  # fmt: skip
                falls += int((runs.outcome.values != Outcome.STANDING).sum())
                count += 1
    return falls, count


def test_lower_is_the_same_solid_with_a_lower_centre_of_gravity(pairs: list[Motion]) -> None:
    found = tried(pairs, SHELF, "lower")["lower"]
    assert found.about == {"cg_height_m": 0.75 * 0.9}
    low = replace(
        SHELF,
        body=replace(SHELF.body, cg_height=0.675),
        sideways=replace(SHELF.sideways, cg_height=0.675),  # type: ignore[type-var]
    )
    solid = solid_of(low, 0.02)
    assert solid is not None
    falls, count = by_hand(solid, pairs)
    assert found.simulations == count
    assert found.fall.value == found.left.value == falls / count


def test_a_wall_and_a_tilt_toward_it(pairs: list[Motion]) -> None:
    found = tried(pairs, SHELF, "wall", "tilt")
    solid = solid_of(SHELF, 0.02)
    assert solid is not None
    around = Surroundings(walls=(Wall(gap=0.01, restitution=0.3),))
    falls, count = by_hand(solid, pairs, around)
    assert found["wall"].fall.value == falls / count
    tilt = math.radians(found["tilt"].about["tilt_deg"])
    assert 0.0 < tilt < math.atan2(0.15, 0.9)
    falls, count = by_hand(solid, pairs, around, tilt=tilt, backward=True, first=False)
    assert found["tilt"].fall.value == falls / count


def test_pads_hold_as_many_newtons_as_are_told(pairs: list[Motion]) -> None:
    """A quarter of the weight under each of four feet."""
    found = tried(pairs, SHELF, "pad")["pad"]
    solid = solid_of(SHELF, 0.02)
    assert solid is not None
    heavy = replace(solid, mass=80.0)
    around = Surroundings(pad=Pad(pull_off=0.25 * 80.0 * STANDARD_GRAVITY))
    falls, count = by_hand(heavy, pairs, around)
    assert found.about == {"holds_weights": 0.25}
    assert found.fall.value == pytest.approx(falls / count, abs=1.0 / count)  # round-off of masses


def test_a_base_does_and_a_smaller_one_does_not(pairs: list[Motion]) -> None:
    found = tried(pairs, SHELF, "base")["base"]
    assert found.left.value <= ACCEPTED_FALLS
    depth = float(found.about["depth_m"])
    assert 0.3 < depth < 3.0 * 0.3
    assert float(found.about["width_m"]) >= 0.9
    (now,) = assess([SHELF], pairs, leading=0, progress=False).results
    assert now.overturns.value > ACCEPTED_FALLS
    # what the search tried just below is a sixteenth of the way or more away, and does not do
    narrow = item(0.3 + 0.4 * (depth - 0.3), 0.9, 1.8, "shelf")
    (less,) = assess([narrow], pairs, leading=0, progress=False).results
    assert less.overturns.value > ACCEPTED_FALLS


def test_a_round_base_stays_round(pairs: list[Motion]) -> None:
    drum = item(0.23, 0.23, 1.6, "drum", shape=BaseShape.CYLINDER)
    found = tried(pairs, drum, "base", "wall", "tilt", "turn", "lock")
    assert set(found) == {"base"}  # what is round is not pushed to a wall, and has no castors
    assert found["base"].about["depth_m"] == found["base"].about["width_m"]


def test_castors(pairs: list[Motion]) -> None:
    """Locked with the worst of three frictions; tethered above the centre of gravity."""
    cart = item(0.5, 0.7, 1.1, "cart", castors=Castors.FREE)
    (one,) = assess([cart], pairs, mitigations=["lock", "tether", "strap"], progress=False).results
    frictions = [each.about["friction"] for each in one.mitigations if each.kind == "lock"]
    assert frictions == [0.4, 0.5, 0.7]
    found = {str(each.kind): each for each in one.tried}
    assert set(found) == {"lock", "tether"}
    assert found["tether"].about["height_m"] == pytest.approx(1.1 * 0.55)
    # it does not roll through the wall that it is fastened to, 50 mm behind it
    assert found["tether"].about["wall_gap_m"] == 0.05
    assert found["tether"].left.value < 0.5 * one.before.value
    assert found["lock"].left.value == max(
        each.left.value for each in one.mitigations if each.kind == "lock"
    )
    # what goes far is of concern there: before, and after
    assert one.solid is not None
    assert one.before == one.solid.level.governing_share


def test_turned_by_a_quarter_where_it_is_known_how_it_stands(pairs: list[Motion]) -> None:
    """A shelf across the stronger component falls less once it is turned along it."""
    facing = replace(SHELF, facing=0.0)
    found = tried(pairs, facing, "turn")["turn"]
    (turned,) = assess(
        [replace(SHELF, facing=math.pi / 2)], pairs, leading=0, progress=False
    ).results
    (back,) = assess(
        [replace(SHELF, facing=-math.pi / 2)], pairs, leading=0, progress=False
    ).results
    assert turned.solid is not None
    assert back.solid is not None
    assert found.fall.value in (turned.solid.fall.value, back.solid.fall.value)
    assert tried(pairs, SHELF, "turn") == {}


def test_moved_to_the_lowest_floor(pairs: list[Motion]) -> None:
    loud = [motion.scaled(1.5) for motion in pairs]
    house = Building(
        name="house", floors={"0": pairs, "1": loud}, told="as computed", computed=True
    )
    above = replace(SHELF, floor="1")
    (found,) = assess([above], house, mitigations=["move"], progress=False).results
    (moved,) = found.tried
    assert moved.kind is MitigationKind.MOVE
    solid = solid_of(SHELF, 0.02)
    assert solid is not None
    falls, count = by_hand(solid, pairs)
    assert moved.left.value == falls / count
    assert moved.left.value < found.before.value
    ground = replace(SHELF, floor="0")
    (there,) = assess([ground], house, mitigations=["move"], progress=False).results
    assert there.mitigations == ()


def test_ten_kinds_and_four_measures_each_where_they_are_worst(pairs: list[Motion]) -> None:
    loud = [motion.scaled(1.4) for motion in pairs]
    house = Building(
        name="house", floors={"0": pairs, "1": loud}, told="as computed", computed=True
    )
    shelves = [replace(SHELF, floor=label) for label in house.floors]
    found = assess(shelves, house, progress=False)
    below, above = found.results
    assert below.mitigations == ()  # alike, and worse upstairs
    assert len({each.kind for each in above.mitigations}) == MOST_TRIED
    assert [each.left.value for each in above.tried] == sorted(
        each.left.value for each in above.tried
    )
    many = [item(0.3, 0.9, 1.7 + 0.01 * k, f"shelf {k}") for k in range(LEADING + 2)]
    some = assess(many, pairs[:3], leading=2, progress=False)
    assert [bool(each.mitigations) for each in some.ranked()] == [True] * 2 + [False] * LEADING


def test_what_is_at_a_wall_is_strapped_to_it(pairs: list[Motion]) -> None:
    left = Surroundings(walls=(Wall(azimuth=math.pi / 2, gap=0.02),))
    found = tried(pairs, replace(SHELF, surroundings=left), "strap", "wall", "tilt")
    assert set(found) == {"strap"}  # its wall is beside it, so that no tilt leans it there
    assert found["strap"].about["wall_gap_m"] == 0.02


def test_premises_choose_measures_and_weights(pairs: list[Motion]) -> None:
    (museum,) = assess([SHELF], pairs, premises="museum", progress=False).results
    assert museum.item.must_not_fall  # the thing itself must survive
    kinds = {each.kind for each in museum.mitigations}
    assert {str(kind) for kind in kinds} == {"pad", "lower", "base", "strap"}
    (office,) = assess([SHELF], pairs, premises="office", progress=False).results
    assert MitigationKind.WALL in {each.kind for each in office.mitigations}
    assert premises_of(None) is PREMISES["hospital"]
    with pytest.raises(InputError, match=r"premises are hospital, .*, home; found 'castle'"):
        premises_of("castle")


def test_kinds_by_name() -> None:
    assert kinds_of(["all"]) == list(MitigationKind)
    assert kinds_of(["base", "strap"]) == [MitigationKind.STRAP, MitigationKind.BASE]
    with pytest.raises(InputError, match=r"what can be tried is strap, .*all; found 'glue'"):
        kinds_of(["glue"])


def test_what_does_not_fall_is_not_tried(pairs: list[Motion]) -> None:
    (found,) = assess([item(1.0, 1.0, 0.4, "slab")], pairs, progress=False).results
    assert found.before.value == 0.0
    assert found.mitigations == ()
    assert np.isnan(found.safe_base)


def test_no_base_beside_an_edge_over_which_it_would_reach(pairs: list[Motion]) -> None:
    edge = replace(SHELF, surroundings=Surroundings(edge=Edge(at=0.3)))
    assert tried(pairs, edge, "base") == {}


def test_what_is_alike_on_a_floor_shares_what_was_found(pairs: list[Motion]) -> None:
    """Two rows of one thing in two rooms get the same measures; the same upstairs none."""
    rooms = [replace(SHELF, location=name) for name in ("here", "there")]
    one, other = assess(rooms, pairs, mitigations=["lower"], progress=False).results
    assert one.mitigations == other.mitigations != ()
    assert other.item.location == "there"


def test_measures_ask_for_three_dimensions(pairs: list[Motion]) -> None:
    with pytest.raises(InputError, match=r"three dimensions alone; leave out planar=True"):
        assess([SHELF], pairs, mitigations=["strap"], planar=True, progress=False)
    flat = [part for motion in pairs for part in motion.components()]
    with pytest.raises(InputError, match="they need both horizontal components"):
        assess([SHELF], flat, mitigations=["strap"], progress=False)


def test_a_recorded_building_moves_nothing_to_another_floor_s_earthquakes(
    pairs: list[Motion],
) -> None:
    loud = [motion.scaled(1.5) for motion in pairs]
    house = Building(name="house", floors={"0": pairs, "1": loud}, told="as recorded")
    (found,) = assess(
        [replace(SHELF, floor="1")], house, mitigations=["move"], progress=False
    ).results
    assert found.mitigations == ()


def test_a_floor_without_pairs_says_what_stands_alone(
    pairs: list[Motion], caplog: pytest.LogCaptureFixture
) -> None:
    flat = [part for motion in pairs for part in motion.components()]
    house = Building(name="house", floors={"0": pairs, "1": flat}, told="as recorded")
    wall = Surroundings(walls=(Wall(gap=0.02),))
    held = [replace(SHELF, floor=label, surroundings=wall) for label in house.floors]
    named = [replace(each, body=replace(each.body, name=f"on {each.floor}")) for each in held]
    found = assess(named, house, leading=0, progress=False)
    (said,) = [each for each in caplog.messages if "stand alone" in each]
    assert "on 1" in said
    assert "on 0" not in said
    assert [floor.pairs for floor in found.floors] == [len(pairs), 0]
    assert found.pairs == len(pairs)
    # components of one recording are one: intervals are no narrower for them
    assert found.floors[0].recordings == found.floors[0].results[0].recordings
