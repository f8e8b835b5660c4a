"""`shaketable select-motions`: recorded motions whose spectra are those of an earthquake."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from shaketable.cli.console import say
from shaketable.cli.earthquake_options import EarthquakeOptions, scales_of
from shaketable.cli.option_groups import settings_of
from shaketable.cli.options import Overwrite, ReadingOptions
from shaketable.cli.shaking import load_motions
from shaketable.errors import InputError, quoted
from shaketable.inputs import NUMBER
from shaketable.report.run_log import RunLog, plain
from shaketable.units import acceleration_factor

if TYPE_CHECKING:
    from rich.console import Console

    from shaketable.hazard import Selection
    from shaketable.motion import Motion

_LEVEL = re.compile(rf"({NUMBER})\s*([A-Za-z/%²^*0-9]*)", re.ASCII)


def select_motions(
    *,
    recordings: Annotated[
        list[str], typer.Argument(help="Names of suites, record files, folders of records.")
    ],
    out: Annotated[Path, typer.Option(help="Folder for the selection, a table and a picture.")],
    earthquake: EarthquakeOptions,
    period_s: Annotated[
        float | None,
        typer.Option(help="Period at which all motions get the same spectral acceleration [s]."),
    ] = None,
    level: Annotated[
        str | None, typer.Option(help="That acceleration, such as 0.3g, with --period-s.")
    ] = None,
    epsilon: Annotated[
        float | None,
        typer.Option(help="The same, as standard deviations above the median of the earthquake."),
    ] = None,
    number: Annotated[int, typer.Option(min=2, help="How many motions to take.")] = 30,
    scales: Annotated[
        str, typer.Option(help="Smallest and largest factor on a motion.")
    ] = "0.25,4",
    reading: ReadingOptions,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the drawn spectra.")] = 0,
    overwrite: Overwrite = False,
) -> None:
    """Select recorded motions whose spectra match those of an earthquake.

    With --period-s and --level (or --epsilon) their spectra are those that the earthquake has where
    its acceleration at that period is that high: the conditional spectrum. The selection.csv that
    is written can be given to --motions of every command.
    """
    settings = {name: value for name, value in settings_of(locals()).items() if name != "overwrite"}
    from rich.console import Console

    from shaketable.hazard import conditional_target, target_of
    from shaketable.hazard import select_motions as selected
    from shaketable.records.selected import is_selection
    from shaketable.report.results_folder import require_folder
    from shaketable.report.selection import write_selection

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    limits = scales_of(scales)
    quake = earthquake.scenario()
    if period_s is None:
        if level is not None or epsilon is not None:
            raise InputError("--level and --epsilon are for --period-s")
        target = target_of(quake)
    else:
        target = conditional_target(
            quake, period_s, level=None if level is None else _level(level), epsilon=epsilon
        )
    again = [name for name in recordings if Path(name).is_file() and is_selection(Path(name))]
    if again:
        raise InputError(
            f"{again[0]}: is a selection itself; give the records that it was made from"
        )
    shaking = [
        (name, load_motions([name], False, reading, "recordings"))
        for name in dict.fromkeys(recordings)
    ]
    candidates = [(name, motion) for name, found in shaking for motion in found.motions]
    selection = selected(
        [motion for _, motion in candidates], target, number,
        scales=limits, seed=seed, progress=True,
    )  # fmt: skip
    run = {
        **run_log.entries(),
        "target": target.name,
        "candidates": len(candidates),
        "sources": [found.entries() for _, found in shaking],
        "settings": {name: plain(value) for name, value in settings.items()},
    }
    write_selection(
        selection,
        candidates,
        run,
        out,
        **reading.as_read,
        overwrite=overwrite,
    )
    _print(selection, candidates, Console())
    say(f"{out / 'selection.csv'}: give it to --motions; how it was chosen is in run.json")


def _level(text: str) -> float:
    """A spectral acceleration [m/s²] of "0.3g"; without a unit in g."""
    match = _LEVEL.fullmatch(text.strip())
    if not match or not float(match[1]) > 0.0:
        raise InputError(f"--level: expected an acceleration such as 0.3g, found {quoted(text)}")
    return float(match[1]) * acceleration_factor(match[2] or "g")


def _print(selection: Selection, candidates: list[tuple[str, Motion]], console: Console) -> None:
    """How near the selection came, at some periods, and in words."""
    import numpy as np
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    from shaketable.units import STANDARD_GRAVITY

    target = selection.target
    say(f"target: {target.name}")
    view = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1))
    for header in ("period\ns", "median wanted\ng", "found\ng", "spread wanted\nof ln", "found"):
        view.add_column(header, justify="right", no_wrap=True)
    for k in range(0, target.periods.size, 3):
        view.add_row(
            f"{target.periods[k]:.2f}",
            f"{np.exp(target.mean[k]) / STANDARD_GRAVITY:.3f}",
            f"{np.exp(selection.mean[k]) / STANDARD_GRAVITY:.3f}",
            f"{target.sigma[k]:.2f}",
            f"{selection.sigma[k]:.2f}",
        )
    console.print(view)
    median, spread = selection.departures()
    say(
        f"{len(selection.motions)} of {len(candidates)} motions, each of another recording, scaled "
        f"by {selection.factors.min():.2f} to {selection.factors.max():.2f} (median "
        f"{np.median(selection.factors):.2f}); at all periods from {target.periods[0]:g} to "
        f"{target.periods[-1]:g} s the median is within {100 * (np.exp(median) - 1):.0f} % and the "
        f"spread of ln within {spread:.2f} of what was wanted"
    )
