"""Results in words: their facts, and what they must never say."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from shaketable import Body, Motion, Strap, Surroundings
from shaketable.assess import (
    FEW_FALLS,
    NOT_CLASSED,
    PREMISES,
    AnchorForce,
    Assessment,
    Direction,
    FloorAssessment,
    FrictionResult,
    ItemResult,
    LevelResult,
    Mitigation,
    MitigationKind,
    Profile,
    Quartiles,
    Share,
    Sides,
    Sliding,
    SolidResult,
    StrapForce,
    SurroundedResult,
    Walls,
    assess,
)
from shaketable.inventory import Castors, Item
from shaketable.models import Rocking
from shaketable.report import first_part, terminal
from shaketable.report.words import (
    advice,
    answer,
    findings,
    headline,
    method,
    mitigation,
    straps,
)
from shaketable.report.words.numbers import (
    distance,
    expected_count,
    in_hundred,
    in_hundred_short,
    limits_in_hundred,
    of_pieces,
    two_digits,
    with_interval,
)
from shaketable.tilting import TiltCurves

NOTHING = np.zeros(3)
CURVES = TiltCurves(
    tilts=NOTHING,
    downhill_share=NOTHING,
    downhill_band=(NOTHING, NOTHING),
    fall_share=NOTHING,
    fall_band=(NOTHING, NOTHING),
    control_tilt=math.radians(2.0),
    control_tilt_interval=(math.radians(1.5), math.radians(2.6)),
    fall_share_there=0.62,
    fall_share_there_interval=(0.5, 0.7),
)
ITEM = Item(body=Body.rectangle(0.32, 1.8, name="shelf"), height=1.8)
PROFILE = Profile(item=ITEM, direction=Direction.FRONT_TO_BACK, body=ITEM.body)
RESULT = ItemResult(
    profile=PROFILE,
    simulations=88,
    recordings=22,
    falls=44,
    falls_downhill=22,
    fall=Share(0.5, 0.4, 0.6),
    downhill=Share(0.5, 0.4, 0.6),
    peak_rotation=Quartiles(*np.radians([10.0, 20.0, 90.0])),
    curves=CURVES,
    safe_base=0.48,
    anchor_forces=(AnchorForce(1.8, 0.9, 1.7, 2.0), AnchorForce(1.2, 1.35, 2.55, 3.0)),
)
QUIET = replace(RESULT, falls=0, falls_downhill=0, fall=Share(0.0, 0.0, 0.149))


def one(result: ItemResult, control: float = 0.95) -> Assessment:
    """The assessment of one object."""
    floor = FloorAssessment(
        floor="", results=[result], motions=["m"], recordings=22, smallest_pga=1.0, largest_pga=2.0
    )
    return Assessment(floors=[floor], control=control, tilt=0.0, scale=1.0, model=Rocking())


def to_do(result: ItemResult, control: float = 0.95) -> list[str]:
    """What is advised."""
    return advice.what_to_do(result, one(result, control))


def first(result: ItemResult) -> str:
    return advice.first_measure(result, PREMISES["hospital"])


def happens(result: ItemResult) -> str:
    return " ".join(answer.what_happens(result))


def of(item: Item, result: ItemResult = RESULT, **changes: object) -> ItemResult:
    """A result of another item."""
    profile = replace(PROFILE, item=item, body=item.body, **changes)
    return replace(result, profile=profile)


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.0, "0"), (0.004, "less than 1"), (0.236, "24"), (0.995, "more than 99"), (1.0, "100")],
)
def test_in_hundred(share: float, text: str) -> None:
    assert in_hundred(share) == text


def test_numbers() -> None:
    # limits are rounded away from the share: zero of 20 and of 22 recordings, and what is whole
    assert limits_in_hundred(Share(0.0, 0.0, 0.1611)) == ("0", "17")
    assert limits_in_hundred(Share(0.0, 0.0, 0.1487)) == ("0", "15")
    assert limits_in_hundred(Share(0.2, 0.07, 0.15)) == ("7", "15")
    assert with_interval(Share(0.825, 0.589, 0.921)) == "83 (58–93)"  # halves are rounded up
    assert with_interval(Share(0.004, 0.0, 0.125)) == "<1 (0–13)"
    assert in_hundred_short(math.nan) == "–"
    # of 47 pieces, 0 to 0.1611 of which are 0 to 7.6
    assert of_pieces(Share(0.0, 0.0, 0.1611), 47) == "none (0–8)"
    assert of_pieces(Share(0.5, 0.3, 0.7), 47) == "24 (14–33)"
    assert [two_digits(x) for x in (0.0, 0.0856, 0.994, 9.96, 14.7, 1234.0)] == [
        "0", "0.086", "0.99", "10", "15", "1,200",
    ]  # fmt: skip
    assert distance(1.234) == "1.2 m"


def test_what_happens() -> None:
    assert happens(RESULT).startswith(
        "Falls in 50 of 100 such shakings (likely between 40 and 60). "
    )
    said = happens(QUIET)
    assert "none of 88 simulated shakings from 22 independent recordings" in said
    assert "up to 15 in 100 cannot be excluded" in said
    still = happens(replace(QUIET, peak_rotation=Quartiles(0.0, 0.0, 0.0)))
    assert "did not rock" in still


@pytest.mark.parametrize("recordings", [2, 9])
def test_few_recordings_decide_nothing(recordings: int) -> None:
    few = replace(QUIET, recordings=recordings, simulations=2 * recordings)
    assert few.risk == NOT_CLASSED
    assert "decide nothing" in happens(few)
    assert first(few) == "use more recordings"
    # no force, distance or locking is advised from so few
    for item in (ITEM, replace(ITEM, castors=Castors.FREE), replace(ITEM, must_not_fall=True)):
        (said,) = to_do(of(item, few))
        assert "Nothing is decided by so few motions" in said
        assert not any(unit in said for unit in (" N ", " m ", " cm", "of 100"))


def test_classes_hang_on_the_number_of_recordings() -> None:
    # zero falls of 22 recordings exclude no more than 15 in 100: that is no low risk
    assert QUIET.risk == FEW_FALLS
    assert findings.risk_in_words(QUIET) == (
        "did not fall in 22 recordings; up to 15 in 100 cannot be excluded"
    )
    once = replace(QUIET, falls=1, fall=Share(1 / 88, 0.0, 0.171))
    assert once.risk == FEW_FALLS
    assert findings.risk_in_words(once) == (
        "fell in 1 of 100 shakings from 22 recordings; up to 18 in 100 cannot be excluded"
    )
    assert findings.risk_in_words(RESULT) == "high risk"
    # zero falls of 125: Wilson's upper limit is below the 3 % of a low risk; of 124 it is not
    assert replace(QUIET, recordings=125, fall=Share(0.0, 0.0, 0.0298)).risk == "low"
    assert replace(QUIET, recordings=125, fall=Share(0.0, 0.0, 0.0301)).risk == "medium"
    assert replace(QUIET, recordings=124, fall=Share(0.0, 0.0, 0.0301)).risk == FEW_FALLS
    assert replace(RESULT, recordings=22).risk == "high"


def test_what_earns_no_green_card() -> None:
    assert of(replace(ITEM, depth_known=False), QUIET).risk == NOT_CLASSED
    assert of(replace(ITEM, depth_known=False), RESULT).risk == "high"  # bad news needs no proof
    assert of(replace(ITEM, castors=Castors.FREE), QUIET).risk == NOT_CLASSED
    assert of(replace(ITEM, castors=Castors.UNKNOWN), QUIET).risk == NOT_CLASSED
    slips = FrictionResult(0.3, Share(0.4, 0.2, 0.6), 0.1)
    assert replace(QUIET, frictions=(slips,)).risk == "high"


@pytest.mark.parametrize("recordings", [5, 22, 124, 125, 500])
def test_nothing_is_ever_said_to_be_safe_or_in_no_need(recordings: int) -> None:
    quiet = replace(QUIET, recordings=recordings, fall=Share(0.0, 0.0, 0.02))
    items = (ITEM, replace(ITEM, castors=Castors.FREE), replace(ITEM, depth_known=False))
    for item in items:
        shown = of(item, quiet)
        said = " ".join(
            [
                happens(shown),
                *to_do(shown),
                first(shown),
            ]
        ).lower()
        for word in ("nothing is needed", "safe", "wide enough", "no risk"):
            assert word not in said


def test_the_other_direction() -> None:
    assert "width is not known" in findings.other_direction(RESULT)
    assert "depth is not known" in findings.other_direction(of(replace(ITEM, depth_known=False)))
    assert "it is the same" in findings.other_direction(of(ITEM, alike=True))
    sideways = replace(PROFILE, direction=Direction.SIDE_TO_SIDE, body=Body.rectangle(0.9, 1.8))
    both = replace(RESULT, other=replace(QUIET, profile=sideways))
    assert "front to back" in happens(both)
    assert findings.other_direction(both) == "Side to side, on its base of 0.9 m, it fell in none."


def test_which_way() -> None:
    # on a level support a symmetric body falls both ways alike: that needs no interval
    assert findings.which_way(RESULT) == "By symmetry as many falls go forward as backward."
    askew = replace(ITEM, body=Body.rectangle(0.32, 1.8, eccentricity=0.4))
    assert "about as often" in findings.which_way(of(askew))
    seldom = replace(of(askew), downhill=Share(0.1, 0.05, 0.2))
    assert findings.which_way(seldom) == ("90 of 100 falls go backward (likely between 80 and 95).")
    sideways = replace(seldom, profile=replace(seldom.profile, direction=Direction.SIDE_TO_SIDE))
    assert "to the right" in findings.which_way(sideways)
    leaning = replace(of(ITEM, tilt=math.radians(3.0)), downhill=Share(0.9, 0.8, 0.95))
    assert findings.which_way(leaning) == (
        "90 of 100 falls go downhill (forward) (likely between 80 and 95)."
    )
    assert "Too few" in findings.which_way(replace(RESULT, falls=3))
    assert findings.which_way(replace(RESULT, falls=0)) == ""


def test_friction() -> None:
    agrees = FrictionResult(0.7, Share(0.5, 0.4, 0.6), 0.0)
    slides = FrictionResult(0.3, Share(0.02, 0.0, 0.15), 0.123)
    assert findings.what_friction_does(replace(RESULT, frictions=(agrees,))) == ""
    said = findings.what_friction_does(replace(RESULT, frictions=(slides, agrees)))
    assert "with a friction of 0.3 it falls in 2 of 100 and slides by 12 cm" in said
    assert "from 0.7 on friction changes nothing" in said
    assert "was not simulated" in findings.what_friction_does(replace(RESULT, frictions=(slides,)))


def test_order_of_advice() -> None:
    anchor, base, move, tilt = to_do(RESULT)
    assert anchor.startswith("Anchor it")
    # no static force is told where somebody may buy a strap by it
    assert anchor.endswith("What a strap must bear was not simulated.")
    assert "0.48 m deep in place of 0.32 m" in base
    assert move.startswith("Or move it")
    # 0.32 m sin 2° = 11.2 mm
    assert "tilt of 2.0° makes falls likelier, 62 in place of 50 of 100" in tilt
    assert tilt.index("likelier") < tilt.index("95 of 100 falls")
    assert "11 mm" in tilt
    assert "likely between 1.5° and 2.6°" in tilt


def test_the_inventory_says_why_to_anchor() -> None:
    seldom = replace(RESULT, fall=Share(0.05, 0.0, 0.1), falls=4)
    near = replace(ITEM, people_nearby=True, blocks_exit=True)
    assert "Anchor it: people are near it and it would block a way out." in " ".join(
        to_do(of(near, seldom))
    )
    assert first(of(near, seldom)) == "anchor it"


def test_what_has_no_depth_is_told_nothing_good() -> None:
    blind = of(replace(ITEM, depth_known=False), QUIET)
    assert happens(blind).startswith("Nothing can be said.")
    assert "cannot be excluded" not in happens(blind)
    (said,) = to_do(blind)
    assert "depth_m" in said
    assert first(blind) == "fill in column depth_m"
    rolling = of(replace(ITEM, castors=Castors.UNKNOWN), QUIET)
    assert happens(rolling).startswith("If it stands on no castors: ")


def test_a_tilt_is_not_said_to_cost_what_it_does_not() -> None:
    gentle = replace(RESULT, curves=replace(CURVES, fall_share_there=0.5))
    said = to_do(gentle)[-1]
    assert "likelier" not in said
    assert "leaves 50 falls in 100, 50 without it" in said


def test_no_tilt_for_what_must_not_fall() -> None:
    said = to_do(of(replace(ITEM, must_not_fall=True)))
    (only,) = said
    # nothing that lets it fall
    assert "anchor or strap it near its top. What a strap must bear was not simulated." in only
    assert "°" not in only
    assert "of 100" not in only


NONE = Share(0.0, 0.0, 0.149)
SOLID = SolidResult(
    simulations=160, recordings=22, falls=88, level=LevelResult(RESULT.fall, RESULT.fall),
    sides=Sides(0.5, 0.5, 0.0, 0.0), turned=(), frictions=(), not_settled=0,
    moved=Quartiles(0.0, 0.0, 0.0), yaw=Quartiles(0.0, 0.0, 0.0),
)  # fmt: skip


def strap(wall_gap: float, high: float, held_up: float = 0.0) -> Mitigation:
    """A strap in which it falls in none of 22 recordings, and which alone holds it up in some."""
    about = {
        "stiffness_per_mass": 2000.0, "slack_m": 0.02, "height_m": 1.8, "wall_gap_m": wall_gap
    }  # fmt: skip
    force = StrapForce(high / 2, high, 2 * high)
    held = Share(held_up, 0.0, 0.4) if held_up else NONE
    return Mitigation(MitigationKind.STRAP, about, 80, NONE, held, held, force)


BASE = Mitigation(
    MitigationKind.BASE, {"depth_m": 0.48, "width_m": 0.9}, 80,
    Share(0.09, 0.03, 0.25), Share(0.0, 0.0, 0.15), Share(0.09, 0.03, 0.25),
)  # fmt: skip
PAD = Mitigation(
    MitigationKind.PAD, {"holds_weights": 0.25}, 80,
    Share(0.5, 0.4, 0.6), Share(0.0, 0.0, 0.15), Share(0.5, 0.4, 0.6),
)  # fmt: skip
TRIED = replace(
    RESULT,
    solid=SOLID,
    mitigations=(BASE, strap(math.nan, 1.73, 0.04), strap(0.01, 0.72, 0.02), PAD),
)


def test_measures_are_ranked_by_what_they_leave() -> None:
    """The strap beside a wall, and what it leaves without one; what does not help comes last."""
    best, base, none, move = to_do(TRIED)
    assert best == (
        "Strap it to the wall (a strap for each, whose hooks and anchors hold 0.72 "
        "times its weight in 90 of 100 shakings, 1.5 times in all (710 N and 1.5 kN if it weighs "
        "100 kg)): from 50 to 2 of 100 (0–40); it falls in 0, and only its wall or strap "
        "holds it up in 2. In 90 of 100 shakings "
        "the strap bears at most 0.72 times its weight beside a wall and 1.7 times its weight to a "
        "post or a ceiling, without a wall behind it (stiffness 200 kN/m for each 100 kg, slack "
        "20 mm); hooks and walls "
        "were taken as unbreakable. Without a wall behind it, it falls or only the strap holds it "
        "up in 4 of 100."
    )
    assert base == (
        "Give it a larger base (a plate or feet, 0.48 m deep and 0.90 m wide): from 50 to 9 of 100 "
        "(3–25)."
    )
    assert (
        none
        == "Tried without clear benefit: put it on adhesive pads (from 50 to 50 of 100 (40–60))."
    )
    assert move.startswith("Or move it")
    assert first(TRIED) == "strap it to the wall"


def test_what_anybody_may_do_instead_is_named_beside_a_craftsman_s_work() -> None:
    """Where it leaves less than half; pads that leave 20 of 50 do, those that leave 36 do not."""
    pads = PAD._replace(fall=Share(0.2, 0.1, 0.3), left=Share(0.2, 0.1, 0.3))
    tried = replace(TRIED, mitigations=(strap(math.nan, 1.73, 0.04), pads))
    (row,) = first_part.rows(one(tried), [tried])
    assert row.who == "a craftsman"
    assert row.holds
    assert row.instead == "or put it on adhesive pads: from 50 to 20 of 100 (10–30)"
    weak = pads._replace(left=Share(0.36, 0.3, 0.45))
    few = replace(tried, mitigations=(strap(math.nan, 1.73, 0.04), weak))
    assert first_part.rows(one(few), [few])[0].instead == ""
    easy = replace(tried, mitigations=(pads,))
    (alone,) = first_part.rows(one(easy), [easy])
    assert (alone.who, alone.instead, alone.holds) == ("anybody", "", False)
    assert "Above 3.2 kN for 90 of 100 it is for an engineer" in method.forces()


def test_a_room_tells_what_rolls_far_beside_what_falls() -> None:
    """Of 3 carts in 30 of 100 shakings: 0.9 on average; Wilson's interval of 30 of 100, n = 20."""
    cart = of(replace(ITEM, castors=Castors.FREE, quantity=3, location="ward"), TRIED)
    level = LevelResult(Share(0.1, 0.0, 0.3), Share(0.4, 0.2, 0.6))
    cart = replace(cart, solid=SOLID._replace(level=level, surrounded=None), mitigations=())
    (ward,) = first_part.places(one(cart), None)
    assert ward.told.startswith("0.3 (0–1) of 3 pieces fall on average, and 0.9 (0–2) roll far")
    still = replace(
        cart, solid=cart.solid._replace(level=level._replace(governing_share=level.fall))
    )
    (ward,) = first_part.places(one(still), None)
    assert ward.told == "0.3 (0–1) of 3 pieces fall on average"


