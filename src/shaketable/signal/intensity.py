"""Intensity measures of a motion's horizontal component, by their usual names, in SI.

Integrals over the record are exact for an acceleration that is linear between its samples;
durations interpolate their ends within a sample.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, quoted
from shaketable.motion import Motion
from shaketable.signal.integrate import displacement, velocity
from shaketable.signal.spectra import spectral_acceleration
from shaketable.units import STANDARD_GRAVITY

BRACKET = 0.05 * STANDARD_GRAVITY  # m/s²; Bolt (1973)
_WITH_PERIOD = re.compile(r"(SA|AvgSA)\(([^()]+)\)", re.IGNORECASE)
_HOUSNER = np.linspace(0.1, 2.5, 121)  # s
_TP = np.geomspace(0.02, 5.0, 200)  # s
_TM_BAND = (0.25, 20.0)  # Hz; Rathje et al. (1998)
_TM_RESOLUTION = 0.05  # Hz: the resolution is at least as fine


class Record:
    """A component with the quantities derived from it, each computed once."""

    def __init__(self, acceleration: NDArray[np.float64], time_step: float) -> None:
        self.a = acceleration
        self.h = time_step

    @cached_property
    def v(self) -> NDArray[np.float64]:
        return velocity(self.a, self.h)

    @cached_property
    def d(self) -> NDArray[np.float64]:
        return displacement(self.a, self.h)

    @cached_property
    def energy(self) -> NDArray[np.float64]:
        """∫a² from the start to each sample [m²/s³]."""
        a0, a1 = self.a[:-1], self.a[1:]
        return np.concatenate([[0.0], np.cumsum(self.h / 3.0 * (a0 * a0 + a0 * a1 + a1 * a1))])

    def psa(self, periods: NDArray[np.float64]) -> NDArray[np.float64]:
        """5 % pseudo-accelerations [m/s²]."""
        return spectral_acceleration(self.a, self.h, periods)


class Measure(NamedTuple):
    """An intensity measure: its name, its unit, what it means, and how it is found."""

    name: str
    unit: str
    meaning: str
    of: Callable[[Record], float]
    power: int | None  # it grows with so high a power of a factor on the motion; None: with none


def pga(record: Record) -> float:
    return float(np.abs(record.a).max())


def pgv(record: Record) -> float:
    return float(np.abs(record.v).max())


def pgd(record: Record) -> float:
    return float(np.abs(record.d).max())


def arias_intensity(record: Record) -> float:
    """π/(2g) ∫a² dt. Arias (1970)."""
    return float(math.pi / (2.0 * STANDARD_GRAVITY) * record.energy[-1])


def cumulative_absolute_velocity(record: Record) -> float:
    """∫|a| dt. EPRI (1988)."""
    a0, a1 = record.a[:-1], record.a[1:]
    size = np.abs(a0) + np.abs(a1)
    crossing = a0 * a1 < 0.0
    mean = 0.5 * size
    mean[crossing] = 0.5 * (a0[crossing] ** 2 + a1[crossing] ** 2) / size[crossing]
    return float(record.h * mean.sum())


def significant_duration(record: Record, low: float, high: float) -> float:
    """Time between two shares of the Arias intensity. Trifunac and Brady (1975)."""
    if record.energy[-1] == 0.0:
        return 0.0
    share = record.energy / record.energy[-1]
    ends = np.interp([low, high], share, np.arange(share.size) * record.h)
    return float(ends[1] - ends[0])


def bracketed_duration(record: Record) -> float:
    """Time between the first and the last instant at which |a| is 0.05 g. Bolt (1973)."""
    above = np.flatnonzero(np.abs(record.a) >= BRACKET)
    if above.size == 0:
        return 0.0
    first, last = int(above[0]), int(above[-1])
    size = np.abs(record.a)
    begin, end = float(first), float(last)
    if first > 0:  # where the straight line to the first sample above the bracket crosses it
        begin -= (size[first] - BRACKET) / (size[first] - _neighbour(record.a, first, -1))
    if last < size.size - 1:
        end += (size[last] - BRACKET) / (size[last] - _neighbour(record.a, last, 1))
    return float((end - begin) * record.h)


def _neighbour(a: NDArray[np.float64], at: int, way: int) -> float:
    """The neighbour of sample `at`, positive where both have the same sign."""
    return float(a[at + way] * np.sign(a[at]))


def predominant_period(record: Record) -> float:
    """Period of the largest 5 % spectral acceleration, on 200 periods from 0.02 to 5 s."""
    return float(_TP[int(np.argmax(record.psa(_TP)))])


def mean_period(record: Record) -> float:
    """Σ C²/f / Σ C² over Fourier amplitudes from 0.25 to 20 Hz. Rathje et al. (1998)."""
    from scipy.fft import next_fast_len, rfft, rfftfreq

    count = next_fast_len(max(record.a.size, math.ceil(1.0 / (_TM_RESOLUTION * record.h))))
    power = np.abs(rfft(record.a, count)) ** 2
    frequency = rfftfreq(count, record.h)
    within = (frequency >= _TM_BAND[0]) & (frequency <= _TM_BAND[1])
    total = power[within].sum()
    return float((power[within] / frequency[within]).sum() / total) if total else 0.0


def velocity_to_acceleration(record: Record) -> float:
    """PGV/PGA."""
    peak = pga(record)
    return pgv(record) / peak if peak else 0.0


def housner_intensity(record: Record) -> float:
    """∫ of the 5 % pseudo-velocity over periods from 0.1 to 2.5 s. Housner (1952)."""
    psv = record.psa(_HOUSNER) * _HOUSNER / (2.0 * math.pi)
    return float(np.trapezoid(psv, _HOUSNER))


def spectral_ordinate(period: float) -> Measure:
    """SA(T): the 5 % pseudo-acceleration at one period [s]."""
    return Measure(
        f"SA({float(period)!r})",
        "m/s2",
        f"5 % pseudo-acceleration at {period:g} s",
        lambda record: float(record.psa(np.array([period]))[0]),
        1,
    )


def average_spectral_acceleration(period: float) -> Measure:
    """AvgSA(T): geometric mean of SA at 100 periods from 0.2 T to 3 T. Eads et al. (2015)."""
    periods = np.linspace(0.2 * period, 3.0 * period, 100)
    return Measure(
        f"AvgSA({float(period)!r})",
        "m/s2",
        f"geometric mean of SA from {0.2 * period:g} to {3 * period:g} s",
        lambda record: _geometric_mean(record.psa(periods)),
        1,
    )


def _geometric_mean(values: NDArray[np.float64]) -> float:
    return float(np.exp(np.log(values).mean())) if values.all() else 0.0


#: The measures that have no parameter.
MEASURES = (
    Measure("PGA", "m/s2", "peak ground acceleration", pga, 1),
    Measure("PGV", "m/s", "peak ground velocity", pgv, 1),
    Measure("PGD", "m", "peak ground displacement", pgd, 1),
    Measure("PGV/PGA", "s", "peak velocity over peak acceleration", velocity_to_acceleration, 0),
    Measure("Arias", "m/s", "Arias intensity", arias_intensity, 2),
    Measure("CAV", "m/s", "cumulative absolute velocity", cumulative_absolute_velocity, 1),
    Measure(
        "D5-75",
        "s",
        "significant duration, 5 to 75 % of the Arias intensity",
        lambda record: significant_duration(record, 0.05, 0.75),
        0,
    ),
    Measure(
        "D5-95",
        "s",
        "significant duration, 5 to 95 % of the Arias intensity",
        lambda record: significant_duration(record, 0.05, 0.95),
        0,
    ),
    Measure("Dbracketed", "s", "time between the first and last 0.05 g", bracketed_duration, None),
    Measure("Tp", "s", "predominant period, that of the largest SA", predominant_period, 0),
    Measure("Tm", "s", "mean period of the Fourier amplitudes", mean_period, 0),
    Measure("Housner", "m", "integral of the pseudo-velocity, 0.1 to 2.5 s", housner_intensity, 1),
)


def measures(
    sa: Sequence[float] = (0.3, 1.0), average_sa: Sequence[float] = (1.0,)
) -> tuple[Measure, ...]:
    """MEASURES with SA and AvgSA at the given periods [s].

    Raises:
        InputError: a period that is not positive.
    """
    for period in (*sa, *average_sa):
        if not (math.isfinite(period) and period > 0.0):
            raise InputError(f"the period of an intensity measure must be positive, got {period!r}")
    return (
        *MEASURES,
        *(spectral_ordinate(period) for period in sa),
        *(average_spectral_acceleration(period) for period in average_sa),
    )


def measure_named(name: str) -> Measure:
    """The measure of a name, in any case: one of MEASURES, SA(T) or AvgSA(T) with T in seconds.

    Raises:
        InputError: there is none of this name.
    """
    found = {measure.name.lower(): measure for measure in MEASURES}.get(name.strip().lower())
    if found is not None:
        return found
    match = _WITH_PERIOD.fullmatch(name.strip())
    try:
        period = float(match[2]) if match else math.nan
    except ValueError:
        period = math.nan
    if match is None or not (math.isfinite(period) and period > 0.0):
        accepted = ", ".join(measure.name for measure in MEASURES)
        raise InputError(
            f"unknown intensity measure {quoted(name)}; accepted: {accepted}, and SA(T) and "
            "AvgSA(T) with a period T in s, such as SA(1.0)"
        )
    return (spectral_ordinate if match[1].lower() == "sa" else average_spectral_acceleration)(
        period
    )


def intensity_measures(
    motion: Motion, *, sa: Sequence[float] = (0.3, 1.0), average_sa: Sequence[float] = (1.0,)
) -> dict[str, float]:
    """Return PGA, PGV and all other intensity measures of the horizontal component, in SI.

    Peak velocity and displacement are those of the motion as it is, from rest: first correct the
    baseline of a motion that is published uncorrected.

    Args:
        sa, average_sa: periods of SA(T) and AvgSA(T) [s].

    Raises:
        InputError: a period that is not positive.
    """
    record = Record(motion.horizontal, motion.time_step)
    return {measure.name: measure.of(record) for measure in measures(sa, average_sa)}
