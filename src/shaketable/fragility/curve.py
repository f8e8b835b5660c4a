"""One fragility function: a body, a limit state, and the probability that it is reached."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.fragility.limit_states import LimitState
from shaketable.fragility.lognormal import (
    Capacities,
    Fits,
    Points,
    basic_limits,
    probability,
    reflected,
)
from shaketable.fragility.shown import in_words
from shaketable.resampling import FEWEST, interval
from shaketable.signal import Measure
from shaketable.solid import Solid

GROUND = "the ground"  # whose intensities are told, where nothing says that it is a floor
#: Recordings, of those that reach a state and those that do not: fewer tell no median.
LEAST_RECORDINGS = 3
FEWEST_EVENTS = 4  # earthquakes: fewer tell no interval


@dataclass(frozen=True, kw_only=True, eq=False)
class Curve:
    """A lognormal fragility function, Φ(ln(x/θ)/β), with what it was fitted to.

    Attributes:
        body, state, measure: whose it is.
        fits: of what was observed, then of the draws of a bootstrap.
        data: simulations at their intensities, or lowest levels of motions.
        falls: how many simulations overturned the body, downhill and uphill; None of an IDA.
        more_beta: what is added to β for what is not known of the object, root sum of squares.
        place: whose motion the measure is of: the ground, or a floor of that name.
        recording_names: of the recordings, (recording,).
        event: the number of each recording's earthquake, (recording,).
    """

    body: Body | Solid
    state: LimitState
    measure: Measure
    fits: Fits
    data: Points | Capacities
    falls: tuple[int, int] | None
    recording_names: tuple[str, ...]
    event: NDArray[np.intp]
    place: str = GROUND
    more_beta: float = 0.0

    @cached_property
    def median(self) -> float:
        """θ [SI]; NaN where it is not known, see `problem`."""
        return np.nan if self.problem else float(self.fits.median[0])

    @cached_property
    def beta(self) -> float:
        """β, the standard deviation of the logarithm; NaN likewise."""
        return np.nan if self.problem else float(self.widened.beta[0])

    @property
    def widened(self) -> Fits:
        """The fits with `more_beta` in each."""
        return Fits(self.fits.median, np.hypot(self.fits.beta, self.more_beta))

    @cached_property
    def median_interval(self) -> tuple[float, float]:
        """Its 95 % interval by the bootstrap [SI], NaN where too few draws have a fit."""
        return self._interval(self.fits.median)

    @property
    def beta_interval(self) -> tuple[float, float]:
        """The 95 % interval of β."""
        return self._interval(self.widened.beta)

    def _interval(self, draws: NDArray[np.float64]) -> tuple[float, float]:
        unknown = self.problem or self.events < FEWEST_EVENTS
        return (np.nan, np.nan) if unknown else basic_limits(draws)

    @cached_property
    def drawn(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """θ [SI] and β of the draws of the basic bootstrap that have both, (draw,) each.

        None where there is no interval.
        """
        if not np.isfinite(self.median_interval).all():
            return np.empty(0), np.empty(0)
        median, beta = (reflected(one) for one in self.widened)
        known = np.isfinite(median) & np.isfinite(beta)
        return median[known], beta[known]

    def require_ground(self, other: str) -> None:
        """InputError where the measure is that of a floor's motion, and `other` of the ground's."""
        if self.place != GROUND:
            raise InputError(
                f"the fragility function is of {self.measure.name} on {self.place}, {other} of "
                "that of the ground: give the ground's motions to fragility(..., ground=...)"
            )

    def probability(self, levels: ArrayLike) -> NDArray[np.float64]:
        """That the state is reached at levels of the measure [SI]; NaN without a function."""
        known = np.array(self.median), np.array(self.beta)
        return probability(np.asarray(levels, np.float64), *known)

    def band(self, levels: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The 95 % interval of that probability at each level, by the bootstrap."""
        x = np.asarray(levels, np.float64)
        if self.events < FEWEST_EVENTS:
            return np.full(x.shape, np.nan), np.full(x.shape, np.nan)
        draws = [reflected(one).reshape(-1, *(1,) * x.ndim) for one in self.widened]
        return interval(probability(x, *draws))

    @property
    def downhill(self) -> float:
        """The share of the falls that are downhill; NaN without any."""
        return self.falls[0] / sum(self.falls) if self.falls and any(self.falls) else np.nan

    @property
    def recordings(self) -> int:
        """How many there are."""
        return int(self.event.size)

    @property
    def events(self) -> int:
        """Of how many earthquakes the recordings are: the independent experiments."""
        return int(self.event.max()) + 1

    @property
    def reached_by(self) -> int:
        """How many recordings reached the state at any level."""
        return self._recordings_with(self.data.reached > 0)

    @property
    def always(self) -> bool:
        """Whether every simulation reached the state, so that the median lies below all of them."""
        return isinstance(self.data, Points) and bool((self.data.reached >= self.data.trials).all())

    def _recordings_with(self, which: NDArray[np.bool_]) -> int:
        return int(np.unique(self.data.recording[which]).size)

    @cached_property
    def problem(self) -> str:
        """Why there is no such function, or only bounds of it; "" where there is one."""
        return _of_capacities(self) if isinstance(self.data, Capacities) else _of_points(self)

    @cached_property
    def caution(self) -> str:
        """What is weak about the function that there is; "" if nothing is."""
        if self.problem:
            return ""
        said = []
        if self.events < FEWEST:
            without = "no interval can be told" if self.events < FEWEST_EVENTS else (
                "intervals are too narrow more often than they should be"
            )  # fmt: skip
            said.append(f"from {self.events} earthquakes alone: {without}")
        if 2 * self.reached_by < self.recordings:
            said.append(
                f"only {self.reached_by} of {self.recordings} recordings reach {self.state.name}: "
                "the upper part of the curve is an extrapolation"
            )
        return "; ".join(said)


