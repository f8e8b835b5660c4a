"""Solids of an ensemble on a GPU: as many simulations at a time as keep it busy."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial

import numpy as np

from shaketable.engine.cuda_solids import run_solids_on_gpu
from shaketable.models import General
from shaketable.simulate.result_fields import Part
from shaketable.simulate.space import SolidBatch, part_of
from shaketable.simulate.space_input import ground_of, shapes_of

#: Simulations of a launch: more than a device runs at once, and few enough to tell progress. Only
#: those that run at once have their workspaces, of 15 kB each.
AT_ONCE = 2**16
SAMPLES = 2**25  # of the motions of a launch: 800 MB


def launches_of(model: General, batches: Iterable[SolidBatch]) -> Iterator[Callable[[], Part]]:
    """What is to be done on a GPU; arguments as for `space.tasks_of`."""
    # those of one motion side by side, so that the threads of a warp read the same samples
    ordered = sorted(batches, key=lambda batch: (-batch.motion.duration, batch.motion_number))
    return (partial(_launch, some, model) for some in _launches(ordered))


def _launches(batches: Iterable[SolidBatch]) -> Iterator[list[SolidBatch]]:
    """Batches, or parts of them, for each launch: as many as its memory takes."""
    some: list[SolidBatch] = []
    work, samples = AT_ONCE, SAMPLES
    for batch in batches:
        rest, length = batch, batch.motion.horizontal.size
        while rest.members.size:
            more = 0 if some and some[-1].motion_number == batch.motion_number else length
            if some and (work == 0 or samples < more):
                yield some
                some, work, samples, more = [], AT_ONCE, SAMPLES, length
            now, rest = rest.split(work)
            some.append(now)
            work, samples = work - now.members.size, samples - more
    if some:
        yield some


def _launch(batches: list[SolidBatch], model: General) -> Part:
    solids = {batch.solid_number: batch.solid for batch in batches}
    motions = {batch.motion_number: batch.motion for batch in batches}
    of_solid, of_motion = ({key: k for k, key in enumerate(each)} for each in (solids, motions))
    sizes = [batch.members.size for batch in batches]
    stands = np.concatenate([batch.stands for batch in batches])
    found = run_solids_on_gpu(
        [shapes_of(solid, model) for solid in solids.values()],
        [ground_of(motion) for motion in motions.values()],
        np.repeat([of_solid[batch.solid_number] for batch in batches], sizes),
        np.repeat([of_motion[batch.motion_number] for batch in batches], sizes),
        stands,
    )
    return part_of(np.concatenate([batch.members for batch in batches]), stands, found)
