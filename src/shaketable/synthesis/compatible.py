"""Artificial motions with a given response spectrum.

As in SIMQKE (Gasparini and Vanmarcke 1976) a motion is a sum of waves with random phases under an
envelope, their amplitudes adjusted until the spectrum fits. SIMQKE scales amplitudes by the ratio
of spectra, which leaves departures of some 12 % at single periods however often it is repeated;
here a few wavelets remove them (see `matching`), and the motion ends at rest.

Gasparini and Vanmarcke (1976) Simulated earthquake motions compatible with prescribed response
spectra, MIT R76-4.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from shaketable.engine import pool
from shaketable.errors import InputError, require_positive, require_whole
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.progress import Progress, meter
from shaketable.signal.spectra import Spectrum, peak_responses, response_spectrum
from shaketable.synthesis.matching import BAND, TOLERANCE, Goal, goal_of, matched, working_periods

#: The envelope's height at the times x = t/duration, both in [0, 1].
Envelope = Callable[[NDArray[np.float64]], NDArray[np.float64]]

#: Periods for a recorded target, whose spectrum is not smooth [s].
FINE_PERIODS = np.geomspace(0.02, 10.0, 1200)
SCALINGS = 5  # by the ratio of spectra
ROUNDS = 24  # of wavelets
SAFE = 0.88  # share of the tolerance aimed at: departures between checked periods may be larger
ATTEMPTS = 5  # each with new phases, where wavelets do not reach the tolerance


def trapezoid(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """An envelope that rises in the first 15 % and falls in the last 35 %."""
    return np.clip(np.minimum(x / 0.15, (1.0 - x) / 0.35), 0.0, 1.0)


def jennings(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """A parabola, a plateau and an exponential decay to 5 %. Jennings, Housner and Tsai (1968)."""
    decay = np.exp(-math.log(20.0) * (x - 0.5) / 0.5)
    return np.minimum(np.minimum((x / 0.15) ** 2, 1.0), decay)


#: Envelopes by name.
ENVELOPES: dict[str, Envelope] = {"trapezoid": trapezoid, "jennings": jennings}


# every argument after n is one choice with a default: an object of them would say no more
def spectrum_compatible(
    target: Spectrum | Motion,
    n: int,
    *,
    duration: float | None = None,
    envelope: str | Envelope = "trapezoid",
    seed: int = 0,
    time_step: float | None = None,
    band: tuple[float, float] = BAND,
    tolerance: float = TOLERANCE,
    progress: Progress = False,
    threads: int | None = None,
) -> list[Motion]:
    """Make `n` artificial motions whose response spectra match a target.

    Each is within `tolerance` of the target at every period of the band, begins at rest, ends at
    rest where it began, and has phases of its own. The k-th motion of a seed is the same for any n.

    Args:
        target: a spectrum, or a motion whose own 5 % spectrum, duration and time step (at
            most 0.01 s) are taken.
        n: number of motions.
        duration: [s]; 20 by default.
        envelope: "trapezoid", "jennings", or a function of t/duration.
        seed: of the random phases.
        time_step: [s]; 0.01 by default.
        band: periods in which the tolerance holds [s].
        tolerance: of the pseudo-acceleration, relative.
        progress: whether to draw a bar.
        threads: all cores by default; the results do not depend on it.

    Raises:
        InputError: arguments out of range, a target that does not cover the band, or one that no
            motion of that duration can match.
    """
    from threadpoolctl import threadpool_limits

    require_whole("n", n)
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        raise InputError(f"seed must be a whole number, not negative, got {seed!r}")
    if isinstance(target, Motion):
        duration = target.duration if duration is None else duration
        time_step = min(target.time_step, 0.01) if time_step is None else time_step
        target = response_spectrum(target, FINE_PERIODS)
    duration = 20.0 if duration is None else duration
    h = 0.01 if time_step is None else time_step
    require_positive("duration [s]", duration)
    require_positive("time_step [s]", h)
    if duration < 2.0 * band[1]:
        raise InputError(
            f"a duration of {duration:g} s is too short for periods of {band[1]:g} s: at least "
            f"{2 * band[1]:g} s is needed"
        )
    shape = ENVELOPES.get(envelope) if isinstance(envelope, str) else envelope
    if shape is None:
        raise InputError(f"unknown envelope {envelope!r}; accepted: {', '.join(ENVELOPES)}")
    goal = goal_of(target, band, tolerance, h)
    count = round(duration / h) + 1
    height = np.asarray(shape(np.linspace(0.0, 1.0, count)), dtype=np.float64)
    if height.shape != (count,) or not np.isfinite(height).all() or not (height > 0.0).any():
        raise InputError("an envelope must give a finite height at each of its times, not all zero")
    called = target.name or "a target"
    motions: list[Motion | None] = [None] * n

    def make(k: int, child: np.random.SeedSequence) -> int:
        series = _one(np.random.default_rng(child), height, h, goal, tolerance, called)
        said = f"artificial, compatible with {called}, seed {seed}, no. {k + 1}"
        origin = Origin(processing=(said,))
        motions[k] = Motion(series, h, name=f"{called} artificial {k + 1}", origin=origin)
        return 1

    children = enumerate(np.random.SeedSequence(seed).spawn(n))
    # every thread works on small matrices: with BLAS threads, it takes half as long again
    with meter("making motions", n, progress) as done, threadpool_limits(1, "blas"):
        pool.run_all([partial(make, k, child) for k, child in children], threads, done)
    return [motion for motion in motions if motion is not None]


def _one(
    rng: np.random.Generator,
    height: NDArray[np.float64],
    h: float,
    goal: Goal,
    tolerance: float,
    name: str,
) -> NDArray[np.float64]:
    closest = math.inf
    coarse = goal.only(working_periods(goal))
    for _ in range(ATTEMPTS):
        series, off = matched(waves(rng, height, h, coarse), h, goal, SAFE * tolerance, ROUNDS)
        if off <= tolerance:
            return series
        closest = min(closest, off)
    raise InputError(
        f"no motion came nearer to the target {name!r} than {closest:.0%}: give it a longer "
        "duration, a finer time step, a narrower band or a wider tolerance; is the target smooth?"
    )


def waves(
    rng: np.random.Generator,
    height: NDArray[np.float64],
    h: float,
    goal: Goal,
    *,
    scalings: int = SCALINGS,
) -> NDArray[np.float64]:
    """Waves of random phases under an envelope, scaled by the ratio of spectra a few times.

    Args:
        height: the envelope at the samples, shape (n,).
        h: time step [s].
    """
    from scipy.fft import irfft, next_fast_len, rfft, rfftfreq

    count = next_fast_len(height.size, real=True)
    f = rfftfreq(count, h)
    T = 1.0 / np.maximum(f, 1e-6)
    # the Fourier amplitude is about the pseudo-velocity; it is zero beyond the periods matched
    inside = (goal.periods[0] <= T) & (goal.periods[-1] >= T)
    psv = np.interp(np.log(T), np.log(goal.periods), goal.wanted * goal.periods)
    spectrum = np.where(inside, psv, 0.0) * np.exp(2j * math.pi * rng.random(f.size))
    series = irfft(spectrum, count)[: height.size] * height
    for _ in range(scalings):
        found, _ = peak_responses(series, h, goal.periods, damping=goal.damping)
        ratio = np.interp(np.log(T), np.log(goal.periods), goal.wanted / np.abs(found))
        series = irfft(rfft(series, count) * ratio, count)[: height.size]
    return series * (height > 0.0)
