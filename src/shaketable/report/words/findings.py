"""What was found about one object in a plane, and the class of any object."""

from __future__ import annotations

import math

from shaketable.assess import (
    FEW_FALLS,
    FEWEST_RECORDINGS,
    NOT_CLASSED,
    ROLLS_FAR,
    Direction,
    FrictionResult,
    ItemResult,
    ProfileResult,
    Share,
    Sliding,
)
from shaketable.criteria.overturning import HOUSNER, ISHIYAMA, KNOWN, RULE, UNKNOWN
from shaketable.errors import quoted
from shaketable.inventory import Castors
from shaketable.language import listed, tell, translated
from shaketable.report.words.numbers import (
    counted,
    distance,
    in_hundred,
    likely,
    limits_in_hundred,
)
from shaketable.tilting import FEWEST_FALLS, SLIDES
from shaketable.units import degrees

#: Where -x and +x are for somebody who looks at the object's front.
SIDES = {
    Direction.FRONT_TO_BACK: ("forward", "backward"),
    Direction.SIDE_TO_SIDE: ("to the left", "to the right"),
}
CRITERIA = {
    ISHIYAMA: "Ishiyama's conditions, as if it were symmetric",
    KNOWN: "Boroschek and Romo's conditions for its eccentricity",
    UNKNOWN: "Boroschek and Romo's condition for an unknown eccentricity",
    RULE: "the rule fitted to FEMA P-695",
}


def in_a_plane(result: ItemResult, sources: str = "recordings") -> list[str]:
    """What becomes of an object of which a plane decides, in sentences.

    Args:
        result: of an item.
        sources: what the independent motions are.
    """
    said = (
        on_condition(result) + _how_often(result, sources),
        other_direction(result),
        which_way(result),
        how_far_it_goes(result),
        what_friction_does(result),
    )
    return [each for each in said if each]


def on_condition(result: ItemResult) -> str:
    """What must be so for the numbers that follow to hold."""
    if result.item.castors is Castors.UNKNOWN:
        return tell("If it stands on no castors: ")
    if result.item.may_be_round:
        return tell("If it is not round: ")
    around = result.item.surroundings
    if around is not None and not result.solid:
        return tell("Without what surrounds it, in a plane: ")
    if result.item.support_length is not None or (around is not None and around.edge):
        return tell("If what carries it does not move: ")
    return ""


def _how_often(result: ItemResult, sources: str) -> str:
    said = _falls(result, sources)
    return said + unsettled(result.not_settled, result.simulations)


def unsettled(count: int, simulations: int) -> str:
    """How many simulations were still moving at their end, in a sentence after that of the falls.

    They are counted neither as falls nor as standing in what is said.
    """
    if not count:
        return ""
    return tell(
        " In {count:,} of the {simulations:,} it had neither fallen nor come to rest at the end.",
        count=count,
        simulations=simulations,
    )


def risk_in_words(result: ItemResult) -> str:
    """The class of an object; of FEW_FALLS what was seen, and what cannot be excluded."""
    if result.risk == NOT_CLASSED and result.item.stands_on:
        return tell("stands on something that was not simulated, not classed")
    if result.risk == NOT_CLASSED and result.item.unread:
        return tell(
            "not classed, because {columns} could not be read",
            columns=listed([quoted(each) for each in result.item.unread]),
        )
    if result.risk == NOT_CLASSED and result.item.rolls:
        return tell("on castors, not classed")
    if result.risk == NOT_CLASSED and result.item.may_be_round:
        return tell("may be round, not classed")
    if result.risk == NOT_CLASSED and result.left_alone:
        return tell("not simulated as it is held, not classed")
    if result.risk == NOT_CLASSED and result.moves_on:
        return tell("still moves at the end too often, not classed")
    if result.risk == NOT_CLASSED:
        return translated(NOT_CLASSED)
    if result.risk != FEW_FALLS:
        return tell("{risk} risk", risk=translated(result.risk))
    share, recordings = result.governing_share, result.by
    limit = limits_in_hundred(share)[1]
    if not share.value:
        return tell(
            "did not fall in {recordings} recordings; up to {limit} in 100 cannot be excluded",
            recordings=recordings,
            limit=limit,
        )
    fell = tell("fell or leaned") if result.as_it_stands is not None else tell("fell")
    return tell(
        "{fell} in {often} of 100 shakings from {recordings} recordings; up to {limit} in 100 "
        "cannot be excluded",
        fell=fell,
        often=in_hundred(share.value),
        recordings=recordings,
        limit=limit,
    )


