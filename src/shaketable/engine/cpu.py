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
    State,
    cross_interval,
    lift_left,
    lift_right,
    make_block,
    push_at,
    step,
)
from shaketable.kernels.taylor import MAX_PHASE
from shaketable.units import STANDARD_GRAVITY

LANES = 8
THETA, OMEGA, SINE, COSINE, SIDE, K, PEAK, POLARITY, EVENTFUL = range(9)
FIELDS = 9

STRETCH = 64  # samples whose largest demand is known beforehand
NEVER = -1

STANDING, OVERTURNED, STILL_ROCKING = range(3)  # how a run ended
FREE_ROCKING_LIMIT = 3600.0  # s after the motion's end; what still rocks then counts as standing
FREE_PHASE = 0.02  # rad: after the motion's end, steps of at least this √(k g) h


class Lanes(NamedTuple):
    """Bodies under one motion: what goes in, and what comes out, an entry each."""

    blocks: NDArray[np.float64]  # (n, 10), Block's fields
    polarity: NDArray[np.float64]
    initial_rotation: NDArray[np.float64]  # rad
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
def block_of(blocks: NDArray[np.float64], lane: int) -> Block:
    return Block(
        blocks[lane, 0],
        blocks[lane, 1],
        blocks[lane, 2],
        blocks[lane, 3],
        blocks[lane, 4],
        blocks[lane, 5],
        blocks[lane, 6],
        blocks[lane, 7],
        blocks[lane, 8],
        blocks[lane, 9],
    )


@driver
def tabulate_blocks(
    sizes: NDArray[np.float64], tilts: NDArray[np.float64], kept: float
) -> NDArray[np.float64]:
    """Block's fields for each (width, cg_height, left, gyration_radius) and tilt, (n, m, 10)."""
    table = np.empty((sizes.shape[0], tilts.size, 10))
    for b in range(sizes.shape[0]):
        for t in range(tilts.size):
            block = make_block(
                sizes[b, 0], sizes[b, 1], sizes[b, 2], sizes[b, 3], tilts[t], kept
            )
            for k in range(10):
                table[b, t, k] = block[k]
    return table


@kernel
def released(block: Block, rotation: float) -> State:
    """The state of a body let go at `rotation`."""
    if rotation == 0.0:
        return AT_REST
    side = 1.0 if rotation > 0.0 else -1.0
    phase = (block.phase_right if side > 0.0 else block.phase_left) - rotation
    return State(side, rotation, 0.0, math.sin(phase), math.cos(phase))


