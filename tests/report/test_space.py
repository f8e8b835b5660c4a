"""Three dimensions in words."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from shaketable import Body
from shaketable.assess import (
    NOT_CLASSED,
    Assessment,
    FloorAssessment,
    FrictionResult,
    ItemResult,
    LevelResult,
    Quartiles,
    Share,
    Sides,
    SolidResult,
    fate_of,
)
from shaketable.inventory import BaseShape, Castors
from shaketable.models import Rocking
from shaketable.report.words import advice, findings, headline, space
from tests.report.test_words import ITEM, PROFILE, QUIET, RESULT

FALL = Share(0.8, 0.7, 0.9)
SOLID = SolidResult(
    simulations=160,
    recordings=20,
    falls=128,
    level=LevelResult(FALL, FALL),
    sides=Sides(0.45, 0.35, 0.15, 0.05),
    turned=(Share(0.7, 0.6, 0.8), Share(0.9, 0.8, 1.0)),
    frictions=(
        FrictionResult(0.3, Share(0.2, 0.1, 0.3), 0.12),
        FrictionResult(0.7, Share(0.8, 0.7, 0.9), 0.002),
    ),
    moved=Quartiles(0.0, 0.0, 0.001),
    yaw=Quartiles(0.0, 0.0, 0.2),
    not_settled=0,
)
NONE = Share(0.0, 0.0, 0.16)
STANDS = SOLID._replace(
    falls=0, level=LevelResult(NONE, NONE), turned=(NONE, NONE), frictions=(),
    sides=Sides(*(math.nan,) * 4), yaw=Quartiles(0.0, 0.0, 0.0),
)  # fmt: skip


def assessment(*solids: SolidResult | None, pairs: int = 20) -> Assessment:
    results = [replace(RESULT, solid=solid) for solid in solids]
    floor = FloorAssessment(
        floor="", results=results, motions=["m"], recordings=22, smallest_pga=1.0, largest_pga=2.0
    )
    return Assessment(
        floors=[floor], control=0.95, tilt=0.0, scale=1.0, model=Rocking(), pairs=pairs
    )


def test_a_card_tells_sides_spread_and_distance() -> None:
    assert space.what_happens(replace(RESULT, solid=SOLID)) == (
        "Shaken in both horizontal directions at once, it falls in 80 of 100 (likely between 70 "
        "and 90). Of its 128 falls 58 go forward, 45 backward, 19 to the left and 6 to the right. "
        "Depending on which way it faces, it falls in 70 to 90 of 100. That is where it cannot "
        "slide; with a friction of 0.3 to 0.7 it is 20 to 80 of 100. Where it stays "
        "upright, with a friction of 0.3 it ends 12 cm or more from its place in half of them; it "
        "is turned by 11° or more in a quarter of them."
    )


def test_a_card_tells_what_still_moved_and_not_where_few_end() -> None:
    """Two runs that left it upright tell nothing of how far it goes."""
    nearly = SOLID._replace(falls=158, not_settled=2)
    said = space.what_happens(replace(RESULT, solid=nearly))
    assert "In 2 of the 160 it had neither fallen nor come to rest at the end." in said
    stood = STANDS._replace(not_settled=8)
    assert "In 8 of the 160 it had neither" in space.what_happens(replace(QUIET, solid=stood))
    assert "from its place" not in said


def test_advice_of_a_plane_says_so() -> None:
    """A base was sought in one direction of shaking at a time."""
    said = " ".join(advice.what_to_do(replace(RESULT, solid=SOLID), 0.95))
    assert "one direction at a time; both at once may overturn it more often" in said
    item = replace(RESULT.item, shape=BaseShape.CYLINDER)
    gas = replace(RESULT, profile=replace(RESULT.profile, item=item), solid=SOLID)
    assert "No wider base was tried in three dimensions" in " ".join(advice.what_to_do(gas, 0.95))
    assert advice.safe_base(gas) == "–"
    assert advice.safe_base(RESULT) != "–"


def test_what_stands_is_not_called_safe() -> None:
    said = space.what_happens(replace(QUIET, solid=STANDS))
    assert said == (
        "Shaken in both horizontal directions at once, it fell in none of 160 shakings from 20 "
        "recordings; up to 16 in 100 cannot be excluded."
    )
    few = space.what_happens(replace(QUIET, solid=STANDS._replace(recordings=3)))
    assert "decide nothing" in few
    assert space.what_happens(QUIET) == ""


def test_few_pairs_decide_nothing() -> None:
    """Three recordings are no reason to leave the class and the share of 22."""
    few = replace(RESULT, solid=SOLID._replace(recordings=3))
    assert few.risk == RESULT.risk == "high"
    assert few.overturns == few.governing_share == RESULT.fall
    (said,) = space.how_sure(assessment(SOLID._replace(recordings=3)))
    assert "So few decide nothing: totals, class and order are of the plane." in said
    enough = replace(RESULT, solid=SOLID)
    assert enough.risk == "very high"
    assert enough.overturns == enough.governing_share == FALL


def test_other_frictions_of_a_floor_are_told_beside_those_of_the_ground() -> None:
    """A cart fell in 0 to 2 of 100 on the ground, and in 21 on its floor, in a plane."""
    planar = (FrictionResult(0.5, Share(0.18, 0.05, 0.4), 0.1),)
    few = tuple(each._replace(fall=Share(0.02, 0.0, 0.2)) for each in SOLID.frictions)
    for on_ground, said in ((False, "it is 2 of 100."), (True, "it is 2 to 18 of 100, on the")):
        solid = SOLID._replace(frictions=few, on_ground=on_ground)
        assert said in space.what_happens(replace(RESULT, solid=solid, frictions=planar))


def test_far_is_told_of_what_decides() -> None:
    """The first table has 50 of 100 by three dimensions, whose paragraph says so."""
    solid = SOLID._replace(level=LevelResult(Share(0.1, 0.0, 0.3), Share(0.5, 0.3, 0.7)))
    cart = replace(ITEM, castors=Castors.FREE)
    said = space.what_happens(replace(RESULT, profile=replace(PROFILE, item=cart), solid=solid))
    assert "In 50 of 100 (likely between 30 and 70) it falls or goes farther than 0.5 m." in said
    assert "farther" not in space.what_happens(replace(RESULT, solid=solid))


def test_no_base_is_told_that_does_not_do_in_three_dimensions() -> None:
    """One that a plane finds wide enough, where it falls in 80 of 100 under both components."""
    narrow = replace(RESULT, safe_width=0.9 * PROFILE.body.width)
    assert advice.safe_base(narrow) != "–"
    assert advice.safe_base(replace(narrow, solid=SOLID)) == "–"
    seldom = SOLID._replace(level=LevelResult(Share(0.05, 0.0, 0.2), FALL))
    assert advice.safe_base(replace(narrow, solid=seldom)) != "–"
    wide = replace(RESULT, safe_width=2.0 * PROFILE.body.width, solid=SOLID)
    assert advice.safe_base(wide) != "–"


def test_what_may_be_round_is_not_classed() -> None:
    asked = replace(ITEM, may_be_round=True)
    for fall, classed in ((0.05, False), (0.3, False), (0.9, True)):
        share = Share(fall, max(0.0, fall - 0.1), min(1.0, fall + 0.1))
        solid = SOLID._replace(level=LevelResult(share, share), frictions=())
        result = replace(RESULT, profile=replace(PROFILE, item=asked), fall=share, solid=solid)
        assert (result.risk != NOT_CLASSED) == classed
        assert (advice.first_measure(result) == "fill in column shape") == (not classed)
        assert findings.what_happens(result).startswith("If it is not round: ")


def test_what_changes() -> None:
    first, clear, left_out = space.what_changes(assessment(SOLID, None))
    assert "0.5 fall on average where they are shaken in one direction at a time" in first
    assert "0.8 where they are shaken in both at once" in first
    assert "Three dimensions change the answer for shelf" in clear
    assert left_out.startswith("In a plane alone")
    alike = SOLID._replace(level=LevelResult(Share(0.55, 0.4, 0.7), FALL))
    assert len(space.what_changes(assessment(alike))) == 1
    assert space.what_changes(assessment(None)) == []


def test_what_a_rim_loses_is_told_where_it_is_not_known() -> None:
    known = replace(ITEM, shape=BaseShape.CYLINDER, rolling_friction=0.003)
    for item, told in ((replace(known, rolling_friction=0.0), True), (known, False), (ITEM, False)):
        result = replace(RESULT, solid=SOLID, profile=replace(PROFILE, item=item))
        one = assessment(SOLID)
        floor = replace(one.floors[0], results=[result])
        said = " ".join(space.what_changes(replace(one, floors=[floor])))
        assert ("What a rim loses as it rolls is not known" in said) == told
        for sentence in ("rolls around on its rim", "Rims are taken as flat"):
            assert (sentence in said) == (item.shape is BaseShape.CYLINDER)


def test_what_it_stands_on() -> None:
    (said,) = space.how_sure(assessment(SOLID._replace(not_settled=3)))
    assert "20 pairs of horizontal components whose compass directions are known" in said
    assert "from 20 independent recordings, each object facing up to 2 ways" in said
    assert "In 3 of all 160 simulations in three dimensions the object still wobbled" in said
    assert "was not held against tests" in said
    assert said in headline.how_sure(assessment(SOLID._replace(not_settled=3)))
    assert space.how_sure(assessment(None)) == []


@pytest.mark.parametrize("turned", [(FALL,), ()])
def test_one_way_has_no_range(turned: tuple[Share, ...]) -> None:
    solid = SOLID._replace(turned=turned, frictions=())
    assert "which way it faces" not in space.what_happens(replace(RESULT, solid=solid))


def round_item(result: ItemResult = RESULT, **changes: object) -> ItemResult:
    """A result of an item that is round."""
    item = replace(RESULT.item, shape=BaseShape.CYLINDER)
    return replace(result, profile=replace(RESULT.profile, item=item), **changes)


def test_a_plane_classes_nothing_that_is_round_square_or_on_feet() -> None:
    """In three dimensions such bodies fall up to three times as often: a class would mislead."""
    assert RESULT.risk == "high"
    assert round_item().risk == NOT_CLASSED
    certain = Share(0.95, 0.9, 1.0)
    assert round_item(fall=certain).risk == "very high"  # it cannot be worse
    for width, classed in ((0.32, False), (0.47, False), (0.49, True), (0.20, True), (0.22, False)):
        item = replace(RESULT.item, sideways=Body.rectangle(width, 1.8))
        result = replace(RESULT, profile=replace(RESULT.profile, item=item))
        assert (result.risk != NOT_CLASSED) == classed, width
    assert round_item(solid=SOLID).risk == "very high"
    # three recordings in space are too few to class by, and leave the plane's class untrusted
    assert round_item(solid=SOLID._replace(recordings=3)).risk == NOT_CLASSED


def test_higher_floors_are_no_safer_than_three_dimensions_on_the_ground() -> None:
    seldom = replace(QUIET, fall=Share(0.25, 0.12, 0.46), falls=22)
    ground = SOLID._replace(on_ground=True)
    both = round_item(seldom, solid=ground)
    assert both.risk == "very high"
    assert both.overturns == FALL
    # and where the floor's plane is worse, that leads
    worse = round_item(replace(RESULT, fall=Share(0.9, 0.8, 0.97)), solid=ground)
    assert worse.overturns == worse.fall
    assert "On the ground, shaken in both" in space.what_happens(both)
    told = replace(
        assessment(None), floors=[replace(assessment(None).floors[0], floor="2", results=[both])]
    )
    first = headline.headline(told)[0]
    assert first.startswith("The floors of the building are simulated in a plane.")
    (_, names) = space.what_changes(told)
    assert "already on the ground" in names.lower()
    assert "shelf" in names


def test_what_makes_all_look_safer_is_said_first() -> None:
    item = replace(RESULT.item, floor="3")
    upstairs = replace(RESULT, profile=replace(RESULT.profile, item=item))
    base = assessment(None)
    told = replace(base, floors=[replace(base.floors[0], results=[upstairs])])
    assert headline.headline(told)[0].startswith("The list names floors")
    item = replace(RESULT.item, unread=("Rodízios",))
    unread = replace(RESULT, profile=replace(RESULT.profile, item=item))
    assert unread.risk == NOT_CLASSED
    told = replace(base, floors=[replace(base.floors[0], results=[unread])])
    assert headline.headline(told)[0].startswith("Nothing is classed: 'Rodízios' may say")


def test_a_place_is_as_bad_as_what_fares_worst_there() -> None:
    good = replace(QUIET, recordings=200, fall=Share(0.0, 0.0, 0.019))
    assert good.risk == "low"
    assert fate_of([good, RESULT]).risk == "high"
    assert fate_of([good, round_item(QUIET)]).risk == NOT_CLASSED
    assert fate_of([RESULT, round_item(QUIET)]).risk == "high"
    many = replace(QUIET, profile=replace(PROFILE, item=replace(ITEM, quantity=47)))
    found = fate_of([many])
    # Wilson's upper limit of none in 22: z² / (22 + z²) with z = 1.96
    assert found.falls == (0.0, 0.0, pytest.approx(3.8415 / 25.8415, abs=1e-4))
    assert (found.pieces, found.rolling) == (47, 0)
    assert math.isnan(found.rolls_far.value)


def test_no_good_class_where_it_may_be_too_good() -> None:
    """What leaves its plane upstairs, and what has not come to rest."""
    many = replace(QUIET, recordings=200, fall=Share(0.0, 0.0, 0.019))
    stands = STANDS._replace(recordings=200, level=LevelResult(many.fall, many.fall))
    assert round_item(many, solid=stands).risk == "low"
    assert round_item(many, solid=stands._replace(on_ground=True)).risk == NOT_CLASSED
    assert round_item(many, solid=stands._replace(not_settled=40)).risk == NOT_CLASSED
    assert round_item(many, solid=stands._replace(not_settled=4)).risk == "low"  # 4 of 160: 2.5 %
    assert replace(many, not_settled=3).risk == NOT_CLASSED  # 3 of 88
