"""How good probabilities of falls are, against what was seen."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.resampling import ends, ratio, resamples, wilson_interval

BINS = np.linspace(0.0, 1.0, 6)  # of the reliability diagram


@dataclass(frozen=True, kw_only=True)
class Scores:
    """Scores of predicted probabilities.

    Attributes:
        tests: number of them.
        share_right: share in which the more likely outcome was seen.
        brier: mean square of probability minus outcome. Brier (1950).
        spiegelhalter: z of the probabilities being right, about normal if they are; NaN where all
            of them are 0 or 1. Spiegelhalter (1986).
    """

    tests: int
    share_right: float
    brier: float
    spiegelhalter: float


def scores(probability: ArrayLike, fell: ArrayLike) -> Scores:
    """Score probabilities of falls, shape (test,)."""
    p, y = np.asarray(probability, np.float64), np.asarray(fell, np.float64)
    away = 1.0 - 2.0 * p
    variance = float((np.square(away) * p * (1.0 - p)).sum())
    surprise = float(((y - p) * away).sum())
    return Scores(
        tests=p.size,
        share_right=float(((p > 0.5) == (y > 0.5)).mean()),
        brier=float(np.square(p - y).mean()),
        spiegelhalter=surprise / math.sqrt(variance) if variance else math.nan,
    )


def brier_difference(
    probability: ArrayLike,
    other: ArrayLike,
    fell: ArrayLike,
    group: NDArray[np.intp],
    seed: int = 0,
) -> tuple[float, float, float]:
    """Brier score of other probabilities less that of these, with its interval.

    Args:
        probability, other: of the same tests, (test,).
        fell: whether the body did, (test,).
        group: the recording of each test, from 0, (test,); the bootstrap draws recordings.
        seed: of the draws.

    Returns:
        The difference, above zero where these are better, and both ends of its interval.
    """
    p, q, y = (np.asarray(each, np.float64) for each in (probability, other, fell))
    gain = np.bincount(group, np.square(q - y) - np.square(p - y))
    drawn = ratio(gain, np.bincount(group), resamples(gain.size, seed=seed))
    low, high = ends(drawn[1:])
    return float(drawn[0]), low, high


@dataclass(frozen=True, kw_only=True, eq=False)
class Reliability:
    """Tests with like probabilities side by side, arrays of shape (bin,); empty bins left out.

    Attributes:
        tests: number in each bin.
        predicted: mean probability.
        seen: share that fell.
        low, high: Wilson's interval of that share, as if all tests were independent.
    """

    tests: NDArray[np.int64]
    predicted: NDArray[np.float64]
    seen: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]


def reliability(probability: ArrayLike, fell: ArrayLike) -> Reliability:
    """Compare predicted probabilities with observed shares, bin by bin."""
    p, y = np.asarray(probability, np.float64), np.asarray(fell, np.float64)
    at = np.clip(np.digitize(p, BINS) - 1, 0, BINS.size - 2)
    tests = np.bincount(at, minlength=BINS.size - 1)
    filled = tests > 0
    tests = tests[filled]
    predicted = np.bincount(at, p, BINS.size - 1)[filled] / tests
    seen = np.bincount(at, y, BINS.size - 1)[filled] / tests
    low, high = wilson_interval(seen, tests)
    return Reliability(tests=tests, predicted=predicted, seen=seen, low=low, high=high)
