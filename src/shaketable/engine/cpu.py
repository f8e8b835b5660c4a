"""CPU drivers: many bodies under one motion in vector lanes, and one body with its history.

Lanes that are in motion stand next to each other, LANES to a group, field after field, so that
the loop over a group is one vector loop at constant distances in memory. A body at rest leaves
its lane and waits in the list of the sample at which it lifts again; a quiet motion costs
nothing. Every body's arithmetic is its own: results do not depend on who shares its group.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.kernels.compiled import driver, kernel, routine
from shaketable.kernels.rocking import (
    AT_REST,
    Block,
    Passage,
    Push,
    Side,
    State,
    bounce,
    cross_interval,
    lift,
    make_block,
    push_at,
    seen_from,
    side_of,
    step,
)
from shaketable.kernels.taylor import MAX_PHASE
from shaketable.units import STANDARD_GRAVITY

LANES = 8
HEIGHT, RATE, SINE, COSINE, SIDE, K, PEAK, POLARITY, EVENTFUL = range(9)
FIELDS = 9

# A batch of bodies that seem to bounce: the fields above, then what the other side needs.
KEEP, K_OTHER, SINE_OTHER, COSINE_OTHER = range(9, 13)
BATCH_FIELDS = 13

STRETCH = 64  # samples whose largest demand is known beforehand
NEVER = -1

STANDING, OVERTURNED, STILL_ROCKING = range(3)  # how a run ended
FREE_ROCKING_LIMIT = 3600.0  # s after the motion's end; what still rocks then counts as standing
FREE_PHASE = 0.02  # rad: after the motion's end, steps of at least this √(k g) h


class Lanes(NamedTuple):
    """Bodies under one motion: what goes in, and what comes out, an entry each."""

    blocks: NDArray[np.float64]  # (n, 12), the fields of both Sides
    polarity: NDArray[np.float64]
    ending: NDArray[np.int8]  # STANDING, OVERTURNED or STILL_ROCKING
    direction: NDArray[np.int8]  # +1, -1, or 0 if it did not overturn
    overturning_time: NDArray[np.float64]  # s, NaN if it did not
    peak: NDArray[np.float64]  # rad
    impacts: NDArray[np.int64]


class History(NamedTuple):
    """Where one body's run is written to, as much of it as fits."""

    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    impact_times: NDArray[np.float64]


class Release(NamedTuple):
    """What became of a body after the motion's end: its last interval, and where that began."""

    passage: Passage
    start: float
    h: float
    samples: int


class Ending(NamedTuple):
    """How one body's run ended, and how long a history it needs."""

    ending: int
    direction: int
    overturning_time: float
    peak: float
    impacts: int
    samples: int


@kernel
def side_in(row: NDArray[np.float64], first: int) -> Side:
    return Side(
        row[first], row[first + 1], row[first + 2], row[first + 3], row[first + 4], row[first + 5]
    )


@kernel
def block_of(blocks: NDArray[np.float64], lane: int) -> Block:
    return Block(side_in(blocks[lane], 0), side_in(blocks[lane], 6))


@driver
def tabulate_blocks(
    sizes: NDArray[np.float64], tilts: NDArray[np.float64], kept: float
) -> NDArray[np.float64]:
    """Block's fields for each (width, cg_height, left, gyration_radius) and tilt, (n, m, 12)."""
    table = np.empty((sizes.shape[0], tilts.size, 12))
    for b in range(sizes.shape[0]):
        for t in range(tilts.size):
            block = make_block(sizes[b, 0], sizes[b, 1], sizes[b, 2], sizes[b, 3], tilts[t], kept)
            for k in range(6):
                table[b, t, k] = block.right[k]
                table[b, t, 6 + k] = block.left[k]
    return table