def test_forces_are_told_in_newtons_where_the_mass_is_known() -> None:
    # 1.73 × 40 kg × 9.80665 m/s² = 678.6 N, 1.73 × 210 kg of that 3.563 kN; what is to be held is
    # that beside a wall, 0.72 and 1.44 of the weight, rounded up: 282.4 and 564.9 N, 1.483 and
    # 2.966 kN
    for mass, told, hold, most in (
        (40.0, "(680 N)", "290 N", "570 N"), (210.0, "(3.6 kN)", "1.5 kN", "3.0 kN"),
    ):  # fmt: skip
        said = to_do(of(replace(ITEM, mass=mass), TRIED))[0]
        assert f"1.7 times its weight {told} to a post or a ceiling, without a wall" in said
        assert f"anchors hold {hold} in 90 of 100 shakings, {most} in all)" in said


def test_a_strap_that_no_wall_holds_is_told_by_what_it_bears_in_the_air() -> None:
    """Of what rolls, or where no wall was tried; and forces of two variants are the larger ones."""
    alone = replace(TRIED, mitigations=(strap(math.nan, 1.73),))
    assert straps.to_hold(MitigationKind.STRAP, alone) == StrapForce(0.865, 1.73, 3.46)
    stiff = strap(0.01, 0.5)._replace(force=StrapForce(0.3, 0.5, 2.1))
    both = replace(TRIED, mitigations=(strap(0.01, 0.72), stiff, strap(math.nan, 1.73)))
    assert straps.to_hold(MitigationKind.STRAP, both) == StrapForce(0.36, 0.72, 2.1)
    assert straps.to_hold(MitigationKind.TETHER, both) is None
    assert straps.strap_forces(both) == "0.72 (2.1)"