@driver
def stretch_demands(
    push: NDArray[np.float64], gravity: NDArray[np.float64]
) -> NDArray[np.float64]:
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
    threshold = min(
        abs(block.sin_right / block.cos_right), abs(block.sin_left / block.cos_left)
    )
    j = earliest
    while j < push.size:
        if demands[j // STRETCH] < threshold * (1.0 - 1e-12):
            j = (j // STRETCH + 1) * STRETCH
            continue
        stop = min((j // STRETCH + 1) * STRETCH, push.size)
        while j < stop:
            a = polarity * push[j]
            if lift_right(block, gravity[j], a) > 0.0 or lift_left(block, gravity[j], a) > 0.0:
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
    """Simulate every lane under one motion; `gravity` is g + a_y."""
    count = lanes.polarity.size
    field = np.zeros(((count + LANES - 1) // LANES) * FIELDS * LANES)
    lane_of = np.zeros(count, np.int64)
    waiting = np.full(push.size, NEVER)  # first lane that lifts in an interval
    following = np.full(count, NEVER)  # next lane in the same list
    no_times = np.empty(0)
    no_history = History(no_times, no_times, no_times, no_times)
    moving = 0
    for lane in range(count):
        block = block_of(lanes.blocks, lane)
        state = released(block, lanes.initial_rotation[lane])
        lanes.peak[lane] = abs(state.theta)
        if state.side == 0.0:
            i = next_lift(block, lanes.polarity[lane], push, gravity, demands, 0)
            if i != NEVER:
                following[lane], waiting[i] = waiting[i], lane
        else:
            occupy(field, moving, state, block, lanes.peak[lane], lanes.polarity[lane])
            lane_of[moving] = lane
            moving += 1

    for i in range(push.size - 1):
        if moving > 0:
            force = push_at(push, gravity, 1.0, i)
            for group in range((moving + LANES - 1) // LANES):
                step_group(field, group * FIELDS * LANES, h, force)
        slot = 0
        while slot < moving:
            at = (slot // LANES) * FIELDS * LANES + slot % LANES
            if field[at + EVENTFUL * LANES] == 0.0:
                slot += 1
                continue
            lane = lane_of[slot]
            state = state_in(field, at)
            lanes.peak[lane] = field[at + PEAK * LANES]
            block = block_of(lanes.blocks, lane)
            polarity = lanes.polarity[lane]
            passage = cross_interval(
                state,
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
            if passage.fallen_at < 0.0 and passage.state.side != 0.0:
                occupy(field, slot, passage.state, block, passage.peak, polarity)
                slot += 1
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
        at = (slot // LANES) * FIELDS * LANES + slot % LANES
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
        theta, omega = field[at + THETA * LANES], field[at + OMEGA * LANES]
        sine, cosine = field[at + SINE * LANES], field[at + COSINE * LANES]
        side, k = field[at + SIDE * LANES], field[at + K * LANES]
        peak, polarity = field[at + PEAK * LANES], field[at + POLARITY * LANES]
        own = Push(
            force.gravity,
            force.gravity_change,
            polarity * force.push,
            polarity * force.push_change,
        )
        new_theta, new_omega, new_sine, new_cosine, eventful = step(
            theta, omega, sine, cosine, side, k, peak, h, own
        )
        height = side * new_theta
        field[at + THETA * LANES] = theta if eventful else new_theta
        field[at + OMEGA * LANES] = omega if eventful else new_omega
        field[at + SINE * LANES] = sine if eventful else new_sine
        field[at + COSINE * LANES] = cosine if eventful else new_cosine
        field[at + PEAK * LANES] = height if (not eventful) & (height > peak) else peak
        field[at + EVENTFUL * LANES] = 1.0 if eventful else 0.0


@kernel
def occupy(
    field: NDArray[np.float64],
    slot: int,
    state: State,
    block: Block,
    peak: float,
    polarity: float,
) -> None:
    at = (slot // LANES) * FIELDS * LANES + slot % LANES
    field[at + THETA * LANES] = state.theta
    field[at + OMEGA * LANES] = state.omega
    field[at + SINE * LANES] = state.sine
    field[at + COSINE * LANES] = state.cosine
    field[at + SIDE * LANES] = state.side
    field[at + K * LANES] = block.k_right if state.side > 0.0 else block.k_left
    field[at + PEAK * LANES] = peak
    field[at + POLARITY * LANES] = polarity
    field[at + EVENTFUL * LANES] = 0.0


@kernel
def state_in(field: NDArray[np.float64], at: int) -> State:
    return State(
        field[at + SIDE * LANES],
        field[at + THETA * LANES],
        field[at + OMEGA * LANES],
        field[at + SINE * LANES],
        field[at + COSINE * LANES],
    )


@kernel
def vacate(field: NDArray[np.float64], slot: int, last: int) -> None:
    """Fill a slot with the last one in use."""
    to = (slot // LANES) * FIELDS * LANES + slot % LANES
    source = (last // LANES) * FIELDS * LANES + last % LANES
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
        history.rotation[sample] = state.theta
        history.angular_velocity[sample] = state.omega


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
    """One interval for one body, the short way where nothing happens in it."""
    if state.side != 0.0:
        theta, omega, sine, cosine, eventful = step(
            state.theta,
            state.omega,
            state.sine,
            state.cosine,
            state.side,
            block.k_right if state.side > 0.0 else block.k_left,
            peak,
            h,
            push_at(push, gravity, 1.0, i),
        )
        if not eventful:
            peak = max(peak, state.side * theta)
            return Passage(State(state.side, theta, omega, sine, cosine), peak, impacts, -1.0)
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
    frequency = math.sqrt(STANDARD_GRAVITY * max(block.k_right, block.k_left))
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
    passage = Passage(state, abs(state.theta), 0, -1.0)
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
