"""Rates of falls in words that a manager understands."""

from __future__ import annotations

import numpy as np

from shaketable.errors import named
from shaketable.fragility.intensities import OWN
from shaketable.fragility.shown import in_words
from shaketable.hazard import AnnualRate, Hazard
from shaketable.hazard.objects import ObjectRate, ObjectRates
from shaketable.hazard.rates import MUCH
from shaketable.hazard.totals import LossTotals
from shaketable.language import number, tell, translated
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
        return tell("how often is not known")
    if found.rate < NEGLIGIBLE_RATE:
        return tell("more seldom than the hazard curve can tell")
    low, high = found.interval
    told = tell("once in {years} years", years=_years(1.0 / found.rate))
    if not (np.isfinite(low) and np.isfinite(high)) or low <= 0.0:
        return told
    least, most = _years(1.0 / high), _years(1.0 / low)
    return tell("{told} ({least} to {most})", told=told, least=least, most=most)


def chance(found: AnnualRate, years: float) -> str:
    """As "30 % in 50 years (20 to 42 %)"."""
    if not np.isfinite(found.rate):
        return "–"
    low, high = found.probability_interval(years)
    share = _percent(found.probability(years))
    told = tell("{share} % in {years:g} years", share=share, years=years)
    if high < LEAST:
        return told
    if not (np.isfinite(low) and np.isfinite(high)):
        return told
    least, most = _percent(low), _percent(high)
    return tell("{told} ({least} to {most} %)", told=told, least=least, most=most)


def note(one: ObjectRate, hazard: Hazard) -> str:
    """What is weak about the rate of an object, "" if nothing is."""
    said = [translated(AS_IF_FIXED)] if one.item.rolls else []
    said += [tell("as if it stood on the floor")] if one.item.stands_on else []
    if one.found.above > MUCH:
        beyond = tell(
            "{share:.0f} % of its falls are at shaking beyond the hazard curve",
            share=100 * one.found.above,
        )
        said.append(
            beyond + ("" if hazard.ends else translated(", which is taken to go straight on"))
        )
    if one.curve.caution:
        said.append(one.curve.caution)
    return "; ".join(said)


def yearly(found: AnnualRate, years: float, rolls: bool = False) -> str:
    """A sentence of one object, which may stand on castors."""
    if not np.isfinite(found.rate):
        return tell(
            "At this site: how often it falls is not known, as its fragility function is not."
        )
    said = f" ({translated(AS_IF_FIXED)})" if rolls else ""
    return tell(
        "At this site it falls {once}: {chance}{said}.",
        once=once_in(found),
        chance=chance(found, years),
        said=said,
    )


def of_inventory(rates: ObjectRates, years: float) -> list[str]:
    """How often things fall at the site, in sentences."""
    found = rates.ranked()
    pieces = sum(one.item.quantity for one in found)
    every = sum(one.item.quantity for one in rates.of_objects().values())
    curve = rates.rates[0].curve
    told = tell(
        "Of {pieces} that are not anchored, {expected:.2g} fall in {years:g} years on average",
        pieces=counted(pieces, "piece"),
        expected=rates.expected(years),
        years=years,
    )
    if every > pieces:
        told += tell(", beside {more} more of which no rate can be told", more=every - pieces)
    usual = rates.hazard.rates[: rates.hazard.positive]
    if usual[-1] <= 1.0 / USUAL <= usual[0]:
        level = rates.hazard.level(1.0 / USUAL)
        told += tell(
            "; {level} of the ground is exceeded once in {years:g} years",
            level=in_words(rates.hazard.measure, level),
            years=USUAL,
        )
    of_levels = translated(
        "any one horizontal component"
        if rates.components == OWN
        else "the geometric mean of both horizontal components"
    )
    sentences = [
        f"{told}.",
        tell(
            "The fragility functions are from {motions} of {recordings} of {earthquakes}; "
            "intervals are 95 %. Levels of shaking are those of {levels}.",
            motions=counted(rates.motions, "motion"),
            recordings=counted(curve.recordings, "recording"),
            earthquakes=counted(curve.events, "earthquake"),
            levels=of_levels,
        ),
    ]
    held = [one.item.name for one in rates.of_objects().values() if one.item.surroundings]
    if held:
        sentences.append(
            tell(
                "In the plane of each direction walls, straps, pads and edges of the list are "
                "simulated where they act in it; what they alone hold up has not fallen: "
                "{names}.",
                names=named(list(dict.fromkeys(held)), MOST_NAMED),
            )
        )
    for one in found[:MOST_NAMED]:
        sentences.append(
            tell(
                "A piece of {name} falls {once}: {chance}.",
                name=one.item.called(one.number),
                once=once_in(one.found),
                chance=chance(one.found, years),
            )
        )
    total = rates.expected(1.0)
    if len(found) > 1 and total > 0.0:
        first = found[0]
        saved = first.item.quantity * first.found.rate / total
        sentences.append(
            tell(
                "To restrain all pieces of {name} alone would save {share:.0f} % of all falls.",
                name=first.item.called(first.number),
                share=100 * saved,
            )
        )
    return sentences


