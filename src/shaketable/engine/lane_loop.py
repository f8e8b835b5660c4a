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
from shaketable.engine.lanes import (
    ARRIVED,
    FLYING,
    LANDED,
    LANES,
    SLOT,
    STICKING_FIELDS,
    STICKING_FLYING_FIELDS,
    come_back,
    eventful_slots,
    fly_group,
    occupy,
    place,
    put_cone,
    step_group,
    take_corners,
    take_off,
    turn_over,
    vacate,
)
from shaketable.engine.tables import CORNERS, STATE, read_corners, read_state, write_state
from shaketable.kernels.flight import MOST_FLIGHTS
from shaketable.kernels.forcing import Shaking, forcing_at
from shaketable.kernels.rocking import State
from shaketable.kernels.sticking import corner_of


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
def rise(
    flying: NDArray[np.float64], n: int, flying_fields: int,
    field: NDArray[np.float64], source: int, batch: Batch, row: int,
) -> None:  # fmt: skip
    """Copy a body with an event into place n among those that fly."""
    at = place(n, flying_fields)
    take_off(flying, at, field, source, block_of(batch, row))
    if flying_fields == STICKING_FLYING_FIELDS:
        corners = read_corners(batch.corners[row], 0, CORNERS)
        take_corners(flying, at, corners, field[source + SLOT.state.side])


@driver_part
def run_lanes(
    batch: Batch,
    shaking: Shaking,
    demands: NDArray[np.float64],
    scratch: Any,
    fields: int,
    flying_fields: int,
    begin: Callable[..., Entry],
    resolve: Callable[..., Entry],
    finish: Callable[..., None],
) -> None:
    """Simulate every body of a batch, initially at rest.

    Args:
        batch: the bodies; the results are written there.
        shaking, demands: the motion, and what `demands_of` gives for it.
        scratch: room that the model's functions use again and again.
        fields, flying_fields: numbers of a slot and of a body that flies, ROCKING_FIELDS and
            FLYING_FIELDS or STICKING_FIELDS and STICKING_FLYING_FIELDS; constants of the caller.
        begin: (batch, row, shaking, demands, scratch) takes a body ahead from its initial rest,
            until it enters the lanes.
        resolve: (batch, row, shaking, demands, scratch, state, i) takes a body with an event
            through interval i, and ahead until it enters the lanes again.
        finish: (batch, row, shaking, scratch, state) takes a body on after the motion's end.

    It is one long function, because its parts share all of their arrays and are inlined anyway.
    """
    count, samples, h = batch.results.shape[0], shaking.push.size, shaking.time_step
    groups = (count + LANES - 1) // LANES
    field, flying = np.zeros(groups * fields * LANES), np.zeros(groups * flying_fields * LANES)
    row_of = np.zeros(count, np.int64)
    slots = np.zeros(count, np.int64)  # of the bodies with an event
    origin = np.zeros(count, np.int64)  # the slots of those that fly
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
        for n in range(eventful):
            slot = origin[n] = slots[n]
            rise(flying, n, flying_fields, field, place(slot, fields), batch, row_of[slot])
        waiting = eventful
        for _ in range(MOST_FLIGHTS):
            for group in range((waiting + LANES - 1) // LANES):
                fly_group(flying, group, h, force, flying_fields)
            landed = 0
            for n in range(waiting):
                at, slot = place(n, flying_fields), origin[n]
                if flying[at + FLYING.ending] == ARRIVED:
                    come_back(field, place(slot, fields), flying, at, flying_fields)
                    batch.results[row_of[slot], RESULT.impacts] += flying[at + FLYING.impacts]
                elif flying[at + FLYING.ending] == LANDED:
                    turn_over(flying, place(landed, flying_fields), at, flying_fields)
                    origin[landed] = slot
                    landed += 1
            waiting = landed
        # from the last slot to the first: a slot is filled with a later one when it is vacated
        for n in range(eventful - 1, -1, -1):
            slot = slots[n]
            at, row = place(slot, fields), row_of[slot]
            if field[at + SLOT.eventful] != 0.0:
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