@kernel
def released(block: Block, rotation: float) -> State:
    """The state of a body let go at `rotation`."""
    if rotation == 0.0:
        return AT_REST
    sign = 1.0 if rotation > 0.0 else -1.0
    phase = side_of(block, sign).phase - abs(rotation)
    return State(sign, abs(rotation), 0.0, math.sin(phase), math.cos(phase))


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
    threshold = min(abs(right.sine / right.cosine), abs(left.sine / left.cosine))
    j = earliest
    while j < push.size:
        if demands[j // STRETCH] < threshold * (1.0 - 1e-12):
            j = (j // STRETCH + 1) * STRETCH
            continue
        stop = min((j // STRETCH + 1) * STRETCH, push.size)
        while j < stop:
            a = polarity * push[j]
            if lift(right, gravity[j], a) > 0.0 or lift(left, gravity[j], a) > 0.0:
                return max(j - 1, earliest)
            j += 1
    return NEVER


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
        block = block_of(lanes.blocks, lane)
        i = next_lift(block, lanes.polarity[lane], push, gravity, demands, 0)
        if i != NEVER:
            following[lane], waiting[i] = waiting[i], lane

    for i in range(push.size - 1):
        force = push_at(push, gravity, 1.0, i)
        for group in range((moving + LANES - 1) // LANES):
            step_group(field, group * FIELDS * LANES, h, force)
        eventful = 0
        for slot in range(moving):
            if field[place(slot) + EVENTFUL * LANES] != 0.0:
                slots[eventful] = slot
                eventful += 1
        # from the last slot to the first: a slot is filled with a later one when it is vacated
        for first in range(0, eventful, LANES):
            count = min(LANES, eventful - first)
            for b in range(count):
                slot = slots[eventful - 1 - first - b]
                enter(batch, b, field, place(slot), block_of(lanes.blocks, lane_of[slot]))
            bounce_group(batch, h, force)
            for b in range(count):
                slot = slots[eventful - 1 - first - b]
                lane = lane_of[slot]
                if batch[b + EVENTFUL * LANES] == 0.0:
                    leave(batch, b, field, place(slot))
                    lanes.impacts[lane] += 1
                    continue
                block = block_of(lanes.blocks, lane)
                polarity = lanes.polarity[lane]
                passage = cross_interval(
                    state_in(field, place(slot)),
                    block,
                    push,
                    gravity,
                    polarity,
                    i,
                    i * h,
                    h,
                    field[place(slot) + PEAK * LANES],
                    lanes.impacts[lane],
                    no_times,
                )
                note(lanes, lane, passage, i * h, h)
                if passage.fallen_at < 0.0 and passage.state.side != 0.0:
                    occupy(field, slot, passage.state, block, passage.peak, polarity)
                    continue
                moving -= 1
                vacate(field, slot, moving)
                lane_of[slot] = lane_of[moving]
                if passage.fallen_at < 0.0:
                    j = next_lift(block, polarity, push, gravity, demands, i + 1)
                    if j != NEVER:
                        following[lane], waiting[j] = waiting[j], lane
        lane = waiting[i]
        while lane != NEVER:
            coming = following[lane]
            block = block_of(lanes.blocks, lane)
            polarity = lanes.polarity[lane]
            passage = cross_interval(
                AT_REST,
                block,
                push,
                gravity,
                polarity,
                i,
                i * h,
                h,
                lanes.peak[lane],
                lanes.impacts[lane],
                no_times,
            )
            note(lanes, lane, passage, i * h, h)
            if passage.fallen_at < 0.0:
                if passage.state.side != 0.0:
                    occupy(field, moving, passage.state, block, passage.peak, polarity)
                    lane_of[moving] = lane
                    moving += 1
                else:
                    j = next_lift(block, polarity, push, gravity, demands, i + 1)
                    if j != NEVER:
                        following[lane], waiting[j] = waiting[j], lane
            lane = coming
    end = (push.size - 1) * h
    for slot in range(moving):
        at = place(slot)
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


@kernel
def step_group(field: NDArray[np.float64], base: int, h: float, force: Push) -> None:
    """One interval for the LANES bodies of a group; a body with an event keeps its state."""
    for lane in range(LANES):
        at = base + lane
        height, rate = field[at + HEIGHT * LANES], field[at + RATE * LANES]
        sine, cosine = field[at + SINE * LANES], field[at + COSINE * LANES]
        peak = field[at + PEAK * LANES]
        own = seen_from(force, field[at + SIDE * LANES] * field[at + POLARITY * LANES])
        new_height, new_rate, new_sine, new_cosine, eventful = step(
            height, rate, sine, cosine, field[at + K * LANES], peak, h, own
        )
        field[at + HEIGHT * LANES] = height if eventful else new_height
        field[at + RATE * LANES] = rate if eventful else new_rate
        field[at + SINE * LANES] = sine if eventful else new_sine
        field[at + COSINE * LANES] = cosine if eventful else new_cosine
        field[at + PEAK * LANES] = new_height if (not eventful) & (new_height > peak) else peak
        field[at + EVENTFUL * LANES] = 1.0 if eventful else 0.0


@kernel
def bounce_group(batch: NDArray[np.float64], h: float, force: Push) -> None:
    """One interval with one impact for a batch; EVENTFUL where it is not that simple."""
    for at in range(LANES):
        side = batch[at + SIDE * LANES]
        height, rate, sine, cosine, _, clean = bounce(
            batch[at + HEIGHT * LANES],
            batch[at + RATE * LANES],
            batch[at + SINE * LANES],
            batch[at + COSINE * LANES],
            batch[at + K * LANES],
            batch[at + KEEP * LANES],
            batch[at + K_OTHER * LANES],
            batch[at + SINE_OTHER * LANES],
            batch[at + COSINE_OTHER * LANES],
            batch[at + PEAK * LANES],
            h,
            seen_from(force, side * batch[at + POLARITY * LANES]),
        )
        batch[at + HEIGHT * LANES] = height
        batch[at + RATE * LANES] = rate
        batch[at + SINE * LANES] = sine
        batch[at + COSINE * LANES] = cosine
        batch[at + SIDE * LANES] = -side
        batch[at + K * LANES] = batch[at + K_OTHER * LANES]
        batch[at + EVENTFUL * LANES] = 0.0 if clean else 1.0


@kernel
def enter(
    batch: NDArray[np.float64], b: int, field: NDArray[np.float64], at: int, block: Block
) -> None:
    """Copy a body into place b of the batch, with what it would land on."""
    for k in range(FIELDS):
        batch[b + k * LANES] = field[at + k * LANES]
    sign = field[at + SIDE * LANES]
    other = side_of(block, -sign)
    batch[b + KEEP * LANES] = side_of(block, sign).keep
    batch[b + K_OTHER * LANES] = other.k
    batch[b + SINE_OTHER * LANES] = other.sine
    batch[b + COSINE_OTHER * LANES] = other.cosine


@kernel
def leave(batch: NDArray[np.float64], b: int, field: NDArray[np.float64], at: int) -> None:
    """Copy a body from place b of the batch back to its own."""
    for k in range(FIELDS):
        field[at + k * LANES] = batch[b + k * LANES]


@kernel
def place(slot: int) -> int:
    """Where a slot's fields begin."""
    return (slot // LANES) * FIELDS * LANES + slot % LANES


@kernel
def occupy(
    field: NDArray[np.float64],
    slot: int,
    state: State,
    block: Block,
    peak: float,
    polarity: float,
) -> None:
    at = place(slot)
    field[at + HEIGHT * LANES] = state.height
    field[at + RATE * LANES] = state.rate
    field[at + SINE * LANES] = state.sine
    field[at + COSINE * LANES] = state.cosine
    field[at + SIDE * LANES] = state.side
    field[at + K * LANES] = side_of(block, state.side).k
    field[at + PEAK * LANES] = peak
    field[at + POLARITY * LANES] = polarity
    field[at + EVENTFUL * LANES] = 0.0


@kernel
def state_in(field: NDArray[np.float64], at: int) -> State:
    return State(
        field[at + SIDE * LANES],
        field[at + HEIGHT * LANES],
        field[at + RATE * LANES],
        field[at + SINE * LANES],
        field[at + COSINE * LANES],
    )


@kernel
def vacate(field: NDArray[np.float64], slot: int, last: int) -> None:
    """Fill a slot with the last one in use."""
    to = place(slot)
    source = place(last)
    for k in range(FIELDS):
        field[to + k * LANES] = field[source + k * LANES]


@kernel
def note(lanes: Lanes, lane: int, passage: Passage, start: float, h: float) -> None:
    """Write down what an interval with events brought."""
    lanes.peak[lane] = passage.peak
    lanes.impacts[lane] = passage.impacts
    if passage.fallen_at >= 0.0:
        lanes.ending[lane] = OVERTURNED
        lanes.direction[lane] = 1 if passage.state.side > 0.0 else -1
        lanes.overturning_time[lane] = start + passage.fallen_at * h


@kernel
def write(history: History, sample: int, time: float, state: State) -> None:
    if sample < history.time.size:
        history.time[sample] = time
        history.rotation[sample] = state.side * state.height
        history.angular_velocity[sample] = state.side * state.rate


@routine
def cross(
    state: State,
    block: Block,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    i: int,
    start: float,
    h: float,
    peak: float,
    impacts: int,
    impact_times: NDArray[np.float64],
) -> Passage:
    """One interval for one body: the short ways first."""
    if state.side != 0.0:
        here, there = side_of(block, state.side), side_of(block, -state.side)
        force = push_at(push, gravity, state.side, i)
        height, rate, sine, cosine, eventful = step(
            state.height, state.rate, state.sine, state.cosine, here.k, peak, h, force
        )
        if not eventful:
            moved = State(state.side, height, rate, sine, cosine)
            return Passage(moved, max(peak, height), impacts, -1.0)
        height, rate, sine, cosine, u, clean = bounce(
            state.height,
            state.rate,
            state.sine,
            state.cosine,
            here.k,
            here.keep,
            there.k,
            there.sine,
            there.cosine,
            peak,
            h,
            force,
        )
        if clean:
            if impacts < impact_times.size:
                impact_times[impacts] = start + u * h
            moved = State(there.sign, height, rate, sine, cosine)
            return Passage(moved, peak, impacts + 1, -1.0)
    return cross_interval(
        state, block, push, gravity, 1.0, i, start, h, peak, impacts, impact_times
    )


@routine
def rock_free(
    state: State,
    block: Block,
    end: float,
    h: float,
    peak: float,
    impacts: int,
    history: History,
    sample: int,
) -> Release:
    """Go on under gravity alone until rest, overturning or FREE_ROCKING_LIMIT."""
    nothing = np.empty(0)
    frequency = math.sqrt(STANDARD_GRAVITY * max(block.right.k, block.left.k))
    h = min(max(h, FREE_PHASE / frequency), MAX_PHASE / frequency)
    passage = Passage(state, peak, impacts, -1.0)
    for i in range(math.ceil(FREE_ROCKING_LIMIT / h)):
        start = end + i * h
        write(history, sample, start, passage.state)
        sample += 1
        if passage.state.side == 0.0:
            return Release(passage, start, h, sample)
        passage = cross(
            passage.state,
            block,
            nothing,
            nothing,
            i,
            start,
            h,
            passage.peak,
            passage.impacts,
            history.impact_times,
        )
        if passage.fallen_at >= 0.0:
            return Release(passage, start, h, sample)
    return Release(passage, end, h, sample)


@driver
def rock_one(
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    h: float,
    blocks: NDArray[np.float64],
    initial_rotation: float,
    history: History,
) -> Ending:
    """One body, sample by sample, until the motion has ended and it rests or has fallen."""
    block = block_of(blocks, 0)
    state = released(block, initial_rotation)
    passage = Passage(state, state.height, 0, -1.0)
    for i in range(push.size - 1):
        write(history, i, i * h, passage.state)
        passage = cross(
            passage.state,
            block,
            push,
            gravity,
            i,
            i * h,
            h,
            passage.peak,
            passage.impacts,
            history.impact_times,
        )
        if passage.fallen_at >= 0.0:
            return ended(passage, i * h, h, i + 1)
    release = rock_free(
        passage.state,
        block,
        (push.size - 1) * h,
        h,
        passage.peak,
        passage.impacts,
        history,
        push.size - 1,
    )
    return ended(release.passage, release.start, release.h, release.samples)


@kernel
def ended(passage: Passage, start: float, h: float, samples: int) -> Ending:
    side = passage.state.side
    if passage.fallen_at >= 0.0:
        time = start + passage.fallen_at * h
        direction = 1 if side > 0.0 else -1
        return Ending(OVERTURNED, direction, time, passage.peak, passage.impacts, samples)
    ending = STANDING if side == 0.0 else STILL_ROCKING
    return Ending(ending, 0, np.nan, passage.peak, passage.impacts, samples)
