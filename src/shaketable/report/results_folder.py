"""The folder of a command's results: a page, tables, pictures and run.json, all of them or none.

`run.json` makes the run repeatable, and lists the files: by that list a later run knows which of
them it may replace.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import pandas as pd
from matplotlib.figure import Figure

from shaketable.outputs import require_writable, results_folder, write_csv, write_table

RUN = "run.json"
PAGE = "index.html"
DPI = 110


class Picture(NamedTuple):
    """A figure of a folder: its file is its name with the ending .png."""

    name: str
    caption: str
    figure: Figure


def earlier_files(folder: Path) -> tuple[str, ...]:
    """The files of earlier results in a folder, as its run.json lists them; none without it."""
    try:
        listed = json.loads((folder / RUN).read_text(encoding="utf-8"))["files"]
        return tuple(str(name) for name in listed)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return ()


def require_folder(folder: Path, overwrite: bool) -> None:
    """InputError unless results can be written there: a new folder, or one of earlier results."""
    require_writable(folder, overwrite, earlier_files(folder) or (RUN,))


def write_folder(
    folder: Path,
    run: Mapping[str, object],
    *,
    overwrite: bool = False,
    tables: Mapping[str, pd.DataFrame] | None = None,
    parquet: Collection[str] = (),
    pictures: Iterable[Picture] = (),
    page: Callable[[Sequence[Mapping[str, str]]], str] | None = None,
    page_name: str = PAGE,
    others: Callable[[Path], object] | None = None,
) -> list[str]:
    """Write all results of a command, or none.

    Args:
        folder: new, or one of earlier results with `overwrite`.
        run: what makes the run repeatable.
        overwrite: replace earlier results.
        tables: by the names of their CSV files.
        parquet: names of the tables that are written as Parquet too, with that extra.
        pictures: drawn one after another.
        page: makes the page from the files and captions of the pictures.
        page_name: its file.
        others: writes what else belongs there into the folder that it is given, before the page.

    Returns:
        The names of all files.

    Raises:
        InputError: the folder cannot be written, or holds something else.
        OSError: names the folder.
    """
    require_folder(folder, overwrite)
    with results_folder(folder, overwrite, earlier_files(folder) or (RUN,)) as fresh:
        for name, table in (tables or {}).items():
            if name in parquet:
                write_table(table, fresh, name)
            else:
                write_csv(table, fresh / f"{name}.csv")
        if others is not None:
            others(fresh)
        shown = []
        for picture in pictures:
            shown.append({"file": f"{picture.name}.png", "caption": picture.caption})
            picture.figure.savefig(fresh / shown[-1]["file"], dpi=DPI)
        if page is not None:
            (fresh / page_name).write_text(page(shown), encoding="utf-8")
        files = sorted([*(path.name for path in fresh.iterdir()), RUN])
        text = json.dumps({**run, "files": files}, indent=2, ensure_ascii=False)
        (fresh / RUN).write_text(text + "\n", encoding="utf-8")
    return files
