"""`shaketable assess`: an inventory under a suite of motions."""

from __future__ import annotations

import logging
import shlex
import sys
from dataclasses import asdict
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, Any

import typer

from shaketable.cli.options import (
    KineticFriction,
    Model,
    ModelName,
    Restitution,
    Scale,
    StaticFriction,
    TiltDeg,
    TimeStep,
    Units,
    support_of,
)
from shaketable.errors import InputError, joined
from shaketable.motion import Motion
from shaketable.records import suite
from shaketable.records.folders import record_files
from shaketable.records.suites import data_folder, info_of
from shaketable.units import STANDARD_GRAVITY, radians

log = logging.getLogger(__name__)

DEFAULT_SUITE = "fema-p695-far-field"


def assess(
    inventory: Annotated[
        Path | None,
        typer.Argument(help="CSV of objects: name, width_m, height_m, ... [examples/hospital.csv]"),
    ] = None,
    motions: Annotated[
        list[str] | None,
        typer.Option(help=f"Suites' names, record files, folders of records. [{DEFAULT_SUITE}]"),
    ] = None,
    vertical: Annotated[
        bool,
        typer.Option(
            "--vertical",
            help="Pair records with their vertical components, of the same file or beside it.",
        ),
    ] = False,
    scale: Scale = 1.0,
    tilt_deg: TiltDeg = 0.0,
    control: Annotated[
        float, typer.Option(help="Share of the falls that the wanted tilt sends downhill.")
    ] = 0.95,
    model: ModelName = Model.ROCKING,
    static_friction: StaticFriction = None,
    kinetic_friction: KineticFriction = None,
    restitution: Restitution = 0.0,
    units: Units = None,
    time_step_s: TimeStep = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("assessment"),
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace the results in an existing folder.")
    ] = False,
) -> None:
    """Who falls, which way, and what to do: an inventory under a suite of motions."""
    from rich.console import Console

    from shaketable import assess as job
    from shaketable.inventory import read_inventory
    from shaketable.report.folder import require_writable, sha256, versions, write_results
    from shaketable.report.terminal import print_table

    started = _now()
    support = support_of(model, 0.0, static_friction, kinetic_friction, restitution)
    require_writable(out, overwrite)
    messages = _Messages()
    logging.getLogger("shaketable").addHandler(messages)
    path = inventory or example_inventory()
    items = read_inventory(path)
    shaking, description, sources = _motions(
        motions or [DEFAULT_SUITE], vertical, units, time_step_s
    )
    if model is Model.ROCKING and any(item.support_length for item in items):
        log.warning("support_length_m is for sliding: nothing slides without --model general")
    results = job.assess(
        items,
        shaking,
        scale=scale,
        tilt=radians(tilt_deg),
        control=control,
        model=model.value,
        support=support,
        progress=True,
    )
    peaks = [motion.peak_ground_acceleration * scale / STANDARD_GRAVITY for motion in shaking]
    run = {
        "command": shlex.join(["shaketable", *sys.argv[1:]]),
        "folder": str(Path.cwd()),
        "started": started,
        "finished": _now(),
        "versions": versions(),
        "inventory": {"path": str(path), "sha256": sha256(path), "items": len(items)},
        "motions": {
            "description": description,
            "count": len(shaking),
            "smallest_pga_g": min(peaks),
            "largest_pga_g": max(peaks),
            "sources": [{"name": str(file), "sha256": sha256(file)} for file in sources],
            "names": list(results.motions),
            "origins": [_told(motion) for motion in shaking],
        },
        "settings": {
            "scale": scale,
            "tilt_deg": tilt_deg,
            "control": control,
            "model": model.value,
            "static_friction": static_friction,
            "kinetic_friction": kinetic_friction,
            "restitution": restitution,
            "vertical": vertical,
            "units": units,
            "time_step_s": time_step_s,
        },
        "messages": messages.lines,
    }
    write_results(results, run, out, overwrite=overwrite)
    print_table(results, Console())
    typer.echo(f"report: {out / 'report.html'}")


def example_inventory() -> Path:
    """The inventory that comes with the package, installed or in its source tree."""
    package = Path(__file__).resolve().parent.parent
    folders = [package, package.parent.parent]
    return next(
        path for folder in folders if (path := folder / "examples" / "hospital.csv").exists()
    )


class _Messages(logging.Handler):
    """Keeps what was logged, for the run log."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        line = f"{record.levelname}: {record.getMessage()}"
        if line not in self.lines:
            self.lines.append(line)


def _motions(
    chosen: list[str], vertical: bool, units: str | None, time_step: float | None
) -> tuple[list[Motion], str, list[Path]]:
    """The motions of suites, folders and files, what to call them, and the files they came from."""
    motions: list[Motion] = []
    sources: list[Path] = []
    faults = [
        f"--motions: {name!r} is named {chosen.count(name)} times and would count as often"
        for name in dict.fromkeys(chosen)
        if chosen.count(name) > 1
    ]
    for name in chosen:
        try:
            found = suite(name, vertical=vertical, units=units, time_step=time_step, progress=True)
        except InputError as error:
            faults.append(f"--motions: {error}")
            continue
        if not found:
            log.warning("%s: left out, it is a vertical component", name)
            continue
        motions += found
        sources += _files(name)
    if vertical and all(info_of(name) for name in chosen):
        faults.append("--vertical: the suites that come with the package have no verticals")
    if not motions and not faults:
        faults = ["--motions: no horizontal motion is left"]
    if faults:
        raise InputError(joined(faults))
    description = chosen[0] if len(chosen) == 1 else f"{len(chosen)} files and suites"
    return motions, description, sources


def _files(name: str) -> list[Path]:
    """What a suite, a folder or a file is made of."""
    info = info_of(name)
    if info is not None:
        return [data_folder() / file for file in info.files]
    return record_files(Path(name)) if Path(name).is_dir() else [Path(name)]


def _told(motion: Motion) -> dict[str, Any]:
    """What is known of where a motion comes from."""
    parts = {"horizontal": motion.origin, "vertical": motion.vertical_origin}
    return {name: asdict(origin) for name, origin in parts.items() if origin is not None}


def _now() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M:%S UTC")
