"""A body of the rocking model by itself: what a thread of a GPU does."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, routine
from shaketable.engine.batch import Batch, block_of
from shaketable.engine.rocking_many import Times, begin, finish, resolve
from shaketable.engine.rocking_one import short_ways
from shaketable.engine.single_lane import run_lane
from shaketable.physics.plane.forcing import Shaking


@routine
def rock_lane(
    batch: Batch, row: int, shaking: Shaking, demands: NDArray[np.float64], no_times: Times
) -> None:
    """Simulate one body of a batch, initially at rest; arguments as for `run_lane`."""
    block = block_of(batch, row)
    run_lane(
        batch, row, shaking, demands, no_times, block, no_times, short_ways, begin, resolve, finish
    )


@driver
def rock_each(shaking: Shaking, demands: NDArray[np.float64], batch: Batch) -> None:
    """Simulate every body of a batch as a GPU would, one after another; for checks."""
    no_times = np.empty(0)
    for row in range(batch.results.shape[0]):
        rock_lane(batch, row, shaking, demands, no_times)
