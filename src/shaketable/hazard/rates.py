"""How often a year an object falls: a fragility function over a hazard curve.

λ = ∫ F(x) |dλ(x)|, where F is the probability of a fall at an intensity x and λ(x) the rate at
which it is exceeded (Cornell 1968; McGuire 2004). In parts, λ = ∫ λ(x) dF(x): where the hazard is a
power law between two levels, λ(x) = c x^-k, and the fragility lognormal, the integral is closed,

    c θ^-k e^{k²β²/2} [Φ(z₂) - Φ(z₁)],    z = (ln(x/θ) + kβ²)/β,

so that the sum over the curve's intervals is exact for a curve that is linear in its logarithms.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.fragility import Curve, Fragility
from shaketable.fragility.lognormal import ndtr, probability
from shaketable.hazard.curve import Hazard
from shaketable.resampling import ends

if TYPE_CHECKING:
    import pandas as pd

log = logging.getLogger(__name__)

YEARS = 50.0
MUCH = 0.1  # of the rate from beyond the curve: it is told


@dataclass(frozen=True, kw_only=True, eq=False)
class AnnualRate:
    """How often a year an object reaches a state.

    Attributes:
        rate: [1/year]; NaN without a function.
        interval: its 95 % interval, from the fragility function's; the hazard curve is taken as it
            is.
        levels: the curve's [SI], with 0 before and infinity after them, (n + 2,).
        by_level: the part of the rate from each interval between them, (n + 1,).
    """

    rate: float
    interval: tuple[float, float]
    levels: NDArray[np.float64]
    by_level: NDArray[np.float64]

    @property
    def below(self) -> float:
        """The share of the rate from below the curve's first level."""
        return float(self.by_level[0] / self.rate) if self.rate else 0.0

    @property
    def above(self) -> float:
        """The share of the rate from above its last level."""
        return float(self.by_level[-1] / self.rate) if self.rate else 0.0

    def probability(self, years: float = YEARS) -> float:
        """That it happens at least once in so many years, if falls follow a Poisson process."""
        return float(-np.expm1(-self.rate * years))

    def probability_interval(self, years: float = YEARS) -> tuple[float, float]:
        """The 95 % interval of that probability."""
        low, high = (float(-np.expm1(-end * years)) for end in self.interval)
        return low, high


def annual_rate(fragility: Fragility | Curve, hazard: Hazard) -> AnnualRate:
    """Integrate a fragility function over a hazard curve: the rate per year of a limit state.

    Args:
        fragility: one function, of the measure of the ground that the hazard has.
        hazard: the curve of the site.

    Raises:
        InputError: several functions, another measure, or the measure of a floor's motion.
    """
    curve = fragility.curve if isinstance(fragility, Fragility) else fragility
    found = rate_of(curve, hazard)
    warn_of_tails([found], hazard)
    return found


def rate_of(curve: Curve, hazard: Hazard) -> AnnualRate:
    """The same of one curve, without a warning."""
    if curve.measure.name != hazard.measure.name:
        raise InputError(
            f"the hazard curve is of {hazard.measure.name}, the fragility function of "
            f"{curve.measure.name}: find the function with measure={hazard.measure.name!r}"
        )
    curve.require_ground("the hazard")
    levels = np.concatenate([[0.0], hazard.levels[: hazard.positive], [np.inf]])
    if curve.problem:
        parts = np.full(levels.size - 1, np.nan)
        return AnnualRate(rate=np.nan, interval=(np.nan, np.nan), levels=levels, by_level=parts)
    by_level = rate_parts(hazard, np.array([curve.median]), np.array([curve.beta]))[0]
    rate = float(by_level.sum())
    interval = np.nan, np.nan
    median, beta = curve.drawn
    if median.size:
        interval = ends(rate_parts(hazard, median, beta).sum(axis=1))
    return AnnualRate(rate=rate, interval=interval, levels=levels, by_level=by_level)


def annual_rates(
    fragility: Fragility, hazard: Hazard, *, years: Iterable[float] = (YEARS,)
) -> pd.DataFrame:
    """The rates of all functions, a row for each.

    Args:
        fragility: of several bodies or states.
        hazard: as for `annual_rate`.
        years: for which the probability is told.
    """
    import pandas as pd

    rows = []
    every = [rate_of(curve, hazard) for curve in fragility.curves]
    warn_of_tails(every, hazard)
    for curve, found in zip(fragility.curves, every, strict=True):
        row: dict[str, object] = {
            "body": curve.body.name,
            "limit_state": curve.state.name,
            "annual_rate": found.rate,
            "annual_rate_low": found.interval[0],
            "annual_rate_high": found.interval[1],
            "years_between": 1.0 / found.rate if found.rate else np.inf,
        }
        for span in years:
            low, high = found.probability_interval(span)
            row[f"probability_in_{span:g}_years"] = found.probability(span)
            row[f"probability_in_{span:g}_years_low"] = low
            row[f"probability_in_{span:g}_years_high"] = high
        row |= {"share_below_curve": found.below, "share_above_curve": found.above}
        rows.append({**row, "problem": curve.problem, "caution": curve.caution})
    return pd.DataFrame(rows)


def rate_parts(
    hazard: Hazard, median: NDArray[np.float64], beta: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Parts of the rate below, between and above the levels, (set, n + 1)."""
    x, rates = hazard.levels[: hazard.positive], hazard.rates[: hazard.positive]
    slopes = np.concatenate([hazard.slopes[:1], hazard.slopes, hazard.slopes[-1:]])
    anchor = np.concatenate([[0], np.arange(x.size)])
    theta, spread = median[:, None], np.maximum(beta, 1e-9)[:, None]
    with np.errstate(divide="ignore"):
        edges = np.log(np.concatenate([[0.0], x, [np.inf]])) - np.log(theta)
    low = (edges[:, :-1] + slopes * spread**2) / spread
    high = (edges[:, 1:] + slopes * spread**2) / spread
    # the difference of two probabilities, from the side on which they are small
    between = np.where(low > 0.0, ndtr(-low) - ndtr(-high), ndtr(high) - ndtr(low))
    scale = rates[anchor] * (theta / x[anchor]) ** -slopes * np.exp(0.5 * (slopes * spread) ** 2)
    within = scale * between  # ∫ λ dF
    if hazard.ends:
        within[:, -1] = 0.0
    # ∫ F |dλ| of an interval is that and what F λ gains over it
    share = probability(x, theta, spread) * rates
    zero = np.zeros((len(median), 1))
    gained = np.concatenate([zero, share], axis=1) - np.concatenate([share, zero], axis=1)
    return np.asarray(np.maximum(within + gained, 0.0))


def warn_of_tails(found: Sequence[AnnualRate], hazard: Hazard) -> None:
    """Tell of how many rates much is from beyond the hazard curve."""
    on = "it is taken to go straight on"
    above = "nothing is taken to exceed it by more" if hazard.ends else on
    for tail, where in (
        ("below", f"below the first level of the hazard curve, where {on}"),
        ("above", f"above the last level of the hazard curve that has a rate, where {above}"),
    ):
        shares = [getattr(one, tail) for one in found]
        much = sum(share > MUCH for share in shares)
        if much:
            log.warning(
                "%d of %d rates are to more than %.0f %% (up to %.0f %%) from %s",
                much, len(found), 100 * MUCH, 100 * max(shares), where,
            )  # fmt: skip