def _too_few(curve: Curve, reaching: int, missing: int) -> str:
    """What is said where too few recordings reached the state, or too few did not."""
    if curve.recordings < LEAST_RECORDINGS:
        return f"{curve.recordings} recordings tell no median: give {LEAST_RECORDINGS} or more"
    few = LEAST_RECORDINGS
    if reaching < few:
        return (
            f"only {reaching} of {curve.recordings} recordings reach {curve.state.name}, too few "
            f"to tell a median: shake stronger than {in_words(curve.measure, _highest(curve))}"
        )
    if missing < few:
        return (
            f"only {missing} of {curve.recordings} recordings ever fail to reach "
            f"{curve.state.name}, too few to tell a median: shake weaker"
        )
    return ""


def _highest(curve: Curve) -> float:
    data = curve.data
    return float((data.level if isinstance(data, Capacities) else data.intensity).max())


def _of_capacities(curve: Curve) -> str:
    few = _too_few(curve, curve.reached_by, curve.recordings)
    if few:
        return few
    if not float(curve.fits.median[0]) <= _highest(curve):
        return (
            f"too few motions reach {curve.state.name} up to "
            f"{in_words(curve.measure, _highest(curve))} to tell a median"
        )
    if not float(curve.fits.beta[0]) > 1e-3:
        return "the lowest levels of all motions are the same: β is not known; give more motions"
    return ""


def _of_points(curve: Curve) -> str:
    data, name = curve.data, curve.state.name
    assert isinstance(data, Points)
    median, beta = float(curve.fits.median[0]), float(curve.fits.beta[0])
    reached, missed = data.reached > 0, data.reached < data.trials
    low, high = (in_words(curve.measure, end) for end in (data.intensity.min(), _highest(curve)))
    if not reached.any():
        return (
            f"no simulation reaches {name}, up to {high}: the median lies above, and how far is "
            "not known; shake stronger"
        )
    if not missed.any():
        return (
            f"every simulation reaches {name}, from {low} on: the median lies below; shake weaker"
        )
    few = _too_few(curve, curve.reached_by, curve._recordings_with(missed))
    if few:
        return few
    if beta == 0.0:
        below = in_words(curve.measure, data.intensity[missed].max())
        above = in_words(curve.measure, data.intensity[reached].min())
        if below == above:
            return (
                f"simulations differ at {above} alone, which is about the median: β is not known; "
                "give more levels"
            )
        return (
            f"every simulation from {above} on reaches {name}, and none up to {below}: the "
            "median lies between, and β is not known; give more levels"
        )
    if not np.isfinite(median):
        return f"{name} does not become more likely with {curve.measure.name}"
    if not data.intensity.min() <= median <= data.intensity.max():
        return (
            f"the median would be {in_words(curve.measure, median)}, outside of what was "
            f"simulated, from {low} to {high}: too few simulations tell"
        )
    return ""
