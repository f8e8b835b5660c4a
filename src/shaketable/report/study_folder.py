"""A study's results as files: a page, a CSV for each table, the figures, a JSON of all numbers."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from shaketable.report.results_folder import Picture, write_folder
from shaketable.report.study_page import render_study
from shaketable.study import PublishedStudy, Study

SUMMARY = "study.json"


def write_study(
    published: PublishedStudy,
    study: Study,
    run: Mapping[str, object],
    folder: Path,
    *,
    overwrite: bool = False,
) -> None:
    """Write all the files of a study, or none.

    Args:
        published: the paper, with the drawing of its figures.
        study: what was found.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
    """

    def summary(fresh: Path) -> None:
        content = {
            "study": published.name,
            "reference": published.reference,
            "records": study.records,
            "run": run,
            "tables": {name: _columns(table) for name, table in study.tables.items()},
        }
        text = json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False)
        (fresh / SUMMARY).write_text(text + "\n", encoding="utf-8")

    write_folder(
        folder,
        run,
        overwrite=overwrite,
        tables=study.tables,
        pictures=(Picture(name, "", figure) for name, figure in published.figures(study)),
        page=lambda pictures: render_study(published, study, run, [p["file"] for p in pictures]),
        others=summary,
    )


def _columns(table: pd.DataFrame) -> dict[str, list[Any]]:
    """A table's columns in plain values; null where a value is missing."""
    return {
        str(name): [_plain(value) for value in values]
        for name, values in table.to_dict("list").items()
    }


def _plain(value: object) -> object:
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value
