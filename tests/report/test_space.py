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
from shaketable.report.words import headline, space
from tests.report.test_words import ITEM, PROFILE, QUIET, RESULT, first, happens

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
        floor="",
        results=results,
        motions=["m"],
        recordings=22,
        smallest_pga=1.0,
        largest_pga=2.0,
        pairs=pairs,
    )
    return Assessment(floors=[floor], control=0.95, tilt=0.0, scale=1.0, model=Rocking())


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


def test_what_stands_is_not_called_safe() -> None:
    said = space.what_happens(replace(QUIET, solid=STANDS))
    assert said == (
        "Shaken in both horizontal directions at once, it fell in none of 160 shakings from 20 "
        "recordings; up to 16 in 100 cannot be excluded."
    )
    few = space.what_happens(replace(QUIET, solid=STANDS._replace(recordings=3)))
    assert "decide nothing" in few
    assert space.what_happens(QUIET) == ""


def test_three_dimensions_decide() -> None:
    found = replace(RESULT, solid=SOLID)
    assert found.risk == "very high"
    assert found.overturns == found.governing_share == FALL
    assert found.by == 20
    few = replace(RESULT, solid=SOLID._replace(recordings=3))
    assert few.risk == NOT_CLASSED


def test_far_is_told_of_what_decides() -> None:
    """The first table has 50 of 100 by three dimensions, whose paragraph says so."""
    solid = SOLID._replace(level=LevelResult(Share(0.1, 0.0, 0.3), Share(0.5, 0.3, 0.7)))
    cart = replace(ITEM, castors=Castors.FREE)
    said = space.what_happens(replace(RESULT, profile=replace(PROFILE, item=cart), solid=solid))
    assert "In 50 of 100 (likely between 30 and 70) it falls or goes farther than 0.5 m." in said
    assert "farther" not in space.what_happens(replace(RESULT, solid=solid))


def test_what_may_be_round_is_not_classed() -> None:
    asked = replace(ITEM, may_be_round=True)
    for fall, classed in ((0.05, False), (0.3, False), (0.9, True)):
        share = Share(fall, max(0.0, fall - 0.1), min(1.0, fall + 0.1))
        solid = SOLID._replace(level=LevelResult(share, share), frictions=())
        result = replace(RESULT, profile=replace(PROFILE, item=asked), fall=share, solid=solid)
        assert (result.risk != NOT_CLASSED) == classed
        assert (first(result) == "fill in column shape") == (not classed)
        assert happens(result).startswith("If it is not round: ")


def test_what_a_plane_alone_knows_is_named() -> None:
    assert space.limits(assessment(SOLID)) == []
    (left_out,) = space.limits(assessment(SOLID, None))
    assert left_out.startswith("In a plane alone")


def test_what_a_rim_loses_is_told_where_it_is_not_known() -> None:
    known = replace(ITEM, shape=BaseShape.CYLINDER, rolling_friction=0.003)
    for item, told in ((replace(known, rolling_friction=0.0), True), (known, False), (ITEM, False)):
        result = replace(RESULT, solid=SOLID, profile=replace(PROFILE, item=item))
        one = assessment(SOLID)
        floor = replace(one.floors[0], results=[result])
        said = " ".join(space.limits(replace(one, floors=[floor])))
        assert ("What a rim loses as it rolls is not known" in said) == told
        for sentence in ("rolls around on its rim", "Rims are taken as flat"):
            assert (sentence in said) == (item.shape is BaseShape.CYLINDER)


def test_what_it_stands_on() -> None:
    (said,) = space.how_sure(assessment(SOLID._replace(not_settled=3)))
    assert "by both horizontal components of 20 recordings at once" in said
    assert "each object facing 2 ways to them" in said
    assert "In 3 of all 160 simulations the object still wobbled" in said
    assert "was not checked against tests" in said
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
    """What has not come to rest."""
    many = replace(QUIET, recordings=200, fall=Share(0.0, 0.0, 0.019))
    stands = STANDS._replace(recordings=200, level=LevelResult(many.fall, many.fall))
    assert round_item(many, solid=stands).risk == "low"
    assert round_item(many, solid=stands._replace(not_settled=40)).risk == NOT_CLASSED
    assert round_item(many, solid=stands._replace(not_settled=4)).risk == "low"  # 4 of 160: 2.5 %
    assert replace(many, not_settled=3).risk == NOT_CLASSED  # 3 of 88
