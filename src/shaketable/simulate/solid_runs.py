"""Runs of solids, some at a time, on all cores."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.endings import counts_of
from shaketable.errors import InputError, joined, require_whole
from shaketable.lazy_motions import heads_of
from shaketable.models import General
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.simulate.devices import CPU, CUDA
from shaketable.simulate.solid_batches import Batch, SolidPart, part_of
from shaketable.simulate.solid_input import ground_of, shapes_of, standing_limit
from shaketable.solid import Solid
from shaketable.units import degrees

log = logging.getLogger(__name__)

RUNS_PER_TASK = 4  # some take a thousand times as long as others


def run_batches(
    batches: Iterable[Batch],
    model: General,
    keep: Callable[[SolidPart], None],
    threads: int | None,
    progress: Progress,
    device: str = CPU,
) -> Counter[float]:
    """Simulate all batches, the longest motions first; returns how many runs ended in which way.

    Args:
        batches: at least one.
        model: the contact model.
        keep: takes the results of some members at a time, in any order, in the caller's thread.
        threads, progress, device: as for `simulate_many`.
    """
    if device == CUDA:
        from shaketable.simulate.solids_on_gpu import run_batches_on_gpu

        return run_batches_on_gpu(batches, model, keep, progress)
    from shaketable.engine.pool import run_all

    if threads is not None:
        require_whole("threads", threads)
    ordered = sorted(batches, key=lambda batch: -batch.motion.duration)
    endings: Counter[float] = Counter()
    with meter("simulations", sum(batch.members.size for batch in ordered), progress) as done:

        def enter(part: SolidPart) -> None:
            keep(part)
            endings.update(counts_of(part.column("ending")))
            done(part.members.size)

        run_all((task for batch in ordered for task in _tasks(batch, model)), threads, enter)
    return endings


def _tasks(batch: Batch, model: General) -> Iterator[Callable[[], SolidPart]]:
    """The runs of a batch, some in each task."""
    from shaketable.solids.drive import move_solid
    from shaketable.solids.room import STATE
    from shaketable.solids.run import Found, Trace

    shapes, rooms = shapes_of(batch.solid, model)
    ground = ground_of(batch.motion)
    nothing = Trace(np.empty((0, STATE)), *np.empty((2, 0), np.int8))

    def run(first: int) -> SolidPart:
        some = slice(first, first + RUNS_PER_TASK)
        members, stands = batch.members[some], batch.stands[some]
        found = np.empty((members.size, len(Found._fields)))
        move_solid(shapes, rooms.copy(), ground, stands, False, nothing, found)
        return part_of(members, stands, found)

    return (partial(run, first) for first in range(0, batch.members.size, RUNS_PER_TASK))


def warn_of_solids(endings: Counter[float]) -> None:
    """Log the runs that did not end regularly."""
    from shaketable.solids.run import SENTENCES

    total = sum(endings.values())
    for ending, sentence in SENTENCES.items():
        if endings[ending]:
            log.warning("%d of %d simulations %s", endings[ending], total, sentence)


def warn_of_components(motions: Iterable[Motion]) -> None:
    """Log how many motions lack their second horizontal component."""
    alone = [not head.has_transverse for head in heads_of(motions)]
    if any(alone):
        log.warning("%d of %d motions have one horizontal component alone", sum(alone), len(alone))


def require_stands(solids: Iterable[Solid], stands: Iterable[NDArray[np.float64]]) -> None:
    """InputError naming each solid that falls by itself in one of its stands.

    Args:
        solids: each solid once.
        stands: of each solid, as `stands_of` gives them.
    """
    faults = []
    for index, (solid, each) in enumerate(zip(solids, stands, strict=True)):
        for tilt, azimuth, orientation in np.unique(each[:, :3], axis=0).tolist():
            limit = standing_limit(solid, azimuth - orientation)
            if tilt >= limit:
                faults.append(
                    f"body {solid.name or index}: falls by itself on a support tilted by "
                    f"{degrees(tilt):.4g}° toward {degrees(azimuth):.4g}°, turned by "
                    f"{degrees(orientation):.4g}°; it stands below {degrees(limit):.4g}°"
                )
    if faults:
        raise InputError(joined(faults))