def test_who_may_do_it() -> None:
    hospital, museum = PREMISES["hospital"], PREMISES["museum"]
    pull = strap(math.nan, 1.73)
    assert mitigation.who(pull, TRIED, hospital) == "a craftsman"
    # beside the wall 90 of 100 ask for 0.72 × 460 kg × 9.80665 m/s² = 3.25 kN, above 3.2 kN, and
    # for 3.18 kN at 450 kg, whatever the largest force, and what it is without a wall
    assert mitigation.who(pull, of(replace(ITEM, mass=460.0), TRIED), hospital) == "an engineer"
    assert mitigation.who(pull, of(replace(ITEM, mass=450.0), TRIED), hospital) == "a craftsman"
    assert mitigation.who(PAD, TRIED, hospital) == "anybody"
    assert mitigation.who(PAD, TRIED, museum) == "a conservator"
    assert mitigation.short(PAD, ITEM, museum) == "fix it with wax or gel"
    assert mitigation.short(PAD, ITEM, hospital) == "put it on adhesive pads"


def test_what_must_not_fall_is_not_let_fall() -> None:
    kept = to_do(of(replace(ITEM, must_not_fall=True), TRIED))
    assert kept[0] == "It must not fall."
    assert not any("its fall hits nobody" in line for line in kept)


