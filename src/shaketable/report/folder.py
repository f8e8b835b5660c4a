"""The folder of an assessment's results, and the log that makes a run repeatable."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pandas as pd

from shaketable.assess import Assessment
from shaketable.building import Building
from shaketable.hazard.objects import ObjectRates
from shaketable.hazard.rates import YEARS
from shaketable.outputs import results_folder, write_table
from shaketable.report.earthquake import TABLES, Quake
from shaketable.report.page import render

#: What `assess` writes.
FILES = ("results.parquet", "results.csv", "report.html", "run.json")
PACKAGES = (
    "shaketable",
    "matplotlib",
    "numba",
    "numpy",
    "openpyxl",
    "pandas",
    "python-calamine",
    "scipy",
    "xarray",
)


def write_results(
    assessment: Assessment,
    run: Mapping[str, object],
    folder: Path,
    *,
    building: Building | None = None,
    rates: ObjectRates | None = None,
    quake: Quake | None = None,
    overwrite: bool = False,
) -> None:
    """Write results.parquet, results.csv, report.html and run.json: all of them or none.

    Args:
        assessment: what was found.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
        building: the building whose floors were assessed, if there is one.
        rates: how often a year the same objects fall, where a hazard curve is known.
        quake: what falls in the earthquake that was simulated, where it is one; its tables are
            written beside.
        overwrite: replace earlier results.
    """
    table = assessment.table if rates is None else _with_rates(assessment, rates)
    files = (*FILES, *TABLES) if quake else FILES
    with results_folder(folder, overwrite, files) as fresh:
        if quake is not None:
            quake.write_tables(fresh)
        write_table(table, fresh, "results")
        page = render(assessment, run, building, rates, quake)
        (fresh / "report.html").write_text(page, encoding="utf-8")
        text = json.dumps(run, indent=2, ensure_ascii=False)
        (fresh / "run.json").write_text(text + "\n", encoding="utf-8")


def _with_rates(assessment: Assessment, rates: ObjectRates) -> pd.DataFrame:
    """The table of an assessment with the annual rates of falls of its items."""
    table = assessment.table
    yearly = rates.of_objects()
    of_results = [yearly.get(result.number) for result in assessment.results]
    known = [each and each.found for each in of_results]
    table["annual_falls"] = [one.rate if one else np.nan for one in known]
    for k, end in enumerate(("low", "high")):
        table[f"annual_falls_{end}"] = [one.interval[k] if one else np.nan for one in known]
    table[f"fall_probability_in_{YEARS:g}_years"] = [
        one.probability() if one else np.nan for one in known
    ]
    return table


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def versions() -> dict[str, str]:
    """The versions on which the results depend."""
    return {"python": platform.python_version(), **{name: version(name) for name in PACKAGES}}
