"""A study's results as files: a CSV a table, its figures, and one JSON file with all numbers."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from shaketable.report.folder import appearing
from shaketable.studies import Study

#: What an earlier result may hold, as patterns.
FILES = ("*.csv", "figure_*.png", "study.json")


def write_study(
    study: Study,
    figures: Callable[[Study], Iterable[tuple[str, Figure]]],
    run: Mapping[str, object],
    folder: Path,
    *,
    overwrite: bool = False,
) -> None:
    """All of it or nothing.

    Args:
        figures: draws the study's figures, each with its name.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
    """
    with appearing(folder, overwrite, FILES) as fresh:
        for name, table in study.tables.items():
            table.to_csv(fresh / f"{name}.csv", index=False, float_format="%.6g")
        for name, figure in figures(study):
            figure.savefig(fresh / f"{name}.png", dpi=110)
        content = {
            "study": study.name,
            "reference": study.reference,
            "records": study.records,
            "run": run,
            "tables": {name: _rows(table) for name, table in study.tables.items()},
        }
        text = json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False)
        (fresh / "study.json").write_text(text + "\n", encoding="utf-8")


def _rows(table: pd.DataFrame) -> list[dict[str, Any]]:
    """A table's rows in plain values; null where there is none."""
    return [
        {str(name): _plain(value) for name, value in row.items()}
        for row in table.to_dict("records")
    ]


def _plain(value: object) -> object:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value
