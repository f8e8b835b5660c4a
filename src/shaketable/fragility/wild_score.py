"""Whether anything beside ln of the intensity changes a probit regression, over few earthquakes.

Standard errors that are robust to clusters are too small where there are few of them: over the 14
earthquakes of FEMA P-695's far-field suite they find effects where there are none more than twice
as often as they should (`python -m benchmarks.fragility`). Here the score of the effect, summed by
earthquake, is compared with what it would be if the signs of the earthquakes' parts were drawn at
random (Kline P., Santos A. (2012) A score based approach to wild bootstrap inference, J.
Econometric Methods 1(1):23-41).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.fragility.lognormal import FARTHEST, Points, ndtr, scored

FLIPS = 1999  # drawn signs; all of them where there are fewer
FEWEST = 5  # earthquakes: with fewer no p-value below 1/16 is possible


def score_p(
    points: Points, beside: NDArray[np.float64], cluster: NDArray[np.intp], seed: int = 0
) -> float:
    """The probability by chance of such an effect of a quantity beside ln of the intensity.

    Args:
        points: what was observed.
        beside: the quantity at each point, (n,).
        cluster: the earthquake of each point, (n,).
        seed: of the drawn signs.

    Returns:
        NaN where nothing can be fitted, the quantity is the same everywhere, or there are fewer
        than FEWEST earthquakes.
    """
    count = int(cluster.max()) + 1
    x = np.log(points.intensity)
    spread = float(x.std())
    if count < FEWEST or spread == 0.0 or np.ptp(beside) == 0.0:
        return np.nan
    columns = np.stack([np.ones_like(x), (x - x.mean()) / spread])
    reached, trials = points.reached.astype(np.float64), points.trials.astype(np.float64)
    fit = scored(columns, reached[None], trials[None])[0]
    if not np.isfinite(fit).all():
        return np.nan
    eta = np.clip(fit @ columns, -FARTHEST, FARTHEST)
    mean, density = ndtr(eta), np.exp(-0.5 * eta * eta) / np.sqrt(2.0 * np.pi)
    variance = mean * ndtr(-eta)
    residual = (reached - trials * mean) * density / variance
    weight = trials * density * density / variance
    # the part of the quantity that the two coefficients do not take up
    known = (columns * weight) @ columns.T
    rest = beside - np.linalg.solve(known, (columns * weight) @ beside) @ columns
    parts = np.bincount(cluster, residual * rest, count)
    observed = abs(parts.sum())
    if count <= int(np.log2(FLIPS + 1)):
        bits = np.arange(2**count)[:, None] >> np.arange(count)
        signs = 1.0 - 2.0 * (bits & 1)
    else:
        drawn = np.random.default_rng(seed).integers(0, 2, (FLIPS, count))
        signs = np.concatenate([np.ones((1, count)), 1.0 - 2.0 * drawn])
    return float((np.abs(signs @ parts) >= observed * (1.0 - 1e-9)).mean())
