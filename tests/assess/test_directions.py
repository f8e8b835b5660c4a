"""Both directions of an object, forces, frictions, castors, levels and the order of objects."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, simulate_many
from shaketable.assess import (
    FRICTIONS,
    NOT_CLASSED,
    CastorFriction,
    Direction,
    Level,
    Profile,
    Weights,
    assess,
)
from shaketable.assess.anchors import anchor_forces, extremes_of
from shaketable.building import Building
from shaketable.inventory import Castors, Item
from shaketable.report.words.advice import first_measure, safe_base, what_to_do
from shaketable.report.words.findings import what_friction_does
from shaketable.resampling import wilson_interval
from shaketable.units import STANDARD_GRAVITY

g = STANDARD_GRAVITY
BOOKCASE = Item(
    body=Body.rectangle(0.32, 1.8, name="bookcase"),
    height=1.8,
    sideways=Body.rectangle(0.9, 1.8, name="bookcase"),
)


@pytest.fixture(scope="module")
def motions(p695: list[Motion]) -> list[Motion]:
    return p695[:24]


def share(body: Body, motions: list[Motion], **options: object) -> float:
    return float((simulate_many([body], motions, progress=False, **options).outcome != 0).mean())


def test_the_worse_direction_leads(motions: list[Motion]) -> None:
    (found,) = assess([BOOKCASE], motions, progress=False).results
    assert found.profile.direction is Direction.FRONT_TO_BACK
    assert found.fall.value == share(BOOKCASE.body, motions) > 0.3
    assert found.other is not None
    assert found.other.fall.value == share(BOOKCASE.sideways, motions) < 0.1
    # the same object with its sides exchanged falls as often, the other way
    turned = replace(BOOKCASE, body=BOOKCASE.sideways, sideways=BOOKCASE.body)
    (other,) = assess([turned], motions, progress=False).results
    assert other.profile.direction is Direction.SIDE_TO_SIDE
    assert other.fall == found.fall
    assert other.safe_base == found.safe_base


def test_what_is_given_front_to_back_is_not_used_side_to_side(motions: list[Motion]) -> None:
    askew = replace(
        BOOKCASE,
        body=Body.rectangle(0.9, 1.8, eccentricity=0.3, name="askew"),
        sideways=Body.rectangle(0.32, 1.8, name="askew"),
        support_length=2.0,
    )
    (found,) = assess([askew], motions, model=General(static_friction=0.6), progress=False).results
    assert found.profile.direction is Direction.SIDE_TO_SIDE
    assert found.profile.body.left == found.profile.body.right
    assert found.profile.support_length is None
    assert found.other is not None
    assert found.other.profile.support_length == 2.0


def test_a_tilted_support_leans_to_the_front(motions: list[Motion]) -> None:
    (found,) = assess([BOOKCASE], motions, tilt=math.radians(3.0), progress=False).results
    assert found.fall.value == share(BOOKCASE.body, motions, tilts=[math.radians(3.0)])
    assert found.other is not None
    assert found.other.fall.value == share(BOOKCASE.sideways, motions)


def test_a_square_base_is_simulated_once(motions: list[Motion]) -> None:
    square = replace(BOOKCASE, sideways=BOOKCASE.body)
    (found,) = assess([square], motions[:4], progress=False).results
    assert found.other is None
    assert found.profile.alike


def test_force_that_keeps_it_from_lifting() -> None:
    series = g * np.array([0.0, 0.3, -0.5, 0.2, 0.0])
    rising = g * np.array([0.0, 0.1, -0.4, 0.1, 0.0])
    profile = Profile(item=BOOKCASE, direction=Direction.FRONT_TO_BACK, body=BOOKCASE.body)
    # F/m z = |a_x| h - (g + a_y) b, largest at the third sample: 0.5 g there, weight g or 0.6 g
    for vertical, weight in ((None, 1.0), (rising, 0.6)):
        top, lower = anchor_forces(
            [profile], extremes_of([Motion(series, 0.01, vertical=vertical)], 1.0)
        )
        assert top.median == pytest.approx(g * (0.5 * 0.9 - weight * 0.16) / 1.8)
        assert lower.median == pytest.approx(top.median * 1.5)
        assert lower.height == pytest.approx(1.2)
    weak, _ = anchor_forces([profile], extremes_of([Motion(series, 0.01)], 0.3))
    assert weak.median == 0.0  # 0.15 g is less than b/h = 0.178 g
    # on a tilt the corner below is nearer to lifting: without shaking tan β < b/h needs no force
    leaning = replace(profile, tilt=math.radians(5.0))
    still, _ = anchor_forces([leaning], extremes_of([Motion(0 * series, 0.01)], 1.0))
    assert still.median == 0.0
    tilted, _ = anchor_forces([leaning], extremes_of([Motion(series, 0.01)], 1.0))
    b = math.radians(5.0)
    along = 0.5 * math.cos(b) + math.sin(b)  # downhill, with the push that adds to it
    normal = math.cos(b) - 0.5 * math.sin(b)
    assert tilted.median == pytest.approx(g * (along * 0.9 - normal * 0.16) / 1.8)


def test_the_hull_of_the_accelerations_is_enough() -> None:
    rng = np.random.default_rng(0)
    profile = Profile(
        item=BOOKCASE, direction=Direction.FRONT_TO_BACK, body=BOOKCASE.body, tilt=0.05
    )
    for count in (3, 200):
        motion = Motion(rng.normal(0, 4, count), 0.01, vertical=rng.normal(0, 4, count))
        top, _ = anchor_forces([profile], extremes_of([motion], 1.3))
        push = 1.3 * np.r_[motion.horizontal, -motion.horizontal]
        weight = g + 1.3 * np.r_[motion.vertical, motion.vertical]
        along = -push * math.cos(0.05) - weight * math.sin(0.05)
        normal = push * math.sin(0.05) - weight * math.cos(0.05)
        brute = (np.abs(along) * 0.9 + normal * 0.16).max() / 1.8
        assert top.median == pytest.approx(brute, rel=1e-12)


def test_forces_are_quantiles_over_the_motions() -> None:
    peaks = np.arange(1, 11) / 10.0
    profile = Profile(item=BOOKCASE, direction=Direction.FRONT_TO_BACK, body=BOOKCASE.body)
    shaken = [Motion(peak * g * np.array([0.0, 1.0, 0.0]), 0.01) for peak in peaks]
    top, _ = anchor_forces([profile], extremes_of(shaken, 1.0))
    assert top.median == pytest.approx(g * (0.5 * 0.9 - 0.16) / 1.8)
    assert top.high == pytest.approx(g * (0.9 * 0.9 - 0.16) / 1.8)


def test_frictions(motions: list[Motion]) -> None:
    squat = Item(body=Body.rectangle(0.35, 1.0, name="box"), height=1.0)  # b/h = 0.35
    slender = Item(body=Body.rectangle(0.2, 1.5, name="pole"), height=1.5)
    box, pole = assess([squat, slender], motions, scale=1.6, progress=False).results
    assert [each.friction for each in box.frictions] == list(FRICTIONS)
    for result, item in ((box, squat), (pole, slender)):
        for each in result.frictions:
            model = General(static_friction=each.friction)
            assert each.fall.value == share(item.body, motions, scales=[1.6], model=model)
    assert box.frictions[0].fall.value == 0.0  # below b/h it only slides
    assert box.friction_decides
    assert not pole.friction_decides
    # a friction that is given is compared with the others, so that a low one hides no falls
    given = General(static_friction=0.3)
    (held,) = assess([squat], motions, scale=1.6, model=given, progress=False).results
    assert held.friction == 0.3
    assert [each.friction for each in held.frictions] == [0.5, 0.7]
    assert held.fall.value == 0.0
    assert held.risk == box.risk
    assert "With the friction of 0.3" in what_friction_does(held)
    # locked castors as well
    locked = replace(squat, castors=Castors.LOCKED)
    slippery = CastorFriction(locked=0.3)
    (cart,) = assess([locked], motions, scale=1.6, castors=slippery, progress=False).results
    assert cart.falls == 0
    assert cart.risk == NOT_CLASSED  # on feet a plane says too little
    free = replace(squat, castors=Castors.FREE)
    (loose,) = assess([free], motions, scale=1.6, castors=slippery, progress=False).results
    assert loose.locked is not None
    assert loose.locked.fall.value == max(each.fall.value for each in box.frictions)


def test_castors_roll(motions: list[Motion]) -> None:
    trolley = replace(BOOKCASE, castors=Castors.FREE)
    (found,) = assess([trolley], motions, progress=False).results
    assert found.sliding is not None
    assert found.falls == 0
    assert found.risk == NOT_CLASSED
    assert found.curves is None
    runs = simulate_many(
        [BOOKCASE.body], motions, model=General(static_friction=0.02), progress=False
    )
    farthest = np.maximum(runs.slip_downhill, runs.slip_uphill).values.ravel()
    far = float((farthest > 0.5).mean())
    assert found.governing_share.value == found.sliding.far.value == far > 0.0
    # locked, it may fall: that is told beside the advice to lock
    assert found.locked is not None
    assert found.locked.fall.value == share(
        BOOKCASE.body, motions, model=General(static_friction=0.4)
    )
    assert found.sliding.far[1:] == pytest.approx(wilson_interval(far, 12))
    grip = CastorFriction(free=0.2, locked=0.4)
    (less,) = assess([trolley], motions, castors=grip, progress=False).results
    assert less.sliding is not None
    assert less.sliding.slip.median < found.sliding.slip.median
    locked = replace(BOOKCASE, castors=Castors.LOCKED)
    (held,) = assess([locked], motions, progress=False).results
    assert held.fall == found.locked.fall
    # a plane says too little of what is on feet; it orders by falls and by going far together
    assert held.risk == NOT_CLASSED
    assert held.sliding is not None
    assert held.governing_share == held.sliding.falls_or_far
    assert held.governing_share.value == held.fall.value + held.sliding.far.value


def test_levels(motions: list[Motion]) -> None:
    levels = [Level(name="half", scale=0.5), Level(name="whole", scale=1.0)]
    found = assess([BOOKCASE], motions, levels=levels, progress=False)
    (result,) = found.results
    assert [each.fall.value for each in result.levels] == [
        share(BOOKCASE.body, motions, scales=[0.5]),
        result.fall.value,
    ]
    assert list(found.table.filter(like="share_at_whole")) == ["share_at_whole"]


def test_the_anchor_holds_in_both_directions() -> None:
    still = [Motion(g * np.array([0.0, 0.6, 0.0]), 0.01)]
    deep = replace(BOOKCASE, body=BOOKCASE.sideways, sideways=BOOKCASE.body)
    for item in (BOOKCASE, deep):
        (found,) = assess([item], still, progress=False).results
        assert found.anchor_forces[0].largest == pytest.approx(g * (0.6 * 0.9 - 0.16) / 1.8)


def test_a_square_base_must_be_wider_both_ways(motions: list[Motion]) -> None:
    square = Item(body=Body.rectangle(0.23, 1.6), height=1.6, sideways=Body.rectangle(0.23, 1.6))
    one = assess([square], motions, progress=False)
    (found,) = one.results
    assert found.falls_either_way
    said = " ".join(what_to_do(found, one))
    assert f"{found.safe_base:.2f} m deep and {found.safe_base:.2f} m wide" in said
    assert "A tilt is no measure here" in said
    assert safe_base(found) == f"{found.safe_base:.2f}×{found.safe_base:.2f}"
    # nearly square: each direction has its own
    nearly = replace(square, sideways=Body.rectangle(0.25, 1.6))
    (found,) = assess([nearly], motions, progress=False).results
    assert found.other is not None
    assert not np.isnan(found.other.safe_base)
    said = " ".join(what_to_do(found, one))
    assert f"{found.safe_base:.2f} m " in said
    assert f"{found.other.safe_base:.2f} m " in said
    assert " deep" in said
    assert " wide" in said


def test_walking_off_is_told_of_the_direction_with_a_support(motions: list[Motion]) -> None:
    item = Item(
        body=Body.rectangle(0.5, 1.0, name="cabinet"),
        height=1.0,
        sideways=Body.rectangle(0.25, 1.0, name="cabinet"),
        support_length=0.52,
    )
    found = assess([item], motions, model=General(static_friction=0.3), scale=4.0, progress=False)
    (result,) = found.results
    assert result.profile.direction is Direction.SIDE_TO_SIDE
    assert result.along_support.sliding is not None
    assert found.table["walks_off_share"][0] == result.along_support.sliding.walks_off > 0.1
    assert any("rim" in line for line in what_to_do(result, found))


def test_what_walks_off_is_no_low_risk(motions: list[Motion]) -> None:
    vase = Item(body=Body.rectangle(0.1, 0.2, name="vase"), height=0.2, support_length=0.12)
    model = General(static_friction=0.1)
    one = assess([vase], motions, model=model, progress=False)
    (found,) = one.results
    assert found.falls == 0
    assert found.sliding is not None
    assert found.sliding.walks_off > 0.1
    assert found.governing_share == found.sliding.falls_or_off
    assert found.governing_share.value == found.sliding.walks_off
    assert found.risk in ("medium", "high")
    assert first_measure(found, one.premises) == "keep it on its support"
    assert "rim" in what_to_do(found, one)[0]


def test_a_tilt_is_not_for_castors_and_says_so(
    motions: list[Motion], caplog: pytest.LogCaptureFixture
) -> None:
    cart = replace(BOOKCASE, castors=Castors.FREE)
    (tilted,) = assess([cart], motions, tilt=math.radians(2.0), progress=False).results
    (level,) = assess([cart], motions, progress=False).results
    assert tilted.sliding == level.sliding
    assert "is simulated on a level floor, not on a tilt of 2°" in caplog.text


def test_no_share_lies_outside_its_own_interval() -> None:
    # Wilson's limits reach 0 and 1 there; round-off does not
    for n in range(1, 300):
        assert wilson_interval(0.0, n)[0] == 0.0
        assert wilson_interval(1.0, n)[1] == 1.0
    still = [Motion(0.01 * np.sin(np.arange(50.0) + k), 0.01) for k in range(12)]
    flat = Item(body=Body.rectangle(0.5, 1.0), height=1.0)
    assert not assess([flat], still, progress=False).results[0].friction_decides


def test_castors_take_the_models_impacts(motions: list[Motion]) -> None:
    model = General(static_friction=0.4, restitution_factor=0.5)
    locked = replace(BOOKCASE, castors=Castors.LOCKED)
    plain = replace(BOOKCASE, body=replace(BOOKCASE.body, name="plain"))
    one, other = assess([locked, plain], motions, model=model, progress=False).results
    assert one.fall == other.fall


@pytest.mark.parametrize(
    "make",
    [
        lambda: Level(name="none", scale=0.0),
        lambda: CastorFriction(free=-0.1),
        lambda: CastorFriction(locked=math.nan),
        lambda: Weights(critical=-1.0),
        lambda: Weights(blocks_exit=math.inf),
    ],
)
def test_settings_that_cannot_be(make: Callable[[], object]) -> None:
    with pytest.raises(InputError):
        make()


def test_order_and_weights(motions: list[Motion]) -> None:
    plain = replace(BOOKCASE, body=Body.rectangle(0.32, 1.8, name="plain"))
    vital = replace(BOOKCASE, body=Body.rectangle(0.36, 1.8, name="vital"), critical=5)
    never = [
        Item(body=Body.rectangle(3.0, 0.5, name=name), height=0.5, people_nearby=people)
        for name, people in (("low", False), ("low with people", True))
    ]
    found = assess([plain, *never, vital], motions, progress=False)
    # ties of objects that never fall go by the upper end of the interval times the weight
    names = [result.item.name for result in found.ranked()]
    assert names == ["vital", "plain", "low with people", "low"]
    alone = assess([plain, vital], motions, weights=Weights(critical=0.0), progress=False)
    assert [result.item.name for result in alone.ranked()] == ["plain", "vital"]
    assert Weights().of(replace(vital, blocks_exit=True, must_not_fall=True)) == 1 + 5 + 3 + 3


def test_anchored_objects_are_listed_and_not_simulated(motions: list[Motion]) -> None:
    fixed = replace(BOOKCASE, body=Body.rectangle(0.1, 2.0, name="fixed"), anchored=True)
    found = assess([fixed, BOOKCASE], motions[:2], progress=False)
    assert [item.name for item in found.anchored] == ["fixed"]
    assert [result.item.name for result in found.results] == ["bookcase"]
    assert [result.number for result in found.results] == [2]  # in the list, the fixed one too
    with pytest.raises(InputError, match="every object is anchored"):
        assess([fixed], motions[:2], progress=False)


def test_results_are_numbered_as_their_items_on_any_floor(motions: list[Motion]) -> None:
    house = Building(name="house", floors={"0": motions[:2], "1": motions[2:4]}, told="as computed")
    items = [replace(BOOKCASE, floor=floor) for floor in ("1", "0", "1")]
    found = assess(items, house, progress=False)
    assert [result.number for result in found.results] == [2, 1, 3]
