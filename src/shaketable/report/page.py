"""The report: one HTML page that needs no other file."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict

from shaketable.assess import (
    ACCEPTED_FALLS,
    BASE_GRID,
    CLASSES,
    ENOUGH_RECORDINGS,
    FEW_FALLS,
    FEWEST_RECORDINGS,
    FRICTIONS,
    NOT_CLASSED,
    STRAP_SHARE,
    Assessment,
    FloorAssessment,
    ItemResult,
    class_of,
    fate_of,
)
from shaketable.building import Building
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES
from shaketable.criteria.overturning import HOUSNER
from shaketable.hazard.objects import ObjectRates
from shaketable.hazard.rates import YEARS
from shaketable.report import figures
from shaketable.report.earthquake import Quake
from shaketable.report.html import embedded_svg, pages
from shaketable.report.words import advice, findings, hazard, headline, numbers, space, straps
from shaketable.tilting import FEWEST_FALLS, SLIDES, TILTS, TURNS
from shaketable.units import degrees

MOST_FIRST = 10
MOST_CARDS = 24
MOST_CURVES = 12
MOST_ROWS = 500
MOST_PLACES = 40
MOST_UNCERTAIN = 40


def render(
    assessment: Assessment,
    run: Mapping[str, object],
    building: Building | None = None,
    rates: ObjectRates | None = None,
    quake: Quake | None = None,
) -> str:
    """The page of an assessment.

    Args:
        assessment: what was found.
        run: what the run log holds.
        building: the building whose floors were assessed, if there is one.
        rates: how often a year the objects fall, where a hazard curve is known.
        quake: what falls in the earthquake that was simulated, where it is one.
    """
    environment = pages()
    environment.filters["needed"] = _needed
    environment.filters["risk_in_words"] = findings.risk_in_words
    environment.filters["hundred"] = numbers.in_hundred_short
    environment.filters["interval"] = numbers.with_interval
    environment.filters["number"] = lambda x, digits=2: "–" if x != x else f"{x:.{digits}f}"
    environment.filters["two"] = numbers.two_digits
    environment.filters["safe_base"] = advice.safe_base
    environment.filters["degrees"] = _in_degrees
    environment.filters["over_turns"] = space.over_turns
    environment.filters["strap_forces"] = straps.strap_forces
    environment.filters["code_force"] = straps.code_force
    template = environment.get_template("page.html.j2")
    ranked = assessment.ranked()
    return template.render(
        assessment=assessment,
        building=building,
        what=headline.headline(assessment),
        how_sure=headline.how_sure(assessment),
        first=[_first(result, assessment) for result in ranked[:MOST_FIRST]],
        places=_places(assessment, building),
        levels=_levels(assessment, ranked),
        in_space=space.what_changes(assessment),
        solids=[each for each in ranked if each.solid is not None][:MOST_ROWS],
        uncertainty=headline.uncertainty(assessment),
        assumed_uncertainty=headline.assumed_uncertainty(),
        uncertain=[each for each in ranked if each.uncertain is not None][:MOST_UNCERTAIN],
        floors=[_shown(floor, assessment) for floor in assessment.floors],
        yearly={} if rates is None else _yearly(rates),
        at_site=[] if rates is None else hazard.of_inventory(rates, YEARS),
        not_in_hazard=hazard.NOT_CONSIDERED,
        hazard_curve=rates and rates.hazard,
        quake=quake and quake.shown(),
        ranked=ranked,
        tried=any(each.frictions for each in ranked),
        weights=asdict(assessment.weights),
        pga=headline.peaks(assessment.floors),
        colors=figures.COLORS,
        risk_classes=RISK_CLASSES,
        not_classed=NOT_CLASSED,
        few_falls=FEW_FALLS,
        what_a_strap_bears=straps.what_a_strap_bears(assessment),
        static_forces=straps.static_forces(),
        strap_share=STRAP_SHARE,
        on_floors=any(each.solid and each.solid.on_ground for each in ranked),
        accepted=ACCEPTED_FALLS,
        fewest=FEWEST_FALLS,
        fewest_recordings=FEWEST_RECORDINGS,
        enough_recordings=ENOUGH_RECORDINGS,
        frictions=FRICTIONS,
        turns=TURNS,
        tilts=[f"{degrees(tilt):g}" for tilt in TILTS],
        bases=[f"{base:g}" for base in BASE_GRID],
        slides=SLIDES,
        criteria=list(next((each.criteria for each in ranked if each.criteria), {})),
        housner=HOUSNER,
        run=run,
    )


def _yearly(rates: ObjectRates) -> dict[int, str]:
    """How often each object falls, by the number of its item."""
    return {
        number: hazard.yearly(one.found, YEARS, one.item.rolls)
        for number, one in rates.of_objects().items()
    }


def _in_degrees(angle: float, digits: int = 1) -> str:
    """An angle [rad] in degrees; empty for the end of an interval beyond all tilts tried."""
    if math.isnan(angle):
        return "–"
    return "" if math.isinf(angle) else f"{degrees(angle):.{digits}f}"


def _first(result: ItemResult, assessment: Assessment) -> dict[str, object]:
    """A line of the list of what to look at first."""
    item = result.item
    place = headline.floor_name(item.floor) if item.floor and assessment.in_building else ""
    return {
        "result": result,
        "where": ", ".join(part for part in (place, item.location) if part),
        "weight": assessment.weights.of(item),
        "like_it": _class_of_its_like(result),
        "measure": advice.first_measure(result),
    }


def _class_of_its_like(result: ItemResult) -> str:
    """The class of objects like it, which are planar: none that is better than its own."""
    if result.uncertain is None or result.risk == NOT_CLASSED:
        return ""
    found = class_of(result.uncertain.fall, result.recordings)
    return found if CLASSES.index(found) >= CLASSES.index(result.risk) else ""


def _places(assessment: Assessment, building: Building | None) -> list[dict[str, object]]:
    """Pieces and falls by floor, the highest first, or by room where there is no building."""
    found: dict[str, list[ItemResult]] = {}
    if building is not None:
        here = {floor.floor: list(floor.results) for floor in assessment.floors}
        found = {label: here.get(label, []) for label in reversed(list(building.floors))}
    else:
        for result in assessment.results:
            found.setdefault(result.item.location or "no room given", []).append(result)
    if len(found) < 2:
        return []
    fates = [(label, fate_of(results)) for label, results in found.items()]
    if building is None:
        fates.sort(key=lambda pair: pair[1].falls.value, reverse=True)
    return [
        {
            "name": headline.floor_name(label) if building else label,
            "fate": fate,
            "falls": numbers.of_pieces(fate.falls, fate.pieces),
            "rolls": numbers.of_pieces(fate.rolls_far, fate.pieces),
        }
        for label, fate in fates[:MOST_PLACES]
    ]


def _needed(friction: float) -> str:
    """A friction that is needed; a dash where nothing rocks, and words where none is enough."""
    if math.isinf(friction):
        return "none is enough"
    return "–" if math.isnan(friction) else f"{friction:.2f}"


def _levels(assessment: Assessment, ranked: Sequence[ItemResult]) -> list[dict[str, object]]:
    """What happens at each level of shaking."""
    return [
        {
            "name": level.name,
            "falls": numbers.expected_count(assessment.at_level(k).falls),
            "kinds": assessment.at_level(k).kinds,
            "first": [each.levels[k].governing_share for each in ranked[:MOST_FIRST]],
        }
        for k, level in enumerate(assessment.levels)
    ]


def _shown(floor: FloorAssessment, assessment: Assessment) -> dict[str, object]:
    """What the page shows for one place."""
    ordered = assessment.ranked(floor)
    curved = [
        each
        for each in ordered
        if each.curves
        and each.fall.value > ACCEPTED_FALLS
        and not (each.item.must_not_fall or each.as_it_stands)
    ]
    name = headline.floor_name(floor.floor) if floor.floor else ""
    return {
        "floor": floor,
        "title": name[:1].upper() + name[1:],
        "counts": f"{numbers.counted(floor.pieces, 'piece')} under "
        f"{numbers.counted(len(floor.motions), 'motion')}",
        "falls": numbers.of_pieces(fate_of(floor.results).falls, floor.pieces),
        "pga": headline.peaks([floor]),
        "overlooked": [
            (each.item.name, said)
            for each in ordered[:MOST_CARDS]
            if not each.as_it_stands and (said := findings.what_criteria_miss(each))
        ],
        "cards": [_card(result, assessment) for result in ordered[:MOST_CARDS]],
        "more_cards": max(0, len(ordered) - MOST_CARDS),
        "results": ordered[:MOST_ROWS],
        "omitted": max(0, len(ordered) - MOST_ROWS),
        "curves": [
            embedded_svg(figures.svg(figures.tilt_curve(each, assessment.control)))
            for each in curved[:MOST_CURVES]
        ],
    }


def _card(result: ItemResult, assessment: Assessment) -> dict[str, object]:
    """What the page says about one item."""
    return {
        "result": result,
        "happens": [
            said
            for said in (
                findings.what_happens(result, assessment.sources),
                findings.other_direction(result),
                findings.which_way(result),
            )
            if said
        ],
        "in_space": space.what_happens(result),
        "goes": findings.how_far_it_goes(result),
        "friction": findings.what_friction_does(result),
        "advice": advice.what_to_do(result, assessment.control),
    }
