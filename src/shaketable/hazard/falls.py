"""What falls in one earthquake, from fragility functions.

Where ln of the measure is normal with mean μ and standard deviation σ, and the function lognormal,
the probability of a fall is Φ((μ - ln θ)/√(σ² + β²)).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError
from shaketable.fragility import Curve, Fragility
from shaketable.fragility.curve import GROUND
from shaketable.fragility.lognormal import ndtr, reflected
from shaketable.resampling import ends


class FallProbability(NamedTuple):
    """The probability that an object falls in an earthquake, with its 95 % interval.

    The interval is that of the fragility function.
    """

    value: float
    low: float
    high: float


def fall_probability(fragility: Fragility | Curve, mean: float, sigma: float) -> FallProbability:
    """The probability of a fall.

    Args:
        fragility: one function, of the ground's measure.
        mean, sigma: of ln of the measure [SI], as `Scenario.of` gives them.

    Raises:
        InputError: several functions, or one of a floor's measure.
    """
    curve = fragility.curve if isinstance(fragility, Fragility) else fragility
    if curve.place != GROUND:
        raise InputError(
            f"the fragility function is of {curve.measure.name} on {curve.place}, the earthquake's "
            "is that of the ground: give the ground's motions to fragility(..., ground=...)"
        )
    if curve.problem:
        return FallProbability(np.nan, np.nan, np.nan)
    value = float(probabilities(curve.median, curve.beta, mean, sigma))
    if not np.isfinite(curve.median_interval).all():
        return FallProbability(value, np.nan, np.nan)
    median, beta = (reflected(one) for one in curve.widened)
    known = np.isfinite(median) & np.isfinite(beta)
    return FallProbability(value, *ends(probabilities(median[known], beta[known], mean, sigma)))


def probabilities(
    median: ArrayLike, beta: ArrayLike, mean: ArrayLike, sigma: ArrayLike
) -> NDArray[np.float64]:
    """Φ((μ - ln θ)/√(σ² + β²)) of shapes that are broadcast; θ in SI."""
    spread = np.hypot(np.asarray(sigma, np.float64), np.asarray(beta, np.float64))
    return ndtr((np.asarray(mean, np.float64) - np.log(median)) / np.maximum(spread, 1e-12))
