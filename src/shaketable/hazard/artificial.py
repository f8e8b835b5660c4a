"""Artificial motions of an earthquake of a magnitude at a distance.

A spectrum is drawn for each motion from the ground-motion models, correlated in period, and a
significant duration, evenly over what they may be, so that few motions stand for many. Waves of
random phases under a trapezoid are brought near to that spectrum; a few wavelets follow where they
help. Spectra that are drawn are rough, and some of them no motion can have: each motion is near to
its own, not on it. What ensembles of these motions have is in docs/how_to/hazard.md.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from shaketable.engine import pool
from shaketable.errors import InputError, require_whole
from shaketable.hazard.ground_motion import Scenario, correlation
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.progress import Progress, meter
from shaketable.signal.spectra import Spectrum
from shaketable.synthesis.compatible import trapezoid, waves
from shaketable.synthesis.matching import Goal, goal_of, matched, state_of, working_periods

EVERY = 4  # of a scenario's periods is drawn; between them spectra are smooth
BAND = (0.03, 8.0)  # s: periods that motions have
TIME_STEP = 0.005  # s
SHORTEST = 2.0 * BAND[1]  # s: what is shaken for less is followed by quiet
WITHIN = 0.638  # of a trapezoid's length, from 5 to 95 % of its square's integral
NEAR = 0.15  # departure [relative] at which wavelets stop
ROUNDS = 4  # of wavelets: more of them drive apart what cannot be had


def artificial_motions(
    quake: Scenario,
    n: int,
    *,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> list[Motion]:
    """Make artificial motions of an earthquake, with the scatter of ground-motion models.

    Each is one horizontal component. The k-th motion of a seed is the same for any n.

    Args:
        quake: of which they are.
        n: how many.
        seed: of spectra, durations and phases.
        progress: whether to draw a bar.
        threads: all cores by default; the results do not depend on it.

    Raises:
        InputError: n is no whole number from 1 on, or a negative seed.
    """
    from threadpoolctl import threadpool_limits

    require_whole("n", n)
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        raise InputError(f"seed must be a whole number, not negative, got {seed!r}")
    normal = _normal(n, quake.periods[::EVERY].size + 1, seed)
    axes = _axes(quake)
    # row by row: a product of matrices rounds otherwise for another number of rows
    spectra = [quake.ln_spectrum[::EVERY] + axes @ drawn for drawn in normal[:, :-1]]
    median, spread = quake.duration
    durations = median * np.exp(spread * normal[:, -1]) / WITHIN
    motions: list[Motion | None] = [None] * n

    def make(k: int, child: np.random.SeedSequence) -> int:
        spectrum = _smooth(quake.periods[::EVERY], spectra[k])
        series = _near(np.random.default_rng(child), spectrum, float(durations[k]))
        said = f"artificial, of {quake.name}, seed {seed}, no. {k + 1}"
        origin = Origin(magnitude=quake.magnitude, processing=(said,))
        motions[k] = Motion(series, TIME_STEP, name=f"artificial {k + 1}", origin=origin)
        return 1

    children = enumerate(np.random.SeedSequence(seed).spawn(n))
    # every thread works on small matrices: with BLAS threads, it takes half as long again
    with meter("making motions", n, progress) as done, threadpool_limits(1, "blas"):
        pool.run_all([partial(make, k, child) for k, child in children], threads, done)
    return [motion for motion in motions if motion is not None]


def _normal(n: int, dimensions: int, seed: int) -> NDArray[np.float64]:
    """Standard normal numbers that fill space evenly (Sobol', scrambled), (n, dimensions)."""
    from scipy.special import ndtri
    from scipy.stats.qmc import Sobol

    points = Sobol(dimensions, rng=np.random.default_rng(seed)).random(1 << (n - 1).bit_length())[
        :n
    ]
    return np.asarray(ndtri(np.clip(points, 1e-12, 1.0 - 1e-12)))


def _axes(quake: Scenario) -> NDArray[np.float64]:
    """The principal axes of ln spectra times their standard deviations, the largest first."""
    periods, sigma = quake.periods[::EVERY], quake.sigma[::EVERY]
    values, vectors = np.linalg.eigh(np.outer(sigma, sigma) * correlation(periods))
    axes = vectors[:, ::-1] * np.sqrt(np.maximum(values[::-1], 0.0))
    return np.asarray(axes * np.where(axes.sum(axis=0) < 0.0, -1.0, 1.0))  # whatever the library


def _smooth(periods: NDArray[np.float64], ln_spectrum: NDArray[np.float64]) -> Spectrum:
    """The spectrum through a few points: its logarithm in that of the period, without overshoot."""
    from scipy.interpolate import PchipInterpolator

    curve = PchipInterpolator(np.log(periods), ln_spectrum)
    fine = np.geomspace(periods[0], periods[-1], 16 * (periods.size - 1) + 1)
    fine[[0, -1]] = periods[[0, -1]]  # geomspace ends a round-off beside them
    return Spectrum(fine, np.exp(curve(np.log(fine))))


def _near(random: np.random.Generator, spectrum: Spectrum, duration: float) -> NDArray[np.float64]:
    """A series [m/s²] whose spectrum is near another, with or without wavelets: the nearer one."""
    goal = goal_of(spectrum, BAND, NEAR, TIME_STEP)
    shaken = trapezoid(np.linspace(0.0, 1.0, round(duration / TIME_STEP) + 1))
    quiet = max(round(SHORTEST / TIME_STEP) + 1 - shaken.size, 0)
    height = np.pad(shaken, (0, quiet))
    start = waves(random, height, TIME_STEP, goal.only(working_periods(goal)))
    tried = [matched(start, TIME_STEP, goal, NEAR, rounds)[0] for rounds in (0, ROUNDS)]
    return min(tried, key=lambda series: _off(series, goal))


def _off(series: NDArray[np.float64], goal: Goal) -> float:
    """The mean square of ln of the ratio to the goal."""
    relative = np.abs(state_of(series, TIME_STEP, goal).relative[goal.counts])
    return float((np.log(np.maximum(relative, 1e-12)) ** 2).mean())
