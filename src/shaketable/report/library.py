"""A library as files: tables, what loss tools read, a page to search it, and what an archive needs.

The page holds the rows and draws them itself, so that it works from a folder and from an archive.
"""

from __future__ import annotations

import hashlib
import json
import logging
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from shaketable.errors import InputError
from shaketable.fragility.exported import word_of
from shaketable.fragility.nrml import write_nrml
from shaketable.fragility.pelicun import write_into
from shaketable.fragility.shown import unit_shown
from shaketable.library.exported import exports_of
from shaketable.library.measures import measure_of
from shaketable.library.other_formats import ned_tables, pyincore_sets
from shaketable.library.table import COLUMNS, rounded
from shaketable.report.html import pages
from shaketable.report.results_folder import write_folder

log = logging.getLogger(__name__)

TABLE, DICTIONARY, PACKAGE = "functions", "data_dictionary", "datapackage.json"
#: Of the rows on the page, in its order; the others are in the CSV.
ON_PAGE = (
    "id", "thing", "place", "held", "tilt", "limit_state", "measure", "median", "median_low",
    "median_high", "beta", "beta_motions", "beta_object", "beta_model", "simulations",
    "recordings", "events", "recordings_reaching", "given_up", "problem", "caution", "depth",
    "width", "height", "cg_low", "cg_high", "friction_low", "friction_high",
)  # fmt: skip
LICENCE = {"name": "CC-BY-4.0", "path": "https://creativecommons.org/licenses/by/4.0/"}
NOT_CONSIDERED = (
    "Things are rigid, as are their floors and walls: contents that move, doors and drawers that "
    "open, soft feet and carpets are not in them. Motions are recorded ones of moderate to large "
    "earthquakes, scaled, without their vertical component; buildings are linear. The sizes of a "
    "kind are assumed from what such things commonly measure. β_model holds what shake-table tests "
    "of two granite blocks ask for; no furniture was tested. Straps break, but their anchors and "
    "walls do not, and their stiffness is assumed. A function is of one thing alone: "
    "what falls onto it or leans on it is not in it."
)


def write_library(
    table: pd.DataFrame,
    title: str,
    edition: str,
    run: Mapping[str, Any],
    folder: Path,
    *,
    overwrite: bool = False,
) -> list[str]:
    """Write all files of a library, or none; returns their names.

    Args:
        table: its rows, as `table_of` gives them.
        title, edition: of the library.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.

    Raises:
        InputError: the folder cannot be written.
    """
    table = rounded(table)

    def others(fresh: Path) -> None:
        called = f"{title}, edition {edition}"
        for state in table["limit_state"].unique():
            for name, export in exports_of(table[table["limit_state"] == state], called).items():
                path = fresh / f"openquake_{file_word(name)}_{word_of(str(state))}.xml"
                try:
                    write_nrml(export, path)
                except InputError as error:
                    log.info("%s not written for OpenQuake: %s", name, error)
        for name, export in exports_of(table, called).items():
            word = file_word(name)
            try:
                write_into(fresh, export, prefix=f"pelicun_{word}_")
            except InputError as error:
                log.info("%s not written for pelicun: %s", name, error)
            if sets := pyincore_sets(table, name, title):
                _write_json(sets, fresh / f"pyincore_{word}.json")
        ned = ned_tables(table, called)
        _write_json(ned.models, fresh / "ned_fragility_model.json")
        _write_json(ned.curves, fresh / "ned_fragility_curve.json")

    def finish(fresh: Path) -> None:
        package = data_package(fresh, title, edition, run)
        _write_json(package, fresh / PACKAGE)

    return write_folder(
        folder,
        run,
        overwrite=overwrite,
        tables={TABLE: table, DICTIONARY: dictionary()},
        parquet=(TABLE,),
        page=lambda pictures: render(table, title, edition, run),
        others=others,
        finish=finish,
    )


def _write_json(value: object, path: Path) -> None:
    text = json.dumps(value, indent=1, ensure_ascii=False)
    path.write_text(text + "\n", encoding="utf-8")


def file_word(measure: str) -> str:
    """The name of a measure in names of files, such as PGV, floor_PGV or SA_1.0."""
    return measure.replace(" ", "_").replace("(", "_").replace(")", "")


def dictionary() -> pd.DataFrame:
    """What each column of the table means."""
    return pd.DataFrame(
        [
            {"column": name, "type": each.kind, "unit": each.unit, "meaning": each.meaning}
            for name, each in COLUMNS.items()
        ]
    )


def data_package(folder: Path, title: str, edition: str, run: Mapping[str, Any]) -> dict[str, Any]:
    """The descriptor of a folder as a Frictionless Data Package, with a hash of each file."""
    resources = []
    for path in sorted(folder.iterdir()):
        content = path.read_bytes()
        resource: dict[str, Any] = {
            "name": path.name.lower().replace(".", "-").replace("_", "-"),
            "path": path.name,
            "bytes": len(content),
            "hash": f"sha256:{hashlib.sha256(content).hexdigest()}",
        }
        if path.name == f"{TABLE}.csv":
            resource |= {
                "profile": "tabular-data-resource",
                "schema": {
                    "fields": [
                        {
                            "name": name,
                            "type": each.kind,
                            "description": f"{each.meaning} [{each.unit}]"
                            if each.unit
                            else each.meaning,
                        }
                        for name, each in COLUMNS.items()
                    ],
                    "missingValues": [""],
                },
            }
        resources.append(resource)
    return {
        "name": "shaketable-library",
        "title": f"Fragility functions: {title}",
        "version": edition,
        "description": NOT_CONSIDERED,
        "licenses": [LICENCE],
        "contributors": [{"title": "The shaketable developers", "role": "author"}],
        "environment": run.get("environment"),
        "motions": run.get("motions"),
        "resources": resources,
    }


def render(
    table: pd.DataFrame, title: str, edition: str, run: Mapping[str, Any], *, published: str = ""
) -> str:
    """The page; arguments as for `write_library`.

    Args:
        published: the path of the table in the repository without its ending, of a page that
            stands by itself.
    """
    units = {}
    for name in table["measure"].unique():
        unit = unit_shown(measure_of(str(name)).measure)
        units[str(name)] = [unit.name, unit.factor]
    known = int(table["median"].notna().sum())
    return (
        pages()
        .get_template("library.html.j2")
        .render(
            title=title,
            edition=edition,
            count=len(table),
            known=known,
            things=table["thing"].nunique(),
            not_considered=NOT_CONSIDERED,
            data=_as_script({"columns": ON_PAGE, "rows": _rows(table), "units": units}),
            run=run,
            published=published,
        )
    )


def _rows(table: pd.DataFrame) -> list[list[Any]]:
    """The rows of the page: numbers in four digits, None for what is not known."""

    def plain(value: Any) -> Any:
        if isinstance(value, (float, np.floating)):
            return float(f"{value:.4g}") if np.isfinite(value) else None
        return value.item() if isinstance(value, np.generic) else value

    return [[plain(value) for value in row] for row in table[list(ON_PAGE)].itertuples(index=False)]


def _as_script(data: Mapping[str, Any]) -> str:
    """JSON that may stand within a script of a page."""
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
