"""What a simulation returns."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.kernels.phases import Phase
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.support import Support
from shaketable.units import degrees

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Response:
    """One body under one motion.

    Histories are given at the motion's samples. They go on after its end, under gravity alone and
    at steps of their own (see `time`), until the body rests; they stop before it has overturned.

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
        slip: how far the lowest corner has moved along the support [m], + toward +x, shape (n,);
            zero in the rocking model.
        peak_slip: largest |slip| while a corner is on the support [m].
        max_lift: largest clearance under the whole base [m]; zero if it never jumps.
        settled: whether it fell or came to rest; what still moved at the end of the run did
            neither, and its outcome is STANDING.
        phase_times: when each phase begins [s], shape (k,); to within a sample in the rocking
            model.
        phases: the k phases.
        model: the contact model, with its parameters.
        body, motion, support: what was simulated.
    """

    outcome: Outcome
    overturning_time: float
    peak_rotation: float
    impacts: int
    impact_times: NDArray[np.float64]
    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    slip: NDArray[np.float64]
    peak_slip: float
    max_lift: float
    settled: bool
    phase_times: NDArray[np.float64]
    phases: tuple[Phase, ...]
    model: Model
    body: Body
    motion: Motion
    support: Support

    def plot(self, ax: tuple[Axes, Axes] | None = None) -> tuple[Axes, Axes]:
        """Rotation over time above the motion; returns both axes."""
        from shaketable.drawing.history import plot_response

        return plot_response(self, ax)

    def animate(self, path: str | Path) -> Path:
        """Write a film of the body on its support; the path's ending chooses GIF or MP4."""
        from shaketable.drawing.film import animate_response

        return animate_response(self, Path(path))

    def __repr__(self) -> str:
        fell = self.outcome is not Outcome.STANDING
        ends = f" at {self.overturning_time:.3f} s" if fell else ""
        return (
            f"Response({self.outcome.name}{ends}, peak {degrees(self.peak_rotation):.3g}°, "
            f"{self.impacts} impacts, {self.time.size} samples; {self.body!r}, {self.motion!r}, "
            f"tilt {degrees(self.support.tilt):.3g}°, {self.model!r})"
        )

    def _repr_html_(self) -> str:
        """For notebooks: the history as a picture under one line of words."""
        from shaketable.drawing.files import as_html

        return as_html(self.plot()[0], repr(self))
