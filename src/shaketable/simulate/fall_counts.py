"""What fell, which way, and how often: the one place where falls are counted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.outcome import Outcome
from shaketable.resampling import sums_of_groups
from shaketable.simulate.ensemble import Ensemble
from shaketable.simulate.result_fields import Part

if TYPE_CHECKING:
    import xarray as xr


def fell(runs: xr.Dataset) -> xr.DataArray:
    """Whether each simulation overturned the body."""
    return runs["outcome"] != int(Outcome.STANDING)


def fell_downhill(runs: xr.Dataset) -> xr.DataArray:
    """Whether each simulation overturned the body downhill."""
    return runs["outcome"] == int(Outcome.DOWNHILL)


def simulated(variable: xr.DataArray) -> NDArray[Any]:
    """A variable of `simulate_many` as (body, tilt, simulation).

    The two directions of a motion are side by side.
    """
    ordered = variable.transpose("body", "tilt", "motion", "polarity", "scale").values
    return np.asarray(ordered.reshape(*ordered.shape[:2], -1))


@dataclass(frozen=True, kw_only=True, eq=False)
class OutcomeCounts:
    """How many simulations of each recording overturn a body on each tilt, and how many downhill.

    Attributes:
        simulations: number for each recording, (body, recording).
        falls, downhill: numbers, (body, tilt, recording).
    """

    simulations: NDArray[np.int64]
    falls: NDArray[np.int64]
    downhill: NDArray[np.int64]


def count_by_recording(
    runs: xr.Dataset,
    recording: NDArray[np.intp],
    counted: NDArray[np.bool_] | None = None,
) -> OutcomeCounts:
    """Count the results of `simulate_many` by recording.

    Args:
        runs: the Dataset, with any polarities, tilts and scales.
        recording: of each motion, as `resampling.recordings_of` gives it, (motion,).
        counted: which motions count for which body, (body, motion); all by default.
    """
    if counted is None:
        counted = np.ones((runs.sizes["body"], runs.sizes["motion"]), np.bool_)
    there, count = np.unique(recording), int(recording.max()) + 1

    def by_recording(happened: xr.DataArray) -> NDArray[np.int64]:
        often = happened.sum(["polarity", "scale"]).transpose("motion", "body", "tilt").values
        return by_group(often * counted.T[:, :, None]).transpose(1, 2, 0)

    def by_group(often: NDArray[np.int64]) -> NDArray[np.int64]:
        found = np.zeros((count, *often.shape[1:]), np.int64)
        found[there] = sums_of_groups(often, recording)
        return found

    each = runs.sizes["polarity"] * runs.sizes["scale"]
    return OutcomeCounts(
        simulations=each * by_group(counted.T.astype(np.int64)).T,
        falls=by_recording(fell(runs)),
        downhill=by_recording(fell_downhill(runs)),
    )


class OutcomeTally:
    """Counts as `count_by_recording` does, but as members end, none of which it keeps."""

    def __init__(self, ensemble: Ensemble, recording: NDArray[np.intp]) -> None:
        """Nothing counted yet.

        Args:
            ensemble: whose members are entered.
            recording: of each motion, as `resampling.recordings_of` gives it, (motion,).
        """
        of_motions = np.bincount(recording)
        shape = ensemble.shape
        self._ensemble = ensemble
        self._recording = recording
        each = shape.scale * ensemble.repeats * of_motions
        self._simulations = np.tile(each, (shape.body, 1))
        self._falls, self._downhill = np.zeros(
            (2, shape.body, shape.tilt, of_motions.size), np.int64
        )

    def store(self, part: Part) -> None:
        """Count the results of some members, as `ensemble.run` hands them over."""
        ended = self._ensemble.falls_of(part)
        for counts, happened in (
            (self._falls, ended.outcome != Outcome.STANDING),
            (self._downhill, ended.outcome == Outcome.DOWNHILL),
        ):
            recording = self._recording[ended.motion[happened]]
            where = (ended.body[happened], ended.tilt[happened], recording)
            np.add.at(counts, where, 1)

    @property
    def counts(self) -> OutcomeCounts:
        """Those of all members, once all are entered."""
        return OutcomeCounts(
            simulations=self._simulations, falls=self._falls, downhill=self._downhill
        )
