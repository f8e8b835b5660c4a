"""What fell, which way, and how often: the one place where falls are counted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.outcome import Outcome

if TYPE_CHECKING:
    import xarray as xr


def fell(runs: xr.Dataset) -> xr.DataArray:
    """Whether each simulation overturned the body."""
    return runs["outcome"] != int(Outcome.STANDING)


def fell_downhill(runs: xr.Dataset) -> xr.DataArray:
    """Whether each simulation overturned the body downhill."""
    return runs["outcome"] == int(Outcome.DOWNHILL)


def fall_share(runs: xr.Dataset) -> NDArray[np.float64]:
    """Share of each body's simulations that overturn it, (body,)."""
    share = fell(runs).mean([name for name in runs.outcome.dims if name != "body"])
    return np.asarray(share.values, np.float64)


def simulated(variable: xr.DataArray) -> NDArray[np.generic]:
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
    groups = recording[:, None] == np.arange(recording.max() + 1)

    def by_recording(happened: xr.DataArray) -> NDArray[np.int64]:
        often = happened.sum(["polarity", "scale"]).transpose("body", "tilt", "motion").values
        return np.asarray((often * counted[:, None]) @ groups)

    each = runs.sizes["polarity"] * runs.sizes["scale"]
    return OutcomeCounts(
        simulations=each * (counted.astype(np.int64) @ groups),
        falls=by_recording(fell(runs)),
        downhill=by_recording(fell_downhill(runs)),
    )
