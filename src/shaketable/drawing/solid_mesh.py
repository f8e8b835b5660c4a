"""A solid as polygons, for films and files of three dimensions."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

ROUND = 48  # corners of a circle
LEGS = 0.08  # of the height of a body on feet: how high its case stands
LEG_WIDTH = 0.04  # of its largest size


class ShownSolid(Protocol):
    """What is asked of a `Solid`."""

    @property
    def name(self) -> str: ...
    @property
    def cg_height(self) -> float: ...
    @property
    def height(self) -> float | None: ...
    @property
    def diameter(self) -> float | None: ...
    @property
    def feet(self) -> bool: ...
    @property
    def contacts(self) -> NDArray[np.float64]: ...
    @property
    def corners(self) -> NDArray[np.float64]: ...


class Prism(NamedTuple):
    """A convex part of a body: its base, counterclockwise, and how far it reaches along z.

    Attributes:
        outline: (m, 2) [m], in the body's frame.
        low, high: z in the body's frame [m].
        is_round: whether the outline stands for a circle.
    """

    outline: NDArray[np.float64]
    low: float
    high: float
    is_round: bool = False

    @property
    def vertices(self) -> NDArray[np.float64]:
        """The corners of the base, then those of the top, (2 m, 3) [m]."""
        m = len(self.outline)
        z = np.repeat([self.low, self.high], m)
        return np.column_stack([np.tile(self.outline, (2, 1)), z])

    @property
    def faces(self) -> list[list[int]]:
        """Indices of the vertices of each face, counterclockwise seen from outside."""
        m = len(self.outline)
        sides = [[k, (k + 1) % m, m + (k + 1) % m, m + k] for k in range(m)]
        return [list(range(m))[::-1], list(range(m, 2 * m)), *sides]


def prisms_of(solid: ShownSolid) -> list[Prism]:
    """The parts that a solid is drawn with; a body on feet has a leg on each."""
    low, top = -solid.cg_height, (solid.height or 0.0) - solid.cg_height
    if solid.diameter is not None:
        angles = 2 * np.pi * np.arange(ROUND) / ROUND
        circle = solid.diameter / 2 * np.column_stack([np.cos(angles), np.sin(angles)])
        return [Prism(circle, low, top, is_round=True)]
    if not solid.feet:
        return [Prism(solid.corners, low, top)]
    case = low + LEGS * (top - low)
    half = LEG_WIDTH / 2 * float(np.ptp(solid.contacts, axis=0).max())
    square = half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    legs = [Prism(foot * (1 - LEG_WIDTH) + square, low, case) for foot in solid.contacts]
    return [*legs, Prism(solid.corners, case, top)]
