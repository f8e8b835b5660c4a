"""A sketch of many values from which quantiles can be told, and which can be added up.

Values are counted in bins whose ends grow by a factor: the middle of a bin is off by half a bin at
most. (The idea of DDSketch, Masson, Rim and Lee 2019, with fixed ends.)
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

SMALLEST, GROWTH = 1e-4, 1.1  # rad: smaller rotations count as none
LARGEST = math.pi / 2  # rad, of a body that fell
MIDDLE = math.ceil(math.log(LARGEST / SMALLEST) / math.log(GROWTH))
BINS = MIDDLE + 2  # below, between, fallen
#: The value that stands for each bin [rad].
VALUES = np.concatenate(
    [[0.0], np.minimum(SMALLEST * GROWTH ** (np.arange(MIDDLE) + 0.5), LARGEST), [LARGEST]]
)
ACCURACY = math.sqrt(GROWTH) - 1.0  # of a quantile, relative


def bins_of(values: ArrayLike, fallen: ArrayLike) -> NDArray[np.intp]:
    """The bin of each value [rad]; what has fallen is in the last one."""
    with np.errstate(divide="ignore"):
        k = np.floor(np.log(np.asarray(values) / SMALLEST) / math.log(GROWTH))
    return np.where(fallen, BINS - 1, np.clip(k, -1, MIDDLE - 1).astype(np.intp) + 1)


def quantile(counts: ArrayLike, share: float) -> NDArray[np.float64]:
    """The value below which a share of what was counted lies; counts (..., bin), NaN of none."""
    total = np.cumsum(np.asarray(counts, np.float64), axis=-1)
    every = total[..., -1:]
    at = (total < share * every).sum(axis=-1)
    return np.where(every[..., 0] > 0.0, VALUES[np.minimum(at, BINS - 1)], np.nan)
