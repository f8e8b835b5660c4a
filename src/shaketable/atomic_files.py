"""Files and folders that appear whole or not at all, and never take earlier results with them.

What is written lies in a hidden folder `.NAME-…` beside its place until it is whole. A run that is
killed leaves that folder; the next run that writes to the same place clears it away, and puts back
earlier results that the killed one had just moved out of the way.
"""

from __future__ import annotations

import errno
import hashlib
import logging
import os
import platform
import re
import shutil
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from shaketable.errors import printable, refused
from shaketable.extras import missing, remedy

if TYPE_CHECKING:
    import pandas as pd

log = logging.getLogger(__name__)

LONGEST_NAME = 100  # bytes
#: Numbers of the errors of a disk that is full; not every system knows quotas.
NO_ROOM = {errno.ENOSPC, errno.EFBIG, getattr(errno, "EDQUOT", errno.ENOSPC)}
FORGOTTEN = 24 * 3600.0  # s: what another machine has not touched for so long is left over
_FORMULA = re.compile(r"[=+\-@\uff1d\uff0b\uff0d\uff20]")  # fullwidth ones, too


@contextmanager
def appearing_file(path: Path) -> Iterator[Path]:
    """A temporary path with the same ending, whose file takes its place once it is written.

    Raises:
        OSError: names the path.
    """
    path = _resolved(path)
    with _workshop(path) as workshop:
        fresh = workshop / f"new{path.suffix}"
        yield fresh
        fresh.replace(path)


@contextmanager
def results_folder(folder: Path, overwrite: bool, files: Sequence[str]) -> Iterator[Path]:
    """A temporary folder that takes the place of `folder` once everything in it is written.

    Args:
        overwrite: replace earlier results.
        files: names of an earlier result.

    Raises:
        InputError: the folder cannot be written, or holds something else.
        OSError: names the folder.
    """
    require_writable(folder, overwrite, files)
    folder = _resolved(folder)
    folder.parent.mkdir(parents=True, exist_ok=True)
    with _workshop(folder) as workshop:
        fresh = workshop / "new"
        fresh.mkdir()
        yield fresh
        if folder.exists():
            folder.rename(workshop / "old")
        fresh.rename(folder)


@contextmanager
def _workshop(place: Path) -> Iterator[Path]:
    """A hidden folder beside a place in which to write what goes there."""
    clear_leftovers(place)
    prefix = f".{_short(place.name)}-{_machine()}-{os.getpid()}-"
    try:
        workshop = Path(tempfile.mkdtemp(dir=place.parent, prefix=prefix))
        try:
            yield workshop
        finally:
            _clear(workshop, place)
    except OSError as error:
        known = error.filename and prefix not in str(error.filename)
        reason = error.strerror or str(error)
        raise OSError(
            error.errno or errno.EIO, reason, error.filename if known else str(place)
        ) from error


def clear_leftovers(place: Path) -> None:
    """Remove what killed runs left beside a place; put back what they had moved out of it."""
    if not place.parent.is_dir():
        return
    left = re.compile(rf"\.{re.escape(_short(place.name))}-(\w+)-(\d+)-\w+")
    for entry in list(place.parent.iterdir()):
        found = left.fullmatch(entry.name)
        if found and entry.is_dir() and _is_over(entry, found[1], int(found[2])):
            _clear(entry, place)


def _clear(workshop: Path, place: Path) -> None:
    """Remove a workshop, but for earlier results whose place is empty: they go back there."""
    old = workshop / "old"
    if old.exists() and not place.exists():
        old.rename(place)
        log.warning("%s: an interrupted run had moved these results; they are back", place)
    shutil.rmtree(workshop, ignore_errors=True)


def _resolved(path: Path) -> Path:
    try:
        return path.resolve()
    except RuntimeError as error:  # links that lead to themselves
        raise refused(path, f"cannot be written ({error})") from None


def _short(name: str) -> str:
    """A name to which more can be added: file systems allow 255 bytes."""
    if len(name.encode(errors="surrogateescape")) <= LONGEST_NAME:
        return name
    return hashlib.sha256(name.encode(errors="surrogateescape")).hexdigest()[:40]


def _machine() -> str:
    """This machine's name, as far as it fits a file's name."""
    return re.sub(r"\W", "_", platform.node())[:40] or "machine"


def _is_over(entry: Path, machine: str, process: int) -> bool:
    """Whether the run that made a folder has ended."""
    if machine == _machine() and os.name == "posix":
        try:
            os.kill(process, 0)  # asks only
        except ProcessLookupError:
            return True
        except OSError:  # somebody else's
            pass
        return False
    try:
        return time.time() - entry.stat().st_mtime > FORGOTTEN
    except OSError:
        return False


def require_writable(folder: Path, overwrite: bool, files: Sequence[str]) -> None:
    """InputError unless `folder` can be written: new, or an earlier result to be replaced.

    Args:
        files: names of an earlier result.
    """
    folder = _resolved(folder)
    if folder == Path.cwd():
        raise refused(folder, "is the current folder; name a folder in it")
    clear_leftovers(folder)
    if folder.exists():
        if not folder.is_dir():
            raise refused(folder, "is a file; --out names a folder")
        held = {entry.name for entry in folder.iterdir()}
        if held and not overwrite:
            instead = ", or --overwrite to replace its results" if files else ""
            raise refused(folder, f"exists and is not empty; give another folder{instead}")
        foreign = sorted(held - {name for name in files if (folder / name).is_file()})
        if foreign:
            raise refused(
                folder,
                f"holds {foreign[0]!r}, which is not a result of this command; "
                "only a folder of earlier results is overwritten",
            )
    if folder.is_mount():
        raise refused(folder, "is a mount point and cannot be replaced; name a folder in it")
    parent = _existing_parent(folder)
    if not os.access(parent, os.W_OK):
        raise refused(folder, f"{parent} is not writable")


def _existing_parent(folder: Path) -> Path:
    parent = folder.parent
    while not parent.exists():
        parent = parent.parent
    if not parent.is_dir():
        raise refused(folder, f"{parent} is not a folder")
    return parent


def _safe_cell(text: str) -> str:
    """A text as a spreadsheet's cell: one that would be a formula begins with an apostrophe.

    Control characters become escapes: a bare carriage return would begin another row.
    """
    shown = printable(text)
    return f"'{shown}" if _FORMULA.match(shown.lstrip()) else shown


def write_csv(table: pd.DataFrame, path: Path) -> None:
    """Write a table for spreadsheets: six digits, and no text that would be a formula."""
    safe = table.copy()
    for k, kind in enumerate(table.dtypes):
        if kind.kind not in "biufc":
            column = table.iloc[:, k]
            safe.isetitem(k, [_safe_cell(one) if isinstance(one, str) else one for one in column])
    header = [_safe_cell(str(name)) for name in table.columns]
    safe.to_csv(path, index=False, header=header, float_format="%.6g")


def write_table(table: pd.DataFrame, folder: Path, name: str) -> list[str]:
    """Write a table as CSV and, with the extra parquet, as Parquet; the files' names."""
    write_csv(table, folder / f"{name}.csv")
    if missing("parquet"):
        log.warning("tables are written as CSV alone: for Parquet too, %s", remedy("parquet"))
        return [f"{name}.csv"]
    table.to_parquet(folder / f"{name}.parquet", index=False)
    return [f"{name}.csv", f"{name}.parquet"]
