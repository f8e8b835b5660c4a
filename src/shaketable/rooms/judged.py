"""What happens in a room in each run: who is hit, what is blocked, and by what.

Things do not touch each other, so that the grounds of some may be exchanged for those of others
under the same motions, such as those of a thing that is strapped.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.rooms.grid import Cells, Grid
from shaketable.rooms.grounds import Ground
from shaketable.rooms.room import Room
from shaketable.rooms.shapes import place_of
from shaketable.rooms.ways import Goals, ways_open

Runs = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Judged:
    """What happens in each run.

    Attributes:
        hit: whether something lies on a place, (place, thing, run).
        closed: whether a way is closed, (place, exit, run), of the places of Goals.
        by: whether a thing alone closes it: without it the way would be open,
            (place, exit, thing, run).
    """

    hit: Runs
    closed: Runs
    by: Runs


class Judge:
    """Judges runs of one room; what was judged before is remembered."""

    def __init__(self, room: Room, grid: Grid, still: Sequence[Ground] = ()) -> None:
        """Prepare.

        Args:
            room: to be judged.
            grid: its cells.
            still: grounds of what is not shaken: it stands where it is.
        """
        self.room, self.grid, self.goals = room, grid, Goals.of(room, grid)
        self._places = [grid.cells(grid.covered(place_of(place))).ravel() for place in room.places]
        self._stands = np.zeros(grid.shape, np.bool_)
        for place, cells in zip(room.places, self._places, strict=True):
            if place.kind.stands:
                self._stands |= cells.reshape(grid.shape)
        for each in still:
            self._stands.flat[each.rest] = True
        self._known: dict[bytes, NDArray[np.bool_]] = {}

    def judged(self, grounds: Sequence[Ground], *, blame: bool = True) -> Judged:
        """What happens in each run.

        Args:
            grounds: one of each thing that is shaken.
            blame: whether to find what closes each way, which takes most of the time.
        """
        things, runs = len(grounds), grounds[0].fell.size if grounds else 0
        hit = np.zeros((len(self._places), things, runs), np.bool_)
        shape = (len(self.goals.starts), len(self.goals.exits))
        closed = np.zeros((*shape, runs), np.bool_)
        by = np.zeros((*shape, things, runs), np.bool_)
        for run in range(runs):
            for row, cells in enumerate(self._places):
                for k, ground in enumerate(grounds):
                    hit[row, k, run] = ground.fell[run] and cells[ground.after[run]].any()
            closed[..., run] = ~self._open(grounds, run)
            if not (blame and closed[..., run].any()):
                continue
            for k, ground in enumerate(grounds):
                if ground.after[run] is not ground.rest:
                    others = [*grounds[:k], *grounds[k + 1 :]]
                    by[..., k, run] = closed[..., run] & self._open(others, run)
        return Judged(hit, closed, by)

    def open_at_rest(self, grounds: Sequence[Ground]) -> NDArray[np.bool_]:
        """Whether each way is open before anything is shaken, (place, exit)."""
        return self._ways([ground.rest for ground in grounds])

    def _open(self, grounds: Sequence[Ground], run: int) -> NDArray[np.bool_]:
        return self._ways([ground.after[run] for ground in grounds])

    def _ways(self, covered: Sequence[NDArray[np.intp]]) -> NDArray[np.bool_]:
        occupied: Cells = self._stands.copy()
        for some in covered:
            occupied.flat[some] = True
        key = np.packbits(occupied).tobytes()
        if key not in self._known:
            self._known[key] = ways_open(self.grid, self.goals, occupied, self.room.way)
        return self._known[key]
