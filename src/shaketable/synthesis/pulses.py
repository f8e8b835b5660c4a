"""Ground pulses in closed form, for tests, for teaching and for near-fault motions.

A motion is linear between its samples, so that a jump takes one time step, and a curve becomes a
polygon. With SAMPLES samples in a pulse, the borders of overturning are 1e-5 off.

| pulse | acceleration |
|---|---|
| one_sine | a sin(2πt/T), 0 <= t <= T |
| one_cosine | a cos(2πt/T), 0 <= t <= T |
| half_sine | a sin(πt/T), 0 <= t <= T |
| rectangular | a, 0 <= t <= T |
| ricker | a (1 - x²) exp(-x²/2), x = √2 π (t - t0)/T |
| mavroeidis_papageorgiou | derivative of v/2 [1 + cos(2πf(t-t0)/γ)] cos(2πf(t-t0) + ν) |

Makris and Roussos (2000) Géotechnique 50(3), 243-262. Vassiliou and Makris (2011) BSSA 101(2),
596-618. Mavroeidis and Papageorgiou (2003) BSSA 93(3), 1099-1131.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, require_positive
from shaketable.motion import Motion
from shaketable.origin import Origin

SAMPLES = 2000  # in a pulse, or a period of it


def one_sine(amplitude: float, period: float, *, samples: int = SAMPLES) -> Motion:
    """A whole wave of sine: amplitude [m/s²], period [s]."""
    return _pulse(
        "one-sine", amplitude, period, lambda t: np.sin(2 * math.pi * t / period), samples
    )


def one_cosine(amplitude: float, period: float, *, samples: int = SAMPLES) -> Motion:
    """A whole wave of cosine, which begins and ends with a jump: amplitude [m/s²], period [s]."""
    return _pulse(
        "one-cosine", amplitude, period, lambda t: np.cos(2 * math.pi * t / period), samples
    )


def half_sine(amplitude: float, duration: float, *, samples: int = SAMPLES) -> Motion:
    """Half a wave of sine: amplitude [m/s²], duration [s]."""
    return _pulse(
        "half-sine", amplitude, duration, lambda t: np.sin(math.pi * t / duration), samples
    )


def rectangular(amplitude: float, duration: float, *, samples: int = SAMPLES) -> Motion:
    """A constant acceleration: amplitude [m/s²], duration [s]; begins and ends with a jump."""
    return _pulse("rectangular", amplitude, duration, np.ones_like, samples)


def ricker(amplitude: float, period: float, *, samples: int = SAMPLES) -> Motion:
    """The symmetric Ricker wavelet: amplitude [m/s²], period [s]; it lasts two periods."""

    def shape(t: NDArray[np.float64]) -> NDArray[np.float64]:
        x = math.sqrt(2.0) * math.pi * (t - period) / period
        return (1.0 - x * x) * np.exp(-0.5 * x * x)

    return _pulse("Ricker", amplitude, period, shape, samples, lasts=2.0)


def mavroeidis_papageorgiou(
    velocity: float,
    period: float,
    *,
    cycles: float = 1.0,
    phase: float = 0.0,
    samples: int = SAMPLES,
) -> Motion:
    """The near-fault pulse of Mavroeidis and Papageorgiou (2003).

    Args:
        velocity: amplitude A of the velocity [m/s].
        period: 1/f of the pulse [s].
        cycles: γ, number of oscillations, above 1; the pulse lasts γ periods.
        phase: ν [rad].
    """
    require_positive("cycles", cycles)
    f, t0 = 1.0 / period if period else math.inf, 0.5 * cycles * period

    def shape(t: NDArray[np.float64]) -> NDArray[np.float64]:
        wave, envelope = 2 * math.pi * f * (t - t0), 2 * math.pi * f * (t - t0) / cycles
        return (-math.pi * f) * (
            np.sin(envelope) / cycles * np.cos(wave + phase)
            + (1.0 + np.cos(envelope)) * np.sin(wave + phase)
        )

    return _pulse("Mavroeidis-Papageorgiou", velocity, period, shape, samples, lasts=cycles)


def _pulse(
    name: str,
    amplitude: float,
    period: float,
    shape: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    samples: int,
    *,
    lasts: float = 1.0,
) -> Motion:
    """A pulse of `lasts` periods, with `samples` samples per period."""
    require_positive("the pulse's period or duration [s]", period)
    if not math.isfinite(amplitude):
        raise InputError(f"a pulse's amplitude must be finite, got {amplitude!r}")
    if samples < 4:
        raise InputError(f"a pulse needs at least 4 samples, got {samples!r}")
    count = math.ceil(samples * lasts)
    time = np.linspace(0.0, lasts * period, count + 1)
    said = f"{name} pulse, amplitude {amplitude:g}, period {period:g} s"
    return Motion(
        amplitude * shape(time),
        lasts * period / count,
        name=said,
        origin=Origin(processing=(said,)),
    )
