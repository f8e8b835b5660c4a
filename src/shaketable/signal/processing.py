"""Detrending and filtering of all components of a motion; its origins record what was done."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, require_whole
from shaketable.motion import Motion

Series = NDArray[np.float64]


def detrended(motion: Motion, *, order: int = 0, until: float | None = None) -> Motion:
    """Subtract the best-fitting polynomial from the acceleration.

    Args:
        order: 0 subtracts the mean, 1 a straight line.
        until: fit only the samples before this time [s], such as those before the earthquake.

    Raises:
        InputError: fewer samples than the polynomial has coefficients.
    """
    count = motion.horizontal.size
    if until is not None:
        count = min(count, round(until / motion.time_step) + 1)
    if order < 0 or count <= order:
        raise InputError(f"a polynomial of order {order} cannot be fitted to {count} samples")
    time = motion.time

    def change(series: Series) -> Series:
        fit = np.polynomial.Polynomial.fit(time[:count], series[:count], order)
        return series - fit(time)

    span = "" if until is None else f" of the first {until:g} s"
    return motion.changed(change, f"polynomial of order {order}{span} subtracted")


def filtered(
    motion: Motion, *, low: float | None = None, high: float | None = None, order: int = 4
) -> Motion:
    """Apply a Butterworth filter forwards and backwards, which shifts no phase.

    While it is filtered, 1.5 order/low seconds of zeros are put before and after the motion
    (Boore 2005); they are removed again.

    Args:
        low, high: corners [Hz], at which the two passes leave half of the amplitude; None
            for no corner.
        order: of each pass.

    Raises:
        InputError: corners that do not satisfy 0 < low < high < half of the sampling rate.
    """
    from scipy.signal import butter, sosfiltfilt

    require_whole("order", order)
    nyquist = 0.5 / motion.time_step
    corners = [corner for corner in (low, high) if corner is not None]
    if not corners or not all(0.0 < corner < nyquist for corner in corners):
        raise InputError(
            f"corners must lie between 0 and {nyquist:g} Hz, got low = {low} and high = {high}"
        )
    if low is not None and high is not None and low >= high:
        raise InputError(f"low = {low:g} Hz must be below high = {high:g} Hz")
    kind: Literal["bandpass", "highpass", "lowpass"] = "bandpass"
    if len(corners) == 1:
        kind = "highpass" if high is None else "lowpass"
    edges = corners if len(corners) == 2 else corners[0]
    sections = butter(order, edges, kind, output="sos", fs=1.0 / motion.time_step)
    pad = round(1.5 * order / corners[0] / motion.time_step)

    def change(series: Series) -> Series:
        padded = np.pad(series, pad)
        through: Series = sosfiltfilt(sections, padded, padlen=0)
        return through[pad : pad + series.size]

    band = "-".join(f"{corner:g}" for corner in corners)
    return motion.changed(
        change, f"{kind} {band} Hz, Butterworth of order {order}, forwards and backwards"
    )
