"""What a simulation returns: what every run has, and the history of a planar one."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.engine.endings import Ending
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.physics.plane.phases import Phase
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.surroundings import Surroundings
from shaketable.units import degrees

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Response(ABC):
    """The result of one simulation: a `PlanarResponse` or a `SolidResponse`.

    Results have the names and meanings of `simulate_many` (docs/reference/results.md). Histories
    are given at the motion's samples. They go on after its end, under gravity alone and at steps of
    their own (see `time`), until the body rests or has fallen.

    Attributes:
        outcome: STANDING, DOWNHILL or UPHILL.
        overturning_time: when the body had turned by π/2 [s], NaN if it did not.
        peak_rotation: largest angle from the support's normal [rad], π/2 if it overturned.
        impacts: how many.
        ending: how the run ended.
        displacement_x: along x at the end of the run [m].
        max_lift: largest clearance under the whole base [m]; zero if it never jumps.
        time: of the history's samples [s], shape (n,).
        position: centre of gravity [m], shape (n, 2) along and normal to the support, or (n, 3).
        velocity: its rate [m/s].
        model: the contact model, with its parameters.
        body, motion, support: what was simulated.
        surroundings: what stood beside it and held it, if anything did.
        held_up: whether it did not fall, and would without its walls, straps and pads: the run goes
            on from its last state with the ground at rest and nothing there but the support.
        strap_force: the largest force of each strap [N].
        strap_broke_at: when each broke [s], NaN for one that did not.
        off_edge: whether it fell off its support, over the edge; then `overturning_time` is that of
            landing, and `outcome` tells the side.
        left_support_at: when it last touched its support [s], NaN if it did not leave.
        landing_time: when it came down [s], NaN if it did not leave; of its centre of gravity then
        landing_x, landing_y: place along x and y from where it stood [m], NaN in the plane of y,
        landing_speed: and speed [m/s].
        landing_rotation: θ then, or the nutation [rad].
    """

    outcome: Outcome
    overturning_time: float
    peak_rotation: float
    impacts: int
    ending: Ending
    displacement_x: float
    max_lift: float
    time: NDArray[np.float64]
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    model: Model
    body: Body | Solid
    motion: Motion
    support: Support
    surroundings: Surroundings | None
    held_up: bool = False
    strap_force: tuple[float, ...] = ()
    strap_broke_at: tuple[float, ...] = ()
    off_edge: bool = False
    left_support_at: float = math.nan
    landing_time: float = math.nan
    landing_x: float = math.nan
    landing_y: float = math.nan
    landing_speed: float = math.nan
    landing_rotation: float = math.nan

    @property
    def settled(self) -> bool:
        """Whether it fell or came to rest; what still moved when it was given up did neither."""
        return self.ending in (Ending.STANDING, Ending.OVERTURNED)

    @abstractmethod
    def plot(self, ax: Any = None) -> tuple[Axes, ...]:
        """The history above the motion; returns the axes."""

    @abstractmethod
    def animate(self, path: str | Path) -> Path:
        """Write a film of the body on its support."""

    def _repr_html_(self) -> str:
        """For notebooks: the history as a picture under one line of words."""
        from shaketable.drawing.files import as_html

        return as_html(self.plot()[0], repr(self))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class PlanarResponse(Response):
    """The result of one planar simulation; its history ends when the body overturns.

    Attributes:
        impacts: up to the certified end of a bounce sequence; among surroundings how often some
            corner landed, or struck something.
        impact_times: [s], shape (impacts,).
        rotation: θ relative to the support [rad], positive toward +x, shape (n,); its peak was
            found between samples too.
        angular_velocity: [rad/s], shape (n,).
        position, velocity: from the foot of the centre of gravity at rest [m, m/s], shape (n, 2).
        slip: how far the lowest corner has moved along the support [m], + toward +x, shape (n,);
            zero in the rocking model.
        slip_downhill, slip_uphill: farthest slip while a corner is on the support [m].
        phase_times: when each phase begins [s], shape (k,); to within a sample in the rocking
            model.
        phases: the k phases; among surroundings what the corners on the support do, at the
            motion's samples.
        fallbacks: how often accumulating events among surroundings were stepped over in time steps
            of 0.1 ms.
    """

    body: Body
    impact_times: NDArray[np.float64]
    rotation: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    slip: NDArray[np.float64]
    slip_downhill: float
    slip_uphill: float
    phase_times: NDArray[np.float64]
    phases: tuple[Phase, ...]
    fallbacks: int = 0

    @property
    def strap_forces(self) -> NDArray[np.float64]:
        """The force of each strap at the samples [N], shape (n, strap)."""
        straps = self.surroundings.straps if self.surroundings else ()
        forces = np.zeros((self.time.size, len(straps)))
        sine, cosine = np.sin(self.rotation), np.cos(self.rotation)
        for k, strap in enumerate(straps):
            x, z = strap.point[0], strap.point[1] - self.body.cg_height
            arm = np.column_stack([x * cosine + z * sine, z * cosine - x * sine])
            toward = np.array(strap.anchor) - self.position - arm
            length = np.hypot(*toward.T)
            turning = self.angular_velocity[:, None] * np.column_stack([arm[:, 1], -arm[:, 0]])
            # where the point is at its anchor the strap is loose, and its rate is of no interest
            rate = -(toward * (self.velocity + turning)).sum(axis=1) / np.maximum(length, 1e-12)
            forces[:, k] = strap.pulls(length, rate, math.dist(strap.point, strap.anchor))
            forces[self.time >= self.strap_broke_at[k], k] = 0.0
        return forces

    @property
    def peak_slip(self) -> float:
        """The farther of both [m]."""
        return max(self.slip_downhill, self.slip_uphill)

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
            f"PlanarResponse({self.outcome.name}{ends}, peak {degrees(self.peak_rotation):.3g}°, "
            f"{self.impacts} impacts, {self.time.size} samples; {self.body!r}, {self.motion!r}, "
            f"tilt {degrees(self.support.tilt):.3g}°, {self.model!r})"
        )
