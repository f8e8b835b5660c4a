"""A body of a batch by itself, as a thread of a GPU takes it: the loop that both models share.

It takes the steps of `lane_loop.run_lanes` in the same order, and gives the same numbers to the
bit; there bodies go side by side through an interval, here one body goes through all of them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import kernel
from shaketable.engine.batch import (
    NEVER,
    RESULT,
    Batch,
    Entry,
    interval_of,
    passage_of,
)
from shaketable.physics.plane.forcing import Shaking
from shaketable.physics.plane.rocking import Passage


@kernel
def note_rocking(batch: Batch, row: int, passage: Passage) -> None:
    """Write down how far a body rocked, and how often it hit the support."""
    batch.results[row, RESULT.peak] = passage.peak
    batch.results[row, RESULT.impacts] = passage.impacts


@kernel
def run_lane(
    batch: Batch,
    row: int,
    shaking: Shaking,
    demands: NDArray[np.float64],
    scratch: Any,
    body: Any,
    no_times: NDArray[np.float64],
    short_ways: Callable[..., tuple[Passage, bool]],
    begin: Callable[..., Entry],
    resolve: Callable[..., Entry],
    finish: Callable[..., None],
) -> None:
    """Simulate one body of a batch, initially at rest.

    Args:
        batch, row: the body; its results are written there.
        shaking, demands, scratch, begin, resolve, finish: as for `run_lanes`.
        body: what `short_ways` needs of it.
        no_times: an empty array of times of impacts.
        short_ways: (passage, body, shaking, interval, times) takes a body that rocks through an
            interval without an event or with one plain impact; also returns if it was so.
    """
    last = shaking.a_x.size - 1
    entry = begin(batch, row, shaking, demands, scratch)
    i = entry.i
    if i == NEVER:
        return
    passage = passage_of(batch, row, entry.state)
    while i < last:
        interval = interval_of(batch, row, shaking, i)
        passage, done = short_ways(passage, body, shaking, interval, no_times)
        if done:
            i += 1
            continue
        note_rocking(batch, row, passage)
        entry = resolve(batch, row, shaking, demands, scratch, passage.state, i)
        i = entry.i
        if i == NEVER:
            return
        passage = passage_of(batch, row, entry.state)
    note_rocking(batch, row, passage)
    finish(batch, row, shaking, scratch, passage.state)