def of_totals(totals: LossTotals) -> list[str]:
    """What all pieces lose together, in sentences."""
    low, high = totals.average_interval
    average, least, most = (amount(each) for each in (totals.average, low, high))
    if totals.in_cost:
        first = tell(
            "Of a value of {value}, in the currency of the list, {average} are lost in a year on "
            "average ({least} to {most}).",
            value=amount(totals.value),
            average=average,
            least=least,
            most=most,
        )
    else:
        first = tell(
            "On average {average} pieces fall in a year ({least} to {most}).",
            average=average,
            least=least,
            most=most,
        )
    said = [first]
    if totals.average_above > MUCH:
        said.append(
            tell(
                "{share:.0f} % of that come from shaking beyond the hazard curve.",
                share=100 * totals.average_above,
            )
        )
    for k, each in enumerate(totals.periods):
        if each.years == USUAL:
            alone, together = (amount(losses[k]) for losses in totals.varied.values())
            said.append(
                tell(
                    "Once in {years:g} years more than {loss} are lost at once ({least} to "
                    "{most}), if what pieces withstand is correlated by {alike:g} between alike "
                    "ones and by {kinds:g} between kinds. It would be {alone} if each piece fell "
                    "by itself, and {together} if all fell together.",
                    years=each.years,
                    loss=amount(each.loss),
                    least=amount(each.low),
                    most=amount(each.high),
                    alike=totals.correlation.alike,
                    kinds=totals.correlation.kinds,
                    alone=alone,
                    together=together,
                )
            )
    beyond = [f"{each.years:g}" for each in totals.periods if each.beyond_curve]
    if beyond:
        said.append(
            tell(
                "Losses of once in {years} years come from shaking beyond the hazard curve, which "
                "is taken to go straight on: they are no result.",
                years=", ".join(beyond),
            )
        )
    for names, why in (
        (totals.without_cost, "without a cost"),
        (totals.without_function, "without a fragility function"),
    ):
        if names:
            said.append(
                tell(
                    "Not counted, {why}: {names}.",
                    why=translated(why),
                    names=named(names, MOST_NAMED),
                )
            )
    return said


def amount(value: float) -> str:
    """An amount in three digits, or in whole numbers where it is large."""
    if not np.isfinite(value):
        return translated("not known")
    return number(value, ",.0f") if abs(value) >= 100.0 else number(value, ".3g")


def _years(value: float) -> str:
    if value < 10.0:
        return number(value, ".2g")
    digits = 10 ** (int(np.floor(np.log10(value))) - 1)
    return number(round(value / digits) * digits, ",")


def _percent(share: float) -> str:
    if share < LEAST:
        return tell("below {least:g}", least=100 * LEAST)
    return number(100 * share, ".2g" if share < 0.995 else ".3g")
