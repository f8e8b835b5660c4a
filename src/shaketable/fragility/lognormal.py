"""Fit lognormal fragility functions by maximum likelihood.

The probability that a state is reached at an intensity x is Φ(ln(x/θ)/β): a probit regression on
ln x. Baker J.W. (2015) Efficient analytical fragility function fitting using dynamic structural
analysis, Earthquake Spectra 31(1):579-599, eqs. 7-11. A bootstrap fits hundreds of draws: here they
are scored side by side (McCullagh and Nelder 1989, section 2.5); a test holds one fit against that
of statsmodels. Levels at which each motion first overturns a body are a sample of the lognormal
itself, cut off at the highest level tried (Baker's eqs. 1-4).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.resampling import ends

AT_ONCE = 2**20  # numbers of an array: some 8 MB, of which a fit takes a dozen
STEPS = 60  # of scoring at most; it doubles its digits in each
CLOSE = 1e-12  # of a coefficient: it stands still
MIN_FITTED_SHARE = 0.9  # of the draws of a bootstrap must have a fit, or there is no interval
FARTHEST = 8.0  # standard deviations; beyond, a probability is 0 or 1 to round-off


class Points(NamedTuple):
    """How often a state was reached.

    Attributes:
        intensity: > 0, (n,).
        reached, trials: numbers, (n,).
        recording: from 0, (n,).
    """

    intensity: NDArray[np.float64]
    reached: NDArray[np.int64]
    trials: NDArray[np.int64]
    recording: NDArray[np.intp]


class Capacities(NamedTuple):
    """The lowest levels at which a state was reached.

    Attributes:
        level: > 0; where it was not reached, the highest that was tried, (n,).
        reached: whether it was, (n,).
        recording: from 0, (n,).
    """

    level: NDArray[np.float64]
    reached: NDArray[np.bool_]
    recording: NDArray[np.intp]


class Fits(NamedTuple):
    """Medians θ and dispersions β, one of each set of weights; NaN where nothing can be fitted.

    Where no intensity at which the state was reached lies below one at which it was not, β is 0
    and θ lies between them, or at the only level where both were seen.
    """

    median: NDArray[np.float64]
    beta: NDArray[np.float64]


def fit_many(points: Points, weights: NDArray[np.float64]) -> Fits:
    """Fits to many sets of weights.

    Args:
        points: what was observed.
        weights: of each recording, (set, recording), as `resampling.resamples` gives them.
    """
    some = max(1, AT_ONCE // points.intensity.size)
    parts = [_fit(points, weights[k : k + some]) for k in range(0, len(weights), some)]
    return Fits(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def _fit(points: Points, weights: NDArray[np.float64]) -> Fits:
    """Fits to sets of weights, side by side."""
    x = np.log(points.intensity)
    center, spread = float(x.mean()), float(x.std()) or 1.0
    z = (x - center) / spread
    often = weights[:, points.recording]
    reached, missed = often * points.reached, often * (points.trials - points.reached)
    total = reached + missed
    some = (reached.sum(axis=1) > 0.0) & (missed.sum(axis=1) > 0.0)
    highest = np.where(missed > 0.0, x, -np.inf).max(axis=1)
    lowest = np.where(reached > 0.0, x, np.inf).min(axis=1)
    ordered = some & (highest <= lowest)
    median = np.full(len(weights), np.nan)
    beta = np.full(len(weights), np.nan)
    median[ordered] = np.exp((highest[ordered] + lowest[ordered]) / 2.0)
    beta[ordered] = 0.0
    todo = np.flatnonzero(some & ~ordered)
    if todo.size:
        columns = np.stack([np.ones_like(z), z])
        first = scored(columns, reached[todo[:1]], total[todo[:1]])
        rest = scored(columns, reached[todo[1:]], total[todo[1:]], first[0])
        a, b = np.concatenate([first, rest]).T
        rising = b > 0.0
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            median[todo] = np.where(rising, np.exp(center - spread * a / b), np.nan)
            beta[todo] = np.where(rising, spread / b, np.nan)
    return Fits(median, beta)


def scored(
    columns: NDArray[np.float64],
    reached: NDArray[np.float64],
    total: NDArray[np.float64],
    near: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """Coefficients of probit regressions by Fisher scoring, (set, column).

    Args:
        columns: of what a state depends on, of about unit size, the first of them ones, (column,
            n).
        reached, total: how often it was reached in how many trials, (set, n).
        near: coefficients near those of all sets, (column,), from which fewer steps are needed.

    Returns:
        NaN where the likelihood has no largest value, as all or none reached the state, or what
        reached it can be told from what did not.
    """
    often = reached.sum(axis=1)
    some = (often > 0.0) & (often < total.sum(axis=1))
    if not some.all():
        found = np.full((len(total), len(columns)), np.nan)
        if some.any():
            found[some] = scored(columns, reached[some], total[some], near)
        return found
    coefficients = np.zeros((len(total), len(columns)))
    coefficients[:, 1] = 1.0
    coefficients[:, 0] = _inverse(often / total.sum(axis=1))
    if near is not None and np.isfinite(near).all():
        coefficients[:] = near
    pairs = (columns[:, None] * columns).reshape(-1, columns.shape[1]).T
    square = (-1, len(columns), len(columns))
    left = np.arange(len(total))  # sets that still move
    for _ in range(STEPS):
        eta = np.clip(coefficients[left] @ columns, -FARTHEST, FARTHEST)
        tail = ndtr(-np.abs(eta))  # exact where it is small
        mean = np.where(eta > 0.0, 1.0 - tail, tail)
        density = np.exp(-0.5 * eta * eta) / np.sqrt(2.0 * np.pi)
        variance = tail * (1.0 - tail)
        information = (total[left] * density * density / variance @ pairs).reshape(square)
        score = ((reached[left] - total[left] * mean) * density / variance) @ columns.T
        move = (np.linalg.pinv(information, hermitian=True) @ score[:, :, None])[:, :, 0]
        longest = np.abs(move).max(axis=1)
        coefficients[left] += np.minimum(1.0, 2.0 / np.maximum(longest, 1e-300))[:, None] * move
        left = left[longest > CLOSE * (1.0 + np.abs(coefficients[left]).sum(axis=1))]
        if not left.size:
            break
    coefficients[left] = np.nan
    return coefficients


def _inverse(share: NDArray[np.float64]) -> NDArray[np.float64]:
    from scipy.special import ndtri

    return np.asarray(ndtri(share))


def ndtr(z: NDArray[np.float64]) -> NDArray[np.float64]:
    """Φ; imported when it is used, as SciPy takes long to load."""
    from scipy.special import ndtr as phi

    return np.asarray(phi(z))


def hazard(z: NDArray[np.float64]) -> NDArray[np.float64]:
    """φ(z)/Φ(-z), the mean of a standard normal above z."""
    return np.asarray(np.exp(-0.5 * z * z) / np.sqrt(2.0 * np.pi) / np.maximum(ndtr(-z), 1e-300))


def fit_capacities(capacities: Capacities, weights: NDArray[np.float64]) -> Fits:
    """Fits to capacities, of which those that were not reached are known to be higher.

    Where all were reached θ and β are the mean and the standard deviation of their logarithms,
    else those of the largest likelihood, by expectation and maximisation (Dempster, Laird and
    Rubin 1977): what is not known is replaced by its mean and variance above the limit.

    Args:
        capacities: what was found.
        weights: of each recording, (set, recording).
    """
    x, often = np.log(capacities.level), weights[:, capacities.recording]
    total = often.sum(axis=1)
    known = (often * capacities.reached).sum(axis=1) > 1.0
    mean = (often @ x) / total
    spread = np.sqrt(np.maximum(often @ (x * x) / total - mean * mean, 1e-12))
    for _ in range(2000 if not capacities.reached.all() else 1):
        z = (x - mean[:, None]) / spread[:, None]
        above = hazard(z)
        first = np.where(capacities.reached, x, mean[:, None] + spread[:, None] * above)
        more = np.where(capacities.reached, 0.0, 1.0 + z * above - above * above)
        new_mean = (often * first).sum(axis=1) / total
        squares = (first - new_mean[:, None]) ** 2 + more * spread[:, None] ** 2
        new_spread = np.sqrt((often * squares).sum(axis=1) / total)
        moved = np.maximum(np.abs(new_mean - mean), np.abs(new_spread - spread))
        mean, spread = new_mean, new_spread
        if (moved[known] < CLOSE).all():
            break
    return Fits(np.where(known, np.exp(mean), np.nan), np.where(known, spread, np.nan))


def reflected(draws: NDArray[np.float64]) -> NDArray[np.float64]:
    """Draws of a bootstrap mirrored about what was observed, in their logarithms.

    Their percentiles are the basic bootstrap limits (Davison and Hinkley 1997, section 5.2), which
    allow for the bias of β over few earthquakes; those of the draws themselves cover too seldom
    (`python -m benchmarks.fragility`).

    Args:
        draws: what was observed, then the draws, (1 + draw, ...); positive.

    Returns:
        (draw, ...).
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(draws[:1] ** 2 / draws[1:])


def basic_limits(draws: NDArray[np.float64]) -> tuple[float, float]:
    """The 95 % interval of a positive quantity, by the basic bootstrap.

    Args:
        draws: what was observed, then the draws, (1 + draw,).

    Returns:
        Both ends; NaN without draws, or where fewer than MIN_FITTED_SHARE of them could be fitted.
    """
    if (
        draws.size < 2
        or not np.isfinite(draws[0])
        or np.isfinite(draws[1:]).mean() < MIN_FITTED_SHARE
    ):
        return np.nan, np.nan
    low, high = ends(reflected(draws))
    return (low, high) if np.isfinite(high) else (np.nan, np.nan)


def probability(
    intensity: NDArray[np.float64], median: NDArray[np.float64], beta: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Φ(ln(x/θ)/β), of shapes that are broadcast; a step where β is 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        z = np.log(np.asarray(intensity) / median) / beta
    return np.asarray(ndtr(z))
