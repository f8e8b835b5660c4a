"""A whole assessment in a few sentences: what, how sure, how it was looked at."""

from __future__ import annotations

import math
from collections.abc import Sequence

from shaketable.assess import (
    ACCEPTED_FALLS,
    ENOUGH_RECORDINGS,
    FEWEST_RECORDINGS,
    Assessment,
    FloorAssessment,
    ItemResult,
)
from shaketable.inventory import Castors
from shaketable.report.words.numbers import (
    counted,
    distance,
    expected_count,
    in_hundred,
    limit_in_hundred,
)
from shaketable.resampling import wilson_interval
from shaketable.tilting import SLIDES

MOST_NAMED = 10  # objects in a sentence


def headline(assessment: Assessment) -> list[str]:
    """What happens, in a few sentences; what decides nothing says so first."""
    results = assessment.results
    sentences = _nothing_decided(assessment)
    often = [each for each in results if each.fall.value > ACCEPTED_FALLS]
    pieces = sum(each.item.quantity for each in results)
    kinds = counted(len(results), "kind of object")
    limit = f"{100 * ACCEPTED_FALLS:.0f}"
    if often:
        falling = sum(each.item.quantity for each in often)
        verb = "overturns" if len(often) == 1 else "overturn"
        sentences.append(
            f"{len(often)} of {kinds} ({falling:,} of {counted(pieces, 'piece')}) {verb} in more "
            f"than {limit} of 100 shakings like these."
        )
    else:
        verb = "overturns" if len(results) == 1 else "overturn"
        sentences.append(
            f"Of {kinds} ({counted(pieces, 'piece')}) none {verb} in more than {limit} of 100 of "
            "the simulated shakings."
        )
    falls = sum(floor.expected_falls for floor in assessment.floors)
    if falls:
        where = _worst_floor(assessment.floors)
        sentences.append(
            f"On average over the motions {expected_count(falls)} of {counted(pieces, 'piece')} "
            f"fall{where}."
        )
    return sentences + _sliding(results)


def how_sure(assessment: Assessment) -> list[str]:
    """What the numbers stand on, and what the inventory does not tell."""
    n, results = assessment.recordings, assessment.results
    kinds = [each.item for each in results]
    untold = [item.name for item in kinds if not item.depth_known]
    one_way = sum(item.depth_known and item.sideways is None for item in kinds)
    castors = sum(item.castors is Castors.UNKNOWN for item in kinds)
    sentences = []
    if n >= FEWEST_RECORDINGS:
        _, high = wilson_interval(0.0, n)
        sentences.append(
            f"The motions come from {n} independent recordings. What fell in none of them may "
            f"still fall in up to {limit_in_hundred(float(high))} of 100"
            + (
                "."
                if n >= ENOUGH_RECORDINGS
                else f": it takes {ENOUGH_RECORDINGS} recordings to bring that below 3."
            )
        )
    if untold:
        sentences.append(
            f"For {counted(len(untold), 'kind of object')} the inventory gives no depth: the width "
            "was taken for it, and none of them is called a low risk. Where the width is the "
            "longer side of the base, the object falls more often than is said here. Fill in "
            "depth_m (front to back) and width_m (side to side)."
        )
    if one_way:
        sentences.append(
            f"For {counted(one_way, 'kind of object')} the inventory gives no width: side to side "
            "nothing was simulated."
        )
    if castors:
        sentences.append(
            f"{counted(castors, 'kind of object')} may stand on castors, by name or note. Nothing "
            "is said about the risk of these until a column castors tells."
        )
    if assessment.anchored:
        names = [item.name for item in assessment.anchored]
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        sentences.append(
            f"{counted(len(names), 'kind of object')} not simulated, as the inventory says that it "
            f"is anchored: {', '.join(names[:MOST_NAMED])}{more}. Whether an anchor holds was not "
            "looked at."
        )
    return sentences


def _nothing_decided(assessment: Assessment) -> list[str]:
    n = assessment.recordings
    if n >= FEWEST_RECORDINGS:
        return []
    return [
        f"This decides nothing: the motions come from {counted(n, 'independent recording')}, and "
        f"objects are classed from {FEWEST_RECORDINGS} on. Zero falls in so few shakings say next "
        "to nothing about the next earthquake."
    ]


def _worst_floor(floors: Sequence[FloorAssessment]) -> str:
    if len(floors) == 1:
        return ""
    worst = max(floors, key=lambda floor: floor.expected_falls / floor.pieces)
    share = worst.expected_falls / worst.pieces
    return f", most of all on {floor_name(worst.floor)}: {in_hundred(share)} of 100 pieces there"


def floor_name(label: str) -> str:
    """ "floor 3"; "the ground floor", "the roof": what is a word needs no "floor" before it."""
    word = label.strip()
    if word.lower() in ("ground", "first", "second", "third", "top"):
        return f"the {word.lower()} floor"
    if word.lower() in ("roof", "basement", "attic", "mezzanine", "penthouse"):
        return f"the {word.lower()}"
    return word if "floor" in word.lower() or "level" in word.lower() else f"floor {word}"


def _sliding(results: Sequence[ItemResult]) -> list[str]:
    known = [
        (each.sliding.slip.upper, each)
        for each in results
        if each.sliding and not math.isnan(each.sliding.slip.upper)
    ]
    sentences = []
    if known and (worst := max(known, key=lambda pair: pair[0]))[0] > SLIDES:
        goes = "rolls" if worst[1].item.castors is Castors.FREE else "slides"
        sentences.append(
            f"What {goes} farthest is {worst[1].item.name!r}: by {distance(worst[0])} or more in a "
            "quarter of the shakings that leave it upright."
        )
    off = [each for each in results if each.sliding and each.sliding.walks_off > 0.0]
    if off:
        far = max(off, key=lambda each: each.sliding.walks_off if each.sliding else 0.0)
        assert far.sliding is not None
        verb = "walks" if len(off) == 1 else "walk"
        sentences.append(
            f"{counted(len(off), 'kind of object')} {verb} off the support in some shakings, "
            f"{far.item.name!r} in {in_hundred(far.sliding.walks_off)} of 100."
        )
    return sentences
