"""Rates of falls in words that a manager understands."""

from __future__ import annotations

import numpy as np

from shaketable.errors import named
from shaketable.fragility.intensities import OWN
from shaketable.fragility.shown import in_words
from shaketable.hazard import AnnualRate, Hazard
from shaketable.hazard.objects import ObjectRate, ObjectRates
from shaketable.hazard.rates import MUCH
from shaketable.report.words.headline import floor_name
from shaketable.report.words.numbers import counted

NOT_CONSIDERED = (
    "The hazard curve is taken as it is: its own uncertainty is not in the intervals, which are "
    "those of the fragility functions. Falls are taken as independent from year to year, after "
    "which everything stands again. Bodies are planar and rigid, each direction by itself; an "
    "object counts in the direction in which it falls more often. The motions of the fragility "
    "functions are scaled: at a level of the measure they need not be those that the hazard of "
    "this site consists of. Anchored objects are left out."
)
AS_IF_FIXED = "as if its castors did not roll"
LEAST = 1e-3  # smaller probabilities are not told in digits
USUAL = 475.0  # years
MOST_NAMED = 3
NEGLIGIBLE_RATE = 1e-6  # a year: no hazard curve tells of what is so seldom


def where(building: str, floor: str) -> str:
    """The building, and the floor whose motions were taken; "" if there is neither."""
    return ", ".join(part for part in (building, floor_name(floor) if floor else "") if part)


def once_in(found: AnnualRate) -> str:
    """As "once in 140 years (90 to 230)"; years are told to two digits."""
    if not np.isfinite(found.rate):
        return "how often is not known"
    if found.rate < NEGLIGIBLE_RATE:
        return "more seldom than the hazard curve can tell"
    low, high = found.interval
    told = f"once in {_years(1.0 / found.rate)} years"
    if not (np.isfinite(low) and np.isfinite(high)) or low <= 0.0:
        return told
    return f"{told} ({_years(1.0 / high)} to {_years(1.0 / low)})"


def chance(found: AnnualRate, years: float) -> str:
    """As "30 % in 50 years (20 to 42 %)"."""
    if not np.isfinite(found.rate):
        return "–"
    low, high = found.probability_interval(years)
    told = f"{_percent(found.probability(years))} % in {years:g} years"
    if high < LEAST:
        return told
    if not (np.isfinite(low) and np.isfinite(high)):
        return told
    return f"{told} ({_percent(low)} to {_percent(high)} %)"


def note(one: ObjectRate, hazard: Hazard) -> str:
    """What is weak about the rate of an object, "" if nothing is."""
    said = [AS_IF_FIXED] if one.item.rolls else []
    if one.found.above > MUCH:
        said.append(
            f"{100 * one.found.above:.0f} % of its falls are at shaking beyond the hazard curve"
            f"{'' if hazard.ends else ', which is taken to go straight on'}"
        )
    if one.curve.caution:
        said.append(one.curve.caution)
    return "; ".join(said)


def yearly(found: AnnualRate, years: float, rolls: bool = False) -> str:
    """A sentence of one object, which may stand on castors."""
    if not np.isfinite(found.rate):
        return "At this site: how often it falls is not known, as its fragility function is not."
    said = f" ({AS_IF_FIXED})" if rolls else ""
    return f"At this site it falls {once_in(found)}: {chance(found, years)}{said}."


def of_inventory(rates: ObjectRates, years: float) -> list[str]:
    """How often things fall at the site, in sentences."""
    found = rates.ranked()
    pieces = sum(one.item.quantity for one in found)
    every = sum(one.item.quantity for one in rates.of_objects().values())
    curve = rates.rates[0].curve
    told = (
        f"Of {counted(pieces, 'piece')} that are not anchored, {rates.expected(years):.2g} fall in "
    )
    told += f"{years:g} years on average"
    if every > pieces:
        told += f", beside {every - pieces} more of which no rate can be told"
    usual = rates.hazard.rates[: rates.hazard.positive]
    if usual[-1] <= 1.0 / USUAL <= usual[0]:
        level = rates.hazard.level(1.0 / USUAL)
        told += (
            f"; {in_words(rates.hazard.measure, level)} of the ground is exceeded once in "
            f"{USUAL:g} years"
        )
    of_levels = (
        "any one horizontal component"
        if rates.components == OWN
        else "the geometric mean of both horizontal components"
    )
    sentences = [
        f"{told}.",
        f"The fragility functions are from {counted(rates.motions, 'motion')} of "
        f"{counted(curve.recordings, 'recording')} of {counted(curve.events, 'earthquake')}; "
        f"intervals are 95 %. Levels of shaking are those of {of_levels}.",
    ]
    held = [one.item.name for one in rates.of_objects().values() if one.item.surroundings]
    if held:
        sentences.append(
            "In the plane of each direction walls, straps, pads and edges of the list are "
            "simulated where they act in it; what ends leaning on them has not fallen: "
            f"{named(list(dict.fromkeys(held)), MOST_NAMED)}."
        )
    for one in found[:MOST_NAMED]:
        sentences.append(
            f"A piece of {one.item.called(one.number)} falls {once_in(one.found)}: "
            f"{chance(one.found, years)}."
        )
    total = rates.expected(1.0)
    if len(found) > 1 and total > 0.0:
        first = found[0]
        saved = first.item.quantity * first.found.rate / total
        sentences.append(
            f"To restrain all pieces of {first.item.called(first.number)} alone would save "
            f"{100 * saved:.0f} % of all falls."
        )
    return sentences


def _years(value: float) -> str:
    if value < 10.0:
        return f"{value:.2g}"
    digits = 10 ** (int(np.floor(np.log10(value))) - 1)
    return f"{round(value / digits) * digits:,}"


def _percent(share: float) -> str:
    if share < LEAST:
        return "below 0.1"
    return f"{100 * share:.2g}" if share < 0.995 else f"{100 * share:.3g}"
