"""How an assessment was made, and what it does not consider, in sentences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from shaketable.assess import (
    ACCEPTED_FALLS,
    BASE_GRID,
    ENOUGH_RECORDINGS,
    FEWEST_RECORDINGS,
    FRICTIONS,
    STRAP_SHARE,
    Assessment,
    Walls,
)
from shaketable.building import Building
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES
from shaketable.language import listed, number, tell, translated
from shaketable.report.words import headline, straps
from shaketable.report.words.numbers import in_hundred_short
from shaketable.report.words.straps import FIXING
from shaketable.tilting import FEWEST_FALLS, TILTS, TURNS
from shaketable.units import degrees


def motions(
    assessment: Assessment, run: Mapping[str, Any], building: Building | None, quake: bool
) -> str:
    """By what everything is shaken."""
    scaled = assessment.scale != 1.0 or bool(run.get("scaling"))
    said = tell(
        "“Shakings” are {motions}{scaled}, each as it is and reversed, with peak accelerations "
        "{peaks}{where}.",
        motions=run["motions"]["description"],
        scaled=tell(", scaled") if scaled else "",
        peaks=headline.peaks(assessment.floors),
        where=tell(" on the floors") if building is not None else "",
    )
    if quake:
        return said + tell(
            " They stand for this earthquake as far as its models, or its map, are right."
        )
    if building is not None:
        return said + tell(
            " They are no forecast: another earthquake shakes these floors differently."
        )
    return said + tell(" They are no forecast: a soft site or a high floor shakes differently.")


#: Ratios of falls with the vertical component to falls without, and their 95 % intervals over
#: recordings: where nothing slides, and with a friction of 0.3 (benchmarks/vertical.py).
VERTICAL = {
    "more": 1.03, "low": 0.99, "high": 1.07,
    "slides": 1.05, "slides_low": 1.01, "slides_high": 1.09,
}  # fmt: skip


def of_what(assessment: Assessment) -> str:
    """What the shares on a page are of."""
    return tell(
        "Shares are of 100 shakings from {recordings} independent {sources}, with the 95 % "
        "interval in brackets.",
        recordings=assessment.recordings,
        sources=translated(assessment.sources),
    )


def forces() -> str:
    """What straps, chains and anchors are to hold."""
    return tell(
        "What straps, chains, hooks and anchors have to hold is told beside a wall, without a "
        "margin: for 90 of 100 of these shakings, and for all. Above {fixing} for 90 of 100 it is "
        "for an engineer: that is what one lag screw of 6 mm holds with 50 mm of thread in a stud "
        "(specific gravity 0.50; NDS 2018, table 12.2A, 225 lb/in, times 1.6 for short loads).",
        fixing=f"{number(FIXING / 1e3, 'g')} kN",
    )


def vertical() -> str:
    """What the vertical component does, by `python -m benchmarks.vertical` on 21 recordings."""
    return tell(
        "the vertical component (with it falls were {more:.2f} times as many, {low:.2f} to "
        "{high:.2f}, in {simulations:,} simulations of {recordings} recordings; {slides:.2f}, "
        "{slides_low:.2f} to {slides_high:.2f}, with a friction of {friction:g})",
        simulations=2016, recordings=21, friction=0.3, **VERTICAL,
    )  # fmt: skip


def not_considered(assessment: Assessment) -> str:
    """What no share knows of."""
    slides = assessment.solids or any(each.frictions for each in assessment.results)
    left = [] if slides else [translated(each) for each in assessment.model.not_considered]
    straps_too = (
        tell("straps and edges that the list does not give")
        if assessment.walls is Walls.YES
        else tell("walls, straps and edges that the list does not give")
    )
    parts = [
        *left,
        straps_too if assessment.solids else tell("walls, straps and edges"),
        tell(
            "objects that hit each other, stacks, the furniture on which a thing stands (it is "
            "shaken as if on the floor)"
        ),
        tell("contents that move"),
        *([] if assessment.vertical else [vertical()]),
        *([] if assessment.solids else [tell("shaking in both horizontal directions at once")]),
        tell("supports that bend"),
    ]
    return tell("Not considered: {parts}.", parts=listed(parts))


def order(assessment: Assessment) -> str:
    """In which order things are listed."""
    parts = []
    for name, value in asdict(assessment.weights).items():
        words = {
            "critical": tell("{value:g} for each step of critical (1 to 5)", value=value),
            "blocks_exit": tell("{value:g} for what blocks an exit", value=value),
            "people_nearby": tell("{value:g} for people nearby", value=value),
            "must_not_fall": tell("{value:g} for what must not fall", value=value),
        }
        parts.append(words[name])
    return tell(
        "In the order of share times priority, which is 1 and adds {parts}.", parts=listed(parts)
    )


def sentences(assessment: Assessment) -> list[str]:
    """The method, point by point."""
    found = []
    if assessment.solids:
        found += _in_space(assessment)
    if any(each.solid is None for each in assessment.results):
        found += [translated(sentence) for sentence in assessment.model.method]
        found += _in_a_plane(assessment)
    return [*found, *_for_all(assessment)]


def _in_space(assessment: Assessment) -> list[str]:
    said = [
        tell(
            "An object whose depth and width are known is a solid on a rectangle, a circle or four "
            "feet, which may rock on its sides, roll on its corners or its rim, turn and jump, "
            "shaken by both horizontal components of a recording at once, on the floor on which it "
            "stands. It stands in {turns} ways to the motion, one after the other (a square over a "
            "quarter of a turn, a circle in one; in one where its list and the records say how "
            "they face). With friction {frictions} it also slides; each motion is then met in one "
            "of the ways, and in all where that changes the share by more than chance.",
            turns=TURNS,
            frictions=listed([f"{each:g}" for each in FRICTIONS]),
        ),
        tell(
            "A fall counts for the side that it goes to within 45°. The class is that of the worst "
            "of all frictions that change the share."
        ),
    ]
    if any(each.mitigations for each in assessment.results):
        said.append(
            tell(
                "Measures are simulated in the same way, in a quarter of the ways, the one that "
                "comes first in half of them. A plane proposes a base; up to four sizes are tried"
                " in three dimensions, and the smallest is told of which at most {accepted:g} of "
                "100 shakings overturn the object, or the largest. A strap goes from the middle "
                "of the top of an object at its back straight to a wall, or to a point 50 mm "
                "behind it where there is none; it does not break, and is damped by 1 to 2 % of "
                "critical. Its force is the "
                "largest of each shaking. The sizes of measures are assumed, not measured.",
                accepted=100 * ACCEPTED_FALLS,
            )
        )
    return said


def _in_a_plane(assessment: Assessment) -> list[str]:
    return [
        tell(
            "In a plane an object is simulated front to back and side to side, each by itself; the "
            "direction in which it falls more often leads. Its eccentricity, radius of gyration "
            "and support length hold front to back only."
        ),
        tell(
            "The tilt for control is the smallest of the tilts tried ({step:g}° apart, up to "
            "{most:g}°) from which on at least {control:g} % of the falls go downhill; none is "
            "given where there are fewer than {fewest} falls at the tilt before it. The base on "
            "which few fall is the smallest from which on at most {accepted:g} % fall, with the "
            "height of its centre of gravity and its radius of gyration unchanged, between {low:g} "
            "and {high:g} times the present one.",
            step=degrees(TILTS[1] - TILTS[0]),
            most=degrees(TILTS[-1]),
            control=100 * assessment.control,
            fewest=FEWEST_FALLS,
            accepted=100 * ACCEPTED_FALLS,
            low=BASE_GRID[0],
            high=BASE_GRID[-1],
        ),
    ]


def _for_all(assessment: Assessment) -> list[str]:
    limits = []
    for name, limit in RISK_CLASSES.items():
        below = limit < 1.0
        limits.append(
            tell("{name} below {limit} %", name=translated(name), limit=in_hundred_short(limit))
            if below
            else tell("{name} otherwise", name=translated(name))
        )
    said = [
        tell(
            "What stands on castors rolls with a friction of {free:g} where they are free, and "
            "slides with {locked:g} where they are locked. Both are assumed.",
            free=assessment.castors.free,
            locked=assessment.castors.locked,
        ),
        tell(
            "An object has overturned when it lies on its support (90°). One that still rocks when "
            "the record ends is followed until it rests or falls."
        ),
        tell(
            "The shakings come from {recordings} independent {sources}; a recording is an "
            "earthquake at a station, with all its components. Intervals of shares are 95 % Wilson "
            "score intervals with that number: scaled copies, reversed motions, components and "
            "ways to stand count nothing.",
            recordings=assessment.recordings,
            sources=translated(assessment.sources),
        ),
        tell(
            "Risk: {limits} (classes of Kaneko & Hayashi 2004). From fewer than {fewest} "
            "recordings nothing is classed; with fewer than {enough} the class is that of the "
            "share, and none is low; with more it is that of the upper end of its interval. Not "
            "classed is what stands on castors and does not fall, what has no depth in the list, "
            "what still moves too often when a simulation ends, and what is round, nearly square "
            "or on feet where a plane alone is known.",
            limits=listed(limits),
            fewest=FEWEST_RECORDINGS,
            enough=ENOUGH_RECORDINGS,
        ),
        tell(
            "The static force against lifting is the least horizontal force at a height that keeps "
            "a standing object from lifting, for {often:g} of 100 motions and for half of them.",
            often=100 * STRAP_SHARE,
        )
        + " "
        + straps.static_forces(),
    ]
    if any(each.criteria for each in assessment.results):
        said.append(
            tell(
                "Criteria: Housner 1963; Ishiyama 1982; Boroschek & Romo 2004; a logistic rule "
                "fitted to FEMA P-695, which calls safe whatever it gives a chance below 3 %. They "
                "are for rigid rectangles that rock on a level support and do not slide."
            )
        )
    return said
