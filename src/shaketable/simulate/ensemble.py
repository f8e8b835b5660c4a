"""An ensemble of simulations on all cores, for full products and for members side by side."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.endings import SENTENCES
from shaketable.errors import require_whole
from shaketable.models import Model, Table
from shaketable.models.engine_input import refined, substeps
from shaketable.motion import Motion
from shaketable.outcome import downhill_sign
from shaketable.progress import Progress, meter
from shaketable.simulate.members import Members

log = logging.getLogger(__name__)

BODIES_PER_TASK = 512


class Rows(NamedTuple):
    """Bodies on their supports, each under its polarity; one entry per row."""

    table: Table
    polarity: NDArray[np.float64]
    downhill: NDArray[np.int8]  # +1 where -x is downhill, -1 where +x is

    def take(self, rows: NDArray[np.intp]) -> Rows:
        return Rows(self.table.take(rows), self.polarity[rows], self.downhill[rows])


class Group(NamedTuple):
    """Rows that meet the same motion, and the members they belong to."""

    motion: Motion
    scale: float
    rows: NDArray[np.intp]
    members: NDArray[np.intp]


def downhill_of(tilts: NDArray[np.float64]) -> NDArray[np.int8]:
    """`Rows.downhill` for tilts [rad]."""
    return np.array([downhill_sign(tilt) for tilt in tilts], np.int8)


def run_groups(
    model: Model,
    rows: Rows,
    groups: Iterable[Group],
    members: Members,
    threads: int | None,
    progress: Progress,
) -> None:
    """Simulate all groups, the longest work first, and log the runs that did not end regularly."""
    from shaketable.engine import pool

    if threads is not None:
        require_whole("threads", threads)
    work = []
    for group in groups:
        loud = group.motion.scaled(group.scale)
        parts = substeps(rows.table.blocks[group.rows], loud)
        energy = float(np.square(loud.horizontal).sum())
        for part in np.unique(parts):
            alike = np.flatnonzero(parts == part)
            for chunk in np.split(alike, range(BODIES_PER_TASK, alike.size, BODIES_PER_TASK)):
                # scaled only when simulated: a thousand scaled motions need not be kept in memory
                piece = group._replace(rows=group.rows[chunk], members=group.members[chunk])
                task = partial(_simulate, model, rows, piece, int(part), members)
                work.append((energy * part * chunk.size, task))
    work.sort(key=lambda each: -each[0])
    with meter("simulations", members.outcome.size, progress) as done:
        pool.run_all([task for _, task in work], threads, done)
    for ending, sentence in SENTENCES.items():
        count = int((members.ending == ending).sum())
        if count:
            log.warning("%d of %d simulations %s", count, members.ending.size, sentence)


def _simulate(model: Model, rows: Rows, group: Group, parts: int, members: Members) -> int:
    """Simulate a group whose steps are cut alike; return the number of simulations."""
    some = rows.take(group.rows)
    runs = model.run_many(
        some.table, some.polarity, refined(group.motion.scaled(group.scale), parts)
    )
    members.write(group.members, runs, some.downhill)
    return group.members.size
