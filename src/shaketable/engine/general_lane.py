"""A body of the general model by itself: what a thread of a GPU does."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.engine.batch import Batch, block_of
from shaketable.engine.body_tables import CORNERS, read_corners
from shaketable.engine.general_many import begin, finish, no_scratch, resolve
from shaketable.engine.general_one import Scratch
from shaketable.engine.single_lane import run_lane
from shaketable.physics.plane.forcing import Interval, Shaking, forcing_at
from shaketable.physics.plane.phase_series import ROWS, TERMS
from shaketable.physics.plane.rocking import Block, Passage, side_of
from shaketable.physics.plane.sticking import (
    StickingCorners,
    bounce_sticking,
    corner_of,
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
    """Cross an interval without an event or with one plain impact, if no corner can slip."""
    state, peak, impacts, _ = passage
    here, there = side_of(body.block, state.side), side_of(body.block, -state.side)
    corner, other = corner_of(body.corners, state.side), corner_of(body.corners, -state.side)
    force = forcing_at(shaking, interval.i, state.side * interval.polarity)
    h = shaking.time_step
    moved, eventful = step_sticking(state, here.k, corner.cone, peak, h, force)
    if not eventful:
        return Passage(moved, max(peak, moved.rotation), impacts, -1.0), True
    moved, _, clean = bounce_sticking(state, here, corner, there, other.cone, peak, h, force)
    if not clean:
        return passage, False
    return Passage(moved, peak, impacts + 1, -1.0), True


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
