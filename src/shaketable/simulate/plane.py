"""Planar bodies of an ensemble: rows of the engine's tables under each motion."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.models import Model, Table
from shaketable.models.engine_input import refined, substeps
from shaketable.models.model import ManyRuns
from shaketable.motion import Motion
from shaketable.outcome import downhill_sign
from shaketable.simulate.around import with_held
from shaketable.simulate.result_fields import Part

BODIES_PER_TASK = 512


class Rows(NamedTuple):
    """Bodies on their supports, each under its polarity; one entry per row."""

    table: Table
    polarity: NDArray[np.float64]
    downhill: NDArray[np.int8]  # +1 where -x is downhill, -1 where +x is
    member: NDArray[np.intp]  # the number of its simulation in the first group

    def take(self, rows: NDArray[np.intp]) -> Rows:
        return Rows(
            self.table.take(rows), self.polarity[rows], self.downhill[rows], self.member[rows]
        )


class Group(NamedTuple):
    """Rows that meet the same motion; `first` is added to the numbers of their simulations."""

    motion: Motion
    scale: float
    rows: NDArray[np.intp]
    first: int


def downhill_of(tilts: NDArray[np.float64]) -> NDArray[np.int8]:
    """`Rows.downhill` for tilts [rad]."""
    return np.array([downhill_sign(tilt) for tilt in tilts], np.int8)


def tasks_of(model: Model, rows: Rows, groups: Iterable[Group]) -> Iterator[Callable[[], Part]]:
    """What is to be done on a processor, the longest work first.

    Args:
        model: the contact model.
        rows: those that the groups take.
        groups: at least one.
    """
    work = []
    for group in groups:
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
    return (task for _, task in work)


def _simulate(model: Model, rows: Rows, group: Group, cuts: int) -> Part:
    """Simulate a group with every step of the motion cut into so many."""
    some = rows.take(group.rows)
    runs = model.run_many(
        some.table, some.polarity, refined(group.motion.scaled(group.scale), cuts)
    )
    part = part_of(group.first + some.member, runs, some.downhill)
    return part if runs.held is None else with_held(part, runs.held)


def part_of(members: NDArray[np.intp], runs: ManyRuns, downhill: NDArray[np.int8]) -> Part:
    """The results of members by their names."""
    toward_left, toward_right = np.abs(runs.farthest_left), runs.farthest_right
    return Part(
        members,
        {
            "outcome": runs.direction * downhill,
            "overturning_time": runs.overturning_time,
            "peak_rotation": runs.peak,
            "impacts": runs.impacts,
            "ending": runs.ending,
            "displacement_x": runs.slip,
            "slip_downhill": np.where(downhill > 0, toward_left, toward_right),
            "slip_uphill": np.where(downhill > 0, toward_right, toward_left),
            "max_lift": runs.lift,
        },
    )
