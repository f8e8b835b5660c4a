"""`shaketable study`: a published study, done again with the motions at hand."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from shaketable.cli.options import TimeStep, Units
from shaketable.cli.run_log import RunLog
from shaketable.cli.shaking import Vertical, gather
from shaketable.recordings import DRAWS

study = typer.Typer(no_args_is_help=True, help="A published study, with the motions at hand.")

DEFAULT_SUITE = "fema-p695"


class Models(StrEnum):
    """Which of the paper's two models."""

    ROCKING = "rocking"
    GENERAL = "general"
    BOTH = "both"


@study.command("boroschek-iruretagoyena-2006")
def boroschek_iruretagoyena_2006(
    out: Annotated[Path, typer.Option(help="Folder for tables, figures and study.json.")],
    motions: Annotated[
        list[str] | None,
        typer.Option(help=f"Suites' names, record files, folders of records. [{DEFAULT_SUITE}]"),
    ] = None,
    vertical: Vertical = False,
    model: Annotated[Models, typer.Option(help="Model, or both.")] = Models.ROCKING,
    units: Units = None,
    time_step_s: TimeStep = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the bootstrap.")] = 0,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace the results in an existing folder.")
    ] = False,
) -> None:
    """Controlled overturning by tilting: tables I, II, III, V, VI and figures 2-10, 13.

    Twelve bodies on supports tilted by 0 to 7°, under every motion in both directions; the
    curves GCOR and SCOR as printed and fitted anew; what the paper says beside what is found.
    """
    from rich.console import Console

    from shaketable.report.folder import require_writable
    from shaketable.report.studies import boroschek_iruretagoyena_2006 as view
    from shaketable.report.studies.folder import earlier_files, write_study
    from shaketable.report.terminal import print_claims
    from shaketable.studies import boroschek_iruretagoyena_2006 as paper

    run_log = RunLog()
    require_writable(out, overwrite, earlier_files(out))
    shaking = gather(motions or [DEFAULT_SUITE], vertical, units, time_step_s)
    models = ("rocking", "general") if model is Models.BOTH else (model.value,)
    results = paper.run(shaking.motions, description=shaking.description, models=models, seed=seed)
    run = {
        **run_log.entries(),
        "motions": shaking.entries(),
        "settings": {
            "models": list(models),
            "friction_of_general_model": paper.FRICTION,
            "vertical": vertical,
            "units": units,
            "time_step_s": time_step_s,
            "seed": seed,
            "draws": DRAWS,
        },
    }
    write_study(results, view.figures, run, out, overwrite=overwrite)
    print_claims(results, Console())
    typer.echo(f"tables, figures and study.json: {out}")
