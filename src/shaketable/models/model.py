"""What every contact model provides."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.engine.endings import Ending
from shaketable.motion import Motion
from shaketable.physics.plane.phases import Phase
from shaketable.surroundings import Surroundings

if TYPE_CHECKING:
    from shaketable.physics.plane.forcing import Shaking


class Table(NamedTuple):
    """A model's bodies on their supports: rows of numbers for the engine.

    Attributes:
        blocks: for the rocking model, (n, numbers of a Block).
        bodies, corners: for the general model, (n, ...); (0, 0) without it.
        scenes: the bodies among what surrounds them in the general model, (n,) of
            `models.scene.Scene`; (0,) where nothing does.
    """

    blocks: NDArray[np.float64]
    bodies: NDArray[np.float64]
    corners: NDArray[np.float64]
    scenes: NDArray[Any] = np.empty(0)

    def take(self, rows: NDArray[np.intp]) -> Table:
        """Some of the rows, each once or more often."""
        return Table(*(part[rows] if part.size else part for part in self))


class Held(NamedTuple):
    """What surroundings did in some runs, by the names of `simulate.result_fields.FIELDS`.

    Attributes:
        strap_force: the largest of each strap [N], (run, strap).
        strap_broke_at: when it broke [s], NaN if it did not, (run, strap).
        held_up: whether it did not fall, and would without its walls and straps, (run,).
        off_edge: whether it left its support over the edge, (run,); None, and so are the others,
            without one.
        left_support_at, landing_time: when it did, and when it came down [s], NaN if it did not.
        landing_x, landing_y: where its centre of gravity was then [m]; None of it in the plane.
        landing_speed: m/s.
        landing_rotation: rad.
    """

    strap_force: NDArray[np.float64]
    strap_broke_at: NDArray[np.float64]
    held_up: NDArray[np.bool_]
    off_edge: NDArray[np.bool_] | None = None
    left_support_at: NDArray[np.float64] | None = None
    landing_time: NDArray[np.float64] | None = None
    landing_x: NDArray[np.float64] | None = None
    landing_y: NDArray[np.float64] | None = None
    landing_speed: NDArray[np.float64] | None = None
    landing_rotation: NDArray[np.float64] | None = None


class ManyRuns(NamedTuple):
    """What became of many bodies under one motion: one number per body in each array.

    Attributes:
        ending: an Ending.
        direction: +1 if it overturned toward +x, -1 toward -x, 0 if it did not.
        overturning_time: [s], NaN if it did not.
        peak: largest |θ| [rad].
        impacts: how many.
        slip: at the end [m], + toward +x.
        farthest_left, farthest_right: farthest slip toward -x, <= 0, and toward +x [m].
        lift: largest clearance under the base [m].
        held: what surroundings did; None without.
    """

    ending: NDArray[np.float64]
    direction: NDArray[np.float64]
    overturning_time: NDArray[np.float64]
    peak: NDArray[np.float64]
    impacts: NDArray[np.float64]
    slip: NDArray[np.float64]
    farthest_left: NDArray[np.float64]
    farthest_right: NDArray[np.float64]
    lift: NDArray[np.float64]
    held: Held | None = None


class OneRun(NamedTuple):
    """What became of one body, with its history at n samples; units as in `Response`."""

    ending: Ending
    direction: int  # +1 if it overturned toward +x, -1 toward -x, 0 if it did not
    overturning_time: float
    peak_rotation: float
    impact_times: NDArray[np.float64]
    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    slip: NDArray[np.float64]
    end_slip: float  # + toward +x [m]
    farthest_left: float  # slip toward -x, <= 0 [m]
    farthest_right: float  # slip toward +x [m]
    max_lift: float
    phase_times: NDArray[np.float64]
    phases: tuple[Phase, ...]
    held: Held | None = None  # of one run
    fallbacks: int = 0  # how often accumulating events were stepped over


class Model(ABC):
    """A contact model. Frozen; its parameters are checked when it is built.

    Attributes:
        name: the short word for the model with its default parameters.
        slides: whether it knows slip and jumps.
        gpu_kernel: its kernel of `engine.cuda_kernels`.
        restitution_factor: multiplies the angular velocity that the impact law leaves at a
            rocking impact, in (0, 1]; a body's own factor takes precedence.
    """

    name: ClassVar[str]
    slides: ClassVar[bool]
    gpu_kernel: ClassVar[str]
    restitution_factor: float

    @abstractmethod
    def tabulate(
        self,
        bodies: Sequence[Body],
        tilts: NDArray[np.float64],
        surroundings: Sequence[Surroundings | None] = (),
    ) -> Table:
        """The engine's rows of bodies, each on a support with its own tilt [rad], (n,).

        Args:
            surroundings: of each; nothing by default.
        """

    @abstractmethod
    def require_surrounded(self, body: Body, surroundings: Surroundings, tilt: float) -> None:
        """InputError unless a body on a tilt [rad] can stand so in this model."""

    @abstractmethod
    def run_one(
        self,
        body: Body,
        tilt: float,
        motion: Motion,
        initial_rotation: float,
        surroundings: Surroundings | None = None,
    ) -> OneRun:
        """Run one body on a tilt [rad], let go at a rotation [rad], with its history."""

    @abstractmethod
    def run_many(self, table: Table, polarity: NDArray[np.float64], shaking: Shaking) -> ManyRuns:
        """Run every body of a table from rest, each under its polarity, on one core."""

    @property
    @abstractmethod
    def method(self) -> tuple[str, ...]:
        """How it works, in whole sentences for a report."""

    @property
    @abstractmethod
    def not_considered(self) -> tuple[str, ...]:
        """What it leaves out, in words."""

    @property
    def rest_limit(self) -> float:
        """The tilt [rad] up to which friction holds a body at rest; infinite if nothing slips."""
        return math.inf

    def warnings(self, tilt: float) -> list[str]:
        """What a user should know before simulating anything on a tilt [rad]."""
        return []
