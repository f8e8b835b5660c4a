"""`shaketable template`: an empty table to fill in."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from shaketable.cli.console import say
from shaketable.errors import refused

NEXT = (
    "A motion is a file of a seismic network, or a CSV file with the columns time_s and "
    "acceleration_g (or acceleration_m/s2).",
    "Then: shaketable calibrate tests.csv --motions FOLDER --out RESULT",
)


def template(
    out: Annotated[
        Path | None,
        typer.Argument(help="File to write, ending in .csv or .xlsx. [inventory.csv, tests.csv]"),
    ] = None,
    tests: Annotated[
        bool, typer.Option("--tests", help="A table of shake-table tests, for calibrate.")
    ] = False,
    xlsx: Annotated[bool, typer.Option("--xlsx", help="Write a spreadsheet, with menus.")] = False,
    language: Annotated[
        str,
        typer.Option(help="Language of headings, menus and explanations: en, es, de, it or ja."),
    ] = "en",
    lengths: Annotated[str, typer.Option(help="Unit of lengths: cm, mm, m or in.")] = "cm",
    every: Annotated[
        bool, typer.Option("--all", help="Also the columns that few lists need.")
    ] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace a file.")] = False,
) -> None:
    """Write an empty inventory, or table of tests, with its columns explained.

    A spreadsheet has menus, and a sheet for the building: how many storeys, of what structure.
    """
    from shaketable.calibration.template import TESTS
    from shaketable.inventory.template import inventory_template
    from shaketable.tables.template import write_template

    chosen = TESTS if tests else inventory_template(language, lengths=lengths, every=every)
    name = "tests" if tests else "inventory"
    path = out or Path(f"{name}.{'xlsx' if xlsx else 'csv'}")
    if path.suffix.lower() not in (".csv", ".xlsx"):
        raise refused(path, "expected a name that ends in .csv or .xlsx")
    if path.exists() and not overwrite:
        raise refused(path, "exists; give another name, or --overwrite")
    write_template(path, chosen)
    width = max(map(len, chosen.explained))
    lines = [f"{name:{width}}  {meaning}" for name, meaning in chosen.explained.items()]
    say("\n".join([*lines, f"template: {path}", *(NEXT if tests else ())]))
