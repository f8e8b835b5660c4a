"""What is tilted: a body in its plane, or a solid toward some direction of its base."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.outcome import Outcome
from shaketable.progress import Progress
from shaketable.simulate import ShakingSet, fell, simulate_each
from shaketable.simulate.standing import standing_limit
from shaketable.solid import Solid
from shaketable.tilting.counts import TiltCounts, count_outcomes

#: In how many ways a solid is turned to the motions, over half a turn: reversed, each motion is
#: that of another half.
TURNS = 4
SLIDES = 0.01  # m: a smaller slip counts as staying
STRAIGHT = math.radians(45.0)  # from downhill


class TiltedBody(Protocol):
    """Something on a support that can be tilted."""

    @property
    def body(self) -> Body:
        """Its section along the tilt, downhill toward -x."""

    @property
    def trial(self) -> ShakingSet:
        """How it is shaken."""

    @property
    def turns(self) -> int:
        """In how many ways it is turned to the motions."""

    def count(self, tilts: NDArray[np.float64], progress: Progress) -> TiltCounts:
        """How it ends on tilts [rad]."""

    def slides(self, tilt: float) -> float:
        """Share of the simulations in which it stays upright and slides more than SLIDES."""


@dataclass(frozen=True, eq=False)
class BodyStand:
    """A planar body."""

    body: Body
    trial: ShakingSet
    turns: int = 1

    def count(self, tilts: NDArray[np.float64], progress: Progress) -> TiltCounts:
        return count_outcomes([self.body], self.trial, tilts, progress=progress)

    def slides(self, tilt: float) -> float:
        runs = self.trial.run([self.body], [tilt], progress=False)
        farthest = np.maximum(runs.slip_downhill, runs.slip_uphill)
        return float((~fell(runs) & (farthest > SLIDES)).mean())


#: Variables of simulations.
Runs = dict[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class SolidStand:
    """A solid, tilted toward an azimuth of its own base [rad], from its x toward its y."""

    solid: Solid
    azimuth: float
    trial: ShakingSet
    turns: int = TURNS
    _known: dict[float, Runs] = field(default_factory=dict)

    @property
    def body(self) -> Body:
        """The section that stands exactly as far as the solid does, downhill and uphill."""
        solid, h = self.solid, self.solid.cg_height
        left, right = (
            h * math.tan(standing_limit(solid, self.azimuth + turn)) for turn in (0.0, math.pi)
        )
        across = np.array([-math.sin(self.azimuth), math.cos(self.azimuth), 0.0])
        radius = math.sqrt(across @ solid.inertia @ across)
        # a round or square base has its centre in the middle: no round-off may tell otherwise
        right = left if math.isclose(left, right, rel_tol=1e-12) else right
        return Body(
            base=left + right, cg_height=h, left=left, gyration_radius=radius, name=solid.name
        )

    def count(self, tilts: NDArray[np.float64], progress: Progress) -> TiltCounts:
        runs = self._runs(tilts, progress)
        happened = runs["outcome"] != Outcome.STANDING
        downhill = runs["outcome"] == Outcome.DOWNHILL
        straight = happened & (np.cos(runs["fall_azimuth"]) >= math.cos(STRAIGHT))
        of_motion = self.trial.recording[:, None] == np.arange(self.trial.recording.max() + 1)

        def counted(which: NDArray[np.bool_]) -> NDArray[np.int64]:
            return np.asarray(which.sum(axis=(2, 3)).T @ of_motion)[None]

        each = 2 * self.turns
        return TiltCounts(
            tilts=tilts,
            simulations=each * of_motion.sum(axis=0)[None],
            falls=counted(happened),
            downhill=counted(downhill),
            stands=np.ones((1, tilts.size), np.bool_),
            straight=counted(straight),
        )

    def slides(self, tilt: float) -> float:
        runs = self._runs(np.array([tilt]), False)
        moved = np.hypot(runs["displacement_x"], runs["displacement_y"])
        return float(((runs["outcome"] == Outcome.STANDING) & (moved > SLIDES)).mean())

    def _runs(self, tilts: NDArray[np.float64], progress: Progress) -> Runs:
        """Variables of every simulation, (motion, tilt, polarity, turn); falls from downhill.

        Each tilt is simulated once.
        """
        new = np.array([tilt for tilt in tilts.tolist() if tilt not in self._known])
        if new.size:
            found = self._simulated(new, progress)
            for k, tilt in enumerate(new.tolist()):
                self._known[tilt] = {name: values[:, k] for name, values in found.items()}
        if callable(progress):
            progress((tilts.size - new.size) * 2 * self.turns * len(self.trial.motions))
        runs = [self._known[tilt] for tilt in tilts.tolist()]
        return {name: np.stack([each[name] for each in runs], axis=1) for name in runs[0]}

    def _simulated(self, tilts: NDArray[np.float64], progress: Progress) -> Runs:
        motions = self.trial.motions
        turns = np.arange(self.turns) * math.pi / self.turns
        shape = (len(motions), tilts.size, 2, turns.size)
        motion, tilt, polarity, turn = (each.ravel() for each in np.indices(shape))
        downhill = self.azimuth + turns[turn]
        around = self.trial.surroundings
        turned = [around.turned(angle) for angle in turns.tolist()] if around else []
        runs = simulate_each(
            self.solid,
            [motions[k] for k in motion],
            tilts=tilts[tilt],
            scales=self.trial.scale,
            polarities=1 - 2 * polarity,
            azimuths=downhill,
            orientations=turns[turn],
            model=self.trial.model,
            surroundings=[turned[k] for k in turn] if around else None,
            progress=progress,
        )
        found = {
            name: runs[name].values
            for name in ("outcome", "displacement_x", "displacement_y", "fall_azimuth")
        }
        found["fall_azimuth"] = found["fall_azimuth"] - downhill
        return {name: values.reshape(shape) for name, values in found.items()}
