"""A batch of bodies under one motion, in vector lanes on one core: the loop that both models share.

A body that rocks is in a lane. Any other body (one at rest; with the general model also one that
slips or flies) is taken through the motion ahead of those, until it rocks at a sample: there it
enters the lanes. A quiet motion costs nothing. Every body's arithmetic is its own: results do not
depend on which bodies share its group.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver_part, kernel
from shaketable.engine.batch import NEVER, RESULT, Batch, Entry, block_of
from shaketable.engine.body_tables import CORNERS, STATE, read_corners, read_state, write_state
from shaketable.engine.lanes import (
    BOUNCING_FIELDS,
    LANES,
    SLOT,
    STICKING_FIELDS,
    bounce_group,
    enter,
    enter_corners,
    eventful_slots,
    leave,
    occupy,
    place,
    put_cone,
    step_group,
    vacate,
)
from shaketable.physics.plane.forcing import Shaking, forcing_at
from shaketable.physics.plane.rocking import State
from shaketable.physics.plane.sticking import corner_of


class Queue(NamedTuple):
    """Bodies that wait to enter the lanes."""

    states: NDArray[np.float64]  # (n, numbers of a State)
    entering: NDArray[np.int64]  # first body that enters at the start of an interval, or NEVER
    following: NDArray[np.int64]  # next body in the same list


@kernel
def enqueue(queue: Queue, row: int, entry: Entry) -> None:
    """Let a body enter the lanes, unless its run is over."""
    if entry.i != NEVER:
        write_state(queue.states[row], 0, STATE, entry.state)
        queue.following[row], queue.entering[entry.i] = queue.entering[entry.i], row


@kernel
def seat(
    field: NDArray[np.float64], slot: int, fields: int, batch: Batch, row: int, state: State
) -> None:
    """Put a body that rocks into a slot."""
    at = place(slot, fields)
    peak, polarity = batch.results[row, RESULT.peak], batch.results[row, RESULT.polarity]
    occupy(field, at, state, block_of(batch, row), peak, polarity)
    if fields == STICKING_FIELDS:
        corners = read_corners(batch.corners[row], 0, CORNERS)
        put_cone(field, at, corner_of(corners, state.side))


@kernel
def try_bouncing(
    bouncing: NDArray[np.float64], b: int, field: NDArray[np.float64], at: int, fields: int,
    batch: Batch, row: int,
) -> None:  # fmt: skip
    """Copy a body with an event into place b among those that seem to bounce."""
    enter(bouncing, b, field, at, block_of(batch, row))
    if fields == STICKING_FIELDS:
        enter_corners(bouncing, b, read_corners(batch.corners[row], 0, CORNERS))


@driver_part
def run_lanes(
    batch: Batch,
    shaking: Shaking,
    demands: NDArray[np.float64],
    scratch: Any,
    fields: int,
    begin: Callable[..., Entry],
    resolve: Callable[..., Entry],
    finish: Callable[..., None],
) -> None:
    """Simulate every body of a batch, initially at rest.

    Args:
        batch: the bodies; the results are written there.
        shaking, demands: the motion, and what `demands_of` gives for it.
        scratch: working memory of the model's functions.
        fields: numbers of a slot, ROCKING_FIELDS or STICKING_FIELDS; a constant of the caller.
        begin: (batch, row, shaking, demands, scratch) takes a body ahead from its initial rest,
            until it enters the lanes.
        resolve: (batch, row, shaking, demands, scratch, state, i) takes a body with an event
            through interval i, and ahead until it enters the lanes again.
        finish: (batch, row, shaking, scratch, state) takes a body on after the motion's end.

    It is one long function, because its parts share all of their arrays and are inlined anyway.
    """
    count, samples, h = batch.results.shape[0], shaking.a_x.size, shaking.time_step
    field = np.zeros(((count + LANES - 1) // LANES) * fields * LANES)
    bouncing = np.zeros(BOUNCING_FIELDS * LANES)
    row_of = np.zeros(count, np.int64)
    slots = np.zeros(count, np.int64)  # the slots of the bodies with an event
    queue = Queue(np.zeros((count, len(STATE))), np.full(samples, NEVER), np.full(count, NEVER))
    moving = 0
    for row in range(count):
        enqueue(queue, row, begin(batch, row, shaking, demands, scratch))

    for i in range(samples - 1):
        row = queue.entering[i]
        while row != NEVER:
            seat(field, moving, fields, batch, row, read_state(queue.states[row], 0, STATE))
            row_of[moving] = row
            moving += 1
            row = queue.following[row]
        force = forcing_at(shaking, i, 1.0)
        for group in range((moving + LANES - 1) // LANES):
            step_group(field, group, h, force, fields)
        eventful = eventful_slots(field, moving, fields, slots)
        # from the last slot to the first: a slot is filled with a later one when it is vacated
        for first in range(0, eventful, LANES):
            size = min(LANES, eventful - first)
            for b in range(size):
                slot = slots[eventful - 1 - first - b]
                at = place(slot, fields)
                try_bouncing(bouncing, b, field, at, fields, batch, row_of[slot])
            bounce_group(bouncing, h, force, fields)
            for b in range(size):
                slot = slots[eventful - 1 - first - b]
                at, row = place(slot, fields), row_of[slot]
                if bouncing[b + SLOT.eventful] == 0.0:
                    leave(bouncing, b, field, at, fields)
                    batch.results[row, RESULT.impacts] += 1.0
                    continue
                batch.results[row, RESULT.peak] = field[at + SLOT.peak]
                state = read_state(field, at, SLOT.state)
                entry = resolve(batch, row, shaking, demands, scratch, state, i)
                if entry.i == i + 1:  # it keeps its lane
                    seat(field, slot, fields, batch, row, entry.state)
                else:
                    enqueue(queue, row, entry)
                    moving -= 1
                    vacate(field, slot, moving, fields)
                    row_of[slot] = row_of[moving]

    for slot in range(moving):
        at, row = place(slot, fields), row_of[slot]
        batch.results[row, RESULT.peak] = field[at + SLOT.peak]
        finish(batch, row, shaking, scratch, read_state(field, at, SLOT.state))
    row = queue.entering[samples - 1]  # what was to enter when the motion ended
    while row != NEVER:
        finish(batch, row, shaking, scratch, read_state(queue.states[row], 0, STATE))
        row = queue.following[row]
