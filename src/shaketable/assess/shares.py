"""Shares and quartiles of simulations."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.resampling import wilson_interval

QUARTERS = (0.25, 0.5, 0.75)


class Share(NamedTuple):
    """A share in [0, 1] with its 95 % interval; NaN where it cannot be told."""

    value: float
    low: float
    high: float


UNKNOWN = Share(math.nan, math.nan, math.nan)


class Quartiles(NamedTuple):
    """Observed values: a quarter, a half and three quarters of all are at most that large."""

    lower: float
    median: float
    upper: float


def apart(one: Share, other: Share) -> bool:
    """Whether each of two shares lies outside the other's interval."""
    return not (one.low <= other.value <= one.high or other.low <= one.value <= other.high)


def agree(one: Share, other: Share) -> bool:
    """Whether each of two shares lies inside the other's interval."""
    return one.low <= other.value <= one.high and other.low <= one.value <= other.high


def is_worse(one: Share, other: Share) -> bool:
    """Whether one share is larger than another, and either lies outside the other's interval."""
    return one.value > other.value and not agree(one, other)


def share_of(happened: NDArray[np.bool_], recordings: int) -> Share:
    """The share of simulations in which something happened, with Wilson's interval."""
    share = float(happened.mean())
    return Share(share, *_interval(share, recordings))


@lru_cache(maxsize=10_000)  # of so many objects the shares are few, as motions are
def _interval(share: float, recordings: int) -> tuple[float, float]:
    low, high = wilson_interval(share, recordings)
    return float(low), float(high)


def observed(values: NDArray[np.float64], share: float) -> float:
    """The observed value that a share of all does not exceed; NaN if there are no values."""
    return float(np.quantile(values, share, method="inverted_cdf")) if values.size else np.nan


def observed_quartiles(values: NDArray[np.float64]) -> Quartiles:
    """Quartiles that were observed; NaN if there are no values.

    They are not interpolated, as nothing was ever half way between a rotation that stood and 90°.
    """
    return Quartiles(*(observed(values, quarter) for quarter in QUARTERS))
