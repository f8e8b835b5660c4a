"""The command line: `shaketable assess`, `simulate`, `suites`.

Exit codes: 0 done, 1 failed, 2 the user's input.
"""

from __future__ import annotations

import json
import logging
import math
import shlex
import sys
from datetime import UTC, datetime
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.errors import InputError, joined
from shaketable.motion import Motion
from shaketable.records import SUITES, read_components, read_motion, suite
from shaketable.records.suites import data_folder, info_of
from shaketable.simulate import simulate as simulate_one
from shaketable.support import Support
from shaketable.units import STANDARD_GRAVITY, radians

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="A virtual shake table for things that are not bolted down: "
    "who falls in an earthquake, which way, and what to do.",
)

log = logging.getLogger(__name__)

DEFAULT_SUITE = "fema-p695-far-field"


class Unit(StrEnum):
    """Units of acceleration, as the command line spells them."""

    G = "g"
    M_S2 = "m/s2"
    CM_S2 = "cm/s2"
    GAL = "gal"


Units = Annotated[
    Unit | None, typer.Option(help="Unit of acceleration, where a record file does not say it.")
]
TimeStep = Annotated[
    float | None, typer.Option(help="Time step [s], where a record file does not say it.")
]
Scale = Annotated[float, typer.Option(help="Factor on the motions.")]
TiltDeg = Annotated[float, typer.Option(help="Tilt of the support [degrees]; downhill is -x.")]


