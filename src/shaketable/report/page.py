"""The report: one HTML page that needs no other file, two pages to sign and an annex."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import PurePath
from typing import Any

from shaketable.assess import (
    ACCEPTED_FALLS,
    LEADING,
    STRAP_SHARE,
    Assessment,
    ItemResult,
    alike,
)
from shaketable.building import Building
from shaketable.criteria.overturning import HOUSNER
from shaketable.errors import named
from shaketable.hazard.objects import ObjectRates
from shaketable.hazard.rates import YEARS
from shaketable.language import Language, number, speaking, spoken, tell, translated
from shaketable.report import annex, figures, first_part
from shaketable.report.earthquake import Quake
from shaketable.report.html import pages
from shaketable.report.words import advice, hazard, headline, method, numbers, straps
from shaketable.tilting import SLIDES
from shaketable.units import degrees

MOST_NAMED = 12  # objects in a warning


def render(
    assessment: Assessment,
    run: Mapping[str, Any],
    building: Building | None = None,
    rates: ObjectRates | None = None,
    quake: Quake | None = None,
    language: Language | None = None,
) -> str:
    """The page of an assessment.

    Args:
        assessment: what was found.
        run: what the run log holds.
        building: the building whose floors were assessed, if there is one.
        rates: how often a year the objects fall, where a hazard curve is known.
        quake: what falls in the earthquake that was simulated, where it is one.
        language: of the page; the one that is spoken if None.
    """
    with speaking(language or spoken()):
        return _rendered(assessment, run, building, rates, quake)


def _rendered(
    assessment: Assessment,
    run: Mapping[str, Any],
    building: Building | None,
    rates: ObjectRates | None,
    quake: Quake | None,
) -> str:
    ranked = assessment.ranked()
    flat = [each for each in ranked if each.solid is None]
    levels = assessment.levels
    kinds = {alike(each.item) for each in ranked}
    environment = pages()
    environment.filters |= {
        "hundred": numbers.in_hundred_short,
        "interval": numbers.with_interval,
        "number": lambda x, digits=2: "–" if x != x else number(x, f".{digits}f"),
        "two": numbers.two_digits,
        "degrees": _in_degrees,
        "needed": annex.needed,
        "safe_base": advice.safe_base,
        "strap_forces": straps.strap_forces,
        "code_force": straps.code_force,
    }
    sure, more_sure = headline.in_three_sentences(assessment)
    rows = first_part.rows(assessment, ranked)
    return environment.get_template("report.html.j2").render(
        tell=tell,
        translated=translated,
        lang=spoken(),
        assessment=assessment,
        building=building,
        run=run,
        list_name=PurePath(str(run["inventory"]["path"])).name,
        quake=quake and quake.shown(),
        warnings=[*headline.not_as_it_stands(assessment), *_not_assessed(run)],
        what=headline.what_falls(assessment),
        assumed=headline.assumed(assessment),
        assumed_in_short=headline.assumed_in_short(assessment),
        rows=rows,
        places=first_part.places(assessment, building),
        of_what=method.of_what(assessment),
        forces=method.forces() if any(row.holds for row in rows) else "",
        sure=sure,
        more_sure=more_sure,
        motions=method.motions(assessment, run, building, quake is not None),
        not_considered=method.not_considered(assessment),
        order=method.order(assessment),
        levels=_levels(assessment, ranked) if levels else [],
        at_site=[] if rates is None else hazard.of_inventory(rates, YEARS),
        not_in_hazard=translated(hazard.NOT_CONSIDERED),
        hazard_curve=rates and rates.hazard,
        cards=annex.cards(assessment, ranked, rates),
        more_cards=max(0, len(kinds) - annex.MOST_CARDS),
        floors=annex.floors(assessment),
        curves=annex.curves(assessment, ranked),
        flat=flat[: annex.MOST_ROWS],
        forced=[each for each in ranked if not each.item.rolls][: annex.MOST_ROWS],
        judged=[each for each in ranked if each.criteria][: annex.MOST_ROWS],
        overlooked=annex.overlooked(ranked[: annex.MOST_ROWS]),
        uncertainty=headline.uncertainty(assessment),
        assumed_uncertainty=headline.assumed_uncertainty(),
        uncertain=assessment.uncertain,
        method=method.sentences(assessment),
        static_forces=straps.static_forces(),
        strap_share=STRAP_SHARE,
        accepted=ACCEPTED_FALLS,
        control=assessment.control,
        slides=SLIDES,
        colors=figures.COLORS,
        criteria=list(next((each.criteria for each in ranked if each.criteria), {})),
        housner=HOUSNER,
        weights=asdict(assessment.weights),
    )


def _in_degrees(angle: float, digits: int = 1) -> str:
    """An angle [rad] in degrees; empty for the end of an interval beyond all tilts tried."""
    if math.isnan(angle):
        return "–"
    return "" if math.isinf(angle) else number(degrees(angle), f".{digits}f")


def _levels(assessment: Assessment, ranked: Sequence[ItemResult]) -> list[dict[str, object]]:
    """What happens at each level of shaking."""
    return [
        {
            "name": level.name,
            "falls": numbers.expected_count(assessment.at_level(k).falls),
            "kinds": assessment.at_level(k).kinds,
            "first": [each.levels[k].governing_share for each in ranked[:LEADING]],
            "names": [each.item.name for each in ranked[:LEADING]],
        }
        for k, level in enumerate(assessment.levels)
    ]


def _not_assessed(run: Mapping[str, Any]) -> list[str]:
    """What the list names without its sizes, which nothing here is about."""
    names = (run.get("inventory") or {}).get("not_assessed") or []
    if not names:
        return []
    return [
        tell(
            "Not assessed, as the list does not give their sizes: {names}. They may fall.",
            names=named(list(names), MOST_NAMED),
        )
    ]
