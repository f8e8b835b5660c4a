"""What falls in one earthquake, from fragility functions.

Where ln of the measure is normal with mean μ and standard deviation σ, and the function lognormal,
the probability of a fall is Φ((μ - ln θ)/√(σ² + β²)).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.fragility import Curve, Fragility
from shaketable.fragility.lognormal import ndtr
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

    Ground-motion models and ShakeMaps give the median component of a site, or the larger one; a
    fragility function is of one component. What single components differ by, some 0.2 in ln, is
    not in sigma.

    Args:
        fragility: one function, of the ground's measure.
        mean, sigma: of ln of the measure [SI], as `Scenario.of` gives them.

    Raises:
        InputError: several functions, or one of a floor's measure.
    """
    curve = fragility.curve if isinstance(fragility, Fragility) else fragility
    curve.require_ground("the earthquake's shaking")
    if curve.problem:
        return FallProbability(np.nan, np.nan, np.nan)
    value = float(probabilities(curve.median, curve.beta, mean, sigma))
    median, beta = curve.drawn
    if median.size == 0:
        return FallProbability(value, np.nan, np.nan)
    return FallProbability(value, *ends(probabilities(median, beta, mean, sigma)))


def probabilities(
    median: ArrayLike, beta: ArrayLike, mean: ArrayLike, sigma: ArrayLike
) -> NDArray[np.float64]:
    """Φ((μ - ln θ)/√(σ² + β²)) of shapes that are broadcast; θ in SI."""
    spread = np.hypot(np.asarray(sigma, np.float64), np.asarray(beta, np.float64))
    return ndtr((np.asarray(mean, np.float64) - np.log(median)) / np.maximum(spread, 1e-12))