def _version(asked: bool) -> None:
    if asked:
        from shaketable import __version__

        typer.echo(f"shaketable {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    logging.basicConfig(format="%(levelname)s: %(message)s", level=logging.WARNING)


@app.command()
def assess(
    inventory: Annotated[
        Path | None,
        typer.Argument(help="CSV of objects: name, width_m, height_m, ... [examples/hospital.csv]"),
    ] = None,
    motions: Annotated[
        list[str] | None,
        typer.Option(help=f"A suite's name, or record files. [{DEFAULT_SUITE}]"),
    ] = None,
    scale: Scale = 1.0,
    tilt_deg: TiltDeg = 0.0,
    control: Annotated[
        float, typer.Option(help="Share of the falls that the wanted tilt sends downhill.")
    ] = 0.95,
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
    require_writable(out, overwrite)
    messages = _Messages()
    logging.getLogger("shaketable").addHandler(messages)
    path = inventory or example_inventory()
    items = read_inventory(path)
    shaking, description, sources = _motions(motions or [DEFAULT_SUITE], units, time_step_s)
    results = job.assess(
        items, shaking, scale=scale, tilt=radians(tilt_deg), control=control, progress=True
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
        },
        "settings": {
            "scale": scale,
            "tilt_deg": tilt_deg,
            "control": control,
            "units": units,
            "time_step_s": time_step_s,
        },
        "messages": messages.lines,
    }
    write_results(results, run, out, overwrite=overwrite)
    print_table(results, Console())
    typer.echo(f"report: {out / 'report.html'}")


@app.command()
def simulate(
    width_m: Annotated[float, typer.Option(help="Base width [m].")],
    height_m: Annotated[float, typer.Option(help="Full height [m].")],
    record: Annotated[Path, typer.Option(help="Record of the horizontal acceleration.")],
    vertical: Annotated[
        Path | None, typer.Option(help="Record of the vertical acceleration.")
    ] = None,
    scale: Scale = 1.0,
    tilt_deg: TiltDeg = 0.0,
    eccentricity: Annotated[
        float,
        typer.Option(
            help="Distance of the centre of gravity's foot from the left (downhill) corner "
            "over the width; 0.5 is symmetric."
        ),
    ] = 0.5,
    units: Units = None,
    time_step_s: TimeStep = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
    plot: Annotated[Path | None, typer.Option(help="Write a picture of the history.")] = None,
    animate: Annotated[Path | None, typer.Option(help="Write a film: .gif or .mp4.")] = None,
) -> None:
    """One rectangular object under one recorded motion."""
    from shaketable import plot as pictures

    if plot is not None:
        pictures.require_picture(plot)
    if animate is not None:
        pictures.require_film(animate)
    body = Body.rectangle(
        width_m, height_m, eccentricity=eccentricity, name=f"{width_m:g} m × {height_m:g} m"
    )
    motion = read_motion(record, vertical=vertical, units=units, time_step=time_step_s)
    response = simulate_one(body, motion.scaled(scale), Support(tilt=radians(tilt_deg)))
    fell = not math.isnan(response.overturning_time)
    if plot is not None:
        pictures.save(response, plot)
    if animate is not None:
        response.animate(animate)
    if as_json:
        summary = {
            "outcome": response.outcome.name.lower(),
            "overturning_time_s": response.overturning_time if fell else None,
            "peak_rotation_rad": response.peak_rotation,
            "impacts": response.impacts,
        }
        typer.echo(json.dumps(summary))
        return
    peak = math.degrees(response.peak_rotation)
    verdict = (
        f"overturns {response.outcome.name.lower()} at {response.overturning_time:.3f} s"
        if fell
        else f"stands; it rocks by at most {peak:.3g}°"
    )
    typer.echo(f"{body.name} under {motion.name}: {verdict}, after {response.impacts} impacts")


@app.command()
def suites() -> None:
    """The suites of motions that come with the package."""
    for name, info in SUITES.items():
        typer.echo(f"{name:30}  {info.description}")


def example_inventory() -> Path:
    """The inventory that comes with the package, installed or in its source tree."""
    package = Path(__file__).resolve().parent
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
        self.lines.append(f"{record.levelname}: {record.getMessage()}")


def _motions(
    chosen: list[str], units: str | None, time_step: float | None
) -> tuple[list[Motion], str, list[Path]]:
    """The motions of suites and files, what to call them, and the files they came from."""
    motions: list[Motion] = []
    sources: list[Path] = []
    faults = [
        f"--motions: {name!r} is named {chosen.count(name)} times and would count as often"
        for name in dict.fromkeys(chosen)
        if chosen.count(name) > 1
    ]
    for name in chosen:
        try:
            info = info_of(name)
            if info is not None:
                motions += suite(name)
                sources += [data_folder() / file for file in info.files]
            elif Path(name).exists() or Path(name).suffix:
                components = read_components(name, units=units, time_step=time_step)
                if len(components) == 1 and components[0].is_vertical:
                    log.warning("%s: left out, it is a vertical component", name)
                    continue
                motions.append(read_motion(name, units=units, time_step=time_step))
                sources.append(Path(name))
            else:
                faults.append(
                    f"--motions: {name!r} is neither a file nor a suite ({', '.join(SUITES)})"
                )
        except InputError as error:
            faults.append(str(error))
    if not motions and not faults:
        faults = ["--motions: no horizontal motion is left"]
    if faults:
        raise InputError(joined(faults))
    description = chosen[0] if len(chosen) == 1 else f"{len(chosen)} files and suites"
    return motions, description, sources


def _now() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M:%S UTC")


def _spread(arguments: list[str]) -> list[str]:
    """`--motions a b c` as `--motions a --motions b --motions c`."""
    spread: list[str] = []
    within = False
    for argument in arguments:
        if argument.startswith("-"):
            within = argument == "--motions"
            spread.append(argument)
        elif within and spread[-1] != "--motions":
            spread += ["--motions", argument]
        else:
            spread.append(argument)
    return spread


def main() -> None:
    """Entry point of the command line."""
    sys.argv[1:] = _spread(sys.argv[1:])
    try:
        app()
    except InputError as error:
        _fail(str(error), 2)
    except OSError as error:
        _fail(f"{error.filename or 'a file'}: {error.strerror or error}", 1)


def _fail(message: str, code: int) -> None:
    for line in message.splitlines():
        typer.echo(f"error: {line}", err=True)
    sys.exit(code)
