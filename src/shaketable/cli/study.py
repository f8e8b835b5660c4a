"""`shaketable study`: a published study, done again with the motions at hand."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from shaketable.cli.console import say
from shaketable.cli.examples import study_epilog
from shaketable.cli.option_groups import with_groups
from shaketable.cli.options import ReadingOptions
from shaketable.cli.shaking import Vertical, load_motions
from shaketable.extras import require
from shaketable.report.run_log import RunLog
from shaketable.resampling import DRAWS
from shaketable.study import PublishedStudy, StudyInput, installed_studies


class InstalledStudies(TyperGroup):
    """The commands of the studies that are installed."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """InputError if there are none: which command it was to be is not known."""
        if not installed_studies():
            require("studies", "shaketable study")
        return super().resolve_command(ctx, args)


study = typer.Typer(
    cls=InstalledStudies,
    no_args_is_help=True,
    epilog=study_epilog(),
    help="Repeat a published study with the motions at hand.",
)

STUDY_SUITE = "fema-p695"

Out = Annotated[Path, typer.Option(help="Folder for the page, tables, figures and JSON files.")]
StudyMotions = Annotated[
    list[str] | None,
    typer.Option(
        "--motions", help=f"Suites' names, record files, folders of records. [{STUDY_SUITE}]"
    ),
]
Seed = Annotated[int, typer.Option(min=0, help="Seed of the bootstrap.")]
Overwrite = Annotated[
    bool, typer.Option("--overwrite", help="Replace the results in an existing folder.")
]


def _do(
    published: PublishedStudy,
    out: Path,
    motions: list[str] | None = None,
    vertical: bool = False,
    *,
    reading: ReadingOptions,
    seed: int = 0,
    overwrite: bool = False,
    **options: object,
) -> None:
    """What every study command does: gather motions, run the study, write and tell its results."""
    from rich.console import Console

    from shaketable.report.results_folder import PAGE, require_folder
    from shaketable.report.study_folder import write_study
    from shaketable.report.terminal import print_claims

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    shaking = load_motions(motions or [STUDY_SUITE], vertical, reading)
    results = published.do(
        StudyInput(
            motions=shaking.motions,
            description=shaking.description,
            seed=seed,
            options=options,
            **reading.as_read,
        )
    )
    paths = {name: str(value) for name, value in options.items() if isinstance(value, Path)}
    log = {
        **run_log.entries(),
        "motions": shaking.entries(),
        "inputs": results.inputs,
        "settings": {
            **options,
            **paths,
            "seed": seed,
            "draws": DRAWS,
            "vertical": vertical,
            **asdict(reading),
        },
    }
    write_study(published, results, log, out, overwrite=overwrite)
    print_claims(results, Console())
    say(f"page: {out / PAGE}; tables, figures and study.json beside it")


def _command(published: PublishedStudy) -> Callable[..., None]:
    """The command of a study, with the options that all studies have and its own."""

    def parameter(name: str, kind: Any, default: object = None) -> inspect.Parameter:
        return inspect.Parameter(
            name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=kind
        )

    shared = [
        inspect.Parameter("out", inspect.Parameter.KEYWORD_ONLY, annotation=Out),
        parameter("motions", StudyMotions),
        *([parameter("vertical", Vertical, False)] if published.takes_verticals else []),
        *(
            parameter(each.name, Annotated[each.kind, typer.Option(help=each.help)], each.default)
            for each in published.options
        ),
        inspect.Parameter("reading", inspect.Parameter.KEYWORD_ONLY, annotation=ReadingOptions),
        parameter("seed", Seed, 0),
        parameter("overwrite", Overwrite, False),
    ]

    def command(**given: Any) -> None:
        _do(published, **given)

    command.__doc__ = published.summary
    command.__signature__ = inspect.Signature(shared)  # type: ignore[attr-defined]
    command.__annotations__ = {each.name: each.annotation for each in shared}
    return with_groups(command)


for _name, _published in installed_studies().items():
    study.command(_name, epilog=study_epilog(_name))(_command(_published))
