"""Response spectra of a motion that is linear between its samples, without discretisation error."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError, require_damping
from shaketable.motion import Motion

#: 100 periods from 0.02 s to 10 s, evenly spaced by ratio [s].
PERIODS = np.geomspace(0.02, 10.0, 100)


@dataclass(frozen=True, eq=False)
class Spectrum:
    """A pseudo-acceleration response spectrum.

    Attributes:
        periods: [s], shape (n,), rising.
        acceleration: pseudo-acceleration [m/s²], shape (n,).
        damping: ratio of critical damping.
        name: what to call it.

    Raises:
        InputError: series that are empty, of unequal length, not finite or negative, periods that
            do not rise, or a damping out of range.
    """

    periods: NDArray[np.float64]
    acceleration: NDArray[np.float64]
    damping: float = 0.05
    name: str = ""

    def __post_init__(self) -> None:
        periods = np.array(self.periods, dtype=np.float64)
        acceleration = np.array(self.acceleration, dtype=np.float64)
        if periods.ndim != 1 or periods.shape != acceleration.shape or periods.size == 0:
            raise InputError(
                "a spectrum needs as many periods as accelerations, in one dimension; got shapes "
                f"{periods.shape} and {acceleration.shape}"
            )
        require_damping(self.damping)
        for what, values in (("periods", periods), ("accelerations", acceleration)):
            bad = np.flatnonzero(~(np.isfinite(values) & (values >= 0.0)))
            if bad.size:
                raise InputError(
                    f"a spectrum's {what} must be finite and not negative: no. {bad[0] + 1} is "
                    f"{values[bad[0]]}"
                )
        falls = np.flatnonzero(np.diff(periods) <= 0.0)
        if falls.size:
            raise InputError(
                f"a spectrum's periods must rise: {periods[falls[0]]:g} s is followed by "
                f"{periods[falls[0] + 1]:g} s"
            )
        periods.flags.writeable = acceleration.flags.writeable = False
        object.__setattr__(self, "periods", periods)
        object.__setattr__(self, "acceleration", acceleration)

    @property
    def velocity(self) -> NDArray[np.float64]:
        """Pseudo-velocity [m/s], shape (n,)."""
        return self.acceleration * self.periods / (2.0 * math.pi)

    @property
    def displacement(self) -> NDArray[np.float64]:
        """Relative displacement [m], shape (n,)."""
        return self.acceleration * (self.periods / (2.0 * math.pi)) ** 2

    def at(self, periods: ArrayLike) -> NDArray[np.float64]:
        """Pseudo-acceleration [m/s²] at other periods [s], interpolated in log T and log SA.

        Raises:
            InputError: a period outside the spectrum.
        """
        wanted = np.asarray(periods, dtype=np.float64)
        low, high = self.periods[0], self.periods[-1]
        if wanted.size and not (
            low * (1 - 1e-9) <= wanted.min() and wanted.max() <= high * (1 + 1e-9)
        ):
            raise InputError(
                f"the spectrum {self.name!r} goes from {low:g} to {high:g} s; asked for "
                f"{wanted.min():g} to {wanted.max():g} s"
            )
        least = 1e-9  # s, for a period of zero
        return np.exp(
            np.interp(
                np.log(np.maximum(wanted, least)),
                np.log(np.maximum(self.periods, least)),
                np.log(np.maximum(self.acceleration, 1e-300)),
            )
        )


def response_spectrum(
    motion: Motion, periods: ArrayLike = PERIODS, *, damping: float = 0.05
) -> Spectrum:
    """Return the response spectrum of the horizontal component, exact for a linear record.

    The largest relative displacement is taken between the samples, too, and in the free vibration
    after the last one. A period of zero gives the peak ground acceleration.

    Args:
        motion: of the ground or of a floor.
        periods: [s], shape (n,), rising.
        damping: ratio of critical damping, 0 <= damping < 1.

    Raises:
        InputError: periods or a damping out of range.
    """
    return Spectrum(
        np.asarray(periods, dtype=np.float64),
        spectral_acceleration(motion.horizontal, motion.time_step, periods, damping=damping),
        damping,
        motion.name,
    )


def spectral_acceleration(
    acceleration: NDArray[np.float64],
    time_step: float,
    periods: ArrayLike,
    *,
    damping: float = 0.05,
) -> NDArray[np.float64]:
    """Pseudo-accelerations of a series [m/s²], shape (n,); see response_spectrum."""
    return np.abs(peak_responses(acceleration, time_step, periods, damping=damping)[0])


def peak_responses(
    acceleration: NDArray[np.float64],
    time_step: float,
    periods: ArrayLike,
    *,
    damping: float = 0.05,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """w² u [m/s²] where |u| is largest, with u's sign, and the time [s]; both of shape (n,)."""
    from shaketable.oscillators.peaks import peak_displacements

    T = np.atleast_1d(np.asarray(periods, dtype=np.float64))
    require_damping(damping)
    if T.ndim != 1 or not (np.isfinite(T).all() and (T >= 0.0).all()):
        raise InputError("periods must be one series, finite and not negative")
    rigid = T == 0.0
    rising = np.argsort(T)[np.count_nonzero(rigid) :]  # oscillators of similar periods go together
    w = 2.0 * math.pi / T[rising]
    peaks, times = np.empty((2, w.size))
    series = np.ascontiguousarray(acceleration, dtype=np.float64).view()
    series.flags.writeable = False  # as motions' own are: it is compiled for one type
    peak_displacements(series, float(time_step), w, float(damping), peaks, times)
    response, when = np.empty((2, T.size))
    response[rising], when[rising] = peaks * w * w, times
    largest = int(np.argmax(np.abs(series)))
    response[rigid], when[rigid] = -series[largest], largest * time_step
    return response, when