def _falls(result: ItemResult, sources: str) -> str:
    fall, direction = result.fall, result.profile.direction
    told = ""
    if result.other is not None:
        told = tell(", shaken {direction}", direction=translated(direction))
    if result.recordings < FEWEST_RECORDINGS:
        return tell(
            "Fell in {falls} of {simulations} simulated shakings{told}; they come from "
            "{recordings} and decide nothing.",
            falls=result.falls,
            simulations=result.simulations,
            told=told,
            recordings=counted(result.recordings, "independent recording"),
        )
    if not result.item.depth_known and not result.falls:
        return tell(
            "Nothing can be said. Were it as deep as its width of {width:.3g} m, it would fall in "
            "none of {simulations} simulated shakings.",
            width=result.profile.body.base,
            simulations=result.simulations,
        )
    if result.falls == 0:
        excluded = tell(
            "Fell in none of {simulations} simulated shakings from {recordings} independent "
            "{sources}; up to {limit} in 100 cannot be excluded.",
            simulations=result.simulations,
            recordings=result.recordings,
            sources=translated(sources),
            limit=limits_in_hundred(fall)[1],
        )
        return excluded + _rocking(result)
    return tell(
        "Falls in {often} of 100 such shakings{told} ({likely}).",
        often=in_hundred(fall.value),
        told=told,
        likely=likely(fall),
    )


def _rocking(result: ItemResult) -> str:
    if result.item.rolls:
        return ""
    median = degrees(result.peak_rotation.median)
    if not median:
        return tell(" In at least half of them it did not rock.")
    return tell(
        " In at least half of them it rocked by no more than about {angle:.2g}°.",
        angle=max(median, 0.01),
    )


def other_direction(result: ItemResult) -> str:
    """What is known of the other direction, and what is not."""
    item, other, profile = result.item, result.other, result.profile
    if other is not None:
        happens = tell("it fell in none")
        if other.falls and result.recordings < FEWEST_RECORDINGS:
            happens = tell(
                "it fell in {falls} of {simulations}",
                falls=other.falls,
                simulations=other.simulations,
            )
        elif other.falls:
            happens = tell("it falls in {often} of 100", often=in_hundred(other.fall.value))
        return tell(
            "{direction}, on its base of {width:.3g} m, {happens}.",
            direction=translated(other.profile.direction).capitalize(),
            width=other.profile.body.base,
            happens=happens,
        )
    if profile.alike:
        return tell("Front to back and side to side it is the same.")
    if not item.depth_known:
        return tell(
            "Its depth is not known, and its width of {width:.3g} m was taken for it: if it is "
            "less deep than wide, it falls more often than this.",
            width=profile.body.base,
        )
    return tell("Its width is not known: side to side nothing was simulated.")


def which_way(result: ItemResult) -> str:
    """Which way it falls in a plane."""
    if result.falls < FEWEST_FALLS:
        return tell("Too few falls to tell which way.") if result.falls else ""
    toward, away = map(translated, SIDES[result.profile.direction])
    if result.profile.tilt > 0.0:
        toward, away = tell("downhill ({side})", side=toward), tell("uphill ({side})", side=away)
    if result.profile.symmetric:
        return tell("By symmetry as many falls go {toward} as {away}.", toward=toward, away=away)
    share, low, high = result.downhill
    if abs(share - 0.5) < 0.05:
        return tell("It falls {toward} about as often as {away}.", toward=toward, away=away)
    side, often = toward, result.downhill
    if share <= 0.5:
        side, often = away, Share(1 - share, 1 - high, 1 - low)
    return tell(
        "{often} of 100 falls go {side} ({likely}).",
        often=in_hundred(often.value),
        side=side,
        likely=likely(often),
    )


