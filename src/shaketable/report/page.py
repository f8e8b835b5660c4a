"""The report: one HTML page that needs nothing else."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from importlib.resources import files

from jinja2 import Environment, StrictUndefined
from markupsafe import Markup
from matplotlib.figure import Figure

from shaketable.assess import (
    ACCEPTED_FALLS,
    BASE_GRID,
    COLUMNS,
    TILT_GRID_DEG,
    Part,
)
from shaketable.building import Building
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES
from shaketable.report import figures, words
from shaketable.report.building import building_picture
from shaketable.tilting import FEWEST_FALLS, SLIDES

MOST_CARDS = 24
MOST_ROWS = 500


def render(
    parts: Sequence[Part], run: Mapping[str, object], building: Building | None = None
) -> str:
    """The page of an assessment; `run` is what the run log holds.

    Args:
        parts: one, or one a floor of a building.
        run: what the run log holds.
        building: the building, if there is one.
    """
    first = parts[0].assessment
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    environment.filters["hundred"] = lambda x, digits=0: "–" if x != x else f"{100 * x:.{digits}f}"
    environment.filters["number"] = lambda x, digits=2: "–" if x != x else f"{x:.{digits}f}"
    template = environment.from_string(
        files("shaketable.report").joinpath("page.html.j2").read_text(encoding="utf-8")
    )
    picture = building and building_picture(building.name, list(building.floors), parts)
    return template.render(
        assessment=first,
        building=building,
        picture=_embedded(picture) if picture else "",
        headline=words.headline(first) if building is None else words.building_headline(parts),
        parts=[_shown(part) for part in parts],
        risk_classes=RISK_CLASSES,
        accepted=ACCEPTED_FALLS,
        fewest=FEWEST_FALLS,
        tilts=[f"{tilt:g}" for tilt in TILT_GRID_DEG],
        bases=[f"{base:g}" for base in BASE_GRID],
        slides=SLIDES,
        criteria=COLUMNS if "housner_share" in first.table else {},
        run=run,
    )


def _shown(part: Part) -> dict[str, object]:
    """What the page shows of one part."""
    assessment = part.assessment
    ordered = assessment.worst_first()
    rows = ordered.head(MOST_ROWS).to_dict("records")
    curves = figures.tilt_curves(assessment)
    cards = [
        {
            "row": row,
            "happens": words.what_happens(row),
            "way": words.which_way(row, assessment.tilt_deg),
            "criteria": words.what_criteria_miss(row),
            "sliding": words.how_far_it_slides(row),
            "advice": words.what_to_do(row, assessment.control, assessment.tilt_deg),
        }
        for row in rows[:MOST_CARDS]
    ]
    return {
        "part": part,
        "title": f"Floor {part.floor}" if part.floor else "",
        "headline": words.headline(assessment),
        "counts": f"{words.counted(part.pieces, 'piece')} under "
        f"{words.counted(len(assessment.motions), 'motion')}",
        "cards": cards,
        "rows": rows,
        "omitted": len(ordered) - len(rows),
        "shares": _embedded(figures.fall_shares(assessment).get_figure()),
        "curves": _embedded(curves) if curves is not None else "",
    }


def _embedded(figure: object) -> Markup:
    assert isinstance(figure, Figure)
    data = base64.b64encode(figures.svg(figure).encode()).decode()
    return Markup(f"data:image/svg+xml;base64,{data}")  # noqa: S704  base64 of our own figure
