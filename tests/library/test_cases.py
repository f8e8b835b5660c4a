"""The things of a library, their cases, and what is drawn of them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import InputError, ShearBuilding
from shaketable.inventory.catalogue import catalogue
from shaketable.library.case import Case, Held, Stand
from shaketable.library.draws import (
    BASE_DIFFERS,
    DAMPING,
    HEIGHT_DIFFERS,
    OF_MODEL,
    OF_OBJECT,
    STIFFNESS,
    draws_of,
)
from shaketable.library.thing import LibraryThing, Size
from shaketable.units import radians

G = 9.80665
STRAP = Held(name="strap 2 W", wall_gap=0.01, strength=2.0, slack=0.005)


def case(kind: str = "bookcase", held: Held | None = None, **more: object) -> Case:
    return Case(thing=LibraryThing(kind=kind), stand=Stand(), held=held or Held(), **more)  # type: ignore[arg-type]


def test_sizes_are_those_of_the_catalogue() -> None:
    usual = catalogue()["bookcase"]
    slender = LibraryThing(kind="bookcase", size=Size.SLENDER)
    assert (slender.depth, slender.width, slender.height) == (
        usual.depth.least, usual.width.least, usual.height.most,
    )  # fmt: skip
    stout = LibraryThing(kind="bookcase", size=Size.STOUT)
    assert (stout.depth, stout.width, stout.height) == (
        usual.depth.most, usual.width.most, usual.height.least,
    )  # fmt: skip
    middle = LibraryThing(kind="bookcase", scale=2.0)
    assert middle.depth == pytest.approx(usual.depth.least + usual.depth.most)
    assert middle.name == "bookcase middle x2"
    own = LibraryThing(kind="bookcase", lengths=(0.32, 0.9, 1.8), label="5 shelves")
    assert (own.depth, own.width, own.height, own.name) == (0.32, 0.9, 1.8, "bookcase 5 shelves")
    round_one = LibraryThing(kind="gas cylinder large")
    assert round_one.round
    assert round_one.width == round_one.depth


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"kind": "bookcas"}, "the catalogue has no 'bookcas'"),
        ({"kind": "bookcase", "scale": 0.0}, "scale of a thing"),
        ({"kind": "bookcase", "label": "x"}, "give lengths and a label, or neither"),
        ({"kind": "bookcase", "label": "x", "lengths": (1.0, 0.0, 1.0)}, "length of a thing"),
    ],
)
def test_wrong_things_are_refused(given: dict[str, object], says: str) -> None:
    with pytest.raises(InputError, match=says):
        LibraryThing(**given)  # type: ignore[arg-type]


def test_wrong_cases_are_refused() -> None:
    with pytest.raises(InputError, match="floor must be from 1 to 3"):
        Stand(name="x", building=ShearBuilding(storeys=3, first_period=0.4), floor=4)
    with pytest.raises(InputError, match="a strap goes to a wall"):
        Held(name="x", strength=1.0)
    with pytest.raises(InputError, match="friction"):
        case(friction=(0.6, 0.4))


def test_a_name_tells_all_that_differs() -> None:
    both = case(held=STRAP, tilt=radians(2.0), friction=(0.2, 0.4))
    assert both.name == "bookcase.middle.ground.strap_2_W.tilt2.mu0_2to0_4"
    assert case().name == "bookcase.middle.ground.free.mu0_4to0_6"


def test_draws_lie_within_what_is_stated() -> None:
    asked = case(friction=(0.3, 0.7))
    draws = draws_of(asked, 60, seed=1)
    usual, thing = asked.thing.common, asked.thing
    heights = np.array([each.solid.height for each in draws.each])
    assert np.abs(heights / thing.height - 1.0).max() <= HEIGHT_DIFFERS
    cg = np.array([each.solid.cg_height for each in draws.each]) / heights
    assert usual.cg.least <= cg.min() < usual.cg.least + 0.01
    assert usual.cg.most >= cg.max() > usual.cg.most - 0.01
    for each in draws.each:
        low, high = each.solid.corners.min(axis=0), each.solid.corners.max(axis=0)
        depth, width = high - low
        assert abs(depth / thing.depth - 1.0) <= BASE_DIFFERS
        assert abs(width / thing.width - 1.0) <= BASE_DIFFERS
        assert 0.45 <= -low[0] / depth <= 0.55
        assert each.around is None
    # three values stand for each range: its sixths at 1, 3 and 5
    assert {round(each.model.static_friction, 6) for each in draws.each} == {
        round(0.3 + 0.4 * share, 6) for share in (1 / 6, 1 / 2, 5 / 6)
    }
    assert len({each.orientation for each in draws.each}) == 60
    assert draws.standard.mean(axis=1) == pytest.approx(0.0, abs=1e-12)
    assert draws.standard.std(axis=1) == pytest.approx(1.0)


def test_standard_deviations_are_those_of_what_was_drawn() -> None:
    """`spread` is that of ln of lengths: of 2,000 draws, to 3 % as ln is not quite linear."""
    asked = case()
    draws = draws_of(asked, 2000, seed=3)
    heights = np.log([each.solid.height or 0.0 for each in draws.each])
    spread = dict(zip(draws.parameters, draws.spread, strict=True))
    assert spread["height"] == pytest.approx(heights.std(), rel=0.03)
    cg = np.log([each.solid.cg_height for each in draws.each]) - heights
    assert spread["cg_height"] == pytest.approx(cg.std(), rel=0.03)
    friction = np.log([each.model.static_friction for each in draws.each])
    assert spread["friction"] == pytest.approx(friction.std(), rel=0.03)


def test_what_is_drawn_depends_on_the_shape() -> None:
    assert draws_of(case(), 4, 1).parameters == tuple(
        name for name in (*OF_OBJECT, *OF_MODEL) if name != "contour"
    )
    of_a_cylinder = draws_of(case("gas cylinder large"), 4, 1)
    assert "contour" in of_a_cylinder.parameters
    assert "width" not in of_a_cylinder.parameters
    rolling = draws_of(case("infusion pump on stand"), 4, 1).each[0].solid
    assert rolling.castors == (True,) * 4
    locked = draws_of(case("server rack"), 4, 1).each[0].solid
    assert locked.feet
    assert not any(locked.castors)


def test_the_wall_and_the_strap_turn_with_the_thing() -> None:
    for each in draws_of(case(held=STRAP), 12, seed=2).each:
        assert each.around is not None
        (wall,), (strap,) = each.around.walls, each.around.straps
        assert wall.azimuth == each.orientation
        assert wall.gap == 0.01
        back = each.solid.corners[:, 0].max()
        assert strap.point == pytest.approx((back, 0.0, each.solid.height))
        # from the back straight to the wall
        way = np.array([math.cos(each.orientation), math.sin(each.orientation)])
        assert strap.anchor[:2] == pytest.approx((back + 0.01) * way)
        assert strap.strength == pytest.approx(2.0 * G)  # of 1 kg
        assert (strap.slack, strap.stiffness, strap.damping) == (0.005, STIFFNESS, DAMPING)


def test_an_edge_is_before_the_front() -> None:
    for each in draws_of(case("vase", Held(name="table", edge=0.05)), 6, seed=2).each:
        assert each.around is not None
        assert each.around.edge is not None
        assert each.around.edge.at == pytest.approx(0.05 + (each.solid.diameter or 0.0) / 2)
        assert each.around.edge.azimuth == pytest.approx(math.pi + each.orientation)


def test_draws_of_a_seed_and_a_case_are_its_own() -> None:
    first, again = draws_of(case(), 8, 1), draws_of(case(), 8, 1)
    assert [each.orientation for each in first.each] == [each.orientation for each in again.each]
    other, held = draws_of(case(), 8, 2), draws_of(case(held=STRAP), 8, 1)
    for different in (other, held):
        assert first.each[0].orientation != different.each[0].orientation
