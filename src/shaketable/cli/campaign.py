"""`shaketable campaign`: simulations without number, in blocks that a store keeps."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from shaketable.cli.examples import epilog
from shaketable.cli.options import Overwrite
from shaketable.cli.tell import say
from shaketable.errors import InputError, SimulationError
from shaketable.progress import duration, rate, size
from shaketable.report.run_log import RunLog

if TYPE_CHECKING:
    from shaketable.assess.stored import ReportJob
    from shaketable.campaign.description import Campaign
    from shaketable.campaign.objects import Objects
    from shaketable.campaign.plan import Plan

campaign = typer.Typer(
    no_args_is_help=True,
    epilog=epilog("campaign"),
    help="Simulations without number: in blocks, resumable, on one machine or many.",
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
    device: Annotated[str, typer.Option(help="cpu, or cuda: a GPU by NVIDIA.")] = "cpu",
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Begin anew, whatever campaign the store holds.")
    ] = False,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Tell blocks, simulations, time and bytes only.")
    ] = False,
) -> None:
    """Run a campaign, or go on with one.

    Without --scheduler or --workers it runs in this process, on all cores. What is done is in the
    store, and is not done again: after Ctrl-C, a crash or a full disk the same command goes on.
    """
    from shaketable.assess.stored import run_report
    from shaketable.campaign import cluster
    from shaketable.campaign.description import read_campaign
    from shaketable.campaign.run import run as run_plan
    from shaketable.campaign.status import estimate

    if scheduler is not None and workers is not None:
        raise InputError("--scheduler and --workers: give one of them, or none")
    described = read_campaign(file, device=device, progress=True)
    if dry_run:
        if described.report:
            _tell_estimate_of_report(_job(described))
        else:
            _tell_estimate(estimate(described.plan))
        return
    if store is None:
        raise InputError("--store: name a folder or a URL for the results, or give --dry-run")
    client: Any = None
    if scheduler is not None:
        client = cluster.connect(scheduler)
    elif workers is not None:
        client = cluster.local(workers)
    try:
        if described.report:
            run_report(_job(described), store, client=client, fresh=fresh)
        else:
            run_plan(described.plan, store, client=client, fresh=fresh)
    except KeyboardInterrupt:
        _tell_status(store)
        raise SimulationError(f"{store}: stopped; the same command goes on") from None
    finally:
        if client is not None:
            client.close()
    _tell_status(store)
    say(f"Then: shaketable campaign collect {store} --out RESULT")


def _job(described: Campaign) -> ReportJob:
    """The assessment that a file describes."""
    from shaketable.assess.stored import ReportJob

    ensemble = described.plan.ensemble
    return ReportJob(
        items=described.items,
        motions=list(ensemble.motions),  # each piece needs all of them
        scale=float(ensemble.scales[0]),
        tilt=float(ensemble.tilts[0]),
        model=ensemble.model,
        inventory=described.inventory,
        motions_told=described.motions,
        in_pairs=described.pairs,
    )


@campaign.command(epilog=epilog("campaign"))
def status(store: Store) -> None:
    """How far a campaign is."""
    _tell_status(store)


@campaign.command(epilog=epilog("campaign"))
def collect(
    store: Store,
    out: Annotated[Path, typer.Option(help="Folder for the tables.")],
    overwrite: Overwrite = False,
) -> None:
    """Falls, directions and intervals by object, as CSV and Parquet.

    Of a campaign with report = true it writes the report of assess, with its tables.
    """
    from shaketable.assess.stored import is_report
    from shaketable.campaign import open_campaign
    from shaketable.campaign.collect import by_recording_table, falls_table
    from shaketable.campaign.objects import Objects
    from shaketable.campaign.results import plan_of
    from shaketable.report.results_folder import require_folder, write_folder

    objects = Objects(store)
    if is_report(objects):
        _collect_report(objects, out, overwrite)
        return
    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    results, plan = open_campaign(store), plan_of(objects)
    table = falls_table(results, plan)
    tables = {"falls": table}
    if plan.recordings:
        tables["falls_by_recording"] = by_recording_table(results)
    run = {**run_log.entries(), **_told(store, plan)}
    written = write_folder(out, run, overwrite=overwrite, tables=tables, parquet=tables)
    falls, simulations = int(table["falls"].sum()), int(table["simulations"].sum())
    share = 100 * falls / simulations
    say(f"{falls:,} of {simulations:,} simulations overturn their body ({share:.3g} %)")
    say(f"{len(table):,} rows, one for each body, tilt and scale, in {out}: {', '.join(written)}")


def _collect_report(objects: Objects, out: Path, overwrite: bool) -> None:
    """The report of an assessment that was done in pieces."""
    from rich.console import Console

    from shaketable.assess.stored import read_report
    from shaketable.report.folder import write_results
    from shaketable.report.results_folder import require_folder
    from shaketable.report.terminal import print_assessment

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    found, job, told = read_report(objects)
    run = {
        **run_log.entries(),
        "store": objects.place,
        "inventory": {"path": job.inventory, "sha256": told["items"], "items": len(job.items)},
        "motions": {"description": job.motions_told, "sources": []},
        "building": None,
        "scaling": "",
        "settings": told,
    }
    write_results(found, run, out, overwrite=overwrite)
    print_assessment(found, Console(), out, job.motions_told)
    say(f"report: {out / 'report.html'}")


def _told(store: str, plan: Plan) -> dict[str, Any]:
    """What to cite, and to repeat it by."""
    from shaketable.campaign.fingerprint import environment
    from shaketable.campaign.inputs import PLAN
    from shaketable.campaign.objects import Objects
    from shaketable.lazy_motions import heads_of

    made = (Objects(store).get_json(PLAN) or {}).get("fingerprint", {})
    return {
        "store": store,
        "simulations": plan.simulations,
        "model": repr(plan.ensemble.model),
        "environment": made.get("environment"),
        "environment_of_this_table": environment(),
        "motions": [head.name for head in heads_of(plan.ensemble.motions)],
    }


def _tell_estimate(told: Any) -> None:
    from shaketable.engine.pool import available_cores

    say(f"simulations       {told.simulations:,} in {told.blocks:,} blocks")
    say(f"time              about {duration(told.seconds)} on the {available_cores()} cores here")
    say(f"                  ({told.rate:,.0f} simulations/s in a sample of them)")
    say(f"bytes             at most {size(told.size)}, before compression")
    say(f"                  and {size(told.inputs)} for bodies and motions")


def _tell_estimate_of_report(job: ReportJob) -> None:
    from shaketable.assess.stored import seconds_of
    from shaketable.engine.pool import available_cores

    say(f"objects           {len(job.items):,} in {job.pieces:,} pieces")
    say(
        f"time              about {duration(seconds_of(job))} on the {available_cores()} cores here"
    )
    say("                  (by a sample of them; a first run also compiles, for a minute)")


def _tell_status(store: str) -> None:
    from shaketable.assess.stored import is_report, status_of_report
    from shaketable.campaign.objects import Objects
    from shaketable.campaign.status import status_of

    objects = Objects(store)
    if is_report(objects):
        assessed, every = status_of_report(objects)
        say(f"objects           {assessed:,} of {every:,} assessed")
        return
    told = status_of(objects)
    say(f"blocks            {told.done:,} of {told.blocks:,} done, {len(told.failed)} failed")
    say(f"simulations       {told.simulated:,} of {told.simulations:,}")
    if told.damaged:
        say(f"damaged           {told.damaged:,} blocks: results are missing or cut short;")
        say("                  the same command does them again")
    if told.seconds:
        speed = rate(told.simulated / told.seconds)
        say(f"work              {duration(told.seconds)} of all workers together, {speed} of each")
        say(f"bytes             {size(told.size)}, without bodies and motions")
        done = ", ".join(f"{n:,} on {host}" for host, n in told.hosts.items())
        say(f"blocks            {done}")
    if told.holder is not None:
        host, process, age = told.holder
        if told.gone:
            say(f"killed            process {process} on {host}; the same command goes on")
        else:
            say(f"running           process {process} on {host}, heard {age:.0f} s ago")
    for number, reason in list(told.failed.items())[:10]:
        say(f"failed            block {number}: {reason}")
