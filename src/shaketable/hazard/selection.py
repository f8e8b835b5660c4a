"""Recorded motions whose spectra, once scaled, are distributed as a target's.

Spectra are drawn from the target, and the recording nearest to each is taken; then each is
exchanged, one by one, for the recording with which mean and spread of all come nearest to the
target's (Jayaram N., Lin T., Baker J.W. (2011) Earthquake Spectra 27(3):797-815; Baker J.W., Lee C.
(2018) An improved algorithm for selecting ground motions to match a conditional spectrum,
J. Earthq. Eng. 22(4):708-723). Where the target has a fixed period, every motion is scaled to the
acceleration there, otherwise each to its own drawn spectrum.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, require_whole
from shaketable.hazard.spectral_target import SpectralTarget, ln_spectra_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import recordings_of

SCALES = (0.25, 4.0)  # factors on a recording within which its shape may still be believed
TRIALS = 20  # sets of drawn spectra, of which the one nearest to the target's moments is taken
LOOPS = 2  # of exchanges over all motions
SPREAD = 2.0  # weight of departures of the standard deviations beside those of the means


@dataclass(frozen=True, kw_only=True, eq=False)
class Selection:
    """Recorded motions, scaled, and what they were chosen for.

    Attributes:
        target: what their spectra should be like.
        candidates: how many motions there were to choose from.
        chosen: the place of each among them, (n,).
        factors: on each, (n,).
        motions: scaled, in the order of `chosen`.
        ln_spectra: of the scaled motions at the target's periods [ln m/s²], (n, period).
        scales: between which factors had to lie.
        seed: of the drawn spectra.
    """

    target: SpectralTarget
    candidates: int
    chosen: NDArray[np.intp]
    factors: NDArray[np.float64]
    motions: Sequence[Motion]
    ln_spectra: NDArray[np.float64]
    scales: tuple[float, float]
    seed: int

    @property
    def mean(self) -> NDArray[np.float64]:
        """Mean of ln pseudo-acceleration, (period,)."""
        return np.asarray(self.ln_spectra.mean(axis=0))

    @property
    def sigma(self) -> NDArray[np.float64]:
        """Standard deviation of ln pseudo-acceleration, (period,)."""
        return np.asarray(self.ln_spectra.std(axis=0, ddof=1))

    def departures(self) -> tuple[float, float]:
        """The largest |ln| by which the median, and by which the spread, are off at any period."""
        return (
            float(np.abs(self.mean - self.target.mean).max()),
            float(np.abs(self.sigma - self.target.sigma).max()),
        )


def select_motions(
    candidates: Sequence[Motion],
    target: SpectralTarget,
    n: int,
    *,
    scales: tuple[float, float] = SCALES,
    seed: int = 0,
    progress: Progress = False,
) -> Selection:
    """Select recorded motions whose spectra have the distribution of a target.

    At most one component of a recording is taken.

    Args:
        candidates: recorded motions.
        target: of their spectra.
        n: how many to take.
        scales: smallest and largest factor on a motion.
        seed: of the drawn spectra.
        progress: whether to draw a bar.

    Raises:
        InputError: too few recordings whose factors lie within the limits, or wrong limits.
    """
    require_whole("n", n)
    low, high = scales
    if n < 2:
        raise InputError(f"at least 2 motions are needed for a spread, got n={n}")
    if not 0.0 < low <= high:
        raise InputError(f"scales= must be 0 < smallest <= largest, got {low:g} and {high:g}")
    ln_spectra = ln_spectra_of(candidates, target.periods, progress=progress)
    recording = recordings_of(candidates)
    wanted = _nearest_draws(target, n, np.random.default_rng(seed))
    ln_factors = _ln_factors(ln_spectra, target, wanted)
    allowed = (ln_factors >= np.log(low) - 1e-12) & (ln_factors <= np.log(high) + 1e-12)
    able = np.unique(recording[allowed.any(axis=0)]).size
    if able < n:
        raise InputError(
            f"of {np.unique(recording).size} recordings {able} can be scaled to {target.name} by "
            f"factors from {low:g} to {high:g}, and {n} are needed: give more recordings, ask for "
            "fewer, or widen the limits"
        )
    chosen = _nearest(ln_spectra, ln_factors, allowed, recording, wanted)
    chosen = _exchanged(ln_spectra, ln_factors, allowed, recording, target, chosen)
    rows = np.arange(n)
    factors = np.exp(ln_factors[rows, chosen])
    return Selection(
        target=target,
        candidates=len(candidates),
        chosen=chosen,
        factors=factors,
        motions=tuple(
            candidates[k].scaled(float(factor)) for k, factor in zip(chosen, factors, strict=True)
        ),
        ln_spectra=ln_spectra[chosen] + ln_factors[rows, chosen][:, None],
        scales=(low, high),
        seed=seed,
    )


def _nearest_draws(
    target: SpectralTarget, n: int, random: np.random.Generator
) -> NDArray[np.float64]:
    """Drawn spectra, those of several sets whose moments are nearest to the target's."""
    sets = [target.draws(n, random) for _ in range(TRIALS)]
    return min(sets, key=lambda one: _departure(one.mean(axis=0), one.std(axis=0, ddof=1), target))


