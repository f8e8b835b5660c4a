"""The rocking model: no sliding, no jump."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body, require_factor
from shaketable.engine.endings import Ending
from shaketable.errors import InputError, keep_floats, require_number
from shaketable.language import tell, translated
from shaketable.models.batch import batch_of
from shaketable.models.engine_input import refined, samples_shown, sizes_of, substeps
from shaketable.models.model import ManyRuns, Model, OneRun, Table
from shaketable.models.one_sided import (
    require_one_sided,
    restitution_of,
    side_of,
    stand_at_walls,
)
from shaketable.motion import Motion
from shaketable.physics.plane.phases import Phase
from shaketable.surroundings import Surroundings

if TYPE_CHECKING:
    from shaketable.physics.plane.forcing import Shaking

IMPACTS = 64  # impacts for which memory is allocated at first


@dataclass(frozen=True, kw_only=True)
class Rocking(Model):
    """The rocking model: a body rocks about its corners and neither slides nor jumps.

    Housner G.W. (1963), on a tilted support Boroschek and Iruretagoyena (2006) eq. 2, off centre
    Boroschek and Romo (2004) eq. 34; theory, section 2.

    Args:
        restitution: η in (0, 1), the share of the angular velocity that is left by an impact; by
            default that of a plastic impact without slip, which keeps the angular momentum about
            the corner that lands. Where the centre of gravity is off centre, a share that would
            add energy is lowered to the largest one that does not.
        restitution_factor: multiplies either share, in (0, 1]; tests on granite find 0.60 to 0.98
            of the plastic impact's. `Body.restitution_factor` takes precedence.

    Raises:
        InputError: a value outside its range.
    """

    restitution: float | None = None
    restitution_factor: float = 1.0

    name: ClassVar[str] = "rocking"
    slides: ClassVar[bool] = False
    gpu_kernel: ClassVar[str] = "rock_members"

    def __post_init__(self) -> None:
        if self.restitution is not None:
            require_number("Rocking.restitution", self.restitution)
            if not 0.0 < self.restitution < 1.0:
                raise InputError(
                    f"Rocking.restitution must lie in (0, 1), got {self.restitution!r}; without it "
                    "an impact keeps the angular momentum about the corner that lands"
                )
        require_factor("Rocking.restitution_factor", self.restitution_factor)
        keep_floats(self, *(field.name for field in fields(self)))

    def tabulate(
        self,
        bodies: Sequence[Body],
        tilts: NDArray[np.float64],
        surroundings: Sequence[Surroundings | None] = (),
    ) -> Table:
        from shaketable.engine.body_tables import tabulate_blocks

        kept = math.nan if self.restitution is None else self.restitution
        nothing = np.empty((0, 0))
        sizes = sizes_of(bodies, self.restitution_factor)
        table = Table(tabulate_blocks(sizes, tilts, kept), nothing, nothing)
        return stand_at_walls(table, bodies, surroundings, self)

    def require_surrounded(self, body: Body, surroundings: Surroundings, tilt: float) -> None:
        require_one_sided(body, surroundings, tilt)
        restitution_of(surroundings.walls[0], body, self)

    def run_many(self, table: Table, polarity: NDArray[np.float64], shaking: Shaking) -> ManyRuns:
        from shaketable.engine.batch import demands_of
        from shaketable.engine.rocking_many import rock_many

        batch, runs = batch_of(table, polarity)
        rock_many(shaking, demands_of(shaking), batch)
        return runs

    def run_one(
        self,
        body: Body,
        tilt: float,
        motion: Motion,
        initial_rotation: float,
        surroundings: Surroundings | None = None,
    ) -> OneRun:
        from shaketable.engine.one_loop import PlanarSummary
        from shaketable.engine.rocking_one import History, rock_one

        if surroundings:
            side = side_of(surroundings.walls[0].azimuth, "wall")
            if initial_rotation * side > 0.0:
                raise InputError(
                    f"initial_rotation [rad] is into the wall, got {initial_rotation!r}"
                )
        blocks = self.tabulate([body], np.array([tilt]), [surroundings]).blocks
        parts = int(substeps(blocks, motion)[0])
        shaking = refined(motion, parts)
        samples, impacts = shaking.a_x.size, IMPACTS
        summary = np.empty(len(PlanarSummary._fields))
        while True:
            time, rotation, rate = np.empty((3, samples))
            history = History(time, rotation, rate, np.empty(impacts))
            rock_one(shaking, blocks[0], initial_rotation, history, summary)
            end = PlanarSummary(*summary.tolist())
            if end.samples <= samples and end.impacts <= impacts:
                break
            samples, impacts = int(end.samples), int(end.impacts)
        shown = samples_shown(int(end.samples), parts, shaking)
        time, theta, omega = time[shown], rotation[shown], rate[shown]
        position, velocity = pivoted(body, theta, omega)
        changes, phases = phases_seen(time, theta)
        return OneRun(
            ending=Ending(int(end.ending)),
            direction=int(end.direction),
            overturning_time=end.overturning_time,
            peak_rotation=end.peak,
            impact_times=history.impact_times[: int(end.impacts)].copy(),
            time=time,
            rotation=theta,
            angular_velocity=omega,
            position=position,
            velocity=velocity,
            slip=np.zeros(shown.size),
            end_slip=0.0,
            farthest_left=0.0,
            farthest_right=0.0,
            max_lift=0.0,
            phase_times=changes,
            phases=phases,
        )

    @property
    def method(self) -> tuple[str, ...]:
        loss = (
            tell("impacts keep angular momentum about the new corner (Housner 1963")
            if self.restitution is None
            else tell(
                "impacts leave {part:g} of the angular velocity (Housner 1963",
                part=self.restitution,
            )
        )
        factor = (
            ""
            if self.restitution_factor == 1.0
            else tell(" An impact leaves {part:g} of that.", part=self.restitution_factor)
        )
        return (
            tell(
                "Each object is a rigid body in the vertical plane of the shaking that rocks about "
                "its base corners without sliding or jumping; {loss}; on a tilted support "
                "Boroschek & Iruretagoyena 2006, with a centre of gravity off centre Boroschek & "
                "Romo 2004).{factor} The equation of motion is solved to round-off; impacts and "
                "uplift are found inside the samples.",
                loss=loss,
                factor=factor,
            ),
        )

    @property
    def not_considered(self) -> tuple[str, ...]:
        return (translated("sliding"), translated("jumping"))


def pivoted(
    body: Body, theta: NDArray[np.float64], omega: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Centre of gravity of a body whose pivots stay in place [m], and its rate; shapes (n, 2)."""
    pivot = np.where(theta >= 0.0, body.right, -body.left)
    # the corner's offset from the centre of gravity (theory, section 3)
    across = pivot * np.cos(theta) - body.cg_height * np.sin(theta)
    down = -pivot * np.sin(theta) - body.cg_height * np.cos(theta)
    return (
        np.column_stack([pivot - across, -down]),
        np.column_stack([-omega * down, omega * across]),
    )


def phases_seen(
    time: NDArray[np.float64], theta: NDArray[np.float64]
) -> tuple[NDArray[np.float64], tuple[Phase, ...]]:
    """Rest and rocking as seen at the samples."""
    seen = np.where(
        theta > 0.0, Phase.ROCK_RIGHT, np.where(theta < 0.0, Phase.ROCK_LEFT, Phase.REST)
    )
    first = np.r_[0, 1 + np.flatnonzero(np.diff(seen))]
    return time[first], tuple(Phase(code) for code in seen[first])
