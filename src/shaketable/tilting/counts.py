"""Simulated outcomes on several tilts, counted by recording."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.models import Model
from shaketable.progress import Progress
from shaketable.simulate import OutcomeCounts, ShakingSet
from shaketable.units import radians

BODIES_AT_ONCE = 256  # these two bound the memory of one call
SIMULATIONS_AT_ONCE = 2_000_000
TILT_RESERVE = radians(0.25)  # between the largest tilt tried and the one at which the body falls


@dataclass(frozen=True, kw_only=True, eq=False)
class TiltCounts:
    """How many simulations of each recording overturn a body on each tilt, and how many downhill.

    Attributes:
        tilts: β [rad], rising, shape (t,).
        simulations: number for each recording, (body, recording).
        falls, downhill: numbers, (body, t, recording).
        stands: whether the body stands, and does not slide, on the tilt by itself, (body, t);
            where it does not, nothing was simulated.
        straight: how many of a solid's falls go downhill within 45°, (body, t, recording); None of
            planar bodies, whose falls all do.
    """

    tilts: NDArray[np.float64]
    simulations: NDArray[np.int64]
    falls: NDArray[np.int64]
    downhill: NDArray[np.int64]
    stands: NDArray[np.bool_]
    straight: NDArray[np.int64] | None = None

    @classmethod
    def of(cls, tilts: NDArray[np.float64], counts: OutcomeCounts) -> TiltCounts:
        """Counts on tilts [rad] on which every body stands."""
        return cls(
            tilts=tilts,
            simulations=counts.simulations,
            falls=counts.falls,
            downhill=counts.downhill,
            stands=np.ones(counts.falls.shape[:2], np.bool_),
        )

    def body(self, number: int) -> TiltCounts:
        """Counts of one of the bodies."""
        one = slice(number, number + 1)
        return replace(
            self,
            simulations=self.simulations[one],
            falls=self.falls[one],
            downhill=self.downhill[one],
            stands=self.stands[one],
            straight=None if self.straight is None else self.straight[one],
        )

    @property
    def recordings(self) -> int:
        """How many recordings there are."""
        return int(self.falls.shape[2])


def steepest(bodies: Sequence[Body], model: Model) -> NDArray[np.float64]:
    """The tilt [rad] up to which each body stands by itself, less TILT_RESERVE, (body,).

    With a model that slides, friction must hold the body there too.
    """
    limits = [min(body.slenderness_left, model.rest_limit) for body in bodies]
    return np.array(limits) - TILT_RESERVE


def pieces(count: int, each: int) -> Iterator[slice]:
    """Slices that together cover `count` bodies, each of a bounded number of them.

    Args:
        each: simulations of a body.
    """
    size = min(BODIES_AT_ONCE, max(1, SIMULATIONS_AT_ONCE // each))
    for start in range(0, count, size):
        yield slice(start, start + size)


def count_outcomes(
    bodies: Sequence[Body],
    trial: ShakingSet,
    tilts: NDArray[np.float64],
    *,
    progress: Progress = True,
) -> TiltCounts:
    """Shake every body on every tilt that it stands on, under every motion in both directions.

    Args:
        bodies: at least one.
        trial: motions, their scale, and the model.
        tilts: β [rad], rising from 0 or above, shape (t,). Every body counts as standing on a
            level support.
        progress: as for simulate_many.

    Raises:
        InputError: tilts that do not rise, and what simulate_many cannot simulate.
    """
    if not (np.diff(tilts) > 0.0).all() or tilts[0] < 0.0:
        raise InputError("count_outcomes needs tilts that rise from 0 or above")
    stands = (tilts < steepest(bodies, trial.model)[:, None]) | (tilts == 0.0)
    recordings = int(trial.recording.max()) + 1
    simulations = np.zeros((len(bodies), recordings), np.int64)
    falls, downhill = np.zeros((2, *stands.shape, recordings), np.int64)
    allowed = stands.sum(axis=1)
    for count in np.unique(allowed[allowed > 0]):
        alike = np.flatnonzero(allowed == count)
        for piece in pieces(alike.size, 2 * len(trial.motions) * int(count)):
            which = alike[piece]
            part = trial.count([bodies[int(k)] for k in which], tilts[:count], progress)
            simulations[which] = part.simulations
            falls[which, :count], downhill[which, :count] = part.falls, part.downhill
    return TiltCounts(
        tilts=tilts, simulations=simulations, falls=falls, downhill=downhill, stands=stands
    )
