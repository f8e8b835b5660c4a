"""Many bodies of the rocking model under one motion, on one core."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.engine.batch import (
    NEVER,
    OVER,
    RESULT,
    Batch,
    Entry,
    block_of,
    next_tipping,
    note_passage,
    passage_of,
    rock_through,
)
from shaketable.engine.endings import OVERTURNED, STANDING, STILL_ROCKING
from shaketable.engine.lane_loop import run_lanes
from shaketable.engine.lanes import ROCKING_FIELDS
from shaketable.engine.rocking_one import History, rock_free
from shaketable.physics.plane.forcing import Shaking
from shaketable.physics.plane.rocking import AT_REST, State

Times = NDArray[np.float64]  # an empty array of times of impacts


@routine
def rest_until_it_rocks(
    batch: Batch, row: int, shaking: Shaking, demands: NDArray[np.float64], times: Times, i: int
) -> Entry:
    """Take a body at rest ahead from interval i, to the sample at which it rocks."""
    block, polarity = block_of(batch, row), batch.results[row, RESULT.polarity]
    i = next_tipping(block, polarity, shaking, demands, i)
    while i != NEVER:
        passage = rock_through(batch, row, block, AT_REST, shaking, i, times)
        if passage.fallen_at >= 0.0:
            return OVER
        if passage.state.side != 0.0:
            return Entry(i + 1, passage.state)
        i = next_tipping(block, polarity, shaking, demands, i + 1)
    return OVER


@kernel
def begin(
    batch: Batch, row: int, shaking: Shaking, demands: NDArray[np.float64], times: Times
) -> Entry:
    return rest_until_it_rocks(batch, row, shaking, demands, times, 0)


@kernel
def resolve(
    batch: Batch,
    row: int,
    shaking: Shaking,
    demands: NDArray[np.float64],
    times: Times,
    state: State,
    i: int,
) -> Entry:
    """Take a body with an event through interval i, and ahead until it rocks again."""
    passage = rock_through(batch, row, block_of(batch, row), state, shaking, i, times)
    if passage.fallen_at >= 0.0:
        return OVER
    if passage.state.side == 0.0:
        return rest_until_it_rocks(batch, row, shaking, demands, times, i + 1)
    return Entry(i + 1, passage.state)


@routine
def finish(batch: Batch, row: int, shaking: Shaking, times: Times, state: State) -> None:
    """Take a body on from the motion's end until it rests or has fallen."""
    history = History(times, times, times, times)
    passage = passage_of(batch, row, state)
    run = rock_free(passage, block_of(batch, row), shaking, history)
    note_passage(batch, row, run.passage, run.start, run.h)
    if run.ending not in (OVERTURNED, STANDING):
        batch.results[row, RESULT.ending] = STILL_ROCKING


@driver
def rock_many(shaking: Shaking, demands: NDArray[np.float64], batch: Batch) -> None:
    """Simulate every body, initially at rest, under one motion.

    Args:
        shaking: the motion.
        demands: what `batch.demands_of` gives for it.
        batch: the bodies; the results are written there.
    """
    no_times = np.empty(0)
    run_lanes(batch, shaking, demands, no_times, ROCKING_FIELDS, begin, resolve, finish)
