"""One body, sample by sample, until the motion has ended and it rests or has fallen.

The loop that both models share; each gives it functions of its own (`rocking_one`, `general_one`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import kernel
from shaketable.physics.plane.forcing import Interval, Shaking
from shaketable.physics.plane.taylor import MAX_PHASE

GOING_ON = -1  # in place of an ending
FREE_LIMIT = 3600.0  # s after the motion's end; what still moves then is given up
MOST_FREE_STEPS = 1_000_000  # and after so many steps: of what is smaller than some 0.2 m
FREE_PHASE = 0.02  # rad: after the motion's end, steps of at least this √(k g) h
MOST_IMPACTS = 1_000_000  # what still bounces then after the motion's end is given up


class Run(NamedTuple):
    """How a run ended."""

    passage: Any  # what became of the body in its last interval
    ending: int  # or GOING_ON if it was given up
    start: float  # of its last interval [s]
    h: float  # its length [s]
    samples: int  # of its history


class PlanarSummary(NamedTuple):
    """What a driver writes about a run, in numbers."""

    ending: float
    direction: float  # +1 toward +x, -1, or 0 if it did not overturn
    overturning_time: float  # s, NaN if it did not
    peak: float  # rad
    impacts: float
    samples: float  # of its history
    slip: float  # at the end [m], + toward +x
    lift: float  # m
    farthest_left: float  # m, <= 0
    farthest_right: float  # m
    changes: float  # of phase


@kernel
def shake_one(
    passage: Any,
    body: Any,
    shaking: Shaking,
    history: Any,
    frequency: float,
    write: Callable[..., None],
    cross: Callable[..., tuple[Any, int]],
    settle: Callable[..., tuple[Any, int]],
) -> Run:
    """Take a body through the motion, and on until its run is over.

    Args:
        passage: state of the body, and what became of it so far.
        body, shaking: what is shaken, and how.
        history: where the run is written, as much of it as fits.
        frequency: √(k g) of the body [rad/s].
        write: (history, sample, time, body, passage) writes a sample.
        cross: (passage, body, shaking, interval, history) takes it through an interval; returns
            how its run ended, or GOING_ON.
        settle: likewise, says at a sample after the motion's end whether the run is over.
    """
    h = shaking.time_step
    for i in range(shaking.a_x.size - 1):
        write(history, i, i * h, body, passage)
        passage, ending = cross(passage, body, shaking, Interval(i, i * h, 1.0), history)
        if ending != GOING_ON:
            return Run(passage, ending, i * h, h, i + 1)
    return shake_free(passage, body, shaking, history, frequency, write, cross, settle)


@kernel
def shake_free(
    passage: Any,
    body: Any,
    shaking: Shaking,
    history: Any,
    frequency: float,
    write: Callable[..., None],
    cross: Callable[..., tuple[Any, int]],
    settle: Callable[..., tuple[Any, int]],
) -> Run:
    """Go on from the motion's end under gravity alone; arguments as for `shake_one`."""
    last = shaking.a_x.size - 1
    end = last * shaking.time_step
    h, intervals = free_steps(shaking.time_step, frequency)
    free = Shaking(shaking.a_x, shaking.g_effective, h)
    start = end
    for i in range(intervals):
        start = end + i * h
        write(history, last + i, start, body, passage)
        interval = Interval(last + i, start, 1.0)
        passage, ending = settle(passage, body, free, interval, history)
        if ending == GOING_ON:
            passage, ending = cross(passage, body, free, interval, history)
        if ending != GOING_ON:
            return Run(passage, ending, start, h, last + i + 1)
    return Run(passage, GOING_ON, start, h, last + intervals)


@kernel
def free_steps(time_step: float, frequency: float) -> tuple[float, int]:
    """The length of the steps after the motion's end [s], and how many are taken at most.

    Args:
        time_step: of the motion [s].
        frequency: √(k g) of the body [rad/s].
    """
    h = min(max(time_step, FREE_PHASE / frequency), MAX_PHASE / frequency)
    # what math.ceil gives is a float on a GPU
    return h, min(int(math.ceil(FREE_LIMIT / h)), MOST_FREE_STEPS)  # noqa: RUF046


@kernel
def write_summary(numbers: NDArray[np.float64], summary: PlanarSummary) -> None:
    """Write what a driver found."""
    for k in range(len(summary)):
        numbers[k] = summary[k]


@kernel
def no_push(shaking: Shaking, i: int) -> bool:
    """Whether the motion has ended when interval i begins."""
    return i + 1 >= shaking.a_x.size
