"""Baseline correction that keeps a permanent displacement.

If an instrument's zero shifts during strong shaking, the velocity drifts afterwards. The two-step
correction (Iwan et al. 1985, as generalised by Boore 2001) subtracts a constant acceleration a_m
between t1 and t2 and another one, a_f, after t2, so that the velocity's tail, fitted by the
straight line v0 + a_f t, ends level at zero: a_m = (v0 + a_f t2)/(t2 - t1). The quadratic
correction (Boore 2001) fits the velocity from t1 on by a parabola through zero at t1 and subtracts
its derivative. Neither forces the displacement back to zero, as a high-pass filter does.

t1 and t2 are not observable, and the permanent displacement depends on them. Where they are not
given, a search finds the pair, before and after the largest acceleration, with which the
displacement is closest to a single step (Wang et al. 2011). Tests with known permanent
displacements show that it finds them within some decimetres, not within centimetres.

Iwan, Moser and Peng (1985) BSSA 75(5), 1225-1246. Boore (2001) BSSA 91(5), 1199-1211.
Wang, Schurr, Milkereit, Shao and Jin (2011) BSSA 101(5), 2029-2044.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.signal.integrate import displacement, velocity
from shaketable.signal.processing import Series

ONSET, SHAKEN = 0.005, 0.95  # shares of the Arias intensity
TRIED_T1, TRIED_T2 = 25, 60
#: Least t2 - t1, as a share of the strong shaking from the onset to t3: a shorter shift would be a
#: pulse of its own, and the fit would trade peak velocity for a sharper step.
SHORTEST = 0.3
USUAL = 0.03  # m/s²: shifts of an instrument's zero are some 0.01 m/s² (Iwan et al. 1985)
SEARCH_SAMPLES = 1000  # of the displacement, which varies slowly enough for them

Settling = TypeVar("Settling", float, NDArray[np.float64])  # one t2, or many


class Times(NamedTuple):
    """Times of a correction [s]; t1 and t2 are None where they are to be searched for.

    The zero shifts by a_m from t1 to t2 and by a_f after t2; the ground stands still from t3 on.
    """

    t1: float | None
    t2: float | None
    onset: float
    t3: float


def baseline_corrected(
    motion: Motion,
    *,
    scheme: Literal["two-step", "quadratic"] = "two-step",
    t1: float | None = None,
    t2: float | None = None,
    t3: float | None = None,
) -> Motion:
    """Correct a motion's baseline and keep its permanent displacement.

    It is meant for records as their instruments gave them. Filtered records have lost their
    permanent displacement, and the correction would invent one of decimetres. To remove an offset
    that was there before the earthquake, use detrended(until=...).

    Args:
        scheme: "two-step" or "quadratic".
        t1: when the zero begins to shift [s]. If None, "two-step" searches for it between the
            onset, when 0.5 % of the Arias intensity has passed, and the largest acceleration;
            "quadratic" takes the onset.
        t2: when the zero has settled [s], "two-step" only. If None, it is searched for after the
            largest acceleration.
        t3: start of the tail, in which the ground stands still [s]. If None, when 95 % of the
            Arias intensity has passed.

    Raises:
        InputError: an unknown scheme, times out of order, or a tail of less than 5 % of the
            motion.
    """
    if scheme not in ("two-step", "quadratic"):
        raise InputError(f"unknown scheme {scheme!r}; accepted: two-step, quadratic")
    if scheme == "quadratic" and t2 is not None:
        raise InputError("the quadratic scheme has no t2")

    def change(series: Series) -> Series:
        times = _times(series, motion.time_step, t1, t2, t3)
        if scheme == "quadratic":
            return _quadratic(series, motion.time_step, times)
        return _two_step(series, motion.time_step, times)

    return motion.changed(change, f"baseline corrected, {scheme}")


def permanent_displacement(motion: Motion, *, t3: float | None = None) -> float:
    """Mean displacement of the horizontal component's tail, from t3 on [m].

    Raises:
        InputError: a tail of less than 5 % of the motion.
    """
    times = _times(motion.horizontal, motion.time_step, None, None, t3)
    tail = displacement(motion.horizontal, motion.time_step)[round(times.t3 / motion.time_step) :]
    return float(tail.mean())


def _times(series: Series, h: float, t1: float | None, t2: float | None, t3: float | None) -> Times:
    """The times given, with the onset and the start of the tail."""
    energy = np.cumsum((series - np.median(series)) ** 2)
    share = energy / energy[-1] if energy[-1] > 0.0 else np.linspace(0.0, 1.0, series.size)
    onset = float(np.searchsorted(share, ONSET)) * h
    t3 = float(np.searchsorted(share, SHAKEN)) * h if t3 is None else t3
    end = (series.size - 1) * h
    given = [time for time in (t1, t2) if time is not None]
    if given != sorted(set(given)) or not all(0.0 <= time <= end for time in given):
        raise InputError(f"a baseline needs 0 <= t1 < t2 <= {end:g} s, got t1 = {t1}, t2 = {t2}")
    if not (t1 or 0.0) < t3 <= 0.95 * end:
        raise InputError(
            f"a baseline needs a tail: t1 < t3 <= {0.95 * end:g} s, got t3 = {t3:g} s; record "
            "longer, or give t3"
        )
    return Times(t1, t2, onset, t3)


def _two_step(series: Series, h: float, times: Times) -> Series:
    time = h * np.arange(series.size, dtype=np.float64)
    tail = time >= times.t3
    slope, level = np.polyfit(time[tail], velocity(series, h)[tail], 1)
    line = float(level), float(slope)
    t1, t2 = _settled(series, h, times, line)
    v0, a_f = line
    a_m = _mean_shift(t1, t2, line)
    shift = np.where(time <= t1, 0.0, np.where(time <= t2, a_m * (time - t1), v0 + a_f * time))
    # central differences: accelerations whose trapezoidal integral is the shift of velocity
    baseline: Series = np.gradient(shift, h)
    return series - baseline


def _settled(
    series: Series, h: float, times: Times, line: tuple[float, float]
) -> tuple[float, float]:
    """The t1 and t2 with which the displacement is closest to one step, or those given."""
    if times.t1 is not None and times.t2 is not None:
        return times.t1, times.t2
    every = max(1, series.size // SEARCH_SAMPLES)
    d = displacement(series, h)[::every]
    time = (h * every) * np.arange(d.size, dtype=np.float64)
    strongest = max(float(np.argmax(np.abs(series))) * h, times.onset + 10 * h)
    shortest = SHORTEST * (times.t3 - times.onset)
    begins = [times.t1] if times.t1 is not None else np.linspace(times.onset, strongest, TRIED_T1)
    best, found = math.inf, None
    for t1 in begins:
        first = max(strongest, t1 + shortest)
        last = max(times.t3, first + h)
        settles = (
            np.array([times.t2]) if times.t2 is not None else np.linspace(first, last, TRIED_T2)
        )
        settles = settles[settles > t1]
        if settles.size == 0:
            continue
        shifts = _shift_displacements(time, t1, settles, line)
        misfits = _misfits(d - shifts, time, times.t3)
        misfits *= 1.0 + (_mean_shift(t1, settles, line) / USUAL) ** 2
        least = int(np.argmin(misfits))
        if misfits[least] < best:
            best, found = float(misfits[least]), (float(t1), float(settles[least]))
    if found is None:
        raise InputError(
            f"no t1 after the onset at {times.onset:g} s is before t2 = {times.t2} s; give t1, too"
        )
    return found


def _mean_shift(t1: float, t2: Settling, line: tuple[float, float]) -> Settling:
    """a_m [m/s²]."""
    return (line[0] + line[1] * t2) / (t2 - t1)


def _shift_displacements(
    time: NDArray[np.float64], t1: float, settles: NDArray[np.float64], line: tuple[float, float]
) -> NDArray[np.float64]:
    """What the two-step shift adds to the displacement [m], for each t2, (t2, sample)."""
    v0, a_f = line
    t2 = settles[:, None]
    rising = 0.5 * _mean_shift(t1, t2, line) * (np.minimum(time, t2) - t1) ** 2
    later = v0 * (time - t2) + 0.5 * a_f * (time**2 - t2**2)
    return np.where(time <= t1, 0.0, rising + np.where(time > t2, later, 0.0))


def _misfits(d: NDArray[np.float64], time: NDArray[np.float64], t3: float) -> NDArray[np.float64]:
    """Least sum of squares between each row and a step from zero to its tail's mean, (row,)."""
    offset = d[:, time >= t3].mean(axis=1, keepdims=True)
    before = np.cumsum(d * d, axis=1)
    after = np.cumsum(((d - offset) ** 2)[:, ::-1], axis=1)[:, ::-1]
    least: NDArray[np.float64] = (before + after).min(axis=1)
    return least


def _quadratic(series: Series, h: float, times: Times) -> Series:
    time = np.arange(series.size) * h - (times.onset if times.t1 is None else times.t1)
    after = time >= 0.0
    v = velocity(series, h)
    basis = np.stack([time[after], time[after] ** 2], axis=1)
    (b, c), *_ = np.linalg.lstsq(basis, v[after] - v[after][0], rcond=None)
    slope: Series = np.where(after, b + 2.0 * c * time, 0.0)
    return series - slope
