"""One body, sample by sample, with its history."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.blocks import block_of
from shaketable.engine.endings import OVERTURNED, STANDING, STILL_ROCKING
from shaketable.kernels.compiled import driver, kernel, routine
from shaketable.kernels.events import cross_interval
from shaketable.kernels.rocking import (
    Block,
    Passage,
    State,
    bounce,
    push_at,
    released,
    rocking_frequency,
    side_of,
    step,
)
from shaketable.kernels.taylor import MAX_PHASE

FREE_ROCKING_LIMIT = 3600.0  # s after the motion's end; what still rocks then counts as standing
FREE_PHASE = 0.02  # rad: after the motion's end, steps of at least this √(k g) h


class History(NamedTuple):
    """Where one body's run is written to, as much of it as fits."""

    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    impact_times: NDArray[np.float64]


class Release(NamedTuple):
    """What became of a body after the motion's end: its last interval, and where that began."""

    passage: Passage
    start: float
    h: float
    samples: int


class Ending(NamedTuple):
    """How one body's run ended, and how long a history it needs."""

    ending: int
    direction: int
    overturning_time: float
    peak: float
    impacts: int
    samples: int


@kernel
def write(history: History, sample: int, time: float, state: State) -> None:
    if sample < history.time.size:
        history.time[sample] = time
        history.rotation[sample] = state.side * state.height
        history.angular_velocity[sample] = state.side * state.rate


@routine
def cross(
    state: State,
    block: Block,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    i: int,
    start: float,
    h: float,
    peak: float,
    impacts: int,
    impact_times: NDArray[np.float64],
) -> Passage:
    """One interval for one body: the short ways first."""
    if state.side != 0.0:
        here, there = side_of(block, state.side), side_of(block, -state.side)
        force = push_at(push, gravity, state.side, i)
        height, rate, sine, cosine, eventful = step(
            state.height, state.rate, state.sine, state.cosine, here.k, peak, h, force
        )
        if not eventful:
            moved = State(state.side, height, rate, sine, cosine)
            return Passage(moved, max(peak, height), impacts, -1.0)
        height, rate, sine, cosine, u, _, clean = bounce(
            state.height,
            state.rate,
            state.sine,
            state.cosine,
            here.k,
            here.keep,
            there.k,
            there.sine,
            there.cosine,
            peak,
            h,
            force,
        )
        if clean:
            if impacts < impact_times.size:
                impact_times[impacts] = start + u * h
            moved = State(there.sign, height, rate, sine, cosine)
            return Passage(moved, peak, impacts + 1, -1.0)
    return cross_interval(
        state, block, push, gravity, 1.0, i, start, h, peak, impacts, impact_times
    )


@routine
def rock_free(
    state: State,
    block: Block,
    end: float,
    h: float,
    peak: float,
    impacts: int,
    history: History,
    sample: int,
) -> Release:
    """Go on under gravity alone until rest, overturning or FREE_ROCKING_LIMIT."""
    nothing = np.empty(0)
    frequency = rocking_frequency(block)
    h = min(max(h, FREE_PHASE / frequency), MAX_PHASE / frequency)
    passage = Passage(state, peak, impacts, -1.0)
    for i in range(math.ceil(FREE_ROCKING_LIMIT / h)):
        start = end + i * h
        write(history, sample, start, passage.state)
        sample += 1
        if passage.state.side == 0.0:
            return Release(passage, start, h, sample)
        passage = cross(
            passage.state,
            block,
            nothing,
            nothing,
            i,
            start,
            h,
            passage.peak,
            passage.impacts,
            history.impact_times,
        )
        if passage.fallen_at >= 0.0:
            return Release(passage, start, h, sample)
    return Release(passage, end, h, sample)


@kernel
def ended(passage: Passage, start: float, h: float, samples: int) -> Ending:
    side = passage.state.side
    if passage.fallen_at >= 0.0:
        time = start + passage.fallen_at * h
        direction = 1 if side > 0.0 else -1
        return Ending(OVERTURNED, direction, time, passage.peak, passage.impacts, samples)
    ending = STANDING if side == 0.0 else STILL_ROCKING
    return Ending(ending, 0, np.nan, passage.peak, passage.impacts, samples)


@driver
def rock_one(
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    h: float,
    blocks: NDArray[np.float64],
    initial_rotation: float,
    history: History,
) -> Ending:
    """One body, sample by sample, until the motion has ended and it rests or has fallen."""
    block = block_of(blocks, 0)
    state = released(block, initial_rotation)
    passage = Passage(state, state.height, 0, -1.0)
    for i in range(push.size - 1):
        write(history, i, i * h, passage.state)
        passage = cross(
            passage.state,
            block,
            push,
            gravity,
            i,
            i * h,
            h,
            passage.peak,
            passage.impacts,
            history.impact_times,
        )
        if passage.fallen_at >= 0.0:
            return ended(passage, i * h, h, i + 1)
    release = rock_free(
        passage.state,
        block,
        (push.size - 1) * h,
        h,
        passage.peak,
        passage.impacts,
        history,
        push.size - 1,
    )
    return ended(release.passage, release.start, release.h, release.samples)