STRAPS = Surroundings(straps=(Strap(point=(0.16, 0, 1.8), anchor=(0.2, 0, 1.8), stiffness=5e4),))


def in_strap(
    fall: float = 0.0, held_up: float = 0.0, broke: float = 0.0, **item: Any
) -> ItemResult:
    """The result of an object that is strapped, in its strap."""
    either = Share(fall + held_up, 0.0, 0.7)
    held = SurroundedResult(
        Share(held_up, 0.0, 0.3), either, StrapForce(0.4, 0.9, 1.3), Share(broke, 0.0, 0.3)
    )
    level = LevelResult(Share(fall, 0.0, 0.5), either)
    solid = SolidResult(
        simulations=160, recordings=20, falls=round(160 * fall), level=level,
        sides=Sides(*(math.nan,) * 4), turned=(), frictions=(), surrounded=held, not_settled=0,
        moved=Quartiles(0.0, 0.0, 0.0), yaw=Quartiles(0.0, 0.0, 0.0),
    )  # fmt: skip
    thing = replace(ITEM, surroundings=STRAPS, **item)
    return of(thing, replace(RESULT, solid=solid))


def test_what_is_held_up_is_told_by_itself() -> None:
    found = in_strap(held_up=0.07, mass=50.0)
    said = happens(found)
    assert said.startswith(
        "Shaken in both horizontal directions at once, in its strap, it fell in none of 160"
    )
    assert "In 7 of 100 (likely between 0 and 30) only its wall or strap holds it up in the" in said
    assert "reaches 0.40 times its weight in half of the shakings, 0.90 times in 90 of 100" in said
    assert "and 1.3 times at most." in said
    assert findings.risk_in_words(found) == "medium risk" or found.risk == FEW_FALLS
    (headed,) = headline._held_up([replace(found, number=1)])
    assert headed.startswith("On average only a wall or a strap would hold up 0.1 more in the end")
    many = replace(
        found, number=2, profile=replace(found.profile, item=replace(found.item, quantity=30))
    )
    (headed,) = headline._held_up([replace(found, number=1), many])
    assert headed.startswith("On average only a wall or a strap would hold up 2.2 more")  # 31 × 7 %
    assert headline._held_up([in_strap(), RESULT]) == []


