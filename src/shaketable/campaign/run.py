"""Run a campaign: many simulations in blocks that can be resumed, here or on many machines."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from shaketable.body import Body
from shaketable.campaign.beginning import begin, missing, require_room, require_store
from shaketable.campaign.blocks import Site
from shaketable.campaign.driver import BlockTally, forget_failures, require_all_done, run_here
from shaketable.campaign.lock import locked
from shaketable.campaign.notes import notes_of
from shaketable.campaign.objects import Objects, disk_of
from shaketable.campaign.plan import ALL, Plan
from shaketable.campaign.results import results_of
from shaketable.campaign.simulations import Simulations
from shaketable.campaign.work import Work
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.simulate.around import Around
from shaketable.simulate.kinds import CUDA
from shaketable.solid import Solid

if TYPE_CHECKING:
    import xarray as xr


def run_campaign(
    bodies: Sequence[Body] | Sequence[Solid],
    motions: Iterable[Motion],
    *,
    store: str | Path,
    tilts: ArrayLike = (0.0,),
    scales: ArrayLike = (1.0,),
    polarities: ArrayLike = (1, -1),
    azimuth: float = math.pi,
    orientations: ArrayLike = (0.0,),
    model: Model | str | None = None,
    surroundings: Around = None,
    client: Any = None,
    device: str = "cpu",
    keep: str = ALL,
    recordings: bool = False,
    fresh: bool = False,
    block: int | None = None,
    progress: Progress = True,
    threads: int | None = None,
) -> xr.Dataset:
    """Run `simulate_many` in blocks that a store keeps, so that it can be resumed.

    A run that was stopped, killed or met a full disk goes on where it was: a block counts once its
    results and the note that it is done are written, and is then never done again.

    Args:
        bodies, tilts, scales, polarities, azimuth, orientations, model, surroundings: as for
            `simulate_many`.
        motions: as for `simulate_many`, or a generator, whose motions are taken one by one into a
            temporary file: of any number only those at hand are in memory.
        store: a folder, or a URL that fsspec knows.
        client: a dask.distributed.Client whose workers do the blocks; this process by default.
        device: "cpu", or "cuda" for a GPU by NVIDIA, of planar bodies.
        keep: "all" keeps every simulation (22 bytes each with the rocking model, 54 with the
            general one, 86 for solids, 1 + 16 n more with n straps, before compression); "summary"
            keeps counts by body, tilt and scale.
        recordings: whether a summary also keeps counts by recording.
        fresh: begin anew, whatever campaign the store holds.
        block: about how many simulations a block has; by default those of BLOCKS.
        progress, threads: as for `simulate_many`.

    Returns:
        What `open_campaign` returns.

    Raises:
        InputError: what `simulate_many` says, but for a body that falls by itself; a store that
            holds something else, a campaign with other inputs, code or versions, or one that
            another process writes; too little disk space.
        SimulationError: some blocks failed, for example as a body cannot stand on a tilt, and the
            others are done; another process took the lock; or the disk is full.
    """
    plan = Plan.of(
        bodies,
        motions,
        tilts=tilts,
        scales=scales,
        polarities=polarities,
        azimuth=azimuth,
        orientations=orientations,
        model=model,
        surroundings=surroundings,
        keep=keep,
        recordings=recordings,
        device=device,
        block=block,
    )
    work = Simulations(plan)
    run(work, store, client=client, fresh=fresh, progress=progress, threads=threads)
    return results_of(work, Objects(store), check=False)  # the run has just looked at them


def run(
    work: Work,
    store: str | Path,
    *,
    client: Any = None,
    fresh: bool = False,
    progress: Progress = True,
    threads: int | None = None,
) -> None:
    """Do what is missing of some work; arguments as for `run_campaign`."""
    objects = Objects(store)
    require_store(objects)
    if work.device == CUDA and client is None:  # workers look for themselves
        from shaketable.engine.cuda import require_gpu

        require_gpu()
    with disk_of(objects), locked(objects) as lost:
        made = begin(work, objects, fresh)
        forget_failures(objects)
        blocks = missing(work, made, objects)
        require_room(work, len(blocks), objects)
        tally = BlockTally(len(blocks))
        with meter(work.counted, sum(map(work.count, blocks)), progress, tally.__str__) as done:
            if client is None:
                site = Site(work, made, objects, work.opened(objects))
                failures = run_here(site, blocks, threads, done, tally, lost)
            else:
                from shaketable.campaign.cluster import run_on

                failures = run_on(client, blocks, objects, done, tally, lost)
        work.warn(notes_of(work, objects).values())
        require_all_done(failures, work.blocks, objects)
