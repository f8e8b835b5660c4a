"""Planar bodies of an ensemble on a GPU: as many members at a time as keep it busy.

A warp of 32 threads takes as long as the longest of its members. Members of one motion therefore
lie side by side in the order of the acceleration at which they can tip, so that those that rest
are together, and those that rock (`python -m benchmarks.gpu_counts` tells what it is worth).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.body_tables import tabulate_demands
from shaketable.engine.cuda import run_on_gpu
from shaketable.models import Model
from shaketable.models.batch import runs_of
from shaketable.models.engine_input import refined, substeps
from shaketable.simulate.plane import Group, Rows, part_of
from shaketable.simulate.result_fields import Part

AT_ONCE = 2**21  # members of a launch: some 250 MB with their results
SAMPLES = 2**25  # of the motions of a launch: 512 MB with the vertical ones


class Piece(NamedTuple):
    """Members that meet the same motion, whose steps are cut into so many."""

    group: Group
    rows: NDArray[np.intp]
    cut: int


def launches_of(model: Model, rows: Rows, groups: Iterable[Group]) -> Iterator[Callable[[], Part]]:
    """What is to be done on a GPU; arguments as for `plane.tasks_of`."""
    return (partial(_launch, model, rows, pieces) for pieces in _launches(rows, groups))


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
    taken = [piece.group.rows[piece.rows] for piece in pieces]
    row = np.concatenate(taken)
    members = np.concatenate(
        [piece.group.first + rows.member[some] for piece, some in zip(pieces, taken, strict=True)]
    )
    motion = np.repeat(np.arange(len(pieces)), [piece.rows.size for piece in pieces])
    table, polarity = rows.table, rows.polarity[row]
    alone = table.blocks, table.bodies, table.corners  # nothing surrounds a body on a GPU
    results = run_on_gpu(model.gpu_kernel, shakings, alone, row, motion, polarity)
    return part_of(members, runs_of(results), rows.downhill[row])
