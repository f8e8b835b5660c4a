"""A body of the general model by itself: what a thread of a GPU does."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.engine.batch import Batch, block_of
from shaketable.engine.general_many import begin, finish, no_scratch, resolve
from shaketable.engine.general_one import Scratch
from shaketable.engine.single_lane import run_lane
from shaketable.engine.tables import CORNERS, read_corners
from shaketable.kernels.flight import MOST_FLIGHTS
from shaketable.kernels.forcing import Interval, Shaking, forcing_at, rest_of, seen_from
from shaketable.kernels.phase_series import ROWS, TERMS
from shaketable.kernels.rocking import Block, Passage, side_of
from shaketable.kernels.sticking import (
    StickingCorners,
    corner_of,
    fly_sticking,
    step_sticking,
)


class Rocker(NamedTuple):
    """A body that rocks on corners with friction."""

    block: Block
    corners: StickingCorners


@kernel
def short_ways(
    passage: Passage,
    body: Rocker,
    shaking: Shaking,
    interval: Interval,
    no_times: NDArray[np.float64],
) -> tuple[Passage, bool]:
    """Cross an interval without an event, or in plain flights, if no corner can slip."""
    state, peak, impacts, _ = passage
    here, there = side_of(body.block, state.side), side_of(body.block, -state.side)
    corner, other = corner_of(body.corners, state.side), corner_of(body.corners, -state.side)
    force, h = forcing_at(shaking, interval.i, 1.0), shaking.time_step
    own = seen_from(force, state.side * interval.polarity)
    moved, eventful = step_sticking(state, here.k, corner.cone, peak, h, own)
    if not eventful:
        return Passage(moved, max(peak, moved.height), impacts, -1.0), True
    elapsed = 0.0
    for _ in range(MOST_FLIGHTS):
        left = 1.0 - elapsed
        own = seen_from(rest_of(force, elapsed), state.side * interval.polarity)
        flight = fly_sticking(state, here, there, corner, peak, left * h, own)
        if not flight.plain:
            break
        state, peak = flight.state, flight.peak
        if not flight.landed:
            return Passage(state, peak, impacts, -1.0), True
        elapsed += flight.until * left
        impacts += 1
        here, there, corner, other = there, here, other, corner
    return passage, False


@routine
def move_lane(
    batch: Batch, row: int, shaking: Shaking, demands: NDArray[np.float64], scratch: Scratch
) -> None:
    """Simulate one body of a batch, initially at rest; arguments as for `run_lane`."""
    body = Rocker(block_of(batch, row), read_corners(batch.corners[row], 0, CORNERS))
    no_times = scratch.log.impact_times
    run_lane(
        batch, row, shaking, demands, scratch, body, no_times, short_ways, begin, resolve, finish
    )


@driver
def move_each(shaking: Shaking, demands: NDArray[np.float64], batch: Batch) -> None:
    """Simulate every body of a batch as a GPU would, one after another; for checks."""
    scratch = no_scratch(np.empty(0), np.empty(0, np.int8), np.zeros((ROWS, TERMS)))
    for row in range(batch.results.shape[0]):
        move_lane(batch, row, shaking, demands, scratch)
