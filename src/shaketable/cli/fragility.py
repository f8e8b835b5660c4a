"""`shaketable fragility`: the probability that objects fall, as functions for loss tools."""

from __future__ import annotations

import logging
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from shaketable.cli.bodies import BodyOptions
from shaketable.cli.console import say
from shaketable.cli.option_groups import settings_of
from shaketable.cli.options import (
    ContactOptions,
    Overwrite,
    TiltDeg,
)
from shaketable.cli.shaking import MotionOptions
from shaketable.errors import InputError, quoted
from shaketable.report.run_log import RunLog
from shaketable.units import radians

log = logging.getLogger(__name__)


class MethodWord(StrEnum):
    """How functions are found from the command line."""

    CLOUD = "cloud"
    STRIPES = "stripes"
    IDA = "ida"
    TRUNCATED_IDA = "truncated-ida"


def fragility(
    *,
    out: Annotated[Path, typer.Option(help="Folder for the page, tables and figures.")],
    body_options: BodyOptions,
    motion_options: MotionOptions,
    measure: Annotated[
        str, typer.Option(help="PGA, PGV, PGD, SA(1.0), AvgSA(1.0), CAV, Arias, ...")
    ] = "PGV",
    limit_states: Annotated[
        str,
        typer.Option(
            help="overturns, uplift, 'rocks 0.5 alpha' (of the slenderness), 'slides 0.1 m' (with "
            "--model general); several with commas."
        ),
    ] = "overturns",
    method: Annotated[
        MethodWord,
        typer.Option(
            help="cloud: all simulations at once; stripes: every motion scaled to --levels; ida: "
            "each motion's lowest level that overturns; truncated-ida: the same up to --highest."
        ),
    ] = MethodWord.CLOUD,
    scales: Annotated[
        str | None,
        typer.Option(
            help="Scale factors of a cloud, with commas. [chosen so that nearly none to "
            "nearly all reach the state]"
        ),
    ] = None,
    levels: Annotated[
        str | None,
        typer.Option(
            help="Levels of the measure for stripes, with commas: in g, cm/s or cm, as the page."
        ),
    ] = None,
    highest: Annotated[
        float | None,
        typer.Option(help="The highest level of a truncated IDA, in the same unit."),
    ] = None,
    geometric_mean: Annotated[
        bool,
        typer.Option(
            "--geometric-mean",
            help="Tell intensities as the geometric mean of a recording's two components.",
        ),
    ] = False,
    more_beta: Annotated[
        float,
        typer.Option(
            min=0.0,
            help="Dispersion of the objects: β becomes √(β² + this²). FEMA P-58 has 0.5 in "
            "all for furniture.",
        ),
    ] = 0.0,
    tilt_deg: TiltDeg = 0.0,
    contact_options: ContactOptions,
    export: Annotated[
        str | None,
        typer.Option(help="nrml (OpenQuake), pelicun, or both with a comma."),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the bootstrap.")] = 0,
    overwrite: Overwrite = False,
) -> None:
    """Fit fragility functions of objects, for loss models such as OpenQuake and pelicun.

    Lognormal fragility functions by maximum likelihood, with intervals over earthquakes, and which
    intensity measure tells most of the first object.
    """
    settings = {name: value for name, value in settings_of(locals()).items() if name != "overwrite"}
    from shaketable.fragility import efficiency, residuals
    from shaketable.fragility import fragility as functions
    from shaketable.fragility.exported import unit_of
    from shaketable.fragility.intensities import GEOMETRIC_MEAN, OWN
    from shaketable.fragility.limit_states import OVERTURNS
    from shaketable.fragility.pelicun import require_blank
    from shaketable.fragility.shown import unit_shown
    from shaketable.report.fragility import EXPORTS, PELICUN, lead, write_fragility
    from shaketable.report.results_folder import require_folder
    from shaketable.report.run_log import sha256
    from shaketable.signal import measure_named

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    exports = _split(export)
    for name in exports:
        if name not in EXPORTS:
            raise InputError(f"--export: unknown {quoted(name)}; accepted: {', '.join(EXPORTS)}")
    contact = contact_options.contact()
    bodies = body_options.bodies()
    known = measure_named(measure)
    unit = unit_shown(known)
    _require(method, levels, highest, f"in {unit.name} for {known.name}")
    for name in exports:
        unit_of(known, *EXPORTS[name])
    if PELICUN in exports or overwrite:
        require_blank(out)
    at = _numbers("--levels", levels)
    components = GEOMETRIC_MEAN if geometric_mean else OWN
    shaking = motion_options.required()
    found = functions(
        bodies,
        shaking.motions,
        measure=measure,
        limit_states=_split(limit_states),
        method=method.value.replace("-", " "),
        scales=_numbers("--scales", scales),
        levels=at and [level / unit.factor for level in at],
        highest=highest and highest / unit.factor,
        tilt=radians(tilt_deg),
        components=components,
        model=contact,
        seed=seed,
        progress=True,
    )
    found = found.with_more_beta(more_beta)
    compared = departing = None
    first = [one for one in found.curves[: len(found.states)] if one.state.kind == OVERTURNS]
    if first and not first[0].problem:
        compared = efficiency(
            bodies[:1], shaking.motions, tilt=radians(tilt_deg), components=components,
            model=contact, seed=seed, scales=found.scales if method is MethodWord.CLOUD else None,
        )  # fmt: skip
        departing = residuals(first[0], shaking.motions)
    table = body_options.inventory
    run = {
        **run_log.entries(),
        "inventory": table and {"path": str(table), "sha256": sha256(table)},
        "motions": shaking.entries(),
        "settings": {
            name: str(value) if isinstance(value, Path) else value
            for name, value in settings.items()
        },
    }
    write_fragility(found, compared, departing, run, out, exports=exports, overwrite=overwrite)
    for sentence in lead(found):
        say(sentence)
    say(f"page: {out / 'index.html'}; functions.csv and the other files beside it")


def _require(method: MethodWord, levels: str | None, highest: float | None, unit: str) -> None:
    """InputError unless a method has what it takes, and nothing else."""
    for wanted, option, value in (
        (MethodWord.STRIPES, "--levels", levels),
        (MethodWord.TRUNCATED_IDA, "--highest", highest),
    ):
        if (method is wanted) != (value is not None):
            verb = "needs" if method is wanted else "takes no"
            raise InputError(f"--method {method.value} {verb} {option}, {unit}")
    if highest is not None and not 0.0 < highest < float("inf"):
        raise InputError(f"--highest must be above 0, {unit}; got {highest:g}")


def _split(text: str | None) -> list[str]:
    return [part.strip() for part in (text or "").split(",") if part.strip()]


def _numbers(option: str, text: str | None) -> list[float] | None:
    if text is None:
        return None
    try:
        found = [float(part) for part in _split(text)]
    except ValueError:
        raise InputError(f"{option}: numbers with commas, got {quoted(text)}") from None
    if not found or not all(0.0 < each < float("inf") for each in found):
        raise InputError(f"{option}: numbers above 0 with commas, got {quoted(text)}")
    return found
