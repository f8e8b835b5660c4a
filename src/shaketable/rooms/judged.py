"""What happens in a room in each run: who is hit, what is blocked, and by what.

Things do not touch each other, so that the grounds of some may be exchanged for those of others
under the same motions, such as those of a thing that is strapped.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from hashlib import blake2b

import numpy as np
from numpy.typing import NDArray

from shaketable.rooms.grid import Grid, Some
from shaketable.rooms.grounds import Ground
from shaketable.rooms.room import Room
from shaketable.rooms.shapes import place_of
from shaketable.rooms.ways import Ways

Runs = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Judged:
    """What happens in each run.

    Attributes:
        hit: whether something lies on a place, (place, thing, run).
        closed: whether a way is closed, (place, exit, run), of the places of Ways.
        by: whether a thing alone closes it: without it the way would be open,
            (place, exit, thing, run).
    """

    hit: Runs
    closed: Runs
    by: Runs


class Judge:
    """Judges runs of one room; what was judged before is remembered."""

    def __init__(
        self,
        room: Room,
        grid: Grid,
        still: Sequence[Ground] = (),
        each: Callable[[], None] = lambda: None,
    ) -> None:
        """Prepare.

        Args:
            room: to be judged.
            grid: its cells.
            still: grounds of what is not shaken: it stands where it is.
            each: is called before each run is judged.
        """
        self._each = each
        self.room, self.grid, self.ways = room, grid, Ways(room, grid)
        self._places = [grid.cells(grid.covered(place_of(place))).ravel() for place in room.places]
        self._still = [
            np.flatnonzero(cells)
            for place, cells in zip(room.places, self._places, strict=True)
            if place.kind.stands
        ] + [each.rest for each in still]
        self._away: dict[int, tuple[Some, Some]] = {}  # by the identity of the cells, which stay
        self._stands, self._stands_away = self._union(self._still)
        self._hit: dict[int, tuple[Ground, Runs]] = {}
        self._known: dict[bytes, NDArray[np.bool_]] = {}

    def judged(self, grounds: Sequence[Ground], *, blame: bool = True) -> Judged:
        """What happens in each run.

        Args:
            grounds: one of each thing that is shaken.
            blame: whether to find what closes each way, which takes most of the time.
        """
        things, runs = len(grounds), grounds[0].fell.size if grounds else 0
        shape = (len(self.ways.names), len(self.ways.exits))
        closed = np.zeros((*shape, runs), np.bool_)
        by = np.zeros((*shape, things, runs), np.bool_)
        hit = np.zeros((len(self._places), things, runs), np.bool_)
        for k, ground in enumerate(grounds):
            hit[:, k] = self._hits(ground)
        for run in range(runs):
            self._each()
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

    def forget(self, ground: Ground) -> None:
        """Free what was remembered of a ground's cells; what it does to people stays known."""
        for some in ground.after:
            self._away.pop(id(some), None)

    def _hits(self, ground: Ground) -> Runs:
        """On which places a thing lies, (place, run)."""
        if id(ground) not in self._hit:
            found = np.zeros((len(self._places), ground.fell.size), np.bool_)
            for run in np.flatnonzero(ground.fell):
                for row, cells in enumerate(self._places):
                    found[row, run] = cells[ground.after[run]].any()
            self._hit[id(ground)] = (ground, found)
        return self._hit[id(ground)][1]

    def _open(self, grounds: Sequence[Ground], run: int) -> NDArray[np.bool_]:
        return self._ways([ground.after[run] for ground in grounds])

    def _ways(self, covered: Sequence[Some]) -> NDArray[np.bool_]:
        occupied, away = self._union(covered)
        occupied |= self._stands
        key = blake2b(np.packbits(occupied).tobytes(), digest_size=16).digest()
        if key not in self._known:
            self._known[key] = self.ways.open(occupied, away | self._stands_away)
        return self._known[key]

    def _union(self, covered: Sequence[Some]) -> tuple[Runs, Runs]:
        """The cells that some cover, and those where what is there keeps people away."""
        occupied, away = (np.zeros(self.grid.shape, np.bool_) for _ in range(2))
        for some in covered:
            if id(some) not in self._away:
                self._away[id(some)] = (some, self.ways.kept_away(some))
            occupied.flat[some] = True
            away.flat[self._away[id(some)][1]] = True
        return occupied, away
