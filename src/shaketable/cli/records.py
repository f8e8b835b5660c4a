"""`shaketable records`: what record files and folders hold."""

from __future__ import annotations

import re
from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from shaketable.cli.console import say
from shaketable.cli.options import ReadingOptions
from shaketable.cli.shaking import require_used
from shaketable.errors import InputError, joined
from shaketable.motion import Motion
from shaketable.records import Component
from shaketable.records.motions import motion_of
from shaketable.units import CM, STANDARD_GRAVITY

if TYPE_CHECKING:
    from rich.console import Console


def records(
    *,
    paths: Annotated[list[Path], typer.Argument(help="Record files, archives and folders.")],
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for records.csv and a picture of each component."),
    ] = None,
    reading: ReadingOptions,
) -> None:
    """List what record files hold, with intensity measures.

    With --out, a CSV file and a picture of each component are written.

    Vertical components are listed like the others. Files that hold no acceleration are named; a
    record that cannot be read is an error, reported after the others are listed.
    """
    import pandas as pd
    from rich.console import Console

    from shaketable.atomic_files import require_writable, results_folder, write_csv
    from shaketable.records.folders import components_of, record_files
    from shaketable.records.read import read_components
    from shaketable.records.text import NoAccelerationError

    if out is not None:
        require_writable(out, False, ())
    missing = [f"{path}: no such file or folder" for path in paths if not path.exists()]
    if missing:
        raise InputError(joined(missing))
    require_used([str(path) for path in paths], reading.units, None)
    files = [file for path in paths for file in (record_files(path) if path.is_dir() else [path])]
    left_out: list[str] = []
    found: list[Component] = []
    faults: list[str] = []
    read = partial(read_components, **reading.as_read)
    for path, components in components_of(files, read, progress=True):
        if isinstance(components, NoAccelerationError):
            left_out.append(str(components) if path in paths else path.name)
        elif isinstance(components, InputError):
            faults.append(str(components))
        else:
            found += components
    rows = []
    if found:
        with results_folder(out, False, ()) if out is not None else nullcontext() as fresh:
            rows = _measured(found, fresh)
            if fresh is not None:
                write_csv(pd.DataFrame(rows), fresh / "records.csv")
        _print(rows, Console())
    if left_out:
        say(f"no records of acceleration: {', '.join(left_out)}")
    if rows and out is not None:
        say(f"{len(rows)} components: {out / 'records.csv'}, and a picture of each")
    if faults:
        raise InputError(joined(faults))
    if not rows:
        raise InputError("no record of acceleration found")


def _measured(found: list[Component], folder: Path | None) -> list[dict[str, Any]]:
    """A row for each component, and its picture in the folder, if there is one."""
    from shaketable.progress import meter

    rows = []
    with meter("measuring", len(found), progress=True) as done:
        for number, component in enumerate(found, 1):
            motion = motion_of(component, None, name=component.path.stem)
            rows.append(_row(component, motion))
            if folder is not None:
                _draw(motion, folder / _picture(number, component))
            done(1)
    return rows


def _row(component: Component, motion: Motion) -> dict[str, Any]:
    """A row of records.csv."""
    from shaketable.signal import intensity_measures

    found = intensity_measures(motion)
    numbers = {
        "time_step_s": component.time_step,
        "duration_s": motion.duration,
        "pga_g": found["PGA"] / STANDARD_GRAVITY,
        "pgv_cm_s": found["PGV"] / CM,
        "pgd_cm": found["PGD"] / CM,
        "arias_m_s": found["Arias"],
        "cav_m_s": found["CAV"],
        "d5_75_s": found["D5-75"],
        "d5_95_s": found["D5-95"],
        "tp_s": found["Tp"],
        "tm_s": found["Tm"],
        "housner_cm": found["Housner"] / CM,
        "sa_0.3_g": found["SA(0.3)"] / STANDARD_GRAVITY,
        "sa_1_g": found["SA(1.0)"] / STANDARD_GRAVITY,
    }
    return {
        "file": str(component.path),
        "format": component.format,
        "event": component.event,
        "station": component.station,
        "location": component.location,
        "component": component.code,
        "azimuth_deg": np.nan if component.azimuth is None else component.azimuth,
        "samples": component.acceleration.size,
        **numbers,
        "processing": "; ".join(motion.origin.processing if motion.origin else ()),
        "sha256": component.sha256,
    }


def _picture(number: int, component: Component) -> str:
    words = f"{component.path.stem} {component.code}".strip()
    return f"{number:03d}_{re.sub(r'[^A-Za-z0-9.-]+', '_', words)[:100]}.png"


def _draw(motion: Motion, path: Path) -> None:
    from shaketable.plot import plot_record

    plot_record(motion).savefig(path, dpi=100)


def _print(rows: list[dict[str, Any]], console: Console) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    from shaketable.report.terminal import plain

    view = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1))
    view.add_column("file", overflow="fold", max_width=34)
    view.add_column("com-\nponent", no_wrap=True)
    for header in ("azimuth\n°", "samples", "step\ns", "PGA\ng", "PGV\ncm/s", "D5-95\ns"):
        view.add_column(header, justify="right", no_wrap=True)
    for row in rows:
        azimuth = row["azimuth_deg"]
        view.add_row(
            plain(Path(row["file"]).name),
            plain(row["component"]),
            "" if np.isnan(azimuth) else f"{azimuth:g}",
            f"{row['samples']}",
            f"{row['time_step_s']:g}",
            f"{row['pga_g']:.3f}",
            f"{row['pgv_cm_s']:.1f}",
            f"{row['d5_95_s']:.1f}",
        )
    console.print(view)
