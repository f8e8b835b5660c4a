"""Bringing a motion's response spectrum to a target by wavelets, one for each period.

Each wavelet is added where its oscillator responds most, so that the motion changes little
elsewhere. Their amplitudes follow from what every wavelet does to every oscillator, by damped
least squares; as the peaks move, it takes a few rounds. After each round, the end velocity and
displacement are brought back to zero by an acceleration that varies as slowly as the motion
allows, to which oscillators with periods of a few seconds do not respond.

Al Atik and Abrahamson (2010) An improved method for nonstationary spectral matching, Earthquake
Spectra 26(3), 601-617.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.signal.integrate import displacement, velocity
from shaketable.signal.spectra import Spectrum, peak_responses

BAND = (0.05, 3.0)  # s: where the tolerance holds
MARGIN = 1.25  # the periods adjusted go beyond the band by this factor at either end
PER_E = 400  # periods per factor of e, 0.25 % apart: the largest peak changes between coarser ones
WORKING = 10  # every tenth period is adjusted from the start, others when they turn out to be off
TOLERANCE = 0.10
RECORD_ROUNDS = 80  # for a recorded motion, which cannot be replaced by another
APART = (
    0.04,
    0.025,
)  # of a period, between one round's wavelets; the second where the first fails
NEAR = 0.03  # relative departures below which no wavelet is spent
EASY = 0.5  # weight of a period without departure; one that is off by the tolerance has 1 more
RIDGE = 0.05  # of the mean singular value: it keeps wavelets that counteract each other small
PULLS = (1.0, 0.5, 0.25)  # shares of the amplitudes, tried in turn until the score falls
POWER = 8  # the score is the sum of the departures to this power


class Goal(NamedTuple):
    """The periods and accelerations to match.

    Attributes:
        periods: [s].
        wanted: pseudo-accelerations [m/s²].
        counts: at which periods the tolerance holds.
        damping: ratio of critical damping.
    """

    periods: NDArray[np.float64]
    wanted: NDArray[np.float64]
    counts: NDArray[np.bool_]
    damping: float

    def only(self, which: NDArray[np.bool_]) -> Goal:
        """The goal at some of its periods."""
        return Goal(self.periods[which], self.wanted[which], self.counts[which], self.damping)


class Matched(NamedTuple):
    """A series, with its peak responses at a goal's periods relative to those wanted, and when."""

    series: NDArray[np.float64]
    relative: NDArray[np.float64]
    times: NDArray[np.float64]

    @property
    def off(self) -> NDArray[np.float64]:
        """Relative departures, shape (periods,)."""
        return np.abs(np.abs(self.relative) - 1.0)

    @property
    def score(self) -> float:
        return float((self.off**POWER).sum())


def goal_of(
    target: Spectrum, band: tuple[float, float], tolerance: float, time_step: float
) -> Goal:
    """The periods to match, with the band's ends among them, and which of them are in the band.

    Raises:
        InputError: a tolerance out of range, or a band that is empty, that the target does not
            cover, or whose periods are too short for the time step.
    """
    low, high = band
    if not 0.0 < tolerance < 1.0:
        raise InputError(f"the tolerance must be between 0 and 1, got {tolerance!r}")
    if 4.0 * time_step > low:
        raise InputError(
            f"a time step of {time_step:g} s cannot hold periods of {low:g} s: the shortest "
            f"is {4 * time_step:g} s"
        )
    if not 0.0 < low < high:
        raise InputError(f"a band of periods must be 0 < low < high, got {band}")
    if low < target.periods[0] * (1 - 1e-9) or high > target.periods[-1] * (1 + 1e-9):
        raise InputError(
            f"the target {target.name!r} goes from {target.periods[0]:g} to "
            f"{target.periods[-1]:g} s, but the band is {low:g} to {high:g} s"
        )
    widest = max(low / MARGIN, float(target.periods[0])), min(high * MARGIN, target.periods[-1])
    parts = [
        np.geomspace(one, other, max(2, 1 + round(PER_E * math.log(other / one))))
        for one, other in ((widest[0], low), (low, high), (high, widest[1]))
        if other > one * (1 + 1e-9)
    ]
    periods = np.unique(np.concatenate(parts))
    wanted = target.at(periods)
    if not (wanted > 1e-12).all():
        raise InputError(f"the target {target.name!r} is zero in the band")
    counts = (periods >= low * (1 - 1e-9)) & (periods <= high * (1 + 1e-9))
    return Goal(periods, wanted, counts, target.damping)


def matched(
    acceleration: NDArray[np.float64],
    h: float,
    goal: Goal,
    tolerance: float,
    rounds: int,
    apart: float = APART[0],
) -> tuple[NDArray[np.float64], float]:
    """The series [m/s²] brought as close to the goal as it came, and its largest departure."""
    series = at_rest_after(acceleration, h)
    worked_on = working_periods(goal)
    part = goal.only(worked_on)
    state = state_of(series, h, part)
    best, least = series, math.inf
    for _ in range(rounds):
        if state.off[part.counts].max() <= tolerance:
            whole = state_of(state.series, h, goal)
            now = float(whole.off[goal.counts].max())
            if now < least:
                best, least = state.series, now
            if least <= tolerance:
                return best, least
            worked_on = worked_on | (whole.off > tolerance)
            part = goal.only(worked_on)
            state = Matched(state.series, whole.relative[worked_on], whole.times[worked_on])
        state = _adjusted(state, h, part, tolerance, apart)
    now = float(state_of(state.series, h, goal).off[goal.counts].max())
    return (state.series, now) if now < least else (best, least)


