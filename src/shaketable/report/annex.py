"""The annex of a report: every kind of thing once, and the figures behind it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from shaketable.assess import (
    ACCEPTED_FALLS,
    Assessment,
    FloorAssessment,
    ItemResult,
    alike,
)
from shaketable.hazard.objects import ObjectRates
from shaketable.hazard.rates import YEARS
from shaketable.language import number, tell
from shaketable.report import figures
from shaketable.report.first_part import where
from shaketable.report.html import embedded_svg
from shaketable.report.words import advice, answer, carried, findings, hazard, headline

MOST_CARDS = 120
MOST_CURVES = 12
MOST_ROWS = 500


class Card(NamedTuple):
    """A kind of thing, where it is worst; others like it in one line."""

    result: ItemResult
    about: str
    class_: str
    also: str
    happens: Sequence[str]
    advice: Sequence[str]
    yearly: str
    note: str


def cards(
    assessment: Assessment, ranked: Sequence[ItemResult], rates: ObjectRates | None
) -> list[Card]:
    """A card for each kind of thing, in the order in which to look at them."""
    kinds: dict[object, list[ItemResult]] = {}
    for each in ranked:
        kinds.setdefault(alike(each.item), []).append(each)
    yearly = rates.of_objects() if rates else {}
    found = []
    for worst, *others in list(kinds.values())[:MOST_CARDS]:
        known = yearly.get(worst.number)
        found.append(
            Card(
                result=worst,
                about=_about(worst, assessment),
                class_=findings.risk_in_words(worst),
                also=_also(worst, others, assessment),
                happens=answer.what_happens(worst, assessment.sources),
                advice=advice.what_to_do(worst, assessment),
                yearly=hazard.yearly(known.found, YEARS, known.item.rolls) if known else "",
                note=worst.item.note,
            )
        )
    return found


def _about(result: ItemResult, assessment: Assessment) -> str:
    """What it is: pieces, place and sizes."""
    item = result.item
    parts = [where(result, assessment)]
    if item.sideways is not None and item.depth_known:
        parts.append(
            tell(
                "{depth:.2f} m deep, {width:.2f} m wide, {height:.2f} m high",
                depth=item.body.base,
                width=item.sideways.base,
                height=item.height,
            )
        )
    else:
        parts.append(
            tell("base {base:.2f} m, {height:.2f} m high", base=item.body.base, height=item.height)
        )
    if item.rolls:
        parts.append(tell("castors locked") if item.castors == "locked" else tell("castors free"))
        parts += [] if item.lock_known else [tell("whether they are locked is not known")]
    if item.must_not_fall:
        parts.append(tell("must not fall"))
    return " · ".join(parts)


def _also(worst: ItemResult, others: Sequence[ItemResult], assessment: Assessment) -> str:
    """Where others like it are, and how often those fall."""
    if not others:
        return ""
    told = [
        tell(
            "{where}: {often} of 100",
            where=where(each, assessment),
            often=carried.often(each),
        )
        for each in others
    ]
    return tell("Others like it: {told}.", told="; ".join(told))


def curves(assessment: Assessment, ranked: Sequence[ItemResult]) -> list[str]:
    """What tilts do to the things of which a plane decides."""
    chosen = [
        each
        for each in ranked
        if each.curves
        and each.solid is None
        and each.fall.value > ACCEPTED_FALLS
        and not each.item.must_not_fall
    ]
    return [
        embedded_svg(figures.svg(figures.tilt_curve(each, assessment.control)))
        for each in chosen[:MOST_CURVES]
    ]


def needed(friction: float) -> str:
    """A friction that is needed; a dash where nothing rocks, and words where none is enough."""
    if math.isinf(friction):
        return tell("none is enough")
    return "–" if math.isnan(friction) else number(friction, ".2f")


def overlooked(ranked: Sequence[ItemResult]) -> list[tuple[str, str]]:
    """What simple criteria call safe, and falls in a plane."""
    return [
        (each.item.name, said) for each in ranked if (said := findings.what_criteria_miss(each))
    ]


def floors(assessment: Assessment) -> list[dict[str, object]]:
    """How strongly each floor is shaken."""
    return [_floor(each) for each in assessment.floors if each.floor]


def _floor(floor: FloorAssessment) -> dict[str, object]:
    return {
        "name": headline.floor_name(floor.floor),
        "motions": len(floor.motions),
        "recordings": floor.recordings,
        "pga": headline.peaks([floor]),
    }
