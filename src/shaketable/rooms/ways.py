"""Ways out of a room: whether somebody as wide as a way can walk from a place to a door.

A disc as wide as the way must pass: its middle stays half that width away from all that stands or
lies there, and from walls. Its middle moves from cell to neighbouring cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from shaketable.rooms.grid import Cells, Grid
from shaketable.rooms.room import Room
from shaketable.rooms.shapes import place_of, sweep_of

# m: somebody begins no farther than this from where the disc touches the place: two cells, so that
# nobody begins behind what lies beside it
REACH = 0.10


class Goals(NamedTuple):
    """From where to where people walk.

    Attributes:
        starts: of each place from which a way begins, how far each cell is from it [m].
        names: of these places.
        exits: numbers of the doors that are ways out.
        swept: the cells that the leaf of each of these sweeps.
    """

    starts: Sequence[NDArray[np.float64]]
    names: tuple[str, ...]
    exits: tuple[int, ...]
    swept: Sequence[Cells]

    @classmethod
    def of(cls, room: Room, grid: Grid) -> Goals:
        """From each bed and desk of a room to each of its exits."""
        places = [place for place in room.places if place.kind.stands]
        far = [
            grid.cell * ndimage.distance_transform_edt(~grid.cells(grid.covered(place_of(place))))
            for place in places
        ]
        exits = tuple(k for k, door in enumerate(room.doors) if door.exit)
        swept = [grid.cells(grid.covered(sweep_of(room.doors[k], room))) for k in exits]
        return cls(far, tuple(place.name for place in places), exits, swept)


def ways_open(grid: Grid, goals: Goals, occupied: Cells, width: float) -> NDArray[np.bool_]:
    """Whether each way is open, (place, exit).

    Args:
        grid: of the room.
        goals: from where to where.
        occupied: cells of the floor on which something stands or lies.
        width: of the way [m].
    """
    clear = grid.floor & ~occupied
    for doorway in grid.doorways:
        clear |= doorway
    half = width / 2
    # cells stand for their middles: a gap as wide as the way is one that is not narrower
    passes = grid.cell * ndimage.distance_transform_edt(clear) >= half - grid.cell / 2
    regions, _ = ndimage.label(passes, structure=np.ones((3, 3)))
    found = np.zeros((len(goals.starts), len(goals.exits)), np.bool_)
    for column, (door, swept) in enumerate(zip(goals.exits, goals.swept, strict=True)):
        if (swept & occupied).any():
            continue  # its leaf meets what lies there
        behind = set(np.unique(regions[grid.doorways[door]]).tolist()) - {0}
        for row, far in enumerate(goals.starts):
            near = set(np.unique(regions[far <= half + REACH]).tolist()) - {0}
            found[row, column] = bool(behind & near)
    return found
