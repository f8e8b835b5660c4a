"""Three dimensions in words."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from shaketable.assess import (
    Assessment,
    FloorAssessment,
    FrictionResult,
    LevelResult,
    Quartiles,
    Share,
    Sides,
    SolidResult,
)
from shaketable.inventory import Shape
from shaketable.models import Rocking
from shaketable.report.words import advice, headline, space
from tests.report.test_words import QUIET, RESULT

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
    given_up=0,
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
        "Depending on which way it faces, it falls in 70 to 90 of 100. That is where its feet "
        "cannot slide; with a friction of 0.3 to 0.7 it is 20 to 80 of 100. Where it stays "
        "upright, with a friction of 0.3 it ends 12 cm or more from its place in half of them; it "
        "is turned by 11° or more in a quarter of them."
    )


def test_a_card_tells_what_still_moved_and_not_where_few_end() -> None:
    """Two runs that left it upright tell nothing of how far it goes."""
    nearly = SOLID._replace(falls=158, given_up=2)
    said = space.what_happens(replace(RESULT, solid=nearly))
    assert "of the 2 that did not, 2 left it wobbling or rolling" in said
    assert "from its place" not in said


def test_advice_of_a_plane_says_so() -> None:
    """A base or a force was sought in one direction of shaking at a time."""
    said = " ".join(advice.what_to_do(replace(RESULT, solid=SOLID), 0.95))
    assert "in one direction at a time: both at once may take more" in said
    item = replace(RESULT.item, shape=Shape.CYLINDER)
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
    assert few.overturns == few.concern == RESULT.fall
    (said,) = space.how_sure(assessment(SOLID._replace(recordings=3)))
    assert "So few decide nothing: totals, class and order are of the plane." in said
    enough = replace(RESULT, solid=SOLID)
    assert enough.risk == "very high"
    assert enough.overturns == enough.concern == FALL


def test_what_changes() -> None:
    first, clear, left_out = space.what_changes(assessment(SOLID, None))
    assert "0.5 fall on average where they are shaken in one direction at a time" in first
    assert "0.8 where they are shaken in both at once" in first
    assert "Three dimensions change the answer for shelf" in clear
    assert left_out.startswith("In a plane alone")
    alike = SOLID._replace(level=LevelResult(Share(0.55, 0.4, 0.7), FALL))
    assert len(space.what_changes(assessment(alike))) == 1
    assert space.what_changes(assessment(None)) == []


def test_what_it_stands_on() -> None:
    (said,) = space.how_sure(assessment(SOLID._replace(given_up=3)))
    assert "20 pairs of horizontal components whose compass directions are known" in said
    assert "from 20 independent recordings, each object facing up to 2 ways" in said
    assert "In 3 of all 160 simulations in three dimensions the object still wobbled" in said
    assert "was not held against tests" in said
    assert said in headline.how_sure(assessment(SOLID._replace(given_up=3)))
    assert space.how_sure(assessment(None)) == []


@pytest.mark.parametrize("turned", [(FALL,), ()])
def test_one_way_has_no_range(turned: tuple[Share, ...]) -> None:
    solid = SOLID._replace(turned=turned, frictions=())
    assert "which way it faces" not in space.what_happens(replace(RESULT, solid=solid))
