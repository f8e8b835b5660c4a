"""`shaketable overturning-spectrum`: all pulses on one body, or all bodies under one record."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.cli.console import say
from shaketable.cli.options import (
    ContactOptions,
    Overwrite,
    ReadingOptions,
)
from shaketable.errors import InputError
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.report.run_log import RunLog
from shaketable.units import radians

SLENDERNESS = "10, 15, 20"  # degrees
LARGEST = 12.0  # ω_p/p, and a_p/(g tan α)


def overturning_spectrum(
    *,
    out: Annotated[Path, typer.Option(help="Folder for the tables and the picture.")],
    base_m: Annotated[
        float | None, typer.Option(help="Base [m] of a body under pulses, with --height-m.")
    ] = None,
    height_m: Annotated[float | None, typer.Option(help="Its full height [m].")] = None,
    eccentricity: Annotated[
        float | None,
        typer.Option(help="Distance of its centre of gravity from the left corner, over the "
                     "base. [0.5]",
                     show_default=False),
    ] = None,
    pulse: Annotated[
        str | None,
        typer.Option(
            help="sine, cosine, 'half sine', rectangular, ricker or mavroeidis-papageorgiou. "
            "[sine]",
            show_default=False,
        ),
    ] = None,
    points: Annotated[int, typer.Option(min=2, max=1000, help="Values along each axis.")] = 120,
    record: Annotated[
        Path | None,
        typer.Option(help="In place of a body: a record, for the rocking spectrum of Makris and "
                     "Konstantinidis (2003)."),
    ] = None,
    slenderness_deg: Annotated[
        str | None,
        typer.Option(help="α of its blocks [degrees], with commas. [10, 15, 20]",
                     show_default=False),
    ] = None,
    contact_options: ContactOptions,
    reading: ReadingOptions,
    overwrite: Overwrite = False,
) -> None:  # fmt: skip
    """Compute the overturning spectrum of a body under pulses, or a record's rocking spectrum.

    With --record it tells the largest rotation of blocks of all sizes under that record.
    """
    from shaketable.records import read_motion
    from shaketable.report.results_folder import require_folder

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    contact = contact_options.contact()
    of_body = {
        "--base-m": base_m, "--height-m": height_m, "--eccentricity": eccentricity,
        "--pulse": pulse,
    }  # fmt: skip
    of_record = {
        "--slenderness-deg": slenderness_deg, "--units": reading.units,
        "--time-step-s": reading.time_step_s,
    }  # fmt: skip
    if record is not None:
        _require_none(of_body, "for a body under pulses, and --record is for blocks of all sizes")
        motion = read_motion(record, units=reading.units, time_step=reading.time_step_s)
        _under_record(
            motion, slenderness_deg or SLENDERNESS, points, contact, run_log, out, overwrite
        )
        return
    _require_none(of_record, "for a --record")
    if base_m is None or height_m is None:
        raise InputError("give --base-m and --height-m of a body, or --record")
    body = Body.rectangle(
        base_m, height_m, eccentricity=0.5 if eccentricity is None else eccentricity
    )
    _under_pulses(body, pulse or "sine", points, contact, run_log, out, overwrite)


def _require_none(options: Mapping[str, object], what_for: str) -> None:
    """InputError where one of some options is given, which would change nothing."""
    given = [option for option, value in options.items() if value is not None]
    if given:
        raise InputError(f"{', '.join(given)}: {what_for}; leave it out")


def _under_pulses(
    body: Body, pulse: str, points: int, contact: Model, run_log: RunLog, out: Path, overwrite: bool
) -> None:
    import numpy as np

    from shaketable.drawing.files import figure_of
    from shaketable.fragility import Fate, borders, overturning_spectrum
    from shaketable.plot import plot_overturning_spectrum
    from shaketable.report.results_folder import Picture, write_folder

    axis = np.linspace(LARGEST / points, LARGEST, points)
    found = overturning_spectrum(
        body, pulse=pulse, frequencies=axis, amplitudes=axis, model=contact, progress=True
    )
    refined = borders(body, found, model=contact)
    table = found[["fate", "impacts", "peak_rotation"]].to_dataframe().reset_index()
    table["fate"] = [Fate(code).name.lower() for code in table["fate"]]
    drawn = figure_of(plot_overturning_spectrum(found, refined))
    write_folder(
        out,
        run_log.entries(),
        overwrite=overwrite,
        tables={"spectrum": table, "borders": refined},
        pictures=[Picture("spectrum", "", drawn)],
    )
    share = 100 * float((found["fate"] >= Fate.OVERTURNS_AFTER_IMPACTS).mean())
    say(f"{share:.0f} % of the {pulse} pulses up to ω_p/p = {LARGEST:g} and a_p/(g tan α) = "
        f"{LARGEST:g} overturn it; p = {found.attrs['p']:.4g} rad/s, "
        f"α = {np.degrees(found.attrs['slenderness']):.4g}°")  # fmt: skip
    say(f"picture: {out / 'spectrum.png'}; spectrum.csv and borders.csv beside it")


def _under_record(
    motion: Motion, slenderness: str, points: int, contact: Model, run_log: RunLog, out: Path,
    overwrite: bool,
) -> None:  # fmt: skip
    import numpy as np

    from shaketable.drawing.files import figure_of
    from shaketable.fragility import rocking_spectrum
    from shaketable.plot import plot_rocking_spectrum
    from shaketable.report.results_folder import Picture, write_folder

    try:
        alpha = [radians(float(part)) for part in slenderness.split(",")]
    except ValueError:
        raise InputError(
            f"--slenderness-deg: numbers with commas, got {slenderness!r:.60}"
        ) from None
    periods = np.linspace(0.5, 8.0, points)
    found = rocking_spectrum(motion, alpha, periods, model=contact, progress=True)
    table = found.to_dataframe().reset_index()
    table.insert(0, "slenderness_deg", np.degrees(table.pop("slenderness")))
    write_folder(
        out,
        run_log.entries(),
        overwrite=overwrite,
        tables={"spectrum": table},
        pictures=[Picture("spectrum", "", figure_of(plot_rocking_spectrum(found)))],
    )
    fallen = int(found["overturns"].sum())
    say(f"{fallen} of {found['overturns'].size} blocks overturn under {motion.name}")
    say(f"picture: {out / 'spectrum.png'}; spectrum.csv beside it")