def test_advice_where_it_is_strapped() -> None:
    # 0.9 and 1.3 × 50 kg × 9.80665 m/s² = 441 and 637 N, rounded up
    (keep,) = to_do(in_strap(mass=50.0))
    assert keep.startswith("Keep it strapped: see that its strap, its hooks and what they are fast")
    assert "fastened to hold 450 N in 90 of 100 shakings, 640 N in all." in keep
    assert keep.endswith(", and so was the strap, whose strength the list does not give.")
    assert first(in_strap()) == "keep it strapped"
    better, move = to_do(in_strap(fall=0.1, held_up=0.2))
    assert better.startswith("Hold it better")
    assert move.startswith("Or move it")
    assert first(in_strap(held_up=0.2)) == "hold it better"
    stronger = to_do(in_strap(broke=0.25))[0]
    assert stronger == "Take a stronger strap: this one breaks in 25 of 100."
    assert first(in_strap(broke=0.25)) == "take a stronger strap"
    moving = in_strap()
    assert moving.solid is not None
    moving = replace(moving, solid=moving.solid._replace(not_settled=20))
    assert first(moving) == "keep it strapped"  # judged by whether it would fall, as what rests
    assert moving.risk == in_strap().risk
    rolls_on = replace(
        TRIED, solid=SOLID._replace(not_settled=20, falls=0, level=LevelResult(NONE, NONE))
    )
    assert findings.risk_in_words(rolls_on) == "still moves at the end too often, not classed"
    kept = in_strap(held_up=0.05, must_not_fall=True)
    assert first(kept) == "hold it better"
    unknown = in_strap(castors=Castors.UNKNOWN)
    assert first(unknown) == "fill in column castors"
    only = to_do(in_strap(held_up=0.05, must_not_fall=True))
    assert [each.partition(":")[0] for each in only] == ["It must not fall.", "Hold it better"]


