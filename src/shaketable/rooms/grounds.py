"""The cells that a thing covers in each run: where it lies, leans, or stands after it has slid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shaketable.rooms.grid import Grid, Some
from shaketable.rooms.room import Room, Thing
from shaketable.rooms.shaken import Fate
from shaketable.rooms.shapes import (
    fallen,
    foot_of,
    footprint,
    leaning,
    outline_of,
    within_walls,
)

STAYS, TURNS = 0.25, 0.01  # of a cell, and rad: what moved by less covers what it did


@dataclass(frozen=True, eq=False)
class Ground:
    """What a thing covers.

    Attributes:
        rest: cells on which it stands before it is shaken.
        after: cells that it covers at the end of each run, those of contents that scatter included.
        fell: whether it lies there.
    """

    rest: Some
    after: tuple[Some, ...]
    fell: np.ndarray


def ground_of(room: Room, grid: Grid, thing: Thing, fate: Fate) -> Ground:
    """The cells that a thing covers in each run."""
    outline, foot = outline_of(room), foot_of(thing, room)
    rest = grid.covered(footprint(thing, room).intersection(outline))
    after = []
    for k in range(fate.fell.size):
        shift, yaw = fate.shift[k], float(fate.yaw[k])
        if fate.fell[k]:
            ground = fallen(thing, room, float(fate.toward[k]), shift, yaw)
            within = within_walls(ground, outline, foot + shift)
            if room.scatter:
                within = within.buffer(room.scatter).intersection(outline)
            after.append(grid.covered(within))
        elif fate.held_up[k]:
            after.append(grid.covered(leaning(thing, room, shift, yaw).intersection(outline)))
        elif np.abs(shift).max() < STAYS * grid.cell and abs(yaw) < TURNS:
            after.append(rest)
        else:
            after.append(grid.covered(footprint(thing, room, shift, yaw).intersection(outline)))
    return Ground(rest, tuple(after), fate.fell)
