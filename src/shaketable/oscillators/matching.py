"""What a wavelet at each oscillator's peak does to every oscillator at its own peak.

The wavelet is the tapered cosine with which a spectrum is adjusted at one period and one instant.

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

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.oscillators.oscillator import advance, step_of
from shaketable.oscillators.peaks import LANES, PEAK, ROWS, TIME, U, V, W, enter, matrix_in

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


@driver
def wavelet_responses(
    f: NDArray[np.float64],
    damping: float,
    peaks: NDArray[np.float64],
    chosen: NDArray[np.int64],
    count: int,
    h: float,
    responses: NDArray[np.float64],
) -> None:
    """Write to responses[i, j] the w² u of oscillator i, at the sample nearest to peaks[i], under
    the wavelet for oscillator chosen[j]."""
    wave = np.empty(count)
    batch = np.empty(ROWS * LANES)
    for j in range(chosen.size):
        own = f[chosen[j]]
        c = centre(peaks[chosen[j]], own, damping)
        first, last = span(c, own, count, h)
        for n in range(first, last + 1):
            wave[n] = tapered_cosine(n * h, c, own, damping)
        for i in range(0, f.size, LANES):
            for lane in range(LANES):
                w = 2.0 * math.pi * f[min(i + lane, f.size - 1)]
                enter(batch, lane, w, damping, h)
                at = round(peaks[min(i + lane, f.size - 1)] / h)
                batch[TIME + lane] = min(count - 1, at)
            shake(batch, wave, first, last, h)
            for lane in range(min(LANES, f.size - i)):
                u = batch[PEAK + lane]
                if batch[TIME + lane] > last:
                    free = step_of(batch[W + lane], damping, (batch[TIME + lane] - last) * h)
                    u = advance(free, batch[U + lane], batch[V + lane], 0.0, 0.0)[0]
                responses[i + lane, j] = batch[W + lane] ** 2 * u


@kernel
def span(c: float, f: float, count: int, h: float) -> tuple[int, int]:
    """First and last sample of a wavelet."""
    reach = REACH * taper(f)
    return max(0, math.ceil((c - reach) / h)), min(count - 1, math.floor((c + reach) / h))


@routine
def shake(
    batch: NDArray[np.float64],
    wave: NDArray[np.float64],
    first: int,
    last: int,
    h: float,
) -> None:
    """Take a batch from rest through a wave; PEAK becomes u at the sample TIME, if in the wave."""
    start = first
    while start < last:
        stop = last  # the next sample at which a lane has its peak
        for lane in range(LANES):
            at = int(batch[TIME + lane])
            stop = at if start < at < stop else stop
        for n in range(start, stop):
            a, s = wave[n], (wave[n + 1] - wave[n]) / h
            for lane in range(LANES):
                u, v = advance(matrix_in(batch, lane), batch[U + lane], batch[V + lane], a, s)
                batch[U + lane], batch[V + lane] = u, v
        for lane in range(LANES):
            if int(batch[TIME + lane]) == stop:
                batch[PEAK + lane] = batch[U + lane]
        start = stop


@driver
def add_wavelets(
    f: NDArray[np.float64],
    damping: float,
    peaks: NDArray[np.float64],
    amplitudes: NDArray[np.float64],
    h: float,
    acceleration: NDArray[np.float64],
) -> None:
    """Add each wavelet times its amplitude to the acceleration."""
    for j in range(f.size):
        c = centre(peaks[j], f[j], damping)
        first, last = span(c, f[j], acceleration.size, h)
        for n in range(first, last + 1):
            acceleration[n] += amplitudes[j] * tapered_cosine(n * h, c, f[j], damping)