def test_what_goes_over_an_edge_is_moved_back() -> None:
    found = in_strap(fall=0.3)
    solid = found.solid
    assert solid is not None
    assert solid.surrounded is not None
    over = solid.surrounded._replace(off=Share(0.25, 0.1, 0.5))
    found = replace(found, solid=solid._replace(surrounded=over))
    assert to_do(found)[0].startswith("Move it back from the edge of its support")
    assert "in 25 of 100 it goes over it" in to_do(found)[0]
    assert first(found) == "move it back from the edge"
    seldom = solid.surrounded._replace(off=Share(0.1, 0.0, 0.3))
    found = replace(found, solid=solid._replace(surrounded=seldom))
    assert first(found) != "move it back from the edge"


def test_advice_at_its_ends() -> None:
    def said(control: float = 0.95, tilt: float = 0.0, **curves: object) -> str:
        changed = replace(RESULT, curves=replace(CURVES, **curves))
        changed = replace(changed, profile=replace(PROFILE, tilt=tilt))
        return to_do(changed, control)[-1]

    assert "likely above 1.5°" in said(control_tilt_interval=(math.radians(1.5), math.inf))
    assert "99.9 of 100" in said(control=0.999)
    assert "already go forward" in said(tilt=math.radians(4.0))
    assert "already go forward" in said(control_tilt=0.0)
    assert "No tilt up to 10°" in said(control_tilt=math.nan)
    askew = replace(ITEM, body=Body.rectangle(0.32, 1.8, eccentricity=0.4))
    assert "turned round" in to_do(of(askew))[-1]
    hopeless = to_do(replace(RESULT, safe_base=math.nan))[1]
    assert "No base up to 6 times" in hopeless
    # a base is never widened from 0.32 to 0.32 m
    assert "0.32" not in to_do(replace(RESULT, safe_base=0.3204))[1]
    (rare,) = to_do(replace(RESULT, fall=Share(0.05, 0.0, 0.1), falls=4))
    assert rare.startswith("Anchor it where")
    (never,) = to_do(replace(QUIET, anchor_forces=(AnchorForce(1.8, 0.0, 0.0, 0.0),) * 2), 0.95)
    assert "does not begin to rock" in never


