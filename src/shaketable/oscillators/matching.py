"""What a wavelet at each oscillator's peak does to every oscillator at its own peak."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.oscillators.oscillator import advance, step_of
from shaketable.oscillators.peaks import LANES, PEAK, ROWS, TIME, U, V, W, enter, matrix_in
from shaketable.oscillators.wavelet import REACH, centre, taper, tapered_cosine


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
