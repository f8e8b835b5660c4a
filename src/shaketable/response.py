"""What a simulation returns."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.motion import Motion
from shaketable.support import Support

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Outcome(IntEnum):
    """How a body ends; on a level support UPHILL and DOWNHILL mean +x and -x."""

    STANDING = 0
    DOWNHILL = -1
    UPHILL = 1


@dataclass(frozen=True, kw_only=True, eq=False)
class Response:
    """One body under one motion.

    Histories stand at the motion's samples. They go on after its end, under gravity alone and at
    steps of their own (see `time`), until the body rests; they stop before it has overturned.

    Attributes:
        outcome: standing, or the direction of overturning.
        overturning_time: when |θ| reached π/2 [s], NaN if it did not.
        peak_rotation: largest |θ| [rad], π/2 if it overturned; found between samples too.
        impacts: number of impacts, up to the certified end of a bounce sequence.
        impact_times: [s], shape (impacts,).
        time: [s], shape (n,).
        rotation: θ relative to the support [rad], positive toward +x, shape (n,).
        angular_velocity: [rad/s], shape (n,).
        body, motion, support: what was simulated.
    """

    outcome: Outcome
    overturning_time: float
    peak_rotation: float
    impacts: int
    impact_times: NDArray[np.float64] = field(repr=False)
    time: NDArray[np.float64] = field(repr=False)
    rotation: NDArray[np.float64] = field(repr=False)
    angular_velocity: NDArray[np.float64] = field(repr=False)
    body: Body
    motion: Motion = field(repr=False)
    support: Support

    @property
    def position(self) -> NDArray[np.float64]:
        """Centre of gravity along and normal to the support [m], shape (n, 2).

        Measured from the foot of the centre of gravity at rest (physics.md section 3's corner
        offsets with the pivot held in place).
        """
        theta = self.rotation
        pivot = np.where(theta >= 0.0, self.body.right, -self.body.left)
        h = self.body.cg_height
        along = pivot - (pivot * np.cos(theta) - h * np.sin(theta))
        normal = pivot * np.sin(theta) + h * np.cos(theta)
        return np.column_stack([along, normal])

    def plot(self, ax: tuple[Axes, Axes] | None = None) -> tuple[Axes, Axes]:
        """Rotation over time above the motion; returns both axes."""
        from shaketable.plot import plot_response

        return plot_response(self, ax)

    def animate(self, path: str | Path) -> Path:
        """Write the body on its support as a GIF or an MP4, by the path's ending."""
        from shaketable.plot import animate_response

        return animate_response(self, Path(path))
