"""Results as sentences that a facility manager can act on."""

from __future__ import annotations

import math
from collections.abc import Sequence

from shaketable.assess import (
    ACCEPTED_FALLS,
    BASE_GRID,
    Assessment,
    FloorAssessment,
    ItemResult,
)
from shaketable.criteria.overturning import HOUSNER
from shaketable.tilting import FEWEST_FALLS, SLIDES, TILTS, TiltCurves, shim_height
from shaketable.units import degrees


def in_hundred(share: float) -> str:
    """A share as a count out of a hundred, never rounded to 0 or 100."""
    if 0.0 < share < 0.01:
        return "less than 1"
    if 0.99 < share < 1.0:
        return "more than 99"
    return f"{100 * share:.0f}"


def counted(number: int, thing: str) -> str:
    """ "1 motion", "2 motions"."""
    return f"{number} {thing}{'' if number == 1 else 's'}"


def expected_count(number: float) -> str:
    """A mean count, to a tenth where it is small."""
    return f"{number:.{0 if number >= 10 else 1}f}"


def what_happens(result: ItemResult) -> str:
    """How often it falls, and how sure that is."""
    fall = result.fall
    if result.falls == 0:
        median = degrees(result.peak_rotation.median)
        still = "did not move" if result.sliding is None else "did not rock"
        half = f"rocked by less than {max(median, 0.01):.2g}°" if median else still
        return (
            f"Did not fall in any of {result.simulations} simulated shakings (the true share is "
            f"below {math.ceil(100 * fall.high)} in 100). In at least half of them it {half}."
        )
    return (
        f"Falls in {in_hundred(fall.value)} of 100 such shakings (likely between "
        f"{in_hundred(fall.low)} and {in_hundred(fall.high)})."
    )


def which_way(result: ItemResult, tilt: float) -> str:
    """Which way it falls; `tilt` [rad] is that of what it stands on now."""
    if result.falls < FEWEST_FALLS:
        return "Too few falls to tell which way." if result.falls else ""
    share, low, high = result.downhill
    downhill, uphill = ("downhill", "uphill") if tilt > 0 else ("left (-x)", "right (+x)")
    if abs(share - 0.5) < 0.05:
        return "It falls either way about equally often."
    side, often = (downhill, share) if share > 0.5 else (uphill, 1 - share)
    if share <= 0.5:
        low, high = 1 - high, 1 - low
    return (
        f"{in_hundred(often)} of 100 falls go {side} (likely between {in_hundred(low)} and "
        f"{in_hundred(high)})."
    )


def what_criteria_miss(result: ItemResult) -> str:
    """A flag where a criterion calls the item safe and the simulation says that it falls.

    Housner's is left out, as it does not call safe what is below its limit.
    """
    missed = [
        f"{name} {found.missed}"
        for name, found in (result.criteria or {}).items()
        if name != HOUSNER and found.missed
    ]
    if not missed:
        return ""
    return (
        f"Some of its {result.falls} simulated falls are under motions that a simple criterion "
        f"calls safe: {', '.join(missed)}."
    )


def how_far_it_slides(result: ItemResult) -> str:
    """Sliding in words; nothing where the model does not slide."""
    sliding, length = result.sliding, result.item.support_length
    if sliding is None or result.fall.value == 1.0:
        return ""
    upright = "Where it does not fall, it" if result.fall.value else "It"
    if sliding.share == 0.0:
        said = f"{upright} never slides by more than {100 * SLIDES:g} cm."
    else:
        said = (
            f"{upright} slides by {distance(sliding.slip.median)} or more in half of the shakings "
            f"and by {distance(sliding.slip.upper)} or more in a quarter of them; it stays "
            f"upright and slides by more than {100 * SLIDES:g} cm in "
            f"{in_hundred(sliding.share)} of 100."
        )
    if length is None or math.isnan(sliding.walks_off):
        return said
    return said + (
        f" In {in_hundred(sliding.walks_off)} of 100 it walks off its support of {length:.2f} m."
        if sliding.walks_off
        else f" It stays on its support of {length:.2f} m."
    )


def distance(metres: float) -> str:
    """A distance to two digits, in the unit that people would use."""
    if metres >= 1.0:
        return f"{metres:.2g} m"
    if metres >= 0.01:
        return f"{100 * metres:.2g} cm"
    return f"{1000 * metres:.2g} mm" if metres >= 1e-4 else "0 mm"


def what_to_do(result: ItemResult, control: float, tilt: float) -> list[str]:
    """The tilt and the base that would help, if it needs help.

    Args:
        result: of an item.
        control: wanted share of the falls that go downhill.
        tilt: [rad] of what it stands on now.
    """
    walks_off = result.sliding.walks_off if result.sliding else 0.0
    keep = ["Keep it on its support: a rim, a strap, a pad with more grip."]
    keep = keep if walks_off > ACCEPTED_FALLS else []
    if result.fall.value <= ACCEPTED_FALLS:
        rare = ["It falls rarely. Anchor it where a fall would hurt somebody or stop work."]
        said = (rare if result.falls else []) + keep
        return said or ["Nothing is needed against shaking like this."]
    if math.isnan(result.safe_width):
        wider = f"No base up to {BASE_GRID[-1]:g} times as wide would be enough: anchor it."
    else:
        wider = (
            f"To keep it standing, anchor it, or widen its base from {result.item.body.width:.2f} "
            f"to {result.safe_width:.2f} m: at most {100 * ACCEPTED_FALLS:g} of 100 such shakings "
            "would still overturn it."
        )
    return [_tilt_advice(result, control, tilt), wider, *keep]


