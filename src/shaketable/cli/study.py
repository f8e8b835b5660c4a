"""`shaketable study`: a published study, done again with the motions at hand."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from shaketable.cli.options import TimeStep, Units
from shaketable.cli.run_log import RunLog
from shaketable.cli.shaking import Vertical, gather
from shaketable.errors import InputError
from shaketable.recordings import DRAWS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from shaketable.studies import Study

study = typer.Typer(no_args_is_help=True, help="A published study, with the motions at hand.")

DEFAULT_SUITE = "fema-p695"


class Models(StrEnum):
    """Which of the paper's two models."""

    ROCKING = "rocking"
    GENERAL = "general"
    BOTH = "both"


Out = Annotated[Path, typer.Option(help="Folder for tables, figures and study.json.")]
StudyMotions = Annotated[
    list[str] | None,
    typer.Option(
        "--motions", help=f"Suites' names, record files, folders of records. [{DEFAULT_SUITE}]"
    ),
]
Seed = Annotated[int, typer.Option(min=0, help="Seed of the bootstrap.")]
Overwrite = Annotated[
    bool, typer.Option("--overwrite", help="Replace the results in an existing folder.")
]


@study.command("boroschek-iruretagoyena-2006")
def boroschek_iruretagoyena_2006(
    out: Out,
    motions: StudyMotions = None,
    vertical: Vertical = False,
    model: Annotated[Models, typer.Option(help="Model, or both.")] = Models.ROCKING,
    units: Units = None,
    time_step_s: TimeStep = None,
    seed: Seed = 0,
    overwrite: Overwrite = False,
) -> None:
    """Controlled overturning by tilting: tables I, II, III, V, VI and figures 2-10, 13.

    Twelve bodies on supports tilted by 0 to 7°, under every motion in both directions; the
    curves GCOR and SCOR as printed and fitted anew; what the paper says beside what is found.
    """
    from shaketable.report.studies import boroschek_iruretagoyena_2006 as view
    from shaketable.studies import boroschek_iruretagoyena_2006 as paper

    models = ("rocking", "general") if model is Models.BOTH else (model.value,)
    _do(
        partial(paper.run, models=models, seed=seed),
        view.figures,
        out,
        overwrite,
        motions,
        vertical,
        units,
        time_step_s,
        {"models": list(models), "friction_of_general_model": paper.FRICTION, "seed": seed},
    )


@study.command("boroschek-romo-2004")
def boroschek_romo_2004(
    out: Out,
    motions: StudyMotions = None,
    vertical: Vertical = False,
    units: Units = None,
    time_step_s: TimeStep = None,
    seed: Seed = 0,
    overwrite: Overwrite = False,
) -> None:
    """Overturning criteria for bodies with the centre of gravity off centre: figures 4-8.

    48 symmetric bodies and 144 off centre under every motion in both directions; how often each
    criterion calls safe what falls, and warns of what stands; a rule fitted to them.
    """
    from shaketable.report.studies import boroschek_romo_2004 as view
    from shaketable.studies import boroschek_romo_2004 as paper

    _do(
        partial(paper.run, seed=seed),
        view.figures,
        out,
        overwrite,
        motions,
        vertical,
        units,
        time_step_s,
        {"seed": seed},
    )


def _do(
    run: Callable[..., Study],
    figures: Callable[[Study], Iterable[tuple[str, Figure]]],
    out: Path,
    overwrite: bool,
    motions: list[str] | None,
    vertical: bool,
    units: str | None,
    time_step: float | None,
    settings: dict[str, object],
) -> None:
    """What every study does: gather, run, write, tell."""
    from shaketable.report.folder import require_writable
    from shaketable.report.studies.folder import earlier_files

    run_log = RunLog()
    require_writable(out, overwrite, earlier_files(out))
    shaking = gather(motions or [DEFAULT_SUITE], vertical, units, time_step)
    results = run(shaking.motions, description=shaking.description)
    log = {
        **run_log.entries(),
        "motions": shaking.entries(),
        "settings": {
            **settings,
            "draws": DRAWS,
            "vertical": vertical,
            "units": units,
            "time_step_s": time_step,
        },
    }
    _write(results, figures, log, out, overwrite)


@study.command("cimellaro-2020")
def cimellaro_2020(
    out: Out,
    building: Annotated[
        Path | None,
        typer.Option(help="A building beside the three: folder of floor motions, or TOML file."),
    ] = None,
    motions: StudyMotions = None,
    n: Annotated[int, typer.Option(min=1, help="Compatible motions for each floor motion.")] = 100,
    units: Units = None,
    time_step_s: TimeStep = None,
    seed: Seed = 0,
    overwrite: Overwrite = False,
) -> None:
    """Overturning risk of furniture on floors: tables 1-3, figures 2 and 5-8.

    The floors of three linear shear buildings in place of the paper's, and those of a recorded
    building: Kaneko and Hayashi's formula, direct integration, and the paper's, as printed and
    fitted anew.
    """
    from shaketable.building import read_building
    from shaketable.report.folder import require_writable
    from shaketable.report.studies import cimellaro_2020 as view
    from shaketable.report.studies.folder import earlier_files
    from shaketable.studies import cimellaro_2020 as paper

    run_log = RunLog()
    require_writable(out, overwrite, earlier_files(out))
    channels = paper.stand_ins()
    told: dict[str, object] = {}
    if building is not None and building.suffix.lower() == ".toml":
        house = read_building(building, progress=True)
        channels += paper.channels_in(house)
        told = {"names": [motion.name for group in house.floors.values() for motion in group]}
    elif building is not None:
        if not building.is_dir():
            raise InputError(f"--building: {building}: there is no such folder or TOML file")
        shaking = gather([str(building)], False, units, time_step_s)
        channels += paper.channels_of(building.name, shaking.motions)
        told = shaking.entries()
    judging = gather(motions or [DEFAULT_SUITE], False, None, None)
    results = paper.run(channels, recorded=judging.motions, n=n, seed=seed)
    settings = {
        "building": building and str(building),
        "n": n,
        "seed": seed,
        "units": units,
        "time_step_s": time_step_s,
    }
    log = {
        **run_log.entries(),
        "building": told,
        "motions": judging.entries(),
        "settings": settings,
    }
    _write(results, view.figures, log, out, overwrite)


def _write(
    results: Study,
    figures: Callable[[Study], Iterable[tuple[str, Figure]]],
    log: dict[str, object],
    out: Path,
    overwrite: bool,
) -> None:
    """Write the folder, and tell what was found."""
    from rich.console import Console

    from shaketable.report.studies.folder import write_study
    from shaketable.report.terminal import print_claims

    write_study(results, figures, log, out, overwrite=overwrite)
    print_claims(results, Console())
    typer.echo(f"tables, figures and study.json: {out}")
