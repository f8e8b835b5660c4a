"""Many bodies of the rocking model under one motion, on one core."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.engine.endings import OVERTURNED, STANDING, STILL_ROCKING
from shaketable.engine.lane_loop import (
    NEVER,
    RUN,
    Batch,
    Shared,
    block_of,
    enqueue,
    interval_of,
    next_tipping,
    note_passage,
    passage_of,
    run_lanes,
)
from shaketable.engine.lanes import ROCKING_FIELDS
from shaketable.engine.rocking_one import History, rock_free
from shaketable.kernels.events import cross_interval
from shaketable.kernels.forcing import Shaking
from shaketable.kernels.rocking import AT_REST, Passage, State

Times = NDArray[np.float64]  # room for the times of impacts: none


@routine
def cross(batch: Batch, lane: int, state: State, shaking: Shaking, i: int, times: Times) -> Passage:
    """Take one body through interval i event by event, and write down what that brought."""
    interval = interval_of(batch, lane, shaking, i)
    passage = passage_of(batch, lane, state)
    passage = cross_interval(passage, block_of(batch, lane), shaking, interval, times)
    note_passage(batch, lane, passage, interval.start, shaking.time_step)
    return passage


@routine
def rest_until_it_rocks(batch: Batch, lane: int, shared: Shared, times: Times, i: int) -> None:
    """Take a body at rest ahead from interval i, to the sample at which it rocks."""
    block, polarity = block_of(batch, lane), batch.runs[lane, RUN.polarity]
    i = next_tipping(block, polarity, shared, i)
    while i != NEVER:
        passage = cross(batch, lane, AT_REST, shared.shaking, i, times)
        if passage.fallen_at >= 0.0:
            return
        if passage.state.side != 0.0:
            enqueue(shared.queue, lane, passage.state, i + 1)
            return
        i = next_tipping(block, polarity, shared, i + 1)


@kernel
def begin(batch: Batch, lane: int, shared: Shared, times: Times) -> None:
    rest_until_it_rocks(batch, lane, shared, times, 0)


@kernel
def resolve(
    batch: Batch, lane: int, state: State, shared: Shared, times: Times, i: int
) -> tuple[bool, State]:
    """Take a body with an event through interval i; it stays in its lane unless it falls or rests."""
    passage = cross(batch, lane, state, shared.shaking, i, times)
    if passage.fallen_at >= 0.0:
        return False, passage.state
    if passage.state.side == 0.0:
        rest_until_it_rocks(batch, lane, shared, times, i + 1)
        return False, passage.state
    return True, passage.state


@routine
def finish(batch: Batch, lane: int, state: State, shared: Shared, times: Times) -> None:
    """Take a body on from the motion's end until it rests or has fallen."""
    history = History(times, times, times, times)
    passage = passage_of(batch, lane, state)
    run = rock_free(passage, block_of(batch, lane), shared.shaking, history)
    note_passage(batch, lane, run.passage, run.start, run.h)
    if run.ending not in (OVERTURNED, STANDING):
        batch.runs[lane, RUN.ending] = STILL_ROCKING


@driver
def rock_many(
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    demands: NDArray[np.float64],
    h: float,
    batch: Batch,
) -> None:
    """Simulate every body, initially at rest, under one motion.

    Args:
        push, gravity: a_x and g + a_y at the samples [m/s²].
        demands: what `lane_loop.demands_of` gives for them.
        h: time step [s].
        batch: the bodies; the results are written there.
    """
    shaking, no_times = Shaking(push, gravity, h), np.empty(0)
    run_lanes(batch, shaking, demands, no_times, ROCKING_FIELDS, begin, resolve, finish)
