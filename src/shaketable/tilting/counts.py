"""Simulated outcomes on several tilts, counted by recording."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.recordings import recordings_of
from shaketable.response import Outcome
from shaketable.simulate import simulate_many
from shaketable.support import Support
from shaketable.units import radians

if TYPE_CHECKING:
    import xarray as xr

BODIES_AT_ONCE = 256  # bounds the memory of one call
TILT_RESERVE = radians(0.25)  # between the largest tilt tried and the one at which it falls


@dataclass(frozen=True, kw_only=True, eq=False)
class TiltCounts:
    """How many simulations of each recording overturn a body on each tilt, and how many downhill.

    Attributes:
        tilts: β [rad], rising, shape (t,).
        simulations: of each recording, (body, recording).
        falls, downhill: (body, t, recording).
        stands: whether the body stands, and does not slide, on the tilt by itself, (body, t);
            where it does not, nothing was simulated.
    """

    tilts: NDArray[np.float64]
    simulations: NDArray[np.int64]
    falls: NDArray[np.int64]
    downhill: NDArray[np.int64]
    stands: NDArray[np.bool_]

    @classmethod
    def of(
        cls,
        runs: xr.Dataset,
        recording: NDArray[np.intp],
        counted: NDArray[np.bool_] | None = None,
    ) -> TiltCounts:
        """Counts of what simulate_many gives for one scale.

        Args:
            runs: on tilts on which every body stands.
            recording: of each motion, as `recordings_of` gives it.
            counted: which motions count for which body, (body, motion); all by default.
        """
        if counted is None:
            counted = np.ones((runs.sizes["body"], runs.sizes["motion"]), np.bool_)
        groups = recording[:, None] == np.arange(recording.max() + 1)
        outcome = runs.outcome.isel(scale=0).transpose("body", "tilt", "motion", "polarity").values
        falls, downhill = (
            ((way.sum(axis=3) * counted[:, None, :]) @ groups)
            for way in (outcome != Outcome.STANDING, outcome == Outcome.DOWNHILL)
        )
        return cls(
            tilts=np.asarray(runs.tilt.values, np.float64),
            simulations=2 * (counted.astype(np.int64) @ groups),
            falls=falls,
            downhill=downhill,
            stands=np.ones(falls.shape[:2], np.bool_),
        )

    @classmethod
    def joined(cls, parts: Sequence[TiltCounts]) -> TiltCounts:
        """Counts of several groups of bodies on the same tilts, as of one group."""
        names = ("simulations", "falls", "downhill", "stands")
        each = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
        return cls(tilts=parts[0].tilts, **each)

    def body(self, number: int) -> TiltCounts:
        """Counts of one of the bodies."""
        one = slice(number, number + 1)
        return replace(
            self,
            simulations=self.simulations[one],
            falls=self.falls[one],
            downhill=self.downhill[one],
            stands=self.stands[one],
        )

    @property
    def recordings(self) -> int:
        """How many."""
        return int(self.falls.shape[2])


def steepest(bodies: Sequence[Body], model: str, support: Support) -> NDArray[np.float64]:
    """The tilt [rad] up to which each body stands by itself, less TILT_RESERVE, (body,).

    With the general model it must not slide by itself either.
    """
    slides_at = math.atan(support.static_friction) if model == "general" else math.inf
    return np.array([min(body.slenderness_left, slides_at) for body in bodies]) - TILT_RESERVE


def pieces(count: int, size: int = BODIES_AT_ONCE) -> Iterator[slice]:
    """Slices of so many bodies, a bounded number at a time."""
    for start in range(0, count, size):
        yield slice(start, start + size)


def count_outcomes(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    tilts: NDArray[np.float64],
    *,
    scale: float = 1.0,
    model: str = "rocking",
    support: Support | None = None,
    progress: Progress = True,
) -> TiltCounts:
    """Shake every body on every tilt that it stands on, under every motion in both directions.

    Args:
        bodies, motions: at least one.
        tilts: β [rad], rising, shape (t,). A level support always counts as one to stand on.
        scale: factor on the motions.
        model, support, progress: as for simulate_many.

    Raises:
        InputError: tilts that do not rise, and what simulate_many cannot simulate.
    """
    if not (np.diff(tilts) > 0.0).all():
        raise InputError("count_outcomes needs rising tilts")
    support = support or Support()
    stands = (tilts < steepest(bodies, model, support)[:, None]) | (tilts == 0.0)
    recording = recordings_of(motions)
    recordings = int(recording.max()) + 1
    simulations = np.zeros((len(bodies), recordings), np.int64)
    falls, downhill = np.zeros((2, *stands.shape, recordings), np.int64)
    allowed = stands.sum(axis=1)
    for count in np.unique(allowed[allowed > 0]):
        alike = np.flatnonzero(allowed == count)
        for piece in pieces(alike.size):
            which = alike[piece]
            runs = simulate_many(
                [bodies[int(k)] for k in which],
                motions,
                tilts=tilts[:count],
                scales=(scale,),
                support=support,
                model=model,
                progress=progress,
            )
            part = TiltCounts.of(runs, recording)
            simulations[which] = part.simulations
            falls[which, :count], downhill[which, :count] = part.falls, part.downhill
    return TiltCounts(
        tilts=tilts, simulations=simulations, falls=falls, downhill=downhill, stands=stands
    )