def working_periods(goal: Goal) -> NDArray[np.bool_]:
    """Every tenth period, and the band's ends."""
    chosen = np.zeros(goal.periods.size, dtype=np.bool_)
    chosen[::WORKING] = True
    chosen[np.flatnonzero(goal.counts)[[0, -1]]] = True
    return chosen


def state_of(series: NDArray[np.float64], h: float, goal: Goal) -> Matched:
    found, times = peak_responses(series, h, goal.periods, damping=goal.damping)
    return Matched(series, found / goal.wanted, np.minimum(times, (series.size - 1) * h))


def _adjusted(state: Matched, h: float, goal: Goal, tolerance: float, apart: float) -> Matched:
    """One round of wavelets at the periods that are farthest off."""
    from shaketable.oscillators.matching import add_wavelets, wavelet_responses

    f = 1.0 / goal.periods
    off = state.off
    chosen = _worst(goal.periods, off, apart)
    times = state.times[chosen]
    responses = np.empty((f.size, chosen.size))
    wavelet_responses(f, goal.damping, state.times, chosen, state.series.size, h, responses)
    # relative, so that small ordinates count as much as large ones
    weight = EASY + (off / tolerance) ** 2
    matrix = responses / goal.wanted[:, None] * goal.wanted[chosen] * weight[:, None]
    missing = (np.sign(state.relative) - state.relative) * weight
    normal, wanted = matrix.T @ matrix, matrix.T @ missing
    damped = normal + RIDGE**2 * np.trace(normal) / chosen.size * np.eye(chosen.size)
    amplitudes = np.linalg.solve(damped, wanted) * goal.wanted[chosen]
    tries = []
    for pull in PULLS:
        series = state.series.copy()
        add_wavelets(f[chosen], goal.damping, times, pull * amplitudes, h, series)
        tries.append(state_of(at_rest_after(series, h), h, goal))
        if tries[-1].score < state.score:
            break
    return min(tries, key=lambda one: one.score)


def _worst(
    periods: NDArray[np.float64], off: NDArray[np.float64], apart: float
) -> NDArray[np.int64]:
    """The periods that are farthest off, not too close to each other; at least one."""
    logs = np.log(periods)
    free = off >= min(NEAR, float(off.max()))
    chosen = []
    for k in np.argsort(-off):
        if free[k]:
            chosen.append(int(k))
            free &= np.abs(logs - logs[k]) > apart
    return np.array(chosen, dtype=np.int64)


def at_rest_after(acceleration: NDArray[np.float64], h: float) -> NDArray[np.float64]:
    """The series with zero velocity and displacement at the end, and zero acceleration at both.

    Two shapes, both zero at the ends, are subtracted: sin² with one hump over the whole motion,
    and the same multiplied by the time from its middle.
    """
    x = np.linspace(0.0, 1.0, acceleration.size)
    series = acceleration.copy()
    series[0] = series[-1] = 0.0
    shapes = np.sin(math.pi * x) ** 2 * np.stack([np.ones_like(x), x - 0.5])
    ends = [[velocity(one, h)[-1], displacement(one, h)[-1]] for one in (*shapes, series)]
    share = np.linalg.solve(np.array(ends[:2]).T, np.array(ends[2]))
    drift: NDArray[np.float64] = share @ shapes
    return series - drift


def match_spectrum(
    motion: Motion,
    target: Spectrum,
    *,
    band: tuple[float, float] = BAND,
    tolerance: float = TOLERANCE,
    prescale: bool = True,
) -> Motion:
    """Change a recorded motion so that its spectrum matches a target in a band of periods.

    It keeps the motion's length, time step and, as far as the target allows, its phases; its
    vertical component is scaled by the same factor. It ends at rest, where it began.

    Args:
        band: periods in which the tolerance holds [s].
        tolerance: of the pseudo-acceleration, relative.
        prescale: scale the motion first so that both spectra agree in the mean of their
            logarithms.

    Raises:
        InputError: a tolerance out of range, a target that does not cover the band, or a motion
            that cannot be brought to it: too short, too coarse, or without anything in the band.
    """
    goal = goal_of(target, band, tolerance, motion.time_step)
    if motion.peak_ground_acceleration == 0.0:
        raise InputError(f"the motion {motion.name!r} is at rest; there is nothing to match")
    factor = 1.0
    if prescale:
        there = state_of(motion.horizontal, motion.time_step, goal).relative[goal.counts]
        factor = float(np.exp(-np.log(np.abs(there)).mean()))
    start = motion.scaled(factor)
    off = math.inf
    for apart in APART:
        if off > tolerance:
            series, off = matched(
                start.horizontal, motion.time_step, goal, tolerance, RECORD_ROUNDS, apart
            )
    if off > tolerance:
        raise InputError(
            f"{motion.name!r} could be brought only to within {off:.0%} of {target.name!r}, not "
            f"{tolerance:.0%}: try a longer motion, one with a spectrum of that shape, or a "
            "narrower band"
        )
    said = f"matched to {target.name or 'a target'} between {band[0]:g} and {band[1]:g} s"
    return start.after(
        said, horizontal=series, vertical=start.vertical, transverse=start.transverse
    )
