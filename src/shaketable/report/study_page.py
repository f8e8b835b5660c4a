"""A study on one page: the paper's claims, the figures and the tables."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence

import pandas as pd

from shaketable.report.html import pages
from shaketable.study import PublishedStudy, Study

MOST_ROWS = 40
DIGITS = 4  # of numbers; the CSV files have all


def render_study(
    published: PublishedStudy, study: Study, run: Mapping[str, object], pictures: Sequence[str]
) -> str:
    """The page of a study.

    Args:
        published: the paper.
        study: what was found.
        run: what the run log holds.
        pictures: names of the files of its figures, beside the page.
    """
    claims = study.tables["claims"].to_dict("records")
    return (
        pages()
        .get_template("study.html.j2")
        .render(
            name=published.name,
            reference=published.reference,
            summary=published.summary,
            records=study.records,
            claims=claims,
            verdicts=Counter(claim["holds"] for claim in claims).most_common(),
            pictures=pictures,
            tables=[
                _shown(name, table) for name, table in study.tables.items() if name != "claims"
            ],
            messages=run.get("messages", ()),
            run=run,
        )
    )


def _shown(name: str, table: pd.DataFrame) -> dict[str, object]:
    """A table's first rows as text."""
    rows = [
        [_text(cell) for cell in row]
        for row in table.head(MOST_ROWS).itertuples(index=False, name=None)
    ]
    return {"name": name, "columns": list(table.columns), "rows": rows, "count": len(table)}


def _text(value: object) -> str:
    if isinstance(value, float):
        return "–" if math.isnan(value) else f"{value:.{DIGITS}g}"
    return str(value)