def what_friction_does(result: ItemResult) -> str:
    """What sliding changes, and up to which friction; nothing where it changes nothing."""
    if not result.friction_decides:
        return ""
    each = [_with_friction(other) for other in result.frictions if result.differs(other)]
    last = max(other.friction for other in result.frictions if result.differs(other))
    from_on = [other.friction for other in result.frictions if other.friction > last]
    until = tell("what more friction does was not simulated")
    if from_on:
        until = tell("from {least:g} on friction changes nothing", least=min(from_on))
    return tell(
        "Friction decides. {present} it falls in {often} of 100; {others}; {until}.",
        present=_present_friction(result),
        often=in_hundred(result.fall.value),
        others="; ".join(each),
        until=until,
    )


def _with_friction(other: FrictionResult) -> str:
    """What another friction makes of the falls."""
    falls = tell(
        "with a friction of {friction:g} it falls in {often} of 100",
        friction=other.friction,
        often=in_hundred(other.fall.value),
    )
    if not other.slip > SLIDES:
        return falls
    far = distance(other.slip)
    return falls + tell(" and slides by {far} or more in half of the shakings", far=far)


def _present_friction(result: ItemResult) -> str:
    if math.isinf(result.friction):
        return tell("Where it cannot slide")
    if result.item.rolls:
        return tell(
            "With the friction of {friction:g} assumed for locked castors",
            friction=result.friction,
        )
    return tell("With the friction of {friction:g} that was given", friction=result.friction)


def what_criteria_miss(result: ItemResult) -> str:
    """A flag where a criterion calls the item safe and the simulation says that it falls.

    Housner's is left out, as it does not call safe what is below its limit.
    """
    missed = [
        f"{translated(CRITERIA[name])} {found.missed}"
        for name, found in (result.criteria or {}).items()
        if name != HOUSNER and found.missed
    ]
    if not missed:
        return ""
    return tell(
        "Simple criteria overlook some of its {falls} falls as simulated in a plane: {missed}.",
        falls=result.falls,
        missed="; ".join(missed),
    )


def how_far_it_goes(result: ItemResult) -> str:
    """Sliding or rolling in words; nothing where the model does not slide."""
    sliding, support = result.sliding, result.along_support
    if sliding is None or result.fall.value == 1.0 or result.recordings < FEWEST_RECORDINGS:
        return ""
    goes = translated("rolls" if result.item.castors is Castors.FREE else "slides")
    upright = tell("Where it does not fall, it") if result.fall.value else tell("It")
    return " ".join(
        part
        for part in (
            f"{upright} {_how_far(sliding, goes)}".strip(),
            _goes_far(sliding) if result.item.rolls and sliding.share else "",
            walks_off(support),
        )
        if part
    )


def _how_far(sliding: Sliding, goes: str) -> str:
    if sliding.share == 0.0:
        return tell("never {goes} by more than {cm:g} cm.", goes=goes, cm=100 * SLIDES)
    often = in_hundred(sliding.share)
    if sliding.slip.upper < SLIDES:
        return tell(
            "hardly ever {goes}: by more than {cm:g} cm in {often} of 100.",
            goes=goes,
            cm=100 * SLIDES,
            often=often,
        )
    return tell(
        "{goes} by {median} or more in half of the shakings and by {upper} or more in a quarter "
        "of them; it stays upright and {goes} by more than {cm:g} cm in {often} of 100.",
        goes=goes,
        median=distance(sliding.slip.median),
        upper=distance(sliding.slip.upper),
        cm=100 * SLIDES,
        often=often,
    )


def _goes_far(sliding: Sliding) -> str:
    return tell(
        "In {often} of 100 ({likely}) it goes farther than {far:g} m, where it may hit somebody or "
        "come off its hoses and cables.",
        often=in_hundred(sliding.far.value),
        likely=likely(sliding.far),
        far=ROLLS_FAR,
    )


def walks_off(result: ProfileResult) -> str:
    """How often it walks off a support of known length, which is known of a plane."""
    sliding, length = result.sliding, result.profile.support_length
    if sliding is None or length is None or math.isnan(sliding.walks_off):
        return ""
    if not sliding.walks_off:
        return tell("It stays on its support of {length:.2f} m.", length=length)
    return tell(
        "In {often} of 100 it walks off its support of {length:.2f} m.",
        often=in_hundred(sliding.walks_off),
        length=length,
    )