def _tilt_advice(result: ItemResult, control: float, present: float) -> str:
    curves, body = result.curves, result.item.body
    tilt = curves.control_tilt
    wanted = f"{100 * control:g} of 100 falls"
    if not math.isfinite(tilt):
        return (
            f"No tilt up to {degrees(TILTS[-1]):g}° was found that sends {wanted} downhill, with "
            f"{FEWEST_FALLS} falls or more at the neighbouring tilts to tell."
        )
    side = "downhill" if present else "to its left (-x)"
    if tilt <= present or tilt == 0.0:
        return f"As it stands, {wanted} or more already go {side}."
    toward = "to the side you choose"
    if body.left / body.width != 0.5:
        toward = "to its left (-x); turned round, it needs another tilt"
    rise = shim_height(body.width, tilt)
    now, then = in_hundred(result.fall.value), in_hundred(curves.fall_share_there)
    return (
        f"To choose the side, tilt what it stands on to {tilt_degrees(tilt)} "
        f"({tilt_interval(curves)}; at {tilt_degrees(tilt)} the uphill edge of its base is "
        f"{1000 * rise:.0f} mm above the other): about {wanted} then go downhill, {toward}; falls "
        f"change from {now} to {then} of 100."
    )


def tilt_degrees(tilt: float) -> str:
    """A tilt [rad] of the grid in degrees: 2.25°, 3.5°, 4.0°."""
    said = f"{degrees(tilt):.2f}"
    return f"{said.removesuffix('0')}°"


def tilt_interval(curves: TiltCurves) -> str:
    """The interval of the tilt for control in words."""
    low, high = curves.control_tilt_interval
    if math.isnan(low):
        return "how sure that is cannot be told from so few falls"
    if math.isinf(high):
        return f"likely above {tilt_degrees(low)}"
    return f"likely between {tilt_degrees(low)} and {tilt_degrees(high)}"


def headline(assessment: Assessment) -> list[str]:
    """The whole assessment in a few sentences."""
    floors = assessment.floors
    found = _building_headline(floors) if floors[0].floor else floor_headline(floors[0])
    return [*found, *directions(assessment)]


def directions(assessment: Assessment) -> list[str]:
    """In which direction each base was simulated, and what the inventory did not tell."""
    given = [each.item.direction for each in assessment.results]
    untold, sideways = given.count(""), given.count("side to side")
    sentences = []
    if untold:
        sentences.append(
            f"For {counted(untold, 'kind')} of object the inventory gives no depth: the width is "
            "taken for it, front to back. Where it is the longer side of the base, the object "
            "falls more often than is said here."
        )
    if sideways:
        sentences.append(
            f"{counted(sideways, 'kind')} of object {'is' if sideways == 1 else 'are'} narrower "
            "than deep and simulated side to side."
        )
    sentences.append("Every object is simulated in one direction only.")
    return sentences


def floor_headline(floor: FloorAssessment) -> list[str]:
    """What stands in one place in a few sentences."""
    sentences = _overturning_headline(floor)
    sliding = [(each.sliding, each.item.name) for each in floor.results if each.sliding]
    known = [(each.slip.upper, name) for each, name in sliding if not math.isnan(each.slip.upper)]
    if known and max(known)[0] > SLIDES:
        far, name = max(known)
        sentences.append(
            f"What slides farthest is {name!r}: by {distance(far)} or more in a quarter of the "
            "shakings that leave it upright."
        )
    off = [(each.walks_off, name) for each, name in sliding if each.walks_off > 0.0]
    if off:
        kinds = "kind of object walks" if len(off) == 1 else "kinds of object walk"
        often, name = max(off)
        sentences.append(
            f"{len(off)} {kinds} off the support in some shakings, {name!r} in "
            f"{in_hundred(often)} of 100."
        )
    return sentences


def _building_headline(floors: Sequence[FloorAssessment]) -> list[str]:
    pieces = sum(floor.pieces for floor in floors)
    falls = sum(floor.expected_falls for floor in floors)
    worst = max(floors, key=lambda floor: floor.expected_falls / floor.pieces)
    share = worst.expected_falls / worst.pieces
    sentences = [
        f"On average over the motions, {expected_count(falls)} of the {pieces} pieces on "
        f"{counted(len(floors), 'floor')} fall."
    ]
    if share > 0.0:
        sentences.append(
            f"The largest share of pieces falls on floor {worst.floor}: {in_hundred(share)} of 100."
        )
    return sentences


def _overturning_headline(floor: FloorAssessment) -> list[str]:
    often = [each for each in floor.worst_first() if each.fall.value > ACCEPTED_FALLS]
    kinds, limit = len(floor.results), f"{100 * ACCEPTED_FALLS:.0f}"
    if not often:
        return [
            f"None of {counted(kinds, 'kind')} of object ({counted(floor.pieces, 'piece')}) "
            f"overturns in more than {limit} of 100 such shakings."
        ]
    worst = often[0]
    fall = sum(each.item.quantity for each in often)
    verb = "overturns" if len(often) == 1 else "overturn"
    return [
        f"{len(often)} of {counted(kinds, 'kind')} of object ({fall} of "
        f"{counted(floor.pieces, 'piece')}) {verb} in more than {limit} of 100 shakings like "
        "those of this suite.",
        f"The most likely to fall is {worst.item.name!r}: {in_hundred(worst.fall.value)} of 100.",
        f"On average over the suite, {expected_count(floor.expected_falls)} of the "
        f"{counted(floor.pieces, 'piece')} fall.",
    ]
