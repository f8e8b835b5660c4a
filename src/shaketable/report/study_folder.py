"""A study's results as files: a page, a CSV for each table, the figures, a JSON of all numbers."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from shaketable.outputs import results_folder, write_csv
from shaketable.report.study_page import render_study
from shaketable.study import PublishedStudy, Study

SUMMARY = "study.json"
PAGE = "index.html"


def earlier_files(folder: Path) -> tuple[str, ...]:
    """The files of an earlier study in a folder, as its study.json lists them; none without it."""
    try:
        listed = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))["files"]
    except (OSError, ValueError, KeyError, TypeError):
        return ()
    return tuple(str(name) for name in listed)


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
    with results_folder(folder, overwrite, earlier_files(folder)) as fresh:
        for name, table in study.tables.items():
            write_csv(table, fresh / f"{name}.csv")
        pictures = []
        for name, figure in published.figures(study):
            pictures.append(f"{name}.png")
            figure.savefig(fresh / pictures[-1], dpi=110)
        page = render_study(published, study, run, pictures)
        (fresh / PAGE).write_text(page, encoding="utf-8")
        content = {
            "study": published.name,
            "reference": published.reference,
            "records": study.records,
            "run": run,
            "files": sorted([*(path.name for path in fresh.iterdir()), SUMMARY]),
            "tables": {name: _columns(table) for name, table in study.tables.items()},
        }
        text = json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False)
        (fresh / SUMMARY).write_text(text + "\n", encoding="utf-8")


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
