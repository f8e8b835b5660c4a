"""What the spectra of motions should be like: their mean, spread and correlation in period."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, require_number, require_positive
from shaketable.hazard.ground_motion import Scenario, correlation
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.signal.spectra import Spectrum, peak_responses
from shaketable.units import STANDARD_GRAVITY

#: Periods at which spectra are compared [s]: what things of a room and of a storey feel.
PERIODS = np.geomspace(0.05, 5.0, 24)


@dataclass(frozen=True, kw_only=True, eq=False)
class SpectralTarget:
    """The distribution of ln pseudo-acceleration [m/s²] of motions, normal at several periods.

    Attributes:
        name: in words.
        periods: [s], rising, (n,).
        mean: (n,).
        covariance: (n, n).
        period: at which all motions have the same acceleration [s], None where they need not.
    """

    name: str
    periods: NDArray[np.float64]
    mean: NDArray[np.float64]
    covariance: NDArray[np.float64]
    period: float | None = None

    @property
    def sigma(self) -> NDArray[np.float64]:
        """Standard deviations, (n,)."""
        return np.asarray(np.sqrt(np.maximum(np.diag(self.covariance), 0.0)))

    @property
    def spectrum(self) -> Spectrum:
        """The median spectrum."""
        return Spectrum(self.periods, np.exp(self.mean), name=self.name)

    def draws(self, n: int, random: np.random.Generator) -> NDArray[np.float64]:
        """Drawn ln pseudo-accelerations, (n, period)."""
        values, vectors = np.linalg.eigh(self.covariance)
        root = vectors * np.sqrt(np.maximum(values, 0.0))  # one is zero at a fixed period
        return np.asarray(self.mean + random.standard_normal((n, values.size)) @ root.T)


def target_of(quake: Scenario, periods: NDArray[np.float64] = PERIODS) -> SpectralTarget:
    """The spectra of an earthquake of a magnitude at a distance, as its models give them."""
    mean, sigma = _at(quake, periods)
    covariance = np.outer(sigma, sigma) * correlation(periods)
    return SpectralTarget(name=quake.name, periods=periods, mean=mean, covariance=covariance)


def conditional_target(
    quake: Scenario,
    period: float,
    *,
    level: float | None = None,
    epsilon: float | None = None,
    periods: NDArray[np.float64] = PERIODS,
) -> SpectralTarget:
    """The conditional spectrum: those of an earthquake whose acceleration at one period is known.

    Where a spectrum is high at one period, it is less high at others: motions that are all scaled
    to the acceleration at one period should look like this, and those scaled to a uniform hazard
    spectrum are too strong elsewhere.

    Baker (2011) Conditional mean spectrum: tool for ground-motion selection, J. Struct. Eng.
    137(3):322-331.

    Args:
        quake: whose models are taken.
        period: [s].
        level: pseudo-acceleration at the period [m/s²].
        epsilon: the same as a number of standard deviations above the median; one of both.
        periods: at which spectra are compared [s].

    Raises:
        InputError: both or none of level and epsilon, or a period outside `periods`.
    """
    if (level is None) == (epsilon is None):
        raise InputError("give the level at that period or its epsilon: one of both")
    if not periods[0] <= period <= periods[-1]:
        raise InputError(
            f"period [s] must lie between {periods[0]:g} and {periods[-1]:g}, got {period:g}"
        )
    periods = np.unique(np.append(periods, period))
    at = int(np.searchsorted(periods, period))
    mean, sigma = _at(quake, periods)
    if epsilon is None:
        assert level is not None
        require_positive("level [m/s²]", level)
        epsilon = (math.log(level) - mean[at]) / sigma[at]
    require_number("epsilon", epsilon)
    rho = correlation(periods)
    beside = rho[at]
    covariance = np.outer(sigma, sigma) * (rho - np.outer(beside, beside))
    covariance[at] = covariance[:, at] = 0.0
    mean = mean + sigma * beside * epsilon
    g = math.exp(mean[at]) / STANDARD_GRAVITY
    return SpectralTarget(
        name=f"{quake.name}, SA({period:g} s) {g:.3g} g (epsilon {epsilon:.2g})",
        periods=periods,
        mean=mean,
        covariance=covariance,
        period=period,
    )


def ln_spectra_of(
    motions: Sequence[Motion],
    periods: NDArray[np.float64] = PERIODS,
    *,
    progress: Progress = False,
) -> NDArray[np.float64]:
    """ln pseudo-accelerations of motions, 5 % damped [ln m/s²], (motion, period).

    Of a motion with both horizontal components they are those of their geometric mean.

    Raises:
        InputError: a motion that is at rest.
    """
    found = np.empty((len(motions), periods.size))
    with meter("spectra", len(motions), progress) as done:
        for k, motion in enumerate(motions):
            peaks = [
                np.abs(peak_responses(each.horizontal, each.time_step, periods, damping=0.05)[0])
                for each in motion.components()
            ]
            if not np.all(peaks):
                raise InputError(f"the motion {motion.name!r} is at rest")
            found[k] = np.log(peaks).mean(axis=0)
            done(1)
    return found


def _at(
    quake: Scenario, periods: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    if not (periods[0] >= quake.periods[0] and periods[-1] <= quake.periods[-1]):
        raise InputError(
            f"the models give periods from {quake.periods[0]:g} to {quake.periods[-1]:g} s, asked "
            f"for {periods[0]:g} to {periods[-1]:g} s"
        )
    known = np.log(quake.periods)
    return (
        np.interp(np.log(periods), known, quake.ln_spectrum),
        np.interp(np.log(periods), known, quake.sigma),
    )
