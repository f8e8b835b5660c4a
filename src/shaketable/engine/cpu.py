"""Many bodies under one motion, in vector lanes on one core.

A body at rest leaves its lane and waits in the list of the sample at which it lifts again: a
quiet motion costs nothing. Every body's arithmetic is its own: results do not depend on who
shares its group.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.blocks import block_of
from shaketable.engine.endings import OVERTURNED, STILL_ROCKING
from shaketable.engine.lanes import (
    BATCH_FIELDS,
    EVENTFUL,
    FIELDS,
    LANES,
    PEAK,
    bounce_group,
    enter,
    eventful_slots,
    leave,
    occupy,
    place,
    state_in,
    step_group,
    vacate,
)
from shaketable.engine.single import History, rock_free
from shaketable.kernels.compiled import driver, kernel, routine
from shaketable.kernels.events import cross_interval
from shaketable.kernels.rocking import AT_REST, Block, Passage, State, least_demand, lift, push_at

STRETCH = 64  # samples whose largest demand is known beforehand
NEVER = -1


class Lanes(NamedTuple):
    """Bodies under one motion: what goes in, and what comes out, an entry each."""

    blocks: NDArray[np.float64]  # (n, 12), the fields of both Sides
    polarity: NDArray[np.float64]
    ending: NDArray[np.int8]  # STANDING, OVERTURNED or STILL_ROCKING
    direction: NDArray[np.int8]  # +1, -1, or 0 if it did not overturn
    overturning_time: NDArray[np.float64]  # s, NaN if it did not
    peak: NDArray[np.float64]  # rad
    impacts: NDArray[np.int64]


@driver
def stretch_demands(push: NDArray[np.float64], gravity: NDArray[np.float64]) -> NDArray[np.float64]:
    """Largest |a_x| / (g + a_y) in each STRETCH of samples; infinite where the floor drops away."""
    demands = np.zeros((push.size + STRETCH - 1) // STRETCH)
    for j in range(push.size):
        demand = abs(push[j]) / gravity[j] if gravity[j] > 0.0 else np.inf
        demands[j // STRETCH] = max(demands[j // STRETCH], demand)
    return demands


@routine
def next_lift(
    block: Block,
    polarity: float,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    demands: NDArray[np.float64],
    earliest: int,
) -> int:
    """The first interval from `earliest` on in which a body that rests at its start lifts."""
    right, left = block.right, block.left
    # a margin for the round-off of the demands: a stretch may be looked at in vain, never missed
    threshold = least_demand(block) * (1.0 - 1e-12)
    j = earliest
    while j < push.size:
        if demands[j // STRETCH] < threshold:
            j = (j // STRETCH + 1) * STRETCH
            continue
        stop = min((j // STRETCH + 1) * STRETCH, push.size)
        while j < stop:
            a = polarity * push[j]
            if lift(right, gravity[j], a) > 0.0 or lift(left, gravity[j], a) > 0.0:
                return max(j - 1, earliest)
            j += 1
    return NEVER


@kernel
def note(lanes: Lanes, lane: int, passage: Passage, start: float, h: float) -> None:
    """Write down what an interval with events brought."""
    lanes.peak[lane] = passage.peak
    lanes.impacts[lane] = passage.impacts
    if passage.fallen_at >= 0.0:
        lanes.ending[lane] = OVERTURNED
        lanes.direction[lane] = 1 if passage.state.side > 0.0 else -1
        lanes.overturning_time[lane] = start + passage.fallen_at * h


@routine
def cross(
    lanes: Lanes,
    lane: int,
    state: State,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    i: int,
    h: float,
    no_times: NDArray[np.float64],
) -> Passage:
    """Take one body through interval i event by event, and write down what that brought."""
    passage = cross_interval(
        state,
        block_of(lanes.blocks, lane),
        push,
        gravity,
        lanes.polarity[lane],
        i,
        i * h,
        h,
        lanes.peak[lane],
        lanes.impacts[lane],
        no_times,
    )
    note(lanes, lane, passage, i * h, h)
    return passage


@kernel
def seat(field: NDArray[np.float64], slot: int, passage: Passage, lanes: Lanes, lane: int) -> None:
    """Put a body in motion into a slot."""
    block = block_of(lanes.blocks, lane)
    occupy(field, place(slot, FIELDS), passage.state, block, passage.peak, lanes.polarity[lane])


@routine
def wait(
    lanes: Lanes,
    lane: int,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    demands: NDArray[np.float64],
    earliest: int,
    waiting: NDArray[np.int64],
    following: NDArray[np.int64],
) -> None:
    """Enter a body at rest in the list of the interval in which it lifts, if there is one."""
    block = block_of(lanes.blocks, lane)
    i = next_lift(block, lanes.polarity[lane], push, gravity, demands, earliest)
    if i != NEVER:
        following[lane], waiting[i] = waiting[i], lane


@driver
def rock_lanes(
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    demands: NDArray[np.float64],
    h: float,
    lanes: Lanes,
) -> None:
    """Simulate every lane, at rest at first, under one motion; `gravity` is g + a_y."""
    count = lanes.polarity.size
    field = np.zeros(((count + LANES - 1) // LANES) * FIELDS * LANES)
    batch = np.zeros(BATCH_FIELDS * LANES)
    lane_of = np.zeros(count, np.int64)
    slots = np.zeros(count, np.int64)  # of the bodies with an event
    waiting = np.full(push.size, NEVER)  # first lane that lifts in an interval
    following = np.full(count, NEVER)  # next lane in the same list
    no_times = np.empty(0)
    no_history = History(no_times, no_times, no_times, no_times)
    moving = 0
    for lane in range(count):
        wait(lanes, lane, push, gravity, demands, 0, waiting, following)

    for i in range(push.size - 1):
        force = push_at(push, gravity, 1.0, i)
        for group in range((moving + LANES - 1) // LANES):
            step_group(field, group, h, force, FIELDS)
        eventful = eventful_slots(field, moving, FIELDS, slots)
        # from the last slot to the first: a slot is filled with a later one when it is vacated
        for first in range(0, eventful, LANES):
            count = min(LANES, eventful - first)
            for b in range(count):
                slot = slots[eventful - 1 - first - b]
                enter(batch, b, field, place(slot, FIELDS), block_of(lanes.blocks, lane_of[slot]))
            bounce_group(batch, h, force, FIELDS)
            for b in range(count):
                slot = slots[eventful - 1 - first - b]
                lane = lane_of[slot]
                if batch[b + EVENTFUL * LANES] == 0.0:
                    leave(batch, b, field, place(slot, FIELDS))
                    lanes.impacts[lane] += 1
                    continue
                lanes.peak[lane] = field[place(slot, FIELDS) + PEAK * LANES]
                passage = cross(
                    lanes, lane, state_in(field, place(slot, FIELDS)), push, gravity, i, h, no_times
                )
                if passage.fallen_at < 0.0 and passage.state.side != 0.0:
                    seat(field, slot, passage, lanes, lane)
                    continue
                moving -= 1
                vacate(field, slot, moving, FIELDS)
                lane_of[slot] = lane_of[moving]
                if passage.fallen_at < 0.0:
                    wait(lanes, lane, push, gravity, demands, i + 1, waiting, following)
        lane = waiting[i]
        while lane != NEVER:
            coming = following[lane]
            passage = cross(lanes, lane, AT_REST, push, gravity, i, h, no_times)
            if passage.fallen_at < 0.0 and passage.state.side != 0.0:
                seat(field, moving, passage, lanes, lane)
                lane_of[moving] = lane
                moving += 1
            elif passage.fallen_at < 0.0:
                wait(lanes, lane, push, gravity, demands, i + 1, waiting, following)
            lane = coming
    end = (push.size - 1) * h
    for slot in range(moving):
        at = place(slot, FIELDS)
        lane = lane_of[slot]
        block = block_of(lanes.blocks, lane)
        release = rock_free(
            state_in(field, at),
            block,
            end,
            h,
            field[at + PEAK * LANES],
            lanes.impacts[lane],
            no_history,
            0,
        )
        note(lanes, lane, release.passage, release.start, release.h)
        if lanes.ending[lane] != OVERTURNED and release.passage.state.side != 0.0:
            lanes.ending[lane] = STILL_ROCKING
