"""How well a lognormal function fits, beside a logistic one and beside any that only rises."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.fragility.curve import Curve
from shaketable.fragility.lognormal import Points, probability
from shaketable.fragility.wild_score import score_p

Function = Callable[[Any], Any]


class Goodness(NamedTuple):
    """The fit of a lognormal function beside that of other functions to the same simulations.

    Attributes:
        deviance: of the lognormal fit.
        logistic_deviance: of a logistic one in the logarithm of the intensity; a smaller one fits
            better.
        logistic_median: the intensity at which that is a half.
        monotone_median: the same of the best function that only rises (isotonic regression).
        departure: the largest difference between that function and the lognormal one, where both
            are between 5 and 95 %.
        curvature_p: the probability by chance of such a curvature in ln x beside the lognormal,
            over earthquakes; small where the truth is not lognormal.
    """

    deviance: float
    logistic_deviance: float
    logistic_median: float
    monotone_median: float
    departure: float
    curvature_p: float


INSIDE = (0.05, 0.95)


def goodness(curve: Curve) -> Goodness:
    """How well a lognormal function fits the simulations that it was fitted to.

    Barlow R.E. and others (1972) Statistical inference under order restrictions, for the isotonic
    regression.

    Raises:
        InputError: an IDA, or a curve without a function.
    """
    from scipy.special import expit, log_expit, log_ndtr

    points = curve.data
    if curve.problem or not isinstance(points, Points):
        raise InputError("goodness is of a function that was fitted to simulations at levels")
    x = np.log(points.intensity)
    normal, _ = _regression(points, x, log_ndtr, _mills)
    logistic, half = _regression(points, x, log_expit, lambda eta: expit(-eta))
    levels, rising = monotone(points)
    smooth = probability(levels, curve.fits.median[0], curve.fits.beta[0])
    inside = (np.maximum(rising, smooth) > INSIDE[0]) & (np.minimum(rising, smooth) < INSIDE[1])
    away = np.abs(rising - smooth)[inside]
    return Goodness(
        normal,
        logistic,
        float(np.exp(half)),
        float(levels[np.argmax(rising >= 0.5)]) if rising[-1] >= 0.5 else np.inf,
        float(away.max()) if away.size else 0.0,
        score_p(points, (x - x.mean()) ** 2, curve.event[points.recording]),
    )


def _regression(
    points: Points,
    x: NDArray[np.float64],
    log_probability: Function,
    slope: Function,
) -> tuple[float, float]:
    """The binomial regression of largest likelihood: its deviance, and x where it is a half.

    McCullagh P. and Nelder J.A. (1989) Generalized Linear Models, sections 2.3 and 4.4.

    Args:
        points: what was reached.
        x: of each of them.
        log_probability: of the predictor η, symmetric: the other outcome's is that of -η.
        slope: its derivative.
    """
    from scipy.optimize import minimize
    from scipy.special import xlogy

    reached, missed = points.reached, points.trials - points.reached
    middle, width = x.mean(), x.std()
    line = np.column_stack([np.ones_like(x), (x - middle) / width])

    def loss(coefficients: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        eta = line @ coefficients
        value = reached @ log_probability(eta) + missed @ log_probability(-eta)
        return -value, -(reached * slope(eta) - missed * slope(-eta)) @ line

    found = minimize(loss, np.zeros(2), jac=True, method="BFGS", options={"gtol": 1e-9})
    best = xlogy(reached, reached / points.trials) + xlogy(missed, missed / points.trials)
    return max(0.0, 2.0 * float(found.fun + best.sum())), middle - width * found.x[0] / found.x[1]


def _mills(eta: NDArray[np.float64]) -> NDArray[np.float64]:
    """The derivative of ln Φ."""
    from scipy.special import log_ndtr

    return np.asarray(np.exp(-0.5 * eta**2 - log_ndtr(eta)) / math.sqrt(2.0 * math.pi))


def monotone(points: Points) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Levels, rising, and the rising probabilities of the largest likelihood there."""
    from scipy.optimize import isotonic_regression

    levels, at = np.unique(points.intensity, return_inverse=True)
    reached, trials = np.bincount(at, points.reached), np.bincount(at, points.trials)
    return levels, np.asarray(isotonic_regression(reached / trials, weights=trials).x)
