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

from shaketable.compiled import driver, kernel, routine
from shaketable.engine.endings import OVERTURNED
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
from shaketable.engine.tables import (
    BLOCK,
    CORNERS,
    STATE,
    read_block,
    read_corners,
    read_state,
    write_state,
)
from shaketable.kernels.events import cross_interval
from shaketable.kernels.forcing import Interval, Shaking, forcing_at
from shaketable.kernels.layout import columns
from shaketable.kernels.rocking import Block, Passage, State, least_demand, tipping
from shaketable.kernels.sticking import corner_of

STRETCH = 64  # samples whose largest demand is known beforehand
NEVER = -1


class Result(NamedTuple):
    """What a simulation is given, and what it brought, in numbers.

    Only the general model fills in the last four.
    """

    polarity: float
    ending: float
    direction: float  # +1 toward +x, -1, or 0 if it did not overturn
    overturning_time: float  # s, NaN if it did not
    peak: float  # rad
    impacts: float
    slip: float  # m, so far
    farthest_left: float  # m, toward -x, <= 0
    farthest_right: float  # m
    lift: float  # m


class Batch(NamedTuple):
    """Bodies under one motion, a row each.

    The arrays are few, because each costs reference counting at every call.
    """

    blocks: NDArray[np.float64]  # numbers of a Block
    bodies: NDArray[np.float64]  # numbers of a ContactBody, shape (0, 0) for the rocking model
    corners: NDArray[np.float64]  # numbers of StickingCorners, likewise
    results: NDArray[np.float64]  # numbers of a Result, with the polarity filled in


RESULT = columns(Result)


class Queue(NamedTuple):
    """Bodies that wait to enter the lanes."""

    states: NDArray[np.float64]  # (n, numbers of a State)
    entering: NDArray[np.int64]  # first body that enters at the start of an interval, or NEVER
    following: NDArray[np.int64]  # next body in the same list


class Shared(NamedTuple):
    """What the bodies of a batch share."""

    shaking: Shaking
    demands: NDArray[np.float64]
    queue: Queue


@driver
def stretch_demands(shaking: Shaking, demands: NDArray[np.float64]) -> None:
    """Write the largest |a_x| / (g + a_y) in each STRETCH of samples to `demands`.

    It is infinite where the floor drops away.
    """
    push, gravity = shaking.push, shaking.gravity
    for stretch in range(demands.size):
        first = stretch * STRETCH
        largest = 0.0
        for j in range(first, min(first + STRETCH, push.size)):
            demand = abs(push[j]) / gravity[j] if gravity[j] > 0.0 else np.inf
            largest = max(largest, demand)
        demands[stretch] = largest


