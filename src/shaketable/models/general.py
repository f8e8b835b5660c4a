"""The general model: rest, slide, rock, slide-rock, flight and impacts."""

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
from shaketable.models.held import nothing_held
from shaketable.models.model import ManyRuns, Model, OneRun, Table
from shaketable.models.scene import require_surrounded, scenes_of
from shaketable.models.surrounded import run_one_surrounded, run_surrounded
from shaketable.motion import Motion
from shaketable.physics.plane.phases import Phase, on_tilt
from shaketable.surroundings import Surroundings
from shaketable.units import degrees

if TYPE_CHECKING:
    from shaketable.physics.plane.forcing import Shaking

EVENTS = 64  # impacts and changes of phase for which memory is allocated at first


@dataclass(frozen=True, kw_only=True)
class General(Model):
    """The general model: a body rests, slides, rocks or flies, with friction and restitution.

    Ishiyama Y. (1982), on a tilted support Boroschek and Iruretagoyena (2006) eqs. 3-10; theory,
    sections 3 to 6.

    Args:
        static_friction: μ_s >= 0; infinite (nothing slips) by default.
        kinetic_friction: μ_k <= μ_s; μ_s by default.
        normal_restitution: Newton's e_n in [0, 1) for a corner that lands.
        restitution_factor: multiplies the angular velocity that is left when the pivot changes
            corner or the base lands flat, in (0, 1]; it acts where a corner stays on the support,
            so that with e_n > 0 it has hardly any effect. `Body.restitution_factor` takes
            precedence.

    Raises:
        InputError: a value outside its range.
    """

    static_friction: float = math.inf
    kinetic_friction: float | None = None
    normal_restitution: float = 0.0
    restitution_factor: float = 1.0

    name: ClassVar[str] = "general"
    slides: ClassVar[bool] = True
    gpu_kernel: ClassVar[str] = "move_members"

    def __post_init__(self) -> None:
        for name in ("static_friction", "normal_restitution"):
            require_number(f"General.{name}", getattr(self, name))
        if not self.static_friction >= 0.0:
            raise InputError(
                "General.static_friction must not be negative (infinite: nothing slips), "
                f"got {self.static_friction!r}"
            )
        kinetic = self.kinetic_friction
        if kinetic is not None:
            require_number("General.kinetic_friction", kinetic)
            if not 0.0 <= kinetic <= self.static_friction:
                raise InputError(
                    "General.kinetic_friction must lie between 0 and static_friction = "
                    f"{self.static_friction!r}, got {kinetic!r}"
                )
        if not 0.0 <= self.normal_restitution < 1.0:
            raise InputError(
                f"General.normal_restitution must lie in [0, 1), got {self.normal_restitution!r}"
            )
        require_factor("General.restitution_factor", self.restitution_factor)
        keep_floats(self, *(field.name for field in fields(self)))

    @property
    def sliding_friction(self) -> float:
        """μ_k, or μ_s where no μ_k is given."""
        return self.static_friction if self.kinetic_friction is None else self.kinetic_friction

    @property
    def rest_limit(self) -> float:
        return math.atan(self.static_friction)

    def warnings(self, tilt: float) -> list[str]:
        found = []
        if math.tan(abs(tilt)) > self.static_friction:
            found.append(
                f"on a support tilted by {degrees(tilt):.4g}° a body slides by itself: a static "
                f"friction of {self.static_friction:.4g} holds it up to "
                f"{degrees(self.rest_limit):.4g}°"
            )
        if self.normal_restitution > 0.0 and self.restitution_factor < 1.0:
            found.append(
                f"with a normal restitution of {self.normal_restitution:g} a corner that is struck "
                "leaves the support again, and the restitution factor, which acts where a corner "
                "stays on it, has hardly any effect: set one of them only"
            )
        return found

    def tabulate(
        self,
        bodies: Sequence[Body],
        tilts: NDArray[np.float64],
        surroundings: Sequence[Surroundings | None] = (),
    ) -> Table:
        from shaketable.engine.body_tables import blocks_of, tabulate_bodies, tabulate_corners

        rows = tabulate_bodies(
            sizes_of(bodies, self.restitution_factor),
            tilts,
            (self.static_friction, self.sliding_friction),
            self.normal_restitution,
        )
        table = Table(blocks_of(rows), rows, tabulate_corners(rows))
        if any(surroundings):
            table = table._replace(scenes=scenes_of(bodies, tilts, surroundings, self))
        return table

    def require_surrounded(self, body: Body, surroundings: Surroundings, tilt: float) -> None:
        require_surrounded(body, surroundings)

    def run_many(self, table: Table, polarity: NDArray[np.float64], shaking: Shaking) -> ManyRuns:
        from shaketable.engine.batch import demands_of
        from shaketable.engine.general_many import move_many

        batch, runs = batch_of(table, polarity)
        move_many(shaking, demands_of(shaking), batch)
        return run_surrounded(table.scenes, polarity, shaking, runs) if table.scenes.size else runs

    def first_phase(self, body: Body, tilt: float, motion: Motion) -> Phase:
        """The phase in which a body at rest on a tilt [rad] begins, when the motion sets in."""
        from shaketable.engine.general_one import begin_one

        table = self.tabulate([body], np.array([tilt]))
        phase = np.empty(1, np.int8)
        parts = int(substeps(table.blocks, motion)[0])
        begin_one(refined(motion, parts), table.bodies[0], 0.0, phase)
        return on_tilt(Phase(phase[0]), tilt)

    def run_one(
        self,
        body: Body,
        tilt: float,
        motion: Motion,
        initial_rotation: float,
        surroundings: Surroundings | None = None,
    ) -> OneRun:
        from shaketable.engine.general_one import Scratch, Trace, move_one
        from shaketable.engine.one_loop import PlanarSummary
        from shaketable.physics.plane.extremes import Log
        from shaketable.physics.plane.phase_series import ROWS, TERMS

        table = self.tabulate([body], np.array([tilt]))
        parts = int(substeps(table.blocks, motion)[0])
        shaking = refined(motion, parts)
        alone = None
        if surroundings:
            scene = scenes_of([body], np.array([tilt]), [surroundings], self)[0]
            run = run_one_surrounded(scene, shaking, parts, initial_rotation)
            if run is not None:
                return run
            alone = nothing_held([surroundings])
        samples, events = shaking.a_x.size, EVENTS
        summary, series = np.empty(len(PlanarSummary._fields)), np.zeros((ROWS, TERMS))
        while True:
            trace = Trace(*np.empty((len(Trace._fields), samples)))
            log = Log(*np.empty((2, events)), *np.empty((2, events), np.int8))
            scratch = Scratch(trace, log, series)
            move_one(shaking, table.bodies[0], initial_rotation, scratch, summary)
            end = PlanarSummary(*summary.tolist())
            if end.samples <= samples and max(end.impacts, end.changes) <= events:
                break
            samples, events = int(end.samples), int(max(end.impacts, end.changes))
        impacts, changes = int(end.impacts), int(end.changes)
        shown = samples_shown(int(end.samples), parts, shaking)
        return OneRun(
            ending=Ending(int(end.ending)),
            direction=int(end.direction),
            overturning_time=end.overturning_time,
            peak_rotation=end.peak,
            impact_times=log.impact_times[:impacts].copy(),
            time=trace.time[shown],
            rotation=trace.rotation[shown],
            angular_velocity=trace.angular_velocity[shown],
            position=np.column_stack([trace.along[shown], trace.normal[shown]]),
            velocity=np.column_stack([trace.along_rate[shown], trace.normal_rate[shown]]),
            slip=trace.slip[shown],
            end_slip=end.slip,
            farthest_left=end.farthest_left,
            farthest_right=end.farthest_right,
            max_lift=end.lift,
            phase_times=log.change_times[:changes].copy(),
            phases=tuple(on_tilt(Phase(code), tilt) for code in log.phases[:changes]),
            held=alone,
        )

    @property
    def method(self) -> tuple[str, ...]:
        factor = (
            ""
            if self.restitution_factor == 1.0
            else tell(
                " A rocking impact after which a corner stays on the support leaves {part:g} of "
                "the angular velocity that this gives.",
                part=self.restitution_factor,
            )
        )
        return (
            tell(
                "Each object is a rigid body in the vertical plane of the shaking that rests, "
                "slides, rocks, slides and rocks, or flies, with impacts of one or both corners "
                "(Ishiyama 1982; on a tilted support Boroschek & Iruretagoyena 2006): Coulomb "
                "friction, static {static:g} and kinetic {kinetic:g}, and Newton's normal "
                "restitution {restitution:g}. What follows a contact is found by complementarity "
                "of forces and impulses; events are found inside the samples.{factor}",
                static=self.static_friction,
                kinetic=self.sliding_friction,
                restitution=self.normal_restitution,
                factor=factor,
            ),
            translated(
                "Slip is the farthest that a corner on the support has moved along it, in either "
                "direction, in the shakings that leave the object upright. An object walks off "
                "where the foot of its centre of gravity passes the edge of a support on whose "
                "middle its base began, without having fallen."
            ),
        )

    @property
    def not_considered(self) -> tuple[str, ...]:
        return ()
