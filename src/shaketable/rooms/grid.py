"""The cells of a plan, and which of them something covers."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from shaketable.errors import InputError
from shaketable.language import tell
from shaketable.rooms.room import Room
from shaketable.rooms.shapes import DOORSTEP, opening_of, outline_of

CELL = 0.05  # m
MOST_CELLS = 16_000_000  # of 5 cm: 200 m × 200 m
Cells = NDArray[np.bool_]  # (y, x)
Some = NDArray[np.intp]  # numbers of cells, row after row


@dataclass(frozen=True, eq=False)
class Grid:
    """Square cells over a room and what is right behind its doors.

    Attributes:
        x, y: middles of the columns and rows [m].
        cell: side of a cell [m].
        floor: whether the middle of a cell is on the room's floor.
        doorways: the same of the opening of each door and what is right behind it.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    cell: float
    floor: Cells
    doorways: tuple[Cells, ...]

    @classmethod
    def of(cls, room: Room, cell: float = CELL) -> Grid:
        """The cells of a room.

        Raises:
            InputError: more than MOST_CELLS in the rectangle around it.
        """
        low = np.min(room.outline, axis=0) - DOORSTEP - cell
        high = np.max(room.outline, axis=0) + DOORSTEP + cell
        counts = [math.ceil((b - a) / cell) for a, b in zip(low, high, strict=True)]
        if math.prod(counts) > MOST_CELLS:
            width, depth = np.ptp(np.array(room.outline), axis=0)
            raise InputError(
                tell(
                    "the plan spans {width:.0f} m × {depth:.0f} m, which is {count:,} cells of "
                    "{cell:g} m; at most {most:,} are taken: give its parts as rooms of their own, "
                    "or the outline in metres",
                    width=width,
                    depth=depth,
                    count=math.prod(counts),
                    cell=cell,
                    most=MOST_CELLS,
                )
            )
        x, y = (a + cell * (np.arange(n) + 0.5) for a, n in zip(low, counts, strict=True))
        return cls(
            x,
            y,
            cell,
            _within(outline_of(room), x, y),
            tuple(_within(opening_of(door, room), x, y) for door in room.doors),
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return (self.y.size, self.x.size)

    @property
    def area(self) -> float:
        """Of a cell [m²]."""
        return self.cell**2

    def covered(self, ground: BaseGeometry) -> Some:
        """The cells whose middles something covers."""
        if ground.is_empty:
            return np.empty(0, np.intp)
        left, low, right, high = ground.bounds
        first, last = np.searchsorted(self.x, [left, right])
        bottom, top = np.searchsorted(self.y, [low, high])
        found = _within(ground, self.x[first:last], self.y[bottom:top])
        rows, columns = np.nonzero(found)
        return np.asarray((rows + bottom) * self.x.size + columns + first, np.intp)

    def cells(self, some: Some) -> Cells:
        """Whether each cell is among some."""
        found = np.zeros(self.y.size * self.x.size, np.bool_)
        found[some] = True
        return found.reshape(self.shape)


def _within(ground: BaseGeometry, x: NDArray[np.float64], y: NDArray[np.float64]) -> Cells:
    """Whether points are inside something, (y, x)."""
    return np.asarray(shapely.contains_xy(ground, *np.meshgrid(x, y)), np.bool_)