def _departure(
    mean: NDArray[np.float64], sigma: NDArray[np.float64], target: SpectralTarget
) -> float:
    off = ((mean - target.mean) ** 2).sum() + SPREAD * ((sigma - target.sigma) ** 2).sum()
    return float(off)


def _ln_factors(
    ln_spectra: NDArray[np.float64], target: SpectralTarget, wanted: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Of each candidate for each drawn spectrum, (n, candidate)."""
    if target.period is None:
        return np.asarray(wanted.mean(axis=1)[:, None] - ln_spectra.mean(axis=1))
    at = int(np.searchsorted(target.periods, target.period))
    return np.broadcast_to(
        target.mean[at] - ln_spectra[:, at], (wanted.shape[0], ln_spectra.shape[0])
    )


def _nearest(
    ln_spectra: NDArray[np.float64],
    ln_factors: NDArray[np.float64],
    allowed: NDArray[np.bool_],
    recording: NDArray[np.intp],
    wanted: NDArray[np.float64],
) -> NDArray[np.intp]:
    """The candidate nearest to each drawn spectrum, no recording twice, (n,).

    Spectra to which few candidates can be scaled are served first.
    """
    chosen = np.full(wanted.shape[0], -1, np.intp)
    free = np.ones(recording.size, np.bool_)
    for i in np.argsort(allowed.sum(axis=1), kind="stable"):
        off = ((ln_spectra + ln_factors[i][:, None] - wanted[i]) ** 2).sum(axis=1)
        off[~(allowed[i] & free)] = np.inf
        best = int(np.argmin(off))
        if np.isinf(off[best]):
            raise InputError(
                "no recording is left that can be scaled to a drawn spectrum within the limits: "
                "give more recordings, ask for fewer, or widen the limits"
            )
        chosen[i] = best
        free &= recording != recording[best]
    return chosen


def _exchanged(
    ln_spectra: NDArray[np.float64],
    ln_factors: NDArray[np.float64],
    allowed: NDArray[np.bool_],
    recording: NDArray[np.intp],
    target: SpectralTarget,
    chosen: NDArray[np.intp],
) -> NDArray[np.intp]:
    """The candidates after exchanges that bring mean and spread nearer to the target's, (n,)."""
    n = chosen.size
    chosen = chosen.copy()
    scaled = ln_spectra[chosen] + ln_factors[np.arange(n), chosen][:, None]
    for _ in range(LOOPS):
        for i in range(n):
            others = np.delete(scaled, i, axis=0)
            tried = ln_spectra + ln_factors[i][:, None]
            total, square = others.sum(axis=0) + tried, (others**2).sum(axis=0) + tried**2
            mean = total / n
            sigma = np.sqrt(np.maximum(square - n * mean**2, 0.0) / (n - 1))
            off = ((mean - target.mean) ** 2).sum(axis=1)
            off += SPREAD * ((sigma - target.sigma) ** 2).sum(axis=1)
            taken = np.isin(recording, np.delete(recording[chosen], i))
            off[~allowed[i] | taken] = np.inf
            chosen[i] = np.argmin(off)
            scaled[i] = tried[chosen[i]]
    return chosen
