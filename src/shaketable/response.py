"""What a simulation returns."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.kernels.phases import Phase
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
        position: centre of gravity along and normal to the support [m], from the foot of the
            centre of gravity at rest, shape (n, 2).
        velocity: its rate [m/s], shape (n, 2).
        slip: how far the lowest corner has moved along the support [m], + uphill, shape (n,);
            zero in the rocking model.
        peak_slip: largest |slip| while a corner is on the support [m].
        max_lift: largest clearance under the whole base [m]; zero if it never jumps.
        phase_times: when each phase begins [s], shape (k,); to the sample in the rocking model.
        phases: what they are, k of them.
        model: "rocking" or "general".
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
    position: NDArray[np.float64] = field(repr=False)
    velocity: NDArray[np.float64] = field(repr=False)
    slip: NDArray[np.float64] = field(repr=False)
    peak_slip: float
    max_lift: float
    phase_times: NDArray[np.float64] = field(repr=False)
    phases: tuple[Phase, ...] = field(repr=False)
    model: str
    body: Body
    motion: Motion = field(repr=False)
    support: Support

    def plot(self, ax: tuple[Axes, Axes] | None = None) -> tuple[Axes, Axes]:
        """Rotation over time above the motion; returns both axes."""
        from shaketable.plot import plot_response

        return plot_response(self, ax)

    def animate(self, path: str | Path) -> Path:
        """Write the body on its support as a GIF or an MP4, by the path's ending."""
        from shaketable.plot import animate_response

        return animate_response(self, Path(path))
