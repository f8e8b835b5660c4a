"""What recordings depart by from a fragility function, beside what is known of their motions.

A recording's residual is ln of its own median over that of all, with β of all: by what share of
the measure more, or less, than the median it takes to reach the state. A measure is sufficient
where residuals do not depend on magnitude, distance or duration (Luco and Cornell 2007).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.fragility.covariates import known_covariates
from shaketable.fragility.curve import Curve
from shaketable.fragility.lognormal import Capacities, ndtr
from shaketable.motion import Motion
from shaketable.resampling import recordings_of

if TYPE_CHECKING:
    import pandas as pd

FARTHEST = 5.0  # of a residual: a factor of 148 on the measure
HALVINGS = 60


def recording_residuals(curve: Curve) -> NDArray[np.float64]:
    """The residual of each recording, (recording,).

    NaN where a recording always or never reached the state, or where the curve has no function.
    """
    if curve.problem:
        return np.full(curve.recordings, np.nan)
    data, recordings = curve.data, curve.recordings

    def summed(values: ArrayLike) -> NDArray[np.float64]:
        return np.bincount(data.recording, np.asarray(values), recordings).astype(np.float64)

    if isinstance(data, Capacities):
        count = summed(np.ones(data.level.size))
        mean = summed(np.log(data.level / curve.median)) / count
        return np.where(summed(data.reached) == count, mean, np.nan)
    away, wanted = np.log(data.intensity / curve.median), summed(data.reached)
    low, high = np.full(recordings, -FARTHEST), np.full(recordings, FARTHEST)
    for _ in range(HALVINGS if curve.beta > 0.0 else 0):
        middle = (low + high) / 2.0
        more = summed(data.trials * ndtr((away - middle[data.recording]) / curve.beta)) > wanted
        low, high = np.where(more, middle, low), np.where(more, high, middle)
    mixed = (wanted > 0) & (wanted < summed(data.trials))
    return np.where(mixed, (low + high) / 2.0, np.nan)


def residuals(curve: Curve, motions: Sequence[Motion]) -> pd.DataFrame:
    """The residual of each recording, beside what is known of it.

    Args:
        curve: a function.
        motions: those that it was fitted to.

    Returns:
        A row for each recording: its name, `residual`, and the significant duration, and the
        magnitude and distance where all motions' are known, each the geometric mean over the
        recording's motions.
    """
    import pandas as pd

    recording = recordings_of(motions)
    table = {"recording": _named(motions, recording), "residual": recording_residuals(curve)}
    count = np.bincount(recording)
    for name, one in known_covariates(motions).items():
        table[name] = np.exp(np.bincount(recording, np.log(one.values)) / count)
    return pd.DataFrame(table)


def _named(motions: Sequence[Motion], recording: NDArray[np.intp]) -> list[str]:
    first = np.unique(recording, return_index=True)[1]
    origins = [(motions[k].origin, motions[k].name) for k in first]
    return [
        f"{origin.event} {origin.station}".strip() if origin and origin.event else name
        for origin, name in origins
    ]