def demands_of(shaking: Shaking) -> NDArray[np.float64]:
    """Largest |a_x| / (g + a_y) in each STRETCH of samples."""
    demands = np.empty((shaking.push.size + STRETCH - 1) // STRETCH)
    stretch_demands(shaking, demands)
    return demands


@kernel
def block_of(batch: Batch, row: int) -> Block:
    return read_block(batch.blocks[row], 0, BLOCK)


@kernel
def interval_of(batch: Batch, row: int, shaking: Shaking, i: int) -> Interval:
    """Interval i as one of the bodies meets it."""
    return Interval(i, i * shaking.time_step, batch.results[row, RESULT.polarity])


@routine
def next_tipping(
    block: Block,
    polarity: float,
    shaking: Shaking,
    demands: NDArray[np.float64],
    earliest: int,
) -> int:
    """The first interval from `earliest` on in which a body that rests at its start tips."""
    right, left = block.right, block.left
    push, gravity = shaking.push, shaking.gravity
    # a margin for the round-off of the demands: a stretch may be searched in vain, but not missed
    threshold = least_demand(block) * (1.0 - 1e-12)
    j = earliest
    while j < push.size:
        if demands[j // STRETCH] < threshold:
            j = (j // STRETCH + 1) * STRETCH
            continue
        stop = min((j // STRETCH + 1) * STRETCH, push.size)
        while j < stop:
            a = polarity * push[j]
            if tipping(right, gravity[j], a) > 0.0 or tipping(left, gravity[j], a) > 0.0:
                return max(j - 1, earliest)
            j += 1
    return NEVER


@kernel
def enqueue(queue: Queue, row: int, state: State, i: int) -> None:
    """Let a body enter the lanes at the start of interval i."""
    write_state(queue.states[row], 0, STATE, state)
    queue.following[row], queue.entering[i] = queue.entering[i], row


@kernel
def note_fall(batch: Batch, row: int, side: float, time: float) -> None:
    """Write down an overturning toward a side, positive for +x."""
    batch.results[row, RESULT.ending] = OVERTURNED
    batch.results[row, RESULT.direction] = 1.0 if side > 0.0 else -1.0
    batch.results[row, RESULT.overturning_time] = time


@kernel
def note_passage(batch: Batch, row: int, passage: Passage, start: float, h: float) -> None:
    """Write down what an interval of rocking brought."""
    batch.results[row, RESULT.peak] = passage.peak
    batch.results[row, RESULT.impacts] = passage.impacts
    if passage.fallen_at >= 0.0:
        note_fall(batch, row, passage.state.side, start + passage.fallen_at * h)


@kernel
def passage_of(batch: Batch, row: int, state: State) -> Passage:
    """What is known of a body when an interval begins."""
    return Passage(
        state, batch.results[row, RESULT.peak], int(batch.results[row, RESULT.impacts]), -1.0
    )


@routine
def rock_through(
    batch: Batch,
    row: int,
    block: Block,
    state: State,
    shaking: Shaking,
    i: int,
    times: NDArray[np.float64],
) -> Passage:
    """Take one body through interval i of rocking event by event, and write down what it brought.

    Times of impacts are written to `times`, as many as fit.
    """
    interval = interval_of(batch, row, shaking, i)
    passage = cross_interval(passage_of(batch, row, state), block, shaking, interval, times)
    note_passage(batch, row, passage, interval.start, shaking.time_step)
    return passage


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


@kernel
def run_lanes(
    batch: Batch,
    shaking: Shaking,
    demands: NDArray[np.float64],
    scratch: Any,
    fields: int,
    begin: Callable[..., None],
    resolve: Callable[..., tuple[bool, State]],
    finish: Callable[..., None],
) -> None:
    """Simulate every body of a batch, initially at rest.

    Args:
        batch: the bodies; the results are written there.
        shaking, demands: the motion, and what `demands_of` gives for it.
        scratch: room that the model's functions use again and again.
        fields: numbers of a slot, ROCKING_FIELDS or STICKING_FIELDS; a constant of the caller.
        begin: (batch, row, shared, scratch) takes a body ahead from its initial rest.
        resolve: (batch, row, state, shared, scratch, i) takes a body with an event through
            interval i; returns whether it stays in its lane, and its state.
        finish: (batch, row, state, shared, scratch) takes a body on after the motion's end.

    It is one long function, because its parts share all of their arrays and are inlined anyway.
    """
    count, samples, h = batch.results.shape[0], shaking.push.size, shaking.time_step
    field = np.zeros(((count + LANES - 1) // LANES) * fields * LANES)
    bouncing = np.zeros(BOUNCING_FIELDS * LANES)
    row_of = np.zeros(count, np.int64)
    slots = np.zeros(count, np.int64)  # the slots of the bodies with an event
    queue = Queue(np.zeros((count, len(STATE))), np.full(samples, NEVER), np.full(count, NEVER))
    shared = Shared(shaking, demands, queue)
    moving = 0
    for row in range(count):
        begin(batch, row, shared, scratch)

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
                stays, state = resolve(
                    batch, row, read_state(field, at, SLOT.state), shared, scratch, i
                )
                if stays:
                    seat(field, slot, fields, batch, row, state)
                else:
                    moving -= 1
                    vacate(field, slot, moving, fields)
                    row_of[slot] = row_of[moving]

    for slot in range(moving):
        at, row = place(slot, fields), row_of[slot]
        batch.results[row, RESULT.peak] = field[at + SLOT.peak]
        finish(batch, row, read_state(field, at, SLOT.state), shared, scratch)
    row = queue.entering[samples - 1]  # what was to enter when the motion ended
    while row != NEVER:
        finish(batch, row, read_state(queue.states[row], 0, STATE), shared, scratch)
        row = queue.following[row]
