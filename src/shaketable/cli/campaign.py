"""`shaketable campaign`: large sets of simulations, in blocks that a store keeps."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from shaketable.cli.console import say
from shaketable.cli.examples import epilog
from shaketable.cli.options import Overwrite
from shaketable.errors import InputError, SimulationError
from shaketable.progress import duration, rate, size
from shaketable.report.run_log import RunLog

if TYPE_CHECKING:
    from shaketable.campaign.assessments import Assessments
    from shaketable.campaign.libraries import Libraries
    from shaketable.campaign.objects import Objects
    from shaketable.campaign.plan import Plan
    from shaketable.campaign.simulations import Simulations
    from shaketable.campaign.work import Work


campaign = typer.Typer(
    no_args_is_help=True,
    epilog=epilog("campaign"),
    help="Run large sets of simulations in blocks that can be resumed, on one machine or many.",
)

Store = Annotated[str, typer.Argument(help="Folder or URL of the campaign's results.")]


@campaign.command(epilog=epilog("campaign"))
def run(
    file: Annotated[
        Path, typer.Argument(help="TOML file: bodies, motions, shaking, model, results.")
    ],
    store: Annotated[
        str | None, typer.Option(help="Folder for the results, or a URL that fsspec knows.")
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(help="Address of a Dask scheduler, as tcp://host:8786.")
    ] = None,
    workers: Annotated[
        int | None, typer.Option(min=1, help="Processes on this machine, of one thread each.")
    ] = None,
    device: Annotated[
        str, typer.Option(help="cpu, or cuda: a GPU by NVIDIA, of planar bodies.")
    ] = "cpu",
    fresh: Annotated[
        bool,
        typer.Option("--fresh", help="Start again and discard the campaign that the store holds."),
    ] = False,
    dry_run: Annotated[
        bool,
        typer.Option(
            "--dry-run",
            help="Print the number of blocks and simulations, the time and the size, and stop.",
        ),
    ] = False,
) -> None:
    """Run a campaign, or resume one.

    Without --scheduler or --workers it runs in this process, on all cores. What is done is in the
    store, and is not done again: after Ctrl-C, a crash or a full disk the same command goes on.
    """
    from shaketable.campaign import cluster
    from shaketable.campaign.description import read_campaign
    from shaketable.campaign.run import run as run_work

    if scheduler is not None and workers is not None:
        raise InputError("--scheduler and --workers: give one of them, or none")
    work = read_campaign(file, device=device, progress=True)
    if dry_run:
        _tell_estimate(work)
        return
    if store is None:
        raise InputError("--store: name a folder or a URL for the results, or give --dry-run")
    clients: AbstractContextManager[Any] = nullcontext()
    if scheduler is not None:
        clients = cluster.connect(scheduler)
    elif workers is not None:
        clients = cluster.local(workers)
    with clients as client:
        try:
            run_work(work, store, client=client, fresh=fresh)
        except KeyboardInterrupt:
            with suppress(InputError, SimulationError):  # nothing may have been written yet
                _tell_status(store)
            raise SimulationError(
                f"{store}: stopped; the same command{', without --fresh,' if fresh else ''} goes on"
            ) from None
    _tell_status(store)
    say(f"Then: shaketable campaign collect {store} --out RESULT")


@campaign.command(epilog=epilog("campaign"))
def status(store: Store) -> None:
    """Show how far a campaign is."""
    _tell_status(store)


@campaign.command(epilog=epilog("campaign"))
def collect(
    store: Store,
    out: Annotated[Path, typer.Option(help="Folder for the tables.")],
    overwrite: Overwrite = False,
) -> None:
    """Write counts of falls, directions and intervals by object, as CSV and Parquet.

    For a campaign with report = true, write the same report and tables as `shaketable assess`. For
    a library, fit its fragility functions and write them for OpenQuake, pelicun and a browser.
    """
    from shaketable.campaign.assessments import Assessments
    from shaketable.campaign.kinds import work_of
    from shaketable.campaign.libraries import Libraries
    from shaketable.campaign.objects import Objects
    from shaketable.campaign.results import simulations_of
    from shaketable.report.results_folder import require_folder

    objects = Objects(store)
    work = work_of(objects)
    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    if isinstance(work, Assessments):
        _write_report(work, objects, run_log, out, overwrite)
    elif isinstance(work, Libraries):
        _write_library(work, objects, run_log, out, overwrite)
    else:
        _write_falls(simulations_of(objects), objects, run_log, out, overwrite)


def _write_falls(
    work: Simulations, objects: Objects, run_log: RunLog, out: Path, overwrite: bool
) -> None:
    """The tables of simulations."""
    from shaketable.campaign.collect import by_recording_table, falls_table
    from shaketable.campaign.results import results_of
    from shaketable.report.results_folder import write_folder

    results, plan = results_of(work, objects), work.plan
    table = falls_table(results, plan)
    tables = {"falls": table}
    if plan.recordings:
        tables["falls_by_recording"] = by_recording_table(results)
    run = {**run_log.entries(), **_told(objects, plan)}
    written = write_folder(out, run, overwrite=overwrite, tables=tables, parquet=tables)
    falls, simulations = int(table["falls"].sum()), int(table["simulations"].sum())
    share = 100 * falls / simulations
    held = int(table["held_up"].sum()) if "held_up" in table else 0
    stays = f"; {held:,} leave it held up by its wall or strap alone" if held else ""
    say(f"{falls:,} of {simulations:,} simulations overturn their body ({share:.3g} %){stays}")
    say(f"{len(table):,} rows, one for each body, tilt and scale, in {out}: {', '.join(written)}")


def _write_report(
    work: Assessments, objects: Objects, run_log: RunLog, out: Path, overwrite: bool
) -> None:
    """The report of an inventory."""
    from rich.console import Console

    from shaketable.campaign.assessments import read_assessment
    from shaketable.campaign.fingerprint import hash_of
    from shaketable.lazy_motions import heads_of
    from shaketable.report.assessment_folder import write_results
    from shaketable.report.terminal import print_assessment

    found, made = read_assessment(work, objects), _fingerprint(objects)
    vertical = any(head.has_vertical for head in heads_of(work.motions))
    run = {
        **run_log.entries(),
        "store": objects.place,
        "inventory": {
            "path": work.inventory,
            "sha256": work.inventory_sha256,
            "items": len(work.items),
        },
        "motions": {"description": work.motions_told, "sources": []},
        "building": None,
        "scaling": "",
        "settings": {
            **made,
            "items": hash_of(*(each.encode() for each in made["items"])),
            "vertical": vertical,
        },
    }
    write_results(found, run, out, overwrite=overwrite)
    print_assessment(found, Console(), out, work.motions_told)
    say(f"report: {out / 'report.html'}")


def _write_library(
    work: Libraries, objects: Objects, run_log: RunLog, out: Path, overwrite: bool
) -> None:
    """The functions of a library."""
    from shaketable.campaign.libraries import functions_of
    from shaketable.lazy_motions import heads_of
    from shaketable.library.table import table_of
    from shaketable.report.library import write_library

    table, library = table_of(functions_of(work, objects)), work.library
    run = {
        **run_log.entries(),
        "store": objects.place,
        "seed": library.seed,
        "environment": _fingerprint(objects).get("environment"),
        "motions": {
            "description": library.motions,
            "hashes": dict(
                zip(
                    [head.name for head in heads_of(work.motions)],
                    _fingerprint(objects).get("motions", []),
                    strict=False,
                )
            ),
        },
    }
    files = write_library(table, library.title, library.edition, run, out, overwrite=overwrite)
    known = int(table["median"].notna().sum())
    say(f"{known:,} of {len(table):,} rows have a function; page: {out / 'index.html'}")
    say(f"{len(files)} files in {out}; functions.csv has all rows")


def _fingerprint(objects: Objects) -> dict[str, Any]:
    """All that the results of a store depend on."""
    from shaketable.campaign.work import PLAN

    return dict((objects.get_json(PLAN) or {}).get("fingerprint", {}))


def _told(objects: Objects, plan: Plan) -> dict[str, Any]:
    """What to cite, and to repeat it by."""
    from shaketable.campaign.fingerprint import environment
    from shaketable.lazy_motions import heads_of

    ensemble = plan.ensemble
    held = {}
    if any(ensemble.surroundings):
        held["surroundings_of_the_first"] = repr(ensemble.around(0))
    return {
        "store": objects.place,
        "simulations": plan.simulations,
        "model": repr(ensemble.model),
        **held,
        "environment": _fingerprint(objects).get("environment"),
        "environment_of_this_table": environment(),
        "motions": [head.name for head in heads_of(ensemble.motions)],
    }


def _tell_estimate(work: Work) -> None:
    from shaketable.campaign.status import estimate
    from shaketable.engine.pool import available_cores

    told = estimate(work)
    say(f"{told.counted:<18}{told.count:,} in {told.blocks:,} blocks")
    say(f"time              about {duration(told.seconds)} on the {available_cores()} cores here")
    say(f"                  ({rate(told.rate)} by a sample of them; a first run also compiles)")
    say(f"bytes             at most {size(told.size)}, before compression")
    say(f"                  and {size(told.inputs)} for bodies and motions")


def _tell_status(store: str) -> None:
    from shaketable.campaign.objects import Objects
    from shaketable.campaign.status import status_of

    told = status_of(Objects(store))
    say(
        f"blocks            {told.blocks_done:,} of {told.blocks:,} done, {len(told.failed)} failed"
    )
    say(f"{told.counted:<18}{told.count_done:,} of {told.count:,}")
    if told.damaged:
        say(f"damaged           {told.damaged:,} blocks: results are missing or cut short;")
        say("                  the same command does them again")
    if told.seconds:
        speed = rate(told.count_done / told.seconds)
        say(f"work              {duration(told.seconds)} of all workers, {speed} per worker")
        say(f"bytes             {size(told.size)}, without bodies and motions")
        done = ", ".join(f"{n:,} on {host}" for host, n in told.hosts.items())
        say(f"blocks            {done}")
    if told.holder is not None:
        host, process, age = told.holder
        if told.gone:
            say(f"killed            process {process} on {host}; the same command goes on")
        else:
            say(f"running           process {process} on {host}, last heartbeat {age:.0f} s ago")
    for number, reason in list(told.failed.items())[:10]:
        say(f"failed            block {number}: {reason}")
