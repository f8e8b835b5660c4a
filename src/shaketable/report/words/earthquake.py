"""What falls in one earthquake, in sentences."""

from __future__ import annotations

import numpy as np

from shaketable.assess import Share
from shaketable.assess.earthquake import EarthquakeFalls, ObjectFall
from shaketable.fragility.shown import unit_shown
from shaketable.hazard import Scenario, ShakeMap
from shaketable.report.words.hazard import AS_IF_FIXED, where
from shaketable.report.words.numbers import (
    counted,
    expected_count,
    in_hundred_short,
    with_interval,
)

OF_SCENARIO = (
    "Ground-motion models of shallow earthquakes in active regions stand for the earthquake; the "
    "median of two horizontal components is taken for the one that shakes an object. The site is "
    "on the footwall; no pulse of a rupture that runs toward it, no basin."
)
OF_MAP = (
    "The map's uncertainty is taken as independent of that of the fragility functions. ShakeMap "
    "gives the median of both horizontal components or the larger one, and a function is of any "
    "one: where it is the larger one, falls come out too many."
)
ALWAYS = (
    "Bodies are planar and rigid, each direction by itself, and an object counts in the direction "
    "in which it falls more often. Aftershocks, damage to the building and objects that hit each "
    "other are not considered. Anchored objects are left out."
)
SAME = 0.15  # of the falls: smaller differences are not explained, nor those of half a piece
MOST_NAMED = 3


def lead(found: EarthquakeFalls, quake: Scenario | ShakeMap) -> list[str]:
    """What falls, how strongly the ground is shaken, and by which method."""
    totals = found.totals()
    pieces = counted(totals.pieces, "piece")
    sentences = [_shaking(found, quake)]
    by_function = expected_count(totals.by_function)
    if np.isfinite(totals.simulated):
        sentences.append(
            f"Of {pieces} that stand free, {expected_count(totals.simulated)} fall on average by "
            f"simulation, and {by_function} by fragility functions."
        )
        if isinstance(quake, Scenario):
            sentences[-1] += (
                f" Simulation knows the whole motion, a function {found.measure.name} alone: the "
                "first number is the one to use."
            )
        sentences += _why(found)
    elif totals.pieces:
        sentences.append(
            f"Of {pieces} that stand free, {by_function} fall on average, by fragility functions."
        )
    if totals.pieces:
        low, high = found.interval
        some = f"{low:,.0f} to {high:,.0f}" if high > 0.0 else "none"
        sentences.append(
            "One such earthquake may be much weaker or much stronger than the average, and it is "
            f"so everywhere at once: in 19 of 20 of them {some} of these pieces fall, by their "
            "functions."
        )
    return sentences + _without_function(found)


def _without_function(found: EarthquakeFalls) -> list[str]:
    """What has no fragility function, and why."""
    untold = found.without_function()
    if not untold:
        return []
    pieces = counted(sum(one.chance.item.quantity for one in untold), "more piece")
    simulated = sum(one.falls for one in untold if one.simulated)
    by_simulation = f"; by simulation {expected_count(simulated)} of them fall"
    reasons = "; ".join(
        f"{one.chance.item.called(one.chance.number)}, {one.chance.curve.problem}"
        for one in untold[:MOST_NAMED]
    )
    return [
        f"Of {pieces} no fragility function can be told, and they are not in these numbers"
        f"{by_simulation if untold[0].simulated else ''} ({reasons}"
        f"{', …' if len(untold) > MOST_NAMED else ''})."
    ]


def _shaking(found: EarthquakeFalls, quake: Scenario | ShakeMap) -> str:
    unit = unit_shown(found.measure)
    medians = sorted({round(unit.factor * float(np.exp(each.mean)), 12)
                      for each in found.places.values()})  # fmt: skip
    sigma = max(each.sigma for each in found.places.values())
    name = f"{found.measure.name} of the ground"
    if isinstance(quake, Scenario):
        low, high = (medians[0] * float(np.exp(sign * sigma)) for sign in (-1.0, 1.0))
        models = ", ".join(quake.weights)
        if quake.hypocentral_depth == quake.hypocentral_depth:
            models += f"; CB14 with its hypocentre {quake.hypocentral_depth:.1f} km deep"
        return (
            f"In an earthquake of {found.name}, the {name} has a median of {medians[0]:.3g} "
            f"{unit.name}, and lies between {low:.3g} and {high:.3g} {unit.name} in two of three "
            f"such earthquakes ({models})."
        )
    said = f"{medians[0]:.3g}"
    if len(medians) > 1:
        said += f" to {medians[-1]:.3g}"
    return (
        f"In “{found.name}” (magnitude {quake.magnitude:g}), the median {name} was {said} "
        f"{unit.name} at "
        f"{counted(len(found.places), 'place')} of the inventory."
    )


def _why(found: EarthquakeFalls) -> list[str]:
    """Why simulation and functions differ, where they do."""
    totals = found.totals()
    measure = found.measure.name
    difference = totals.simulated - totals.by_function
    if abs(difference) <= max(SAME * max(totals.simulated, totals.by_function), 0.5):
        return [
            f"The totals are within {100 * SAME:.0f} % of each other; single objects may differ "
            "more, see the table."
        ]
    sampled = totals.through - totals.by_function
    shape = totals.simulated - totals.through
    return [
        f"Simulation gives {_more(difference)} pieces: {_more(sampled)} as the {measure} of the "
        f"simulated motions is not exactly that of this earthquake, and {_more(shape)} for what "
        f"{measure} does not tell: how long the shaking lasts, which periods it has, and whether "
        "it comes in pulses. The functions are from recorded motions of other earthquakes, scaled. "
        "With so many motions chance alone may make a difference of "
        f"{expected_count(totals.by_chance)} pieces."
    ]


def _more(number: float) -> str:
    return f"{abs(number):.1f} {'more' if number >= 0.0 else 'fewer'}"


def row(one: ObjectFall) -> dict[str, object]:
    """A line of the table of objects."""
    item, chance = one.chance.item, one.chance.chance
    known = np.isfinite(chance.value)
    here = where(item.building, one.chance.floor) or one.chance.place.name
    return {
        "name": item.called(one.chance.number),
        "where": ", ".join(part for part in (here, item.location) if part),
        "quantity": item.quantity,
        "direction": one.chance.direction,
        "simulated": _of_hundred(*one.simulated) if one.simulated else "–",
        "through": in_hundred_short(one.through) if np.isfinite(one.through) else "–",
        "by_function": _of_hundred(*chance) if known else "–",
        "falls": f"{one.falls:.2g}" if np.isfinite(one.falls) else "–",
        "note": _note(one),
    }  # fmt: skip


def _of_hundred(value: float, low: float, high: float) -> str:
    """As "12 (8–17)"."""
    if not np.isfinite(low) or 0.0 < high < 0.01:
        return in_hundred_short(value)
    return with_interval(Share(value, low, high))


def _note(one: ObjectFall) -> str:
    if one.chance.item.rolls and one.simulated:
        return f"simulated rolling on its castors, its function {AS_IF_FIXED}"
    return one.chance.curve.problem or one.chance.curve.caution
