"""Shares, control and tilts from counts; weights and draws as in `resampling`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.resampling import interval, ratio, wilson_interval
from shaketable.tilting.counts import TiltCounts

FEWEST_FALLS = 10  # with fewer falls no direction is judged


def fall_share(counts: TiltCounts, weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Share of the simulations that overturn the body, (k, body, t); NaN where there are none."""
    share = ratio(counts.falls, counts.simulations[:, None], weights)
    return np.where(counts.stands, share, np.nan)


def downhill_share(counts: TiltCounts, weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Share of the overturnings that go downhill, (k, body, t).

    NaN where fewer than FEWEST_FALLS were observed, and in draws without any.
    """
    share = ratio(counts.downhill, counts.falls, weights)
    return np.where(counts.falls.sum(axis=2) >= FEWEST_FALLS, share, np.nan)


def downhill_interval(
    counts: TiltCounts, share: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The ends of the interval of `downhill_share`, (body, t) each.

    Where all falls go one way no draw can differ: there Wilson's interval takes the recordings
    with falls as experiments.

    Args:
        counts: those of the share.
        share: of what was observed and of draws, (k, body, t).
    """
    low, high = interval(share[1:])
    with_falls = (counts.falls > 0).sum(axis=2)
    lowest, highest = wilson_interval(share[0], with_falls)
    one_way = (share[0] == 0.0) | (share[0] == 1.0)
    return np.where(one_way, lowest, low), np.where(one_way, highest, high)


def control_tilt(
    tilts: NDArray[np.float64], share: NDArray[np.float64], control: float
) -> NDArray[np.float64]:
    """The tilt from which on a share `control` of the falls goes downhill, interpolated.

    Args:
        tilts: rising tilts on which the body stands, shape (t,), in any unit.
        share: share of the falls that go downhill, (..., t), NaN where they are too few to tell.
        control: wanted share.

    Returns:
        Tilts in the unit of `tilts`, shape (...): infinite if the last tilt still falls short, NaN
        if there are too few falls at a neighbouring tilt to tell.
    """
    before = last_short(share, control)
    padded = np.concatenate([share, np.full_like(share[..., :1], np.nan)], axis=-1)
    low, high = (
        np.take_along_axis(padded, index[..., None], -1)[..., 0]
        for index in (np.maximum(before, 0), before + 1)
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        part = np.where(before < 0, 1.0, (control - low) / (high - low))
    ends = np.append(tilts, np.nan)
    between = ends[np.maximum(before, 0)] * (1.0 - part) + ends[before + 1] * part
    missing = np.where(before == share.shape[-1] - 1, np.inf, np.nan)
    return np.asarray(np.where(high >= control, between, missing))


def last_short(share: NDArray[np.float64], control: float) -> NDArray[np.intp]:
    """Index (...) of the last tilt at which a share (..., t) is known to fall short, or -1."""
    short = ~(share >= control) & np.isfinite(share)
    backwards = np.concatenate([short[..., ::-1], np.ones_like(short[..., :1])], axis=-1)
    return np.asarray(share.shape[-1] - 1 - np.argmax(backwards, axis=-1))