def test_castors() -> None:
    far = Sliding(
        share=0.9,
        slip=Quartiles(0.1, 0.3, 0.8),
        reach=1.2,
        far=Share(0.4, 0.2, 0.6),
        falls_or_far=Share(0.45, 0.2, 0.7),
        walks_off=math.nan,
        falls_or_off=Share(0.0, 0.0, 0.15),
    )
    cart = of(replace(ITEM, castors=Castors.FREE), replace(QUIET, sliding=far))
    assert cart.governing_share == far.falls_or_far
    said = findings.how_far_it_goes(cart)
    assert "rolls by 30 cm or more in half" in said
    assert "In 40 of 100 (likely between 20 and 60) it goes farther than 0.5 m" in said
    (tether,) = to_do(cart)
    assert "1.2 m around it clear: in 90 of 100 it goes no farther" in tether
    # locking is advised only where it makes nothing fall
    holds = replace(cart, locked=replace(QUIET, sliding=far._replace(reach=0.05)))
    assert "no farther than 5 cm" in to_do(holds)[1]
    falls = replace(cart, locked=replace(RESULT, sliding=far))
    assert "where they hold, it falls in 50 of 100" in to_do(falls)[1]
    locked = of(replace(ITEM, castors=Castors.LOCKED), replace(RESULT, sliding=far))
    assert locked.risk == NOT_CLASSED  # a plane says too little of what is on feet
    said = to_do(locked)
    assert said[0].startswith("Anchor it, or strap it")
    assert any("off its top" in line for line in said)


def test_headline(p695: list[Motion]) -> None:
    items = [
        Item(body=Body.rectangle(0.2, 1.5, name="tall"), height=1.5, quantity=4),
        Item(body=Body.rectangle(1.0, 0.5, name="flat"), height=0.5, quantity=6),
    ]
    result = assess(items, p695[:24], progress=False)
    first, second, crustal = headline.headline(result)
    assert "shallow crustal earthquakes" in crustal
    assert first.startswith("1 of 2 kinds of object (4 of 10 pieces)")
    assert "of these shakings" in first
    expected = 4 * result.table["fall_share"][0]
    assert f"{expected_count(expected)} (" in second
    assert "of 10 pieces" in second
    assert "12 independent recordings" in headline.how_sure(result)[0]
    few = assess(items[1:], p695[:2], progress=False)
    assert headline.headline(few)[0].startswith("This decides nothing")
    unknown = [replace(items[1], depth_known=False, castors=Castors.UNKNOWN)]
    blind = assess(unknown, p695[:24], progress=False)
    # of what has no depth nothing good is said, in the first sentence
    assert headline.what_falls(blind) == [
        "Of 1 kind of object nothing can be said, as the inventory gives no depth."
    ]
    said = headline.how_sure(blind)
    assert any("no depth" in line for line in said)
    assert any("may stand on castors" in line for line in said)


@pytest.mark.parametrize(
    ("label", "name"),
    [("3", "floor 3"), ("ground", "the ground floor"), ("Roof", "the roof"), ("2nd floor",) * 2],
)
def test_names_of_floors(label: str, name: str) -> None:
    assert headline.floor_name(label) == name


def test_no_tilt_is_told_where_it_is_no_measure() -> None:
    """What falls as well across a tilt: the card says so, and the terminal's table has a dash."""
    across = replace(RESULT, fall=Share(0.4, 0.3, 0.5))
    for result, told in ((RESULT, "2.00"), (replace(RESULT, other=across), "-")):
        assert terminal._tilt(result) == told
    assert "A tilt is no measure here" in advice._tilt(replace(RESULT, other=across), 0.95)


def test_what_leaves_about_as_much_is_no_help() -> None:
    """Measures are tried in half of the ways: 50 and 36 of 100 may be the same.

    And 40 of 50 is no help, however sure.
    """
    less = PAD._replace(fall=Share(0.36, 0.3, 0.55), left=Share(0.36, 0.3, 0.55))
    assert replace(TRIED, mitigations=(less,)).helpful == []
    clearly = less._replace(left=Share(0.36, 0.35, 0.45))
    assert replace(TRIED, mitigations=(clearly,)).helpful == [clearly]
    hardly = less._replace(left=Share(0.4, 0.35, 0.45))
    assert replace(TRIED, mitigations=(hardly,)).helpful == []


