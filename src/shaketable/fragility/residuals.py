"""Residuals of recordings about a fragility function, against covariates of their motions.

A recording's residual is ln of its own median over that of all, with β of all: by what share of
the measure more, or less, than the median it takes to reach the state. A measure is sufficient
where residuals do not depend on magnitude, distance or duration (Luco and Cornell 2007).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError
from shaketable.fragility.covariates import known_covariates
from shaketable.fragility.curve import Curve
from shaketable.fragility.lognormal import Capacities, hazard, ndtr
from shaketable.motion import Motion
from shaketable.resampling import recording_names, recordings_of

if TYPE_CHECKING:
    import pandas as pd

FARTHEST = 5.0  # of a residual: a factor of 148 on the measure
HALVINGS = 60


def recording_residuals(curve: Curve) -> NDArray[np.float64]:
    """The residual of each recording, with β of all, (recording,).

    Of an IDA a level that was not reached is known to be higher. NaN where a recording never
    reached the state, or did at every level of a cloud or stripes; and where the curve has no
    function.
    """
    if curve.problem:
        return np.full(curve.recordings, np.nan)
    data, recordings = curve.data, curve.recordings

    def summed(values: ArrayLike) -> NDArray[np.float64]:
        return np.bincount(data.recording, np.asarray(values), recordings).astype(np.float64)

    if isinstance(data, Capacities):
        away, some = np.log(data.level / curve.median), summed(data.reached) > 0
    else:
        away, wanted = np.log(data.intensity / curve.median), summed(data.reached)
        some = (wanted > 0) & (wanted < summed(data.trials))
    low, high = np.full(recordings, -FARTHEST), np.full(recordings, FARTHEST)
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        z = (away - middle[data.recording]) / curve.fits.beta[0]
        if isinstance(data, Capacities):
            score = summed(np.where(data.reached, z, hazard(z)))
        else:
            score = summed(data.trials * ndtr(z) - data.reached)
        low, high = np.where(score > 0.0, middle, low), np.where(score > 0.0, high, middle)
    return np.where(some, (low + high) / 2.0, np.nan)


def residuals(curve: Curve, motions: Sequence[Motion]) -> pd.DataFrame:
    """The residual of each recording, beside what is known of it.

    Args:
        curve: a function.
        motions: those that it was fitted to, or of its ground; in their order.

    Returns:
        A row for each recording: body, limit state, measure, the recording's name, `residual`, and
        the significant duration, and the magnitude and distance where all motions' are known, each
        the geometric mean over the recording's motions.

    Raises:
        InputError: other motions.
    """
    import pandas as pd

    recording = recordings_of(motions)
    if recording_names(motions) != curve.recording_names:
        raise InputError("motions= must be those that the curve was fitted to, in their order")
    table = {
        "body": curve.body.name,
        "limit_state": curve.state.name,
        "measure": curve.measure.name,
        "recording": curve.recording_names,
        "residual": recording_residuals(curve),
    }
    count = np.bincount(recording)
    for name, one in known_covariates(motions).items():
        table[name] = np.exp(np.bincount(recording, np.log(one.values)) / count)
    return pd.DataFrame(table)
