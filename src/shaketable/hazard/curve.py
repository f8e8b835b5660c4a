"""A hazard curve: how often a year the ground of a site is shaken by more than each level."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError
from shaketable.signal import Measure

MOST_OFTEN = 20.0  # a year: no site is shaken so often by what a curve begins with


@dataclass(frozen=True, kw_only=True, eq=False)
class Hazard:
    """The annual rate of exceedance of each level of a measure of the ground's motion.

    Between two levels the logarithm of the rate is linear in that of the level. Beyond the first
    and the last of them it goes straight on, unless the curve ends at a rate of zero.

    Attributes:
        measure: of the ground's motion.
        levels: rising [SI], (n,).
        rates: of exceedance, not rising [1/year], (n,).
        site: longitude and latitude [degrees], None if the file does not say.
        source: the file.
    """

    measure: Measure
    levels: NDArray[np.float64]
    rates: NDArray[np.float64]
    site: tuple[float, float] | None = None
    source: str = ""

    def __post_init__(self) -> None:
        levels, rates = np.asarray(self.levels, np.float64), np.asarray(self.rates, np.float64)
        object.__setattr__(self, "levels", levels)
        object.__setattr__(self, "rates", rates)
        where = f"{self.source}: " if self.source else ""
        if levels.ndim != 1 or levels.shape != rates.shape:
            raise InputError(f"{where}a hazard curve has as many levels as rates")
        if not (np.isfinite(levels).all() and np.isfinite(rates).all()):
            raise InputError(f"{where}levels and rates must be finite numbers")
        if not (levels > 0.0).all() or not (np.diff(levels) > 0.0).all():
            raise InputError(f"{where}levels must be above 0 and rise from one to the next")
        if (rates < 0.0).any():
            raise InputError(f"{where}a rate is negative ({rates.min():g})")
        up = np.flatnonzero(np.diff(rates) > 1e-9 * rates[:-1])
        if up.size:
            k = int(up[0])
            raise InputError(
                f"{where}the rate rises with the level, from {rates[k]:g} a year at "
                f"{levels[k]:.4g} {self.measure.unit} to {rates[k + 1]:g} at {levels[k + 1]:.4g}: "
                "rates of exceedance fall; are these rates of occurrence, or columns exchanged?"
            )
        if (rates > 0.0).sum() < 2:
            raise InputError(f"{where}a hazard curve needs two levels with a rate above 0")
        if rates[0] > MOST_OFTEN:
            raise InputError(
                f"{where}a rate of {rates[0]:g} a year: nowhere is shaken so often; are these "
                "percents, or of more than one year?"
            )

    @cached_property
    def positive(self) -> int:
        """How many levels, from the first, have a rate above 0."""
        return int((self.rates > 0.0).sum())

    @property
    def ends(self) -> bool:
        """Whether the curve says that nothing exceeds its last levels."""
        return self.positive < self.rates.size

    @cached_property
    def slopes(self) -> NDArray[np.float64]:
        """k of λ ~ x^-k between levels with rates above 0, (positive - 1,)."""
        x, y = np.log(self.levels[: self.positive]), np.log(self.rates[: self.positive])
        return np.asarray(np.maximum(-np.diff(y) / np.diff(x), 0.0))

    def rate(self, levels: ArrayLike) -> NDArray[np.float64]:
        """The annual rate of exceedance of levels [SI]."""
        x = np.asarray(levels, np.float64)
        known, rates = self.levels[: self.positive], self.rates[: self.positive]
        at = np.clip(np.searchsorted(known, x, side="right") - 1, 0, self.slopes.size - 1)
        with np.errstate(divide="ignore", over="ignore"):
            found = rates[at] * (x / known[at]) ** -self.slopes[at]
        return np.where(self.ends & (x > known[-1]), 0.0, found)

    def level(self, rate: float) -> float:
        """The level that is exceeded at a rate [1/year], [SI].

        Raises:
            InputError: the curve does not reach this rate.
        """
        known, rates = self.levels[: self.positive], self.rates[: self.positive]
        if not rates[-1] <= rate <= rates[0]:
            raise InputError(
                f"the curve has rates from {rates[-1]:.3g} to {rates[0]:.3g} a year, not {rate:.3g}"
            )
        return float(np.exp(np.interp(-np.log(rate), -np.log(rates), np.log(known))))