def test_what_falls_more_often_is_no_help_though_it_rolls_less_far() -> None:
    """Locked castors that trip a cart."""
    cart = of(replace(ITEM, castors=Castors.FREE), TRIED)
    locked = Mitigation(
        MitigationKind.LOCK, {"friction": 0.4}, 80, Share(0.7, 0.6, 0.8), NONE,
        Share(0.1, 0.05, 0.2),
    )  # fmt: skip
    tripped = replace(cart, mitigations=(locked,))
    assert first(tripped) == "nothing that was tried clearly helps"
    seldom = locked._replace(fall=Share(0.52, 0.4, 0.65))  # no more than chance
    assert replace(cart, mitigations=(seldom,)).helpful == [seldom]
    assert tripped.overturns.value < 0.7
    assert tripped.helpful == []
    assert "it falls in 70 instead of 50" in mitigation.outcome(locked, tripped)


def test_what_is_held_up_counts_before_and_after_a_measure() -> None:
    """A pad that leaves as much held up by the strap alone as there is helps nothing."""
    half = Share(0.5, 0.4, 0.6)
    as_much = PAD._replace(fall=NONE, held_up=half, left=half)
    found = replace(in_strap(fall=0.0, held_up=0.5), mitigations=(as_much,))
    assert found.before.value == 0.5
    assert found.helpful == []
    assert mitigation.outcome(as_much, found) == (
        "from 50 to 50 of 100 (40–60); it falls in 0, and only its wall or strap holds it up in 50"
    )


def test_a_locked_cart_is_tethered_where_the_list_says_that_people_are_near() -> None:
    cart = replace(ITEM, castors=Castors.LOCKED)
    assert first(of(cart, QUIET)) == "tether it if it could hit somebody"
    assert first(of(replace(cart, people_nearby=True), QUIET)) == "tether it"


def test_what_falls_with_another_friction_alone() -> None:
    """It is never said that nothing overturns it."""
    solid = SOLID._replace(falls=0, level=LevelResult(NONE, NONE))
    near = of(replace(ITEM, people_nearby=True), replace(RESULT, solid=solid))
    assert "none of these shakings overturns it" in to_do(near)[0]
    slides = FrictionResult(0.7, Share(0.08, 0.01, 0.2), 0.1)
    told = to_do(replace(near, solid=solid._replace(frictions=(slides,))))[0]
    assert told.startswith("Anchor it all the same")
    assert told.endswith("with another friction some of these shakings overturn it.")


def test_the_floor_on_which_most_falls() -> None:
    """Of 7 pieces 50 of 100 fall, and of 3 none: 3.5 of 10."""
    some = of(replace(ITEM, quantity=7), RESULT)
    none = of(replace(ITEM, quantity=3), QUIET)
    low, high = (one(each).floors[0] for each in (none, some))
    floors = [replace(low, floor="1"), replace(high, floor="4")]
    said = " ".join(headline.headline(replace(one(some), floors=floors)))
    assert "of 10 pieces would fall, most of all on floor 4: 3.5 of 7 pieces there" in said


def test_a_wall_that_was_answered_is_not_left_out() -> None:
    """What is not considered names no walls then, and the first lines tell who has none."""
    free, walled = (replace(one(TRIED), walls=each) for each in (Walls.NO, Walls.YES))
    assert "walls, straps and edges that the list does not give" in method.not_considered(free)
    assert ": straps and edges that the list does not give" in method.not_considered(walled)
    told = " ".join(headline.assumed(walled))
    assert "not on castors, on furniture or near an edge" in told


def test_what_was_tried_and_does_not_help_is_not_advised() -> None:
    """A tether in which a cart falls more often than without; a pad that does nothing."""
    cart = of(replace(ITEM, castors=Castors.FREE), TRIED)
    tether = strap(math.nan, 8.0)._replace(
        kind=MitigationKind.TETHER, fall=Share(0.8, 0.6, 0.9), left=Share(0.8, 0.6, 0.9)
    )
    tethered = replace(cart, mitigations=(tether,))
    assert first(tethered) == "nothing that was tried clearly helps"
    assert mitigation.of_no_help(tethered, PREMISES["hospital"]) == (
        "With this it falls, or goes far, more often: tether it (from 50 to 80 of 100 (60–90); it "
        "falls in 80 instead of 50)."
    )
    assert first(replace(cart, mitigations=())) == "tether it"
    assert first(replace(TRIED, mitigations=(PAD,))) == "anchor it"
