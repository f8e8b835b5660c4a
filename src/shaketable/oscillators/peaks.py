"""Linear oscillators under one motion: peaks over many periods, or one history."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.oscillators.oscillator import (
    LONGEST_PHASE,
    GroundSeries,
    Step,
    advance,
    extreme,
    free_extreme,
    highest,
    step_of,
)

LANES = 16  # oscillators that go through the motion together
# rows of a batch: the step's matrix, the oscillator's frequency, the state before and after
UU, UV, UA, US, VU, VV, VA, VS, W, U, V, U_WAS, V_WAS, PEAK, TIME, HIT = (
    row * LANES for row in range(16)
)
ROWS = 16


@driver
def peak_displacements(
    acceleration: NDArray[np.float64],
    time_step: float,
    w: NDArray[np.float64],
    damping: float,
    peaks: NDArray[np.float64],
    times: NDArray[np.float64],
) -> None:
    """Write each oscillator's largest |u| [m], with u's sign, and its time [s].

    They go from rest through the samples and the free vibration after the last. `w` must fall.
    """
    batch = np.empty(ROWS * LANES)
    for first in range(0, w.size, LANES):
        parts = math.ceil(w[first] * time_step / LONGEST_PHASE)
        h = time_step / parts
        for lane in range(LANES):
            enter(batch, lane, w[min(first + lane, w.size - 1)], damping, h)
        for i in range(acceleration.size - 1):
            a = acceleration[i]
            s = (acceleration[i + 1] - a) / time_step
            for part in range(parts):
                if step_batch(batch, damping, h, a, s) > 0:
                    look_closer(batch, damping, h, a, s, i * time_step + part * h)
                a += s * h
        end = (acceleration.size - 1) * time_step
        for lane in range(min(LANES, w.size - first)):
            top, when = free_extreme(batch[W + lane], damping, batch[U + lane], batch[V + lane])
            later = abs(top) > abs(batch[PEAK + lane])
            peaks[first + lane] = top if later else batch[PEAK + lane]
            times[first + lane] = end + when if later else batch[TIME + lane]


@kernel
def enter(batch: NDArray[np.float64], lane: int, w: float, damping: float, h: float) -> None:
    """Put an oscillator at rest into a lane."""
    for row, entry in enumerate(step_of(w, damping, h)):
        batch[row * LANES + lane] = entry
    for row in (W, U, V, U_WAS, V_WAS, PEAK, TIME, HIT):
        batch[row + lane] = 0.0
    batch[W + lane] = w


@kernel
def matrix_in(batch: NDArray[np.float64], lane: int) -> Step:
    """The step matrix of a lane."""
    return Step(
        batch[UU + lane],
        batch[UV + lane],
        batch[UA + lane],
        batch[US + lane],
        batch[VU + lane],
        batch[VV + lane],
        batch[VA + lane],
        batch[VS + lane],
    )


@kernel
def step_batch(batch: NDArray[np.float64], damping: float, h: float, a: float, s: float) -> int:
    """Take every lane one step on; mark the lanes that may have a new peak, and count them."""
    hits = 0
    for lane in range(LANES):
        u, v = batch[U + lane], batch[V + lane]
        u1, v1 = advance(matrix_in(batch, lane), u, v, a, s)
        batch[U_WAS + lane], batch[V_WAS + lane] = u, v
        batch[U + lane], batch[V + lane] = u1, v1
        most = highest(batch[W + lane], damping, h, u, v, u1, v1, GroundSeries(a, s))
        bound = most if v * v1 < 0.0 else abs(u1)
        hit = 1 if bound > abs(batch[PEAK + lane]) else 0
        batch[HIT + lane] = hit
        hits += hit
    return hits


@routine
def look_closer(
    batch: NDArray[np.float64], damping: float, h: float, a: float, s: float, at: float
) -> None:
    """Give the marked lanes the step's largest |u|, where it is a new peak."""
    for lane in range(LANES):
        if batch[HIT + lane] == 0.0:
            continue
        u, v = batch[U_WAS + lane], batch[V_WAS + lane]
        u1, v1 = batch[U + lane], batch[V + lane]
        top, time = u1, at + h
        if v * v1 < 0.0:
            inside = extreme(batch[W + lane], damping, h, u, v, u1, v1, GroundSeries(a, s))
            if abs(inside) > abs(top):
                top, time = inside, at + v / (v - v1) * h
        if abs(top) > abs(batch[PEAK + lane]):
            batch[PEAK + lane] = top
            batch[TIME + lane] = time


@driver
def history(
    acceleration: NDArray[np.float64],
    time_step: float,
    w: float,
    damping: float,
    displacement: NDArray[np.float64],
    velocity: NDArray[np.float64],
) -> None:
    """Write u [m] and u' [m/s] at the samples, from rest."""
    to = step_of(w, damping, time_step)
    u = v = 0.0
    displacement[0] = velocity[0] = 0.0
    for i in range(acceleration.size - 1):
        a = acceleration[i]
        s = (acceleration[i + 1] - a) / time_step
        u, v = advance(to, u, v, a, s)
        displacement[i + 1] = u
        velocity[i + 1] = v
