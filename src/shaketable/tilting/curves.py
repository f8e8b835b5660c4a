"""What tilts do to one body: which way it falls, how often, and the tilt that controls it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.recordings import interval, pair
from shaketable.tilting.counts import TiltCounts
from shaketable.tilting.rates import control_share, control_tilt, fall_share

Interval = tuple[float, float]
Band = tuple[NDArray[np.float64], NDArray[np.float64]]


@dataclass(frozen=True, kw_only=True, eq=False)
class TiltCurves:
    """Shares of one body over the tilt; intervals are by bootstrap over recordings.

    Attributes:
        tilts: β [rad], shape (t,).
        control: share of the falls that go downhill, (t,), NaN where they are too few to tell;
            control_band: ends of its interval.
        falls, falls_band: share of the simulations that overturn it, (t,), NaN where it does not
            stand by itself.
        tilt, tilt_interval: the smallest tilt from which on the wanted control is kept [rad];
            infinite if no tilt does, NaN if too few fall to tell.
        falls_at_tilt, falls_at_tilt_interval: share that falls there; NaN without a tilt.
    """

    tilts: NDArray[np.float64]
    control: NDArray[np.float64]
    control_band: Band
    falls: NDArray[np.float64]
    falls_band: Band
    tilt: float
    tilt_interval: Interval
    falls_at_tilt: float
    falls_at_tilt_interval: Interval


def curves_of(counts: TiltCounts, weights: NDArray[np.float64], control: float) -> TiltCurves:
    """Shares of the only body of `counts`.

    Args:
        counts: of one body.
        weights: of what was observed and of draws, as `resamples` gives them.
        control: wanted share of the falls that go downhill.
    """
    shares, falls = control_share(counts, weights)[:, 0], fall_share(counts, weights)[:, 0]
    tilts = control_tilt(counts.tilts, shares, control)
    stands = counts.stands[0]
    at = np.full(len(weights), np.nan)
    if np.isfinite(tilts[0]):
        at = np.array([np.interp(tilts[0], counts.tilts[stands], row[stands]) for row in falls])
    return TiltCurves(
        tilts=counts.tilts,
        control=shares[0],
        control_band=interval(shares[1:]),
        falls=falls[0],
        falls_band=interval(falls[1:]),
        tilt=float(tilts[0]),
        tilt_interval=pair(tilts[1:]),
        falls_at_tilt=float(at[0]),
        falls_at_tilt_interval=pair(at[1:]),
    )
