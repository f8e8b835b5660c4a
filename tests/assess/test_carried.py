"""What stands on furniture, hangs, or is on castors that may be locked, in an assessment."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import pytest

from shaketable import Body, General, Motion, assess
from shaketable.assess import NOT_CLASSED, Assessment, ItemResult, LevelResult, Share, Walls
from shaketable.assess.carried import carrier_of, kick_of
from shaketable.assess.floor import _how_bad
from shaketable.assess.walls import at_their_walls
from shaketable.errors import InputError
from shaketable.inventory import Castors, Item
from shaketable.records import suite
from shaketable.report.annex import cards
from shaketable.report.first_part import rows
from shaketable.report.words import advice, answer, carried, findings, headline
from shaketable.surroundings import Edge, Surroundings

MODEL = General(static_friction=0.5)


def thing(name: str, depth: float, width: float, height: float, **more: object) -> Item:
    front, side = (Body.rectangle(size, height, name=name) for size in (depth, width))
    return Item(body=front, sideways=side, height=height, **more)  # type: ignore[arg-type]


SHELF = thing("Bookcase 1.80 m", 0.32, 0.9, 1.8, row=3)
VASE = thing("Vase", 0.10, 0.12, 0.3, stands_on="on Bookcase 1.80 m", row=4, quantity=3)


@pytest.fixture(scope="module")
def pairs() -> Sequence[Motion]:
    """Twelve of the shortest with both components: fewer than ten give no class."""
    known = [m for m in suite("fema-p695-far-field", pairs=True) if m.transverse is not None]
    return sorted(known, key=lambda motion: motion.duration)[:12]


@pytest.fixture(scope="module")
def found(pairs: Sequence[Motion]) -> Assessment:
    items = [
        SHELF, VASE, thing("Urn", 0.10, 0.12, 0.3, row=5),
        thing("Projector", 0.3, 0.4, 0.15, hangs=True),
        thing("Cart", 0.4, 0.6, 1.2, castors=Castors.SOME, row=7),
        thing("Free cart", 0.4, 0.6, 1.2, castors=Castors.FREE, row=8),
        thing("Locked cart", 0.4, 0.6, 1.2, castors=Castors.LOCKED, row=9),
        thing("Bust", 0.3, 0.35, 0.6, row=10,
              surroundings=Surroundings(edge=Edge(at=0.3, azimuth=math.pi))),
        thing("Rack", 0.5, 0.6, 1.9, unread=("Wheels?",), row=13),
    ]  # fmt: skip
    return assess(items, pairs, model=MODEL, leading=1, progress=False)


def by(found: Assessment, name: str) -> ItemResult:
    return next(each for each in found.results if each.item.name == name)


@pytest.mark.parametrize(
    ("base", "height", "friction", "slenderness"),
    [
        (0.32, 1.80, 0.287, 0.295), (0.40, 1.20, 0.547, 0.574), (0.45, 1.00, 0.739, 0.791),
        (0.50, 1.20, 0.674, 0.712), (0.60, 1.80, 0.527, 0.545),
    ],
)  # fmt: skip
def test_the_thresholds_of_an_object_on_top_of_furniture(
    base: float, height: float, friction: float, slenderness: float
) -> None:
    """Of an object with its centre of gravity at 0.15 m, by a time stepping of the landing."""
    furniture = thing("x", base, 2.0, height)
    kick = kick_of(thing("o", 0.1, 0.2, 0.3), furniture)
    assert kick.friction == pytest.approx(friction, abs=1e-3)
    assert kick.slenderness == pytest.approx(slenderness, abs=2e-3)
    assert kick.own == pytest.approx(0.05 / 0.15)
    just = 2 * 0.15 * kick.slenderness
    assert kick_of(thing("o", 0.999 * just, 2.0, 0.3), furniture).rocks
    assert not kick_of(thing("o", 1.001 * just, 2.0, 0.3), furniture).rocks


def test_what_no_width_keeps_from_rocking() -> None:
    """A tall thing on a low wide plate: every base is too short."""
    assert math.isinf(kick_of(thing("o", 0.1, 0.2, 2.0), thing("x", 0.8, 0.9, 0.3)).slenderness)


def test_which_furniture_carries_it() -> None:
    """The longest name in what the list says; none where it is carried, too, or is fixed."""
    short = thing("Bookcase", 0.3, 0.9, 1.0)
    assert carrier_of(VASE, [VASE, short, SHELF]) is SHELF
    assert carrier_of(VASE, [VASE]) is None
    assert carrier_of(VASE, [replace(SHELF, stands_on="table")]) is None
    assert carrier_of(VASE, [replace(SHELF, anchored=True)]) is None


def test_what_stands_on_furniture_has_neither_class_nor_interval(found: Assessment) -> None:
    """It was simulated as if on the floor, like the urn of the same size there."""
    vase, urn = by(found, "Vase"), by(found, "Urn")
    assert vase.overturns == urn.overturns
    assert vase.risk == NOT_CLASSED != urn.risk
    assert vase.mitigations == ()
    share = carried.often(vase)
    assert share == f"{round(100 * vase.overturns.value)} or more"
    assert (
        carried.often(urn)
        == f"{round(100 * urn.overturns.value)} ({carried.often(urn).partition('(')[2]}"
    )
    first = "It stands on something that was not simulated. What falls may be more."
    happens, landings = answer.what_happens(vase)
    assert happens.startswith(first)
    assert "likely between" not in happens
    assert (
        "slides where its friction is below 0.29, and rocks where its half base is less" in landings
    )
    assert (
        "than 0.29 of the height of its centre of gravity. It does not rock by that: it has 0.33."
        in landings
    )
    (card,) = [each for each in cards(found, found.ranked(), None) if each.result is vase]
    assert card.happens[0].startswith(first)
    (row,) = [each for each in rows(found, found.ranked()) if each.name == "Vase"]
    assert row.told.startswith(first)
    assert (row.share.low, row.share.high) == (row.share.value, row.share.value)
    assert "few or no falls seen" not in findings.risk_in_words(vase)
    assert advice.what_to_do(vase, found) == carried.what_to_do()
    assert advice.first_measure(vase, found.premises) == "hold what it stands on, and it"


def test_what_hangs_is_not_simulated_and_asked_about(found: Assessment) -> None:
    assert [each.name for each in found.hanging] == ["Projector"]
    assert "Projector" not in {each.item.name for each in found.results}
    (asked,) = [each for each in headline.not_as_it_stands(found) if "hang or are fixed" in each]
    assert asked == (
        "Not simulated, as names or notes say that they hang or are fixed: Projector. Are they? "
        "Say yes or no in a column “anchored”; what is not fixed is then simulated."
    )


def test_of_castors_that_may_be_locked_the_worse_leads(found: Assessment) -> None:
    cart, free, locked = (by(found, name) for name in ("Cart", "Free cart", "Locked cart"))
    worse = max(free, locked, key=lambda each: each.governing_share)
    assert free.governing_share != locked.governing_share
    assert cart.governing_share == worse.governing_share
    assert cart.item.castors is worse.item.castors
    assert not cart.item.lock_known
    said = answer.what_happens(cart)[0]
    assert said == (
        "Whether its castors are locked is not known: both were simulated, and what follows is the "
        f"worse, {worse.item.castors} castors."
    )
    assert "Whether its castors" not in answer.what_happens(free)[0]


def test_near_an_edge_it_is_told_on_condition(found: Assessment) -> None:
    assert answer.what_happens(by(found, "Bust"))[0].startswith(
        "If what carries it does not move: "
    )
    assert not answer.what_happens(by(found, "Urn"))[0].startswith("If what carries it")


def test_how_many_have_no_class_because_of_a_cell(found: Assessment) -> None:
    (said,) = [each for each in headline.not_as_it_stands(found) if "could not be read" in each]
    assert said == (
        "1 of 8 kinds of object have no class, because a cell could not be read: 'Wheels?', row 13."
    )
    rack = by(found, "Rack")
    assert findings.risk_in_words(rack) == "not classed, because 'Wheels?' could not be read"
    every = replace(found.floors[0], results=[rack])
    alone = replace(found, floors=[every])
    assert any(each.startswith("Nothing is classed: ") for each in headline.not_as_it_stands(alone))


def test_of_two_lock_states_that_which_falls_is_the_worse(found: Assessment) -> None:
    """A cart that rolls far as often as it falls when it is locked is told as it falls."""
    free, locked = by(found, "Free cart"), by(found, "Locked cart")
    assert free.solid is not None
    assert locked.solid is not None
    falls = Share(0.31, 0.2, 0.5)
    far = replace(
        free,
        solid=free.solid._replace(level=LevelResult(Share(0.0, 0.0, 0.1), falls), frictions=()),
    )
    fell = replace(locked, solid=locked.solid._replace(level=LevelResult(falls, falls)))
    assert max((far, fell), key=_how_bad) is fell
    assert max((fell, far), key=_how_bad) is fell


def test_a_carrier_that_rolls_away_does_not_rock() -> None:
    trolley = thing("Trolley", 0.5, 0.7, 0.9, castors=Castors.FREE)
    assert carrier_of(thing("Jar", 0.1, 0.1, 0.2, stands_on="Trolley"), [trolley]) is None


def test_a_wall_is_put_only_where_it_is_simulated(pairs: Sequence[Motion]) -> None:
    """Not in a plane, nor behind what has no known width, whose class it would cost."""
    with pytest.raises(InputError, match="in three dimensions alone"):
        assess([SHELF], pairs, planar=True, walls="yes", progress=False)
    narrow = replace(SHELF, sideways=None)
    stands, flat = at_their_walls([SHELF, narrow], Walls.YES)
    assert stands.surroundings is not None
    assert flat == narrow


def test_an_edge_that_was_not_simulated_is_said(found: Assessment) -> None:
    bust = by(found, "Bust")
    assert findings.on_condition(bust) == "If what carries it does not move: "
    assert findings.on_condition(replace(bust, solid=None)) == (
        "Without what surrounds it, in a plane: "
    )
