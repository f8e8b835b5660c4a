"""`shaketable template`: an empty inventory to fill in."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from shaketable.cli.tell import say
from shaketable.errors import InputError


def template(
    out: Annotated[
        Path | None, typer.Argument(help="Its name, ending in .csv or .xlsx. [inventory.csv]")
    ] = None,
    xlsx: Annotated[bool, typer.Option("--xlsx", help="Write inventory.xlsx instead.")] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace a file.")] = False,
) -> None:
    """An empty inventory with its columns explained."""
    from shaketable.inventory.template import EXPLAINED, write_template

    path = out or Path("inventory.xlsx" if xlsx else "inventory.csv")
    if path.suffix.lower() not in (".csv", ".xlsx"):
        raise InputError(f"{path}: expected a name that ends in .csv or .xlsx")
    if path.exists() and not overwrite:
        raise InputError(f"{path}: exists; give another name, or --overwrite")
    write_template(path)
    width = max(map(len, EXPLAINED))
    lines = [f"{name:{width}}  {meaning}" for name, meaning in EXPLAINED.items()]
    say("\n".join([*lines, f"template: {path}"]))
