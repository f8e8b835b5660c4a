"""Shares, control and tilts from counts, with intervals by bootstrap over recordings.

A bootstrap draws as many recordings as there are, with replacement, many times (Efron B. (1979)
Bootstrap methods: another look at the jackknife, Ann. Statist. 7(1):1-26). A draw is a row of
weights, how often each recording was taken; a row of ones is what was observed. So every result
below takes weights of shape (k, recording) and has k as its first axis.
"""

from __future__ import annotations

import logging

import numpy as np
from numpy.typing import NDArray

from shaketable.tilting.counts import TiltCounts

log = logging.getLogger(__name__)

CONFIDENCE = 0.95
FEWEST_FALLS = 10  # below it no direction is judged
FEWEST_RECORDINGS = 10  # below it intervals are said to mean little


def resamples(counts: TiltCounts, number: int, seed: int = 0) -> NDArray[np.float64]:
    """Weights of `number` draws after one of what was observed, shape (1 + number, recording)."""
    size = counts.falls.shape[2]
    if number and size < FEWEST_RECORDINGS:
        log.warning(
            "intervals over so few recordings (%d) mean little: use %d or more",
            size,
            FEWEST_RECORDINGS,
        )
    drawn = np.random.default_rng(seed).multinomial(size, np.full(size, 1 / size), size=number)
    return np.vstack([np.ones(size), drawn])


def fall_share(counts: TiltCounts, weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Share of the simulations that overturn the body, (k, body, t); NaN where none was made."""
    simulations = (weights @ counts.simulations.T)[..., None]
    with np.errstate(invalid="ignore", divide="ignore"):
        share = _weighted(counts.falls, weights) / simulations
    return np.where(counts.stands, share, np.nan)


def control_share(counts: TiltCounts, weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Share of the overturnings that go downhill, (k, body, t).

    NaN where fewer than FEWEST_FALLS were observed, and in draws without any.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        share = _weighted(counts.downhill, weights) / _weighted(counts.falls, weights)
    return np.where(counts.falls.sum(axis=2) >= FEWEST_FALLS, share, np.nan)


def _weighted(values: NDArray[np.int64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.moveaxis(values @ weights.T, 2, 0)


def control_tilt(
    tilts: NDArray[np.float64], share: NDArray[np.float64], control: float
) -> NDArray[np.float64]:
    """The smallest tilt from which on `control` of the falls go downhill, interpolated.

    Args:
        tilts: rising, shape (t,), in any unit.
        share: of the falls that go downhill, (..., t), NaN where they are too few to tell.
        control: wanted share.

    Returns:
        in the unit of `tilts`, shape (...): infinite if no tilt does, NaN if too few fall at the
        tilt before to tell.
    """
    short = ~(share >= control) & np.isfinite(share)
    backwards = np.concatenate([short[..., ::-1], np.ones_like(short[..., :1])], axis=-1)
    before = share.shape[-1] - 1 - np.argmax(backwards, axis=-1)  # the last that falls short, or -1
    padded = np.concatenate([share, np.full_like(share[..., :1], np.nan)], axis=-1)
    low, high = (
        np.take_along_axis(padded, index[..., None], -1)[..., 0]
        for index in (np.maximum(before, 0), before + 1)
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        part = np.where(before < 0, 1.0, (control - low) / (high - low))
    ends = np.append(tilts, np.nan)
    between = ends[np.maximum(before, 0)] * (1.0 - part) + ends[before + 1] * part
    missing = np.where(before < 0, np.nan, np.inf)
    return np.asarray(np.where(high >= control, between, missing))


def interval(draws: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The CONFIDENCE interval of drawn values along their first axis, NaN left out.

    Values that were drawn, none between: some may be infinite.
    """
    tails = [(1.0 - CONFIDENCE) / 2, (1.0 + CONFIDENCE) / 2]
    count = (~np.isnan(draws)).sum(axis=0)
    ordered = np.sort(draws, axis=0)  # NaN last
    ends = []
    for tail in tails:
        index = np.clip(np.ceil(tail * count).astype(np.intp) - 1, 0, draws.shape[0] - 1)
        ends.append(np.take_along_axis(ordered, index[None], 0)[0])
    return ends[0], ends[1]
