"""An ensemble of simulations on a GPU: as many members at a time as keep it busy.

A warp of 32 threads takes as long as the longest of its members. Members of one motion therefore
lie side by side in the order of the acceleration at which they can tip, so that those that rest
are together, and those that rock (`python -m benchmarks.gpu_counts` tells what it is worth).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.cuda import run_on_gpu
from shaketable.engine.endings import counts_of
from shaketable.engine.tables import tabulate_demands
from shaketable.models import Model
from shaketable.models.batch import runs_of
from shaketable.models.engine_input import refined, substeps
from shaketable.progress import Progress, meter
from shaketable.simulate.ensemble import Group, Part, Rows

AT_ONCE = 2**21  # members of a launch: some 250 MB with their results
SAMPLES = 2**25  # of the motions of a launch: 512 MB with the vertical ones


class Piece(NamedTuple):
    """Members that meet the same motion, whose steps are cut into so many."""

    group: Group
    rows: NDArray[np.intp]
    cut: int


def run_groups_on_gpu(
    model: Model,
    rows: Rows,
    groups: Iterable[Group],
    keep: Callable[[Part], None],
    progress: Progress,
) -> Counter[float]:
    """What `run_groups` does, on a GPU.

    Raises:
        InputError: there is none.
    """
    groups = list(groups)
    endings: Counter[float] = Counter()
    with meter("simulations", sum(group.rows.size for group in groups), progress) as done:
        for pieces in _launches(rows, groups):
            part = _launch(model, rows, pieces)
            keep(part)
            endings.update(counts_of(part.runs.ending))
            done(part.members.size)
    return endings


def _pieces(rows: Rows, groups: Iterable[Group]) -> Iterator[Piece]:
    """The members of each motion in turn, the liveliest first."""
    demands = tabulate_demands(rows.table.blocks)
    for group in groups:
        cuts = substeps(rows.table.blocks[group.rows], group.motion.scaled(group.scale))
        order = np.argsort(demands[group.rows], kind="stable")
        for cut in np.unique(cuts):
            alike = order[cuts[order] == cut]
            for first in range(0, alike.size, AT_ONCE):
                yield Piece(group, alike[first : first + AT_ONCE], int(cut))


def _launches(rows: Rows, groups: Iterable[Group]) -> Iterator[list[Piece]]:
    """Pieces for each launch, as many as its memory takes, and at least one."""
    pieces: list[Piece] = []
    members = samples = 0
    for piece in _pieces(rows, groups):
        length = piece.group.motion.horizontal.size * piece.cut
        if pieces and (members + piece.rows.size > AT_ONCE or samples + length > SAMPLES):
            yield pieces
            pieces, members, samples = [], 0, 0
        pieces.append(piece)
        members, samples = members + piece.rows.size, samples + length
    if pieces:
        yield pieces


def _launch(model: Model, rows: Rows, pieces: list[Piece]) -> Part:
    shakings = [
        refined(piece.group.motion.scaled(piece.group.scale), piece.cut) for piece in pieces
    ]
    row = np.concatenate([piece.group.rows[piece.rows] for piece in pieces])
    members = np.concatenate([piece.group.first + piece.group.rows[piece.rows] for piece in pieces])
    motion = np.repeat(np.arange(len(pieces)), [piece.rows.size for piece in pieces])
    polarity = rows.polarity[row]
    results = run_on_gpu(model.gpu_kernel, shakings, rows.table, row, motion, polarity)
    return Part(members, runs_of(results), rows.downhill[row])
