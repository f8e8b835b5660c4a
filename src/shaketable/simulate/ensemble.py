"""An ensemble of simulations on all cores, for full products and for members side by side."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Callable, Iterable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.endings import SENTENCES, counts_of
from shaketable.errors import require_whole
from shaketable.models import Model, Table
from shaketable.models.engine_input import refined, substeps
from shaketable.models.model import ManyRuns
from shaketable.motion import Motion
from shaketable.outcome import downhill_sign
from shaketable.progress import Progress, meter

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
    """Rows that meet the same motion; row k is member `first` + k of the ensemble."""

    motion: Motion
    scale: float
    rows: NDArray[np.intp]
    first: int


class Part(NamedTuple):
    """Results of some members of an ensemble, one entry for each."""

    members: NDArray[np.intp]
    runs: ManyRuns
    downhill: NDArray[np.int8]  # as in Rows


def downhill_of(tilts: NDArray[np.float64]) -> NDArray[np.int8]:
    """`Rows.downhill` for tilts [rad]."""
    return np.array([downhill_sign(tilt) for tilt in tilts], np.int8)


def run_groups(
    model: Model,
    rows: Rows,
    groups: Iterable[Group],
    keep: Callable[[Part], None],
    threads: int | None,
    progress: Progress,
) -> Counter[float]:
    """Simulate all groups, the longest work first; returns how many runs ended in which way.

    Args:
        model: the contact model.
        rows: those that the groups take.
        groups: at least one.
        keep: takes the results of some members at a time, in any order, in the caller's thread.
        threads, progress: as for `simulate_many`.
    """
    from shaketable.engine import pool

    if threads is not None:
        require_whole("threads", threads)
    work = []
    total = 0
    for group in groups:
        total += group.rows.size
        loud = group.motion.scaled(group.scale)
        cuts = substeps(rows.table.blocks[group.rows], loud)
        energy = float(np.square(loud.horizontal).sum())
        for cut in np.unique(cuts):
            # one array for all groups, where all are cut alike: there may be very many groups
            alike = group.rows if (cuts == cut).all() else group.rows[cuts == cut]
            for start in range(0, alike.size, BODIES_PER_TASK):
                # scaled only when simulated: a thousand scaled motions need not be kept in memory
                piece = group._replace(rows=alike[start : start + BODIES_PER_TASK])
                task = partial(_simulate, model, rows, piece, int(cut))
                work.append((energy * cut * piece.rows.size, task))
    work.sort(key=lambda each: -each[0])
    endings: Counter[float] = Counter()
    with meter("simulations", total, progress) as done:

        def enter(part: Part) -> None:
            keep(part)
            endings.update(counts_of(part.runs.ending))
            done(part.members.size)

        pool.run_all((task for _, task in work), threads, enter)
    return endings


def warn_of(endings: Counter[float]) -> None:
    """Log the runs that did not end regularly."""
    total = sum(endings.values())
    for ending, sentence in SENTENCES.items():
        if endings[ending]:
            log.warning("%d of %d simulations %s", endings[ending], total, sentence)


def _simulate(model: Model, rows: Rows, group: Group, cuts: int) -> Part:
    """Simulate a group with every step of the motion cut into so many."""
    some = rows.take(group.rows)
    runs = model.run_many(
        some.table, some.polarity, refined(group.motion.scaled(group.scale), cuts)
    )
    return Part(group.first + group.rows, runs, some.downhill)
