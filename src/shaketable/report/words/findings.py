"""What was found about one object."""

from __future__ import annotations

import math

from shaketable.assess import (
    FEWEST_RECORDINGS,
    ROLLS_FAR,
    Direction,
    ItemResult,
    ProfileResult,
    Sliding,
)
from shaketable.criteria.overturning import HOUSNER, ISHIYAMA, KNOWN, RULE, UNKNOWN
from shaketable.inventory import Castors
from shaketable.report.words.numbers import (
    counted,
    distance,
    in_hundred,
    likely,
    limit_in_hundred,
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


def what_happens(result: ItemResult, sources: str = "recordings") -> str:
    """How often it falls, in which direction of shaking, and how sure that is.

    Args:
        result: of an item.
        sources: what the independent motions are.
    """
    return _on_condition(result) + _how_often(result, sources)


def _on_condition(result: ItemResult) -> str:
    """What must be so for the numbers that follow to hold."""
    if result.item.castors is Castors.UNKNOWN:
        return "If it stands on no castors: "
    return ""


def _how_often(result: ItemResult, sources: str) -> str:
    fall, direction = result.fall, result.profile.direction
    told = "" if result.other is None else f", shaken {direction}"
    if result.recordings < FEWEST_RECORDINGS:
        return (
            f"Fell in {result.falls} of {result.simulations} simulated shakings{told}; they come "
            f"from {counted(result.recordings, 'independent recording')} and decide nothing."
        )
    if not result.item.depth_known and not result.falls:
        return (
            f"Nothing can be said. Were it as deep as its width of {result.profile.body.width:.3g} "
            f"m, it would fall in none of {result.simulations} simulated shakings."
        )
    if result.falls == 0:
        return (
            f"Fell in none of {result.simulations} simulated shakings from {result.recordings} "
            f"independent {sources}; up to {limit_in_hundred(fall.high)} in 100 cannot be "
            f"excluded.{_rocking(result)}"
        )
    return f"Falls in {in_hundred(fall.value)} of 100 such shakings{told} ({likely(fall)})."


def _rocking(result: ItemResult) -> str:
    if result.item.rolls:
        return ""
    median = degrees(result.peak_rotation.median)
    half = f"rocked by no more than about {max(median, 0.01):.2g}°" if median else "did not rock"
    return f" In at least half of them it {half}."


def other_direction(result: ItemResult) -> str:
    """What is known of the other direction, and what is not."""
    item, other, profile = result.item, result.other, result.profile
    if other is not None:
        happens = "it fell in none"
        if other.falls and result.recordings < FEWEST_RECORDINGS:
            happens = f"it fell in {other.falls} of {other.simulations}"
        elif other.falls:
            happens = f"it falls in {in_hundred(other.fall.value)} of 100"
        base = f"on its base of {other.profile.body.width:.3g} m"
        return f"{str(other.profile.direction).capitalize()}, {base}, {happens}."
    if profile.alike:
        return "Front to back and side to side it is the same."
    if not item.depth_known:
        return (
            f"Its depth is not known, and its width of {profile.body.width:.3g} m was taken for "
            "it: if it is less deep than wide, it falls more often than this."
        )
    return "Its width is not known: side to side nothing was simulated."


def which_way(result: ItemResult) -> str:
    """Which way it falls."""
    if result.falls < FEWEST_FALLS:
        return "Too few falls to tell which way." if result.falls else ""
    toward, away = SIDES[result.profile.direction]
    if result.profile.tilt > 0.0:
        toward, away = f"downhill ({toward})", f"uphill ({away})"
    if result.profile.symmetric:
        return f"By symmetry as many falls go {toward} as {away}."
    share, low, high = result.downhill
    if abs(share - 0.5) < 0.05:
        return f"It falls {toward} about as often as {away}."
    side, often = (toward, share) if share > 0.5 else (away, 1 - share)
    if share <= 0.5:
        low, high = 1 - high, 1 - low
    return (
        f"{in_hundred(often)} of 100 falls go {side} (likely between {in_hundred(low)} and "
        f"{in_hundred(high)})."
    )


def what_friction_does(result: ItemResult) -> str:
    """What sliding changes, and up to which friction; nothing where it changes nothing."""
    if not result.friction_decides:
        return ""
    each = [
        f"with a friction of {other.friction:g} it falls in {in_hundred(other.fall.value)} of 100"
        + (
            f" and slides by {distance(other.slip)} or more in half of the shakings"
            if other.slip > SLIDES
            else ""
        )
        for other in result.frictions
        if result.differs(other)
    ]
    last = max(other.friction for other in result.frictions if result.differs(other))
    from_on = [other.friction for other in result.frictions if other.friction > last]
    until = (
        f"from {min(from_on):g} on friction changes nothing"
        if from_on
        else "what more friction does was not simulated"
    )
    return (
        f"Friction decides. {_present_friction(result)} it falls in "
        f"{in_hundred(result.fall.value)} of 100; {'; '.join(each)}; {until}."
    )


def _present_friction(result: ItemResult) -> str:
    if math.isinf(result.friction):
        return "Where it cannot slide"
    if result.item.rolls:
        return f"With the friction of {result.friction:g} assumed for locked castors"
    return f"With the friction of {result.friction:g} that was given"


def what_criteria_miss(result: ItemResult) -> str:
    """A flag where a criterion calls the item safe and the simulation says that it falls.

    Housner's is left out, as it does not call safe what is below its limit.
    """
    missed = [
        f"{CRITERIA[name]} {found.missed}"
        for name, found in (result.criteria or {}).items()
        if name != HOUSNER and found.missed
    ]
    if not missed:
        return ""
    return (
        f"Simple criteria overlook some of its {result.falls} simulated falls: {'; '.join(missed)}."
    )


def how_far_it_goes(result: ItemResult) -> str:
    """Sliding or rolling in words; nothing where the model does not slide."""
    sliding, support = result.sliding, result.on_support
    if sliding is None or result.fall.value == 1.0 or result.recordings < FEWEST_RECORDINGS:
        return ""
    goes = "rolls" if result.item.castors is Castors.FREE else "slides"
    upright = "Where it does not fall, it" if result.fall.value else "It"
    return " ".join(
        part
        for part in (
            f"{upright} {_how_far(sliding, goes)}",
            _goes_far(sliding) if result.item.rolls and sliding.share else "",
            _walks_off(support),
        )
        if part
    )


def _how_far(sliding: Sliding, goes: str) -> str:
    if sliding.share == 0.0:
        return f"never {goes} by more than {100 * SLIDES:g} cm."
    if sliding.slip.upper < SLIDES:
        return (
            f"hardly ever {goes}: by more than {100 * SLIDES:g} cm in {in_hundred(sliding.share)} "
            "of 100."
        )
    return (
        f"{goes} by {distance(sliding.slip.median)} or more in half of the shakings and by "
        f"{distance(sliding.slip.upper)} or more in a quarter of them; it stays upright and "
        f"{goes} by more than {100 * SLIDES:g} cm in {in_hundred(sliding.share)} of 100."
    )


def _goes_far(sliding: Sliding) -> str:
    return (
        f"In {in_hundred(sliding.far.value)} of 100 ({likely(sliding.far)}) it goes farther than "
        f"{ROLLS_FAR:g} m, where it may hit somebody or come off its hoses and cables."
    )


def _walks_off(result: ProfileResult) -> str:
    sliding, length = result.sliding, result.profile.support_length
    if sliding is None or length is None or math.isnan(sliding.walks_off):
        return ""
    if not sliding.walks_off:
        return f"It stays on its support of {length:.2f} m."
    return f"In {in_hundred(sliding.walks_off)} of 100 it walks off its support of {length:.2f} m."
