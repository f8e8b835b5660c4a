"""How well a lognormal function fits, beside a logistic one and beside any that only rises."""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.fragility.curve import Curve
from shaketable.fragility.lognormal import Points, probability
from shaketable.fragility.score_test import score_p


class Goodness(NamedTuple):
    """How a lognormal function compares with others, of the same simulations.

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
    import statsmodels.api as sm

    points = curve.data
    if curve.problem or not isinstance(points, Points):
        raise InputError("goodness is of a function that was fitted to simulations at levels")
    x = np.log(points.intensity)
    counts = np.column_stack([points.reached, points.trials - points.reached])
    line = sm.add_constant(x)
    probit = sm.families.Binomial(sm.families.links.Probit())
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of separation, which the deviance tells
        normal = sm.GLM(counts, line, family=probit).fit()
        logistic = sm.GLM(counts, line, family=sm.families.Binomial()).fit()
    levels, rising = monotone(points)
    smooth = probability(levels, curve.fits.median[0], curve.fits.beta[0])
    inside = (np.maximum(rising, smooth) > INSIDE[0]) & (np.minimum(rising, smooth) < INSIDE[1])
    away = np.abs(rising - smooth)[inside]
    return Goodness(
        float(normal.deviance),
        float(logistic.deviance),
        float(np.exp(-logistic.params[0] / logistic.params[1])),
        float(levels[np.argmax(rising >= 0.5)]) if rising[-1] >= 0.5 else np.inf,
        float(away.max()) if away.size else 0.0,
        score_p(points, (x - x.mean()) ** 2, curve.event[points.recording]),
    )


def monotone(points: Points) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Levels, rising, and the rising probabilities of the largest likelihood there."""
    from scipy.optimize import isotonic_regression

    levels, at = np.unique(points.intensity, return_inverse=True)
    reached, trials = np.bincount(at, points.reached), np.bincount(at, points.trials)
    return levels, np.asarray(isotonic_regression(reached / trials, weights=trials).x)
