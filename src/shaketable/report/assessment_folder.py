"""The folder of an assessment's results."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd

from shaketable.assess import Assessment
from shaketable.building import Building
from shaketable.errors import SimulationError
from shaketable.hazard.objects import ObjectRates
from shaketable.hazard.rates import YEARS
from shaketable.language import Language, tell
from shaketable.report.earthquake import Quake
from shaketable.report.page import render
from shaketable.report.print_pdf import print_pdf
from shaketable.report.results_folder import write_folder

PAGE = "report.html"


def write_results(
    assessment: Assessment,
    run: Mapping[str, object],
    folder: Path,
    *,
    building: Building | None = None,
    rates: ObjectRates | None = None,
    quake: Quake | None = None,
    overwrite: bool = False,
    pdf: bool = False,
    docx: bool = False,
    languages: Sequence[Language] = (),
) -> None:
    """Write results.csv, results.parquet, report.html and run.json: all of them or none.

    What is printed or converted comes last, and one that fails takes nothing else with it.

    Args:
        assessment: what was found.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
        building: the building whose floors were assessed, if there is one.
        rates: how often a year the same objects fall, where a hazard curve is known.
        quake: what falls in the earthquake that was simulated, where it is one; its tables are
            written beside.
        overwrite: replace earlier results.
        pdf: whether the report is printed as report.pdf too.
        docx: whether its first part is written as report.docx too, with the extra docx.
        languages: in which the report is written beside the one that is spoken, as
            report.es.html.

    Raises:
        InputError: a folder that cannot be written.
        SimulationError: the PDF or the Word document could not be made; all else is written.
    """
    with_page = partial(render, assessment, run, building, rates, quake)

    failed: list[str] = []

    def converted(name: str, write: Callable[[], None]) -> None:
        try:
            write()
        except Exception as error:  # what browsers and python-docx raise
            failed.append(f"{name}: {error}")

    def beside(fresh: Path) -> None:
        for language in languages:
            page = with_page(language)
            (fresh / f"report.{language}.html").write_text(page, encoding="utf-8")
        if pdf:
            converted("report.pdf", lambda: print_pdf(fresh / PAGE, fresh / "report.pdf"))
        if docx:
            from shaketable.report.as_docx import write_docx

            path = fresh / "report.docx"
            converted(path.name, lambda: write_docx(assessment, run, building, path))

    table = assessment.table if rates is None else _with_rates(assessment, rates)
    write_folder(
        folder,
        run,
        overwrite=overwrite,
        tables={**(quake.tables() if quake else {}), "results": table},
        parquet=["results"],
        page=lambda _: with_page(),
        page_name=PAGE,
        finish=beside,
    )
    if failed:
        raise SimulationError(
            tell(
                "{failed}; all other results are in {folder}",
                failed="; ".join(failed),
                folder=folder,
            )
        )


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
