"""The report: one HTML page that needs no other file."""

from __future__ import annotations

import base64
import math
from collections.abc import Mapping
from importlib.resources import files

from jinja2 import Environment, StrictUndefined
from markupsafe import Markup
from matplotlib.figure import Figure

from shaketable.assess import (
    ACCEPTED_FALLS,
    BASE_GRID,
    Assessment,
    FloorAssessment,
    ItemResult,
)
from shaketable.building import Building
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES
from shaketable.criteria.overturning import HOUSNER
from shaketable.report import figures, words
from shaketable.report.building import building_picture
from shaketable.tilting import FEWEST_FALLS, SLIDES, TILTS
from shaketable.units import STANDARD_GRAVITY, degrees

MOST_CARDS = 24
MOST_ROWS = 500


def render(
    assessment: Assessment, run: Mapping[str, object], building: Building | None = None
) -> str:
    """The page of an assessment.

    Args:
        assessment: what was found.
        run: what the run log holds.
        building: the building whose floors were assessed, if there is one.
    """
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    environment.filters["hundred"] = lambda x, digits=0: "–" if x != x else f"{100 * x:.{digits}f}"
    environment.filters["number"] = lambda x, digits=2: "–" if x != x else f"{x:.{digits}f}"
    environment.filters["degrees"] = _in_degrees
    template = environment.from_string(
        files("shaketable.report").joinpath("page.html.j2").read_text(encoding="utf-8")
    )
    picture = building and building_picture(building.name, list(building.floors), assessment)
    return template.render(
        assessment=assessment,
        building=building,
        picture=_embedded(picture) if picture else "",
        headline=words.headline(assessment),
        floors=[_shown(floor, assessment) for floor in assessment.floors],
        risk_classes=RISK_CLASSES,
        accepted=ACCEPTED_FALLS,
        fewest=FEWEST_FALLS,
        tilts=[f"{degrees(tilt):g}" for tilt in TILTS],
        bases=[f"{base:g}" for base in BASE_GRID],
        slides=SLIDES,
        criteria=list(assessment.results[0].criteria or ()),
        housner=HOUSNER,
        run=run,
    )


def _in_degrees(angle: float, digits: int = 1) -> str:
    """An angle [rad] in degrees; empty for the end of an interval beyond all tilts tried."""
    if math.isnan(angle):
        return "–"
    return "" if math.isinf(angle) else f"{degrees(angle):.{digits}f}"


def _shown(floor: FloorAssessment, assessment: Assessment) -> dict[str, object]:
    """What the page shows for one place."""
    ordered = floor.worst_first()
    curves = figures.tilt_curves(floor, assessment.control)
    return {
        "floor": floor,
        "title": f"Floor {floor.floor}" if floor.floor else "",
        "headline": words.floor_headline(floor),
        "counts": f"{words.counted(floor.pieces, 'piece')} under "
        f"{words.counted(len(floor.motions), 'motion')}",
        "smallest_pga_g": floor.smallest_pga / STANDARD_GRAVITY,
        "largest_pga_g": floor.largest_pga / STANDARD_GRAVITY,
        "cards": [_card(result, assessment) for result in ordered[:MOST_CARDS]],
        "results": ordered[:MOST_ROWS],
        "omitted": max(0, len(ordered) - MOST_ROWS),
        "shares": _embedded(figures.fall_shares(floor).get_figure()),
        "curves": _embedded(curves) if curves is not None else "",
    }


def _card(result: ItemResult, assessment: Assessment) -> dict[str, object]:
    """What the page says about one item."""
    return {
        "result": result,
        "happens": words.what_happens(result),
        "way": words.which_way(result, assessment.tilt),
        "criteria": words.what_criteria_miss(result),
        "sliding": words.how_far_it_slides(result),
        "advice": words.what_to_do(result, assessment.control, assessment.tilt),
    }


def _embedded(figure: object) -> Markup:
    assert isinstance(figure, Figure)
    data = base64.b64encode(figures.svg(figure).encode()).decode()
    return Markup(f"data:image/svg+xml;base64,{data}")  # noqa: S704  base64 of our own figure
