"""`shaketable library`: rows of a library of fragility functions, for loss tools."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from shaketable.cli.console import say
from shaketable.cli.options import Overwrite
from shaketable.report.run_log import RunLog

if TYPE_CHECKING:
    import pandas as pd

MOST_SHOWN = 40


def library(
    *,
    table: Annotated[Path, typer.Argument(help="Table of a library's rows: its functions.csv.")],
    find: Annotated[
        str, typer.Option(help="Words that all have to be in a row, such as 'bookcase wall'.")
    ] = "",
    limit_state: Annotated[
        str | None, typer.Option(help="overturns, uplift, 'slides 0.1 m', 'reaches 0.8 m', ...")
    ] = None,
    measure: Annotated[
        str | None, typer.Option(help="PGV, PGA, 'SA(1.0)', 'AvgSA(1.0)', 'floor PGV', ...")
    ] = None,
    place: Annotated[str | None, typer.Option(help="ground, or a floor of a building.")] = None,
    held: Annotated[
        str | None, typer.Option(help="free, or how the things are held, as the table has it.")
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for these rows: a table, a page, files for OpenQuake and pelicun."
        ),
    ] = None,
    overwrite: Overwrite = False,
) -> None:
    """Find rows in a library of fragility functions, and write them for loss tools.

    Without --out the rows are printed.
    """
    from shaketable.library.published import found_rows, read_library_table
    from shaketable.report.library import write_library
    from shaketable.report.results_folder import require_folder
    from shaketable.report.run_log import sha256

    run_log = RunLog()
    if out is not None:
        require_folder(out, overwrite, run_log)
    rows = found_rows(
        read_library_table(table), words=find, limit_state=limit_state, measure=measure,
        place=place, held=held,
    )  # fmt: skip
    if out is None:
        for line in _lines(rows):
            say(line)
        return
    run = {**run_log.entries(), "library": {"path": str(table), "sha256": sha256(table)}}
    write_library(rows, "Unanchored things", f"rows of {table.name}", run, out, overwrite=overwrite)
    say(f"{len(rows):,} rows; page: {out / 'index.html'}")


def _lines(rows: pd.DataFrame) -> list[str]:
    """The first rows in words, and how many more there are."""
    from shaketable.fragility.shown import unit_shown
    from shaketable.library.measures import measure_of

    found = []
    for _, row in rows.head(MOST_SHOWN).iterrows():
        found += _told(row, unit_shown(measure_of(str(row["measure"])).measure))
    more = len(rows) - MOST_SHOWN
    if more > 0:
        found.append(f"{more:,} more rows; --find, --measure and the other options narrow them")
    return found


def _told(row: pd.Series[Any], unit: Any) -> list[str]:
    """A row: whose function it is, and what that is."""
    tilt = f", tilt {row['tilt']:g}°" if row["tilt"] else ""
    whose = f"{row['thing']}, {row['place']}, {row['held']}{tilt}: {row['limit_state']}"
    if row["problem"]:
        return [whose, f"    {row['measure']}: no function; {row['problem']}"]
    theta, low, high = (
        f"{unit.factor * row[name]:.3g}" for name in ("median", "median_low", "median_high")
    )
    said = [
        whose,
        f"    {row['measure']}: θ {theta} {unit.name} ({low} to {high}), β {row['beta']:.2f} "
        f"(motions {row['beta_motions']:.2f}, object {row['beta_object']:.2f}, model "
        f"{row['beta_model']:.2f}), {row['recordings']} recordings of {row['events']} earthquakes",
    ]
    return [*said, *([f"    caution: {row['caution']}"] if row["caution"] else [])]
