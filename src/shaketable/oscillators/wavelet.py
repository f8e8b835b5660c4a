"""The tapered cosine with which a motion's spectrum is adjusted at one period and one instant.

| symbol | meaning | unit |
|---|---|---|
| t | time | s |
| c | the wavelet's centre | s |
| f | the oscillator's frequency | Hz |
| z | its damping ratio | - |
| g | width of the taper, 2.356 f^-0.93 | s |

cos(2π f √(1-z²) (t - c)) exp(-((t - c)/g)²): it leaves next to no velocity or displacement.
Al Atik and Abrahamson (2010) An improved method for nonstationary spectral matching, Earthquake
Spectra 26(3), 601-617, eq. 14, whose taper is half as wide (1.178): the wider one touches fewer
periods beside its own, and more motions reach the target with it.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel

REACH = 2.5  # tapers: beyond this, the wavelet is below 2e-3


@kernel
def taper(f: float) -> float:
    return 2.356 * f**-0.93  # type: ignore[no-any-return]


@kernel
def lead(f: float, z: float) -> float:
    """How long before its oscillator's peak a wavelet's centre lies [s]; eq. 15."""
    w = 2.0 * math.pi * f * math.sqrt(1.0 - z * z)
    return math.atan2(math.sqrt(1.0 - z * z), z) / w


@kernel
def centre(peak: float, f: float, z: float) -> float:
    """c of the wavelet that raises an oscillator's peak [s]."""
    return peak - lead(f, z)


@kernel
def tapered_cosine(t: float, c: float, f: float, z: float) -> float:
    x = (t - c) / taper(f)
    return math.cos(2.0 * math.pi * f * math.sqrt(1.0 - z * z) * (t - c)) * math.exp(-x * x)
