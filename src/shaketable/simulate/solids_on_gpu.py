"""An ensemble of solids on a GPU: as many simulations at a time as keep it busy."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from shaketable.engine.cuda_solids import run_solids_on_gpu
from shaketable.engine.endings import counts_of
from shaketable.models import General
from shaketable.progress import Progress, meter
from shaketable.simulate.solid_batches import Batch, SolidPart, part_of
from shaketable.simulate.solid_input import ground_of, shapes_of

#: Simulations of a launch: more than a device runs at once, and few enough to tell progress. Only
#: those that run at once have their room, of 15 kB each.
AT_ONCE = 2**16
SAMPLES = 2**25  # of the motions of a launch: 800 MB


def run_batches_on_gpu(
    batches: Iterable[Batch],
    model: General,
    keep: Callable[[SolidPart], None],
    progress: Progress,
) -> Counter[float]:
    """What `run_batches` does, on a GPU.

    Raises:
        InputError: there is none.
    """
    # those of one motion side by side, so that the threads of a warp read the same samples
    ordered = sorted(batches, key=lambda batch: (-batch.motion.duration, id(batch.motion)))
    endings: Counter[float] = Counter()
    with meter("simulations", sum(batch.members.size for batch in ordered), progress) as done:
        for some in _launches(ordered):
            part = _launch(some, model)
            keep(part)
            endings.update(counts_of(part.column("ending")))
            done(part.members.size)
    return endings


def _launches(batches: Iterable[Batch]) -> Iterator[list[Batch]]:
    """Batches, or parts of them, for each launch: as many as its memory takes."""
    some: list[Batch] = []
    room, samples = AT_ONCE, SAMPLES
    for batch in batches:
        rest, length = batch, batch.motion.horizontal.size
        while rest.members.size:
            more = 0 if some and some[-1].motion is batch.motion else length
            if some and (room == 0 or samples < more):
                yield some
                some, room, samples, more = [], AT_ONCE, SAMPLES, length
            now, rest = rest.split(room)
            some.append(now)
            room, samples = room - now.members.size, samples - more
    if some:
        yield some


def _launch(batches: list[Batch], model: General) -> SolidPart:
    solids = {id(batch.solid): batch.solid for batch in batches}
    motions = {id(batch.motion): batch.motion for batch in batches}
    numbers = [{key: number for number, key in enumerate(each)} for each in (solids, motions)]
    sizes = [batch.members.size for batch in batches]
    stands = np.concatenate([batch.stands for batch in batches])
    found = run_solids_on_gpu(
        [shapes_of(solid, model) for solid in solids.values()],
        [ground_of(motion) for motion in motions.values()],
        np.repeat([numbers[0][id(batch.solid)] for batch in batches], sizes),
        np.repeat([numbers[1][id(batch.motion)] for batch in batches], sizes),
        stands,
    )
    return part_of(np.concatenate([batch.members for batch in batches]), stands, found)
