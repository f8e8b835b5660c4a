"""What tilts do to one body: which way it falls, how often, and the tilt that controls it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.resampling import ends, wilson_interval
from shaketable.tilting.counts import TiltCounts
from shaketable.tilting.rates import control_tilt, downhill_interval, downhill_share, fall_share

MOST_UNDECIDED = 0.05  # of the draws: with more, an interval of the rest would mean nothing

Interval = tuple[float, float]
Band = tuple[NDArray[np.float64], NDArray[np.float64]]


@dataclass(frozen=True, kw_only=True, eq=False)
class TiltCurves:
    """Shares of one body over the tilt, with intervals as in `resampling`.

    Attributes:
        tilts: β [rad], shape (t,).
        downhill_share, downhill_band: share of the falls that go downhill, and the ends of its
            interval, (t,); NaN where there are too few falls to tell.
        fall_share, fall_band: share of the simulations that overturn the body, and Wilson's
            interval with the recordings as experiments, (t,); NaN where the body does not stand by
            itself.
        control_tilt, control_tilt_interval: the smallest of the tilts from which on the wanted
            share of the falls goes downhill [rad]; infinite if there is none, NaN if there are too
            few falls to tell. The interval is NaN if too many draws cannot tell.
        fall_share_there, fall_share_there_interval: at the control tilt; NaN without one.
    """

    tilts: NDArray[np.float64]
    downhill_share: NDArray[np.float64]
    downhill_band: Band
    fall_share: NDArray[np.float64]
    fall_band: Band
    control_tilt: float
    control_tilt_interval: Interval
    fall_share_there: float
    fall_share_there_interval: Interval


def curves_of(counts: TiltCounts, weights: NDArray[np.float64], control: float) -> TiltCurves:
    """Shares of the only body of `counts`.

    Args:
        counts: the counts of one body.
        weights: those of what was observed and of draws, as `resamples` gives them.
        control: wanted share of the falls that go downhill.
    """
    downhill = downhill_share(counts, weights)
    low, high = downhill_interval(counts, downhill)
    shares, falls = downhill[:, 0], fall_share(counts, weights)[:, 0]
    stands = counts.stands[0]
    tilts = counts.tilts[stands]
    crossings = control_tilt(tilts, shares[:, stands], control)
    # take a tilt that was tried, so that its effect is one that was simulated
    tried = np.searchsorted(tilts, crossings - 1e-12)
    draws = np.where(np.isfinite(crossings), np.append(tilts, np.inf)[tried], crossings)
    share, fall = shares[0].copy(), falls[0].copy()  # a view would keep all draws in memory
    there = fall[tried[0]] if np.isfinite(draws[0]) else np.nan
    undecided = np.isnan(draws[1:]).mean() > MOST_UNDECIDED
    return TiltCurves(
        tilts=counts.tilts,
        downhill_share=share,
        downhill_band=(low[0], high[0]),
        fall_share=fall,
        fall_band=wilson_interval(fall, counts.recordings),
        control_tilt=float(draws[0]),
        control_tilt_interval=(np.nan, np.nan) if undecided else ends(draws[1:]),
        fall_share_there=float(there),
        fall_share_there_interval=share_interval(float(there), counts.recordings),
    )


def share_interval(share: float, recordings: int) -> Interval:
    """Wilson's interval for one share of simulations."""
    low, high = wilson_interval(share, recordings)
    return float(low), float(high)
