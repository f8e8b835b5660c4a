"""Ways out of a room: whether somebody as wide as a way can walk from a place to a door.

A disc as wide as the way must pass: its middle stays half that width away from all that stands or
lies there, and from walls. Its middle moves from cell to neighbouring cell. What keeps it away from
several things is all that keeps it away from each of them, which is found once for each.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from shaketable.rooms.grid import Cells, Grid, Some
from shaketable.rooms.room import Room
from shaketable.rooms.shapes import place_of, sweep_of

# m: somebody begins no farther than this from where the disc touches the place: two cells, so that
# nobody begins behind what lies beside it
REACH = 0.10
NEIGHBOURS = np.ones((3, 3))


class Ways:
    """From each bed and desk of a room to each of its exits.

    Attributes:
        names: of the places from which a way begins.
        exits: numbers of the doors that are ways out.
    """

    def __init__(self, room: Room, grid: Grid) -> None:
        """Find where ways begin and end, and what walls keep away."""
        places = [place for place in room.places if place.kind.stands]
        self.names = tuple(place.name for place in places)
        self.exits = tuple(k for k, door in enumerate(room.doors) if door.exit)
        self._grid, half = grid, room.way / 2
        # cells stand for their middles: a gap as wide as the way is one that is not narrower
        self._away = half - grid.cell / 2
        self._doorways = np.zeros(grid.shape, np.bool_)
        for doorway in grid.doorways:
            self._doorways |= doorway
        self._walls = self._near(~(grid.floor | self._doorways))
        far = [
            grid.cell * ndimage.distance_transform_edt(~grid.cells(grid.covered(place_of(place))))
            for place in places
        ]
        self._starts = [np.flatnonzero(each <= half + REACH) for each in far]
        self._ends = [np.flatnonzero(grid.doorways[k]) for k in self.exits]
        self._swept = [
            grid.covered(sweep_of(room.doors[k], room)) for k in self.exits
        ]  # by the leaf of each

    def kept_away(self, some: Some) -> Some:
        """The cells where the disc's middle cannot be because of what covers some cells.

        In a doorway, and behind it, nothing keeps it away.
        """
        some = some[~self._doorways.flat[some]]
        if not some.size:
            return some
        columns = self._grid.shape[1]
        y, x = np.divmod(some, columns)
        pad = math.ceil(self._away / self._grid.cell) + 1
        top, left = max(int(y.min()) - pad, 0), max(int(x.min()) - pad, 0)
        window = np.zeros((int(y.max()) + pad + 1 - top, int(x.max()) + pad + 1 - left), np.bool_)
        window = window[: self._grid.shape[0] - top, : columns - left]
        window[y - top, x - left] = True
        rows, across = np.nonzero(self._near(window))
        return np.asarray((rows + top) * columns + across + left, np.intp)

    def open(self, occupied: Cells, kept_away: Cells) -> NDArray[np.bool_]:
        """Whether each way is open, (place, exit).

        Args:
            occupied: cells on which something stands or lies.
            kept_away: the union of what `kept_away` gives for these.
        """
        regions, _ = ndimage.label(~(self._walls | kept_away), structure=NEIGHBOURS)
        near = [set(np.unique(regions.flat[start]).tolist()) - {0} for start in self._starts]
        found = np.zeros((len(self._starts), len(self.exits)), np.bool_)
        for column, (end, swept) in enumerate(zip(self._ends, self._swept, strict=True)):
            if occupied.flat[swept].any():
                continue  # the door's leaf meets what lies there
            behind = set(np.unique(regions.flat[end]).tolist()) - {0}
            found[:, column] = [bool(behind & each) for each in near]
        return found

    def _near(self, obstacles: Cells) -> Cells:
        """Cells whose middles are too near to those of obstacles."""
        if not obstacles.any():
            return obstacles
        far = self._grid.cell * ndimage.distance_transform_edt(~obstacles)
        return np.asarray(far < self._away)
