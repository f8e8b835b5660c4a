"""A body of the rocking model by itself: what a thread of a GPU does.

It takes the steps of `rocking_many` in the same order, and gives the same numbers to the bit; there
bodies go side by side through an interval, here one body goes through all of them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, routine
from shaketable.engine.lane_loop import (
    NEVER,
    RESULT,
    Batch,
    block_of,
    next_tipping,
    rock_through,
)
from shaketable.engine.rocking_many import Times, rock_on
from shaketable.kernels.forcing import Shaking, forcing_at
from shaketable.kernels.rocking import AT_REST, bounce, side_of, step


@routine
def rock_lane(
    batch: Batch, row: int, shaking: Shaking, demands: NDArray[np.float64], times: Times
) -> None:
    """Simulate one body of a batch, initially at rest, under one motion.

    Args:
        batch: the bodies; the results are written there.
        row: of the body.
        shaking, demands: the motion, and what `demands_of` gives for it.
        times: room for the times of impacts: none.
    """
    block, polarity = block_of(batch, row), batch.results[row, RESULT.polarity]
    h, last = shaking.time_step, shaking.push.size - 1
    state, peak, impacts = AT_REST, 0.0, 0.0
    i = 0
    while i < last or state.side == 0.0:
        eventful = True
        if state.side == 0.0:
            i = next_tipping(block, polarity, shaking, demands, i)
            if i == NEVER:
                return
        else:
            here = side_of(block, state.side)
            force = forcing_at(shaking, i, state.side * polarity)
            moved, eventful = step(state, here.k, peak, h, force)
            if not eventful:
                state = moved
                peak = max(peak, moved.height)
            else:
                there = side_of(block, -state.side)
                moved, _, clean = bounce(state, here.k, here.keep, there, peak, h, force)
                if clean:
                    state, eventful = moved, False
                    impacts += 1.0
        if eventful:
            batch.results[row, RESULT.peak], batch.results[row, RESULT.impacts] = peak, impacts
            passage = rock_through(batch, row, block, state, shaking, i, times)
            if passage.fallen_at >= 0.0:
                return
            state, peak, impacts = passage.state, passage.peak, float(passage.impacts)
        i += 1
    batch.results[row, RESULT.peak], batch.results[row, RESULT.impacts] = peak, impacts
    rock_on(batch, row, state, shaking, times)


@driver
def rock_each(shaking: Shaking, demands: NDArray[np.float64], batch: Batch) -> None:
    """Simulate every body of a batch as a GPU would, one after another; for checks."""
    no_times = np.empty(0)
    for row in range(batch.results.shape[0]):
        rock_lane(batch, row, shaking, demands, no_times)
