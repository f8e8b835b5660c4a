"""The folder of a command's results: a page, tables, pictures and run.json, all of them or none.

`run.json` makes the run repeatable, and lists the files: by that list a later run of the same
command knows which of them it may replace.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import pandas as pd
from matplotlib.figure import Figure

from shaketable.atomic_files import require_writable, results_folder, write_csv, write_table
from shaketable.report.run_log import RunLog

RUN = "run.json"
PAGE = "index.html"
DPI = 110


class Picture(NamedTuple):
    """A figure of a folder: its file is its name with the ending .png."""

    name: str
    caption: str
    figure: Figure


def require_folder(folder: Path, overwrite: bool, run_log: RunLog) -> None:
    """InputError unless the command can write there: a new folder, or its own earlier results."""
    require_writable(folder, overwrite, _replaceable(folder, run_log.entries()))


def _replaceable(folder: Path, run: Mapping[str, object]) -> tuple[str, ...]:
    """The files of earlier results of the same command in a folder, as its run.json lists them."""
    try:
        earlier = json.loads((folder / RUN).read_text(encoding="utf-8"))
        if _subcommand(earlier) == _subcommand(run):
            return tuple(str(name) for name in earlier["files"]) or (RUN,)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        pass  # a list that cannot be read allows no more than to replace itself
    return (RUN,)


def _subcommand(run: Mapping[str, object]) -> str:
    """Such as 'assess' of a run of 'shaketable assess ...'."""
    words = shlex.split(str(run.get("command", "")))
    return words[1] if len(words) > 1 else ""


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
    finish: Callable[[Path], object] | None = None,
) -> list[str]:
    """Write all results of a command, or none.

    Args:
        folder: new, or with `overwrite` one of earlier results of the same command.
        run: what makes the run repeatable.
        overwrite: replace earlier results of the same command.
        tables: by the names of their CSV files.
        parquet: names of the tables that are written as Parquet too, with that extra.
        pictures: drawn one after another.
        page: makes the page from the files and captions of the pictures.
        page_name: its file.
        others: writes what else belongs there into the folder that it is given, before the page.
        finish: the same after the page.

    Returns:
        The names of all files.

    Raises:
        InputError: the folder cannot be written, or holds something else.
        OSError: names the folder.
    """
    replaceable = _replaceable(folder, run)
    require_writable(folder, overwrite, replaceable)
    with results_folder(folder, overwrite, replaceable) as fresh:
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
        if finish is not None:
            finish(fresh)
        files = sorted([*(path.name for path in fresh.iterdir()), RUN])
        text = json.dumps({**run, "files": files}, indent=2, ensure_ascii=False)
        (fresh / RUN).write_text(text + "\n", encoding="utf-8")
    return files
