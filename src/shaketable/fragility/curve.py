"""One fragility function: a body, a limit state, and the probability that it is reached."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.fragility.limit_states import LimitState
from shaketable.fragility.lognormal import Capacities, Fits, Points, probability, reflected
from shaketable.resampling import ends, interval
from shaketable.signal import Measure

GROUND = "the ground"  # whose intensities are told, where nothing says that it is a floor
SURE = 0.9  # of the draws of a bootstrap must have a fit, or there is no interval


@dataclass(frozen=True, kw_only=True, eq=False)
class Curve:
    """A lognormal fragility function, Φ(ln(x/θ)/β), with what it was fitted to.

    Attributes:
        body, state, measure: whose it is.
        fits: of what was observed, then of the draws of a bootstrap.
        data: simulations at their intensities, or lowest levels of motions.
        falls: how many simulations overturned the body, downhill and uphill; None of an IDA.
        place: whose motion the measure is of: the ground, or a floor of that name.
        recordings, events: how many independent experiments there are.
    """

    body: Body
    state: LimitState
    measure: Measure
    fits: Fits
    data: Points | Capacities
    falls: tuple[int, int] | None
    recordings: int
    events: int
    place: str = GROUND

    @property
    def median(self) -> float:
        """θ [SI]; NaN where it is not known, see `problem`."""
        return np.nan if self.problem else float(self.fits.median[0])

    @property
    def beta(self) -> float:
        """β, the standard deviation of the logarithm; NaN likewise."""
        return np.nan if self.problem else float(self.fits.beta[0])

    @property
    def median_interval(self) -> tuple[float, float]:
        """Its 95 % interval by the bootstrap [SI], NaN where too few draws have a fit."""
        return self._interval(self.fits.median)

    @property
    def beta_interval(self) -> tuple[float, float]:
        """The 95 % interval of β."""
        return self._interval(self.fits.beta)

    def _interval(self, draws: NDArray[np.float64]) -> tuple[float, float]:
        if self.problem or draws.size < 2 or np.isfinite(draws[1:]).mean() < SURE:
            return np.nan, np.nan
        return ends(reflected(draws))

    def probability(self, levels: ArrayLike) -> NDArray[np.float64]:
        """That the state is reached at levels of the measure [SI]; NaN without a function."""
        known = np.array(self.median), np.array(self.beta)
        return probability(np.asarray(levels, np.float64), *known)

    def band(self, levels: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The 95 % interval of that probability at each level, by the bootstrap."""
        x = np.asarray(levels, np.float64)
        draws = [reflected(one).reshape(-1, *(1,) * x.ndim) for one in self.fits]
        return interval(probability(x, *draws))

    @property
    def downhill(self) -> float:
        """The share of the falls that are downhill; NaN without any."""
        return self.falls[0] / sum(self.falls) if self.falls and any(self.falls) else np.nan

    @property
    def problem(self) -> str:
        """Why there is no such function, or only bounds of it; "" where there is one."""
        name, unit = self.measure.name, self.measure.unit
        median, beta = float(self.fits.median[0]), float(self.fits.beta[0])
        if isinstance(self.data, Capacities):
            high = self.data.level.max()
            if median <= high:
                return ""
            return (
                f"too few motions reach {self.state.name} up to {name} = {high:.3g} {unit} to tell "
                "a median"
            )
        reached, missed = self.data.reached > 0, self.data.reached < self.data.trials
        if not reached.any():
            high = self.data.intensity.max()
            return (
                f"no simulation reaches {self.state.name}, up to {name} = {high:.3g} {unit}: the "
                "median lies above, and how far is not known; shake stronger"
            )
        if not missed.any():
            low = self.data.intensity.min()
            return (
                f"every simulation reaches {self.state.name}, from {name} = {low:.3g} {unit} on: "
                "the median lies below; shake weaker"
            )
        if beta == 0.0:
            low = self.data.intensity[missed].max()
            high = self.data.intensity[reached].min()
            return (
                f"every simulation above {name} = {high:.3g} {unit} reaches {self.state.name}, and "
                f"none up to {low:.3g} {unit}: the median lies between, and β is not known"
            )
        if not np.isfinite(median):
            return f"{self.state.name} does not become more likely with {name}"
        low, high = self.data.intensity.min(), self.data.intensity.max()
        if not low <= median <= high:
            return (
                f"the median would be {name} = {median:.3g} {unit}, outside of what was "
                f"simulated, {low:.3g} to {high:.3g} {unit}: too few simulations tell"
            )
        return ""
