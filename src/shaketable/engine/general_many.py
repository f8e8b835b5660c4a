"""Many bodies under one motion with the general model, on one core.

A body that rocks without slip goes through the vector lanes of the rocking model, with a check
that its corner holds. Everything else is taken through the motion ahead of the others, phase by
phase and from rest to rest, until it rocks without slip: at that sample it enters the lanes.
Every body's arithmetic is its own: results do not depend on who shares its group.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.cpu import NEVER, next_lift
from shaketable.engine.endings import OVERTURNED, UNRESOLVED
from shaketable.engine.general_one import Trace, move_free
from shaketable.engine.lanes import (
    BATCH_FIELDS,
    EVENTFUL,
    GRIP,
    GRIP_HERE,
    GRIP_THERE,
    GRIPPED,
    KEEP,
    LANES,
    PEAK,
    bounce_group,
    enter,
    eventful_slots,
    grip_in,
    leave,
    occupy,
    place,
    put_grip,
    state_in,
    step_group,
    vacate,
)
from shaketable.engine.stands import grip_of, stand_of
from shaketable.kernels.codes import LEFT, REST, RIGHT, contact_of, slip_of
from shaketable.kernels.compiled import driver, kernel, routine
from shaketable.kernels.contact import Pose, Stand
from shaketable.kernels.course import ROWS, TERMS, Course
from shaketable.kernels.crossing import cross_phases
from shaketable.kernels.events import cross_interval
from shaketable.kernels.holding import calm, pose_of, resting_block, state_of
from shaketable.kernels.resets import Shaking, forcing
from shaketable.kernels.rocking import AT_REST, Block, Passage, Push, State, push_at
from shaketable.kernels.tally import Log, Tally, slipped

STATE_FIELDS = len(State._fields)


class Crowd(NamedTuple):
    """Bodies under one motion: what goes in, and what comes out, an entry each."""

    stands: NDArray[np.float64]  # (n, fields of a Stand)
    grips: NDArray[np.float64]  # (n, fields of both Grips)
    polarity: NDArray[np.float64]
    ending: NDArray[np.int8]
    direction: NDArray[np.int8]  # +1, -1, or 0 if it did not overturn
    overturning_time: NDArray[np.float64]  # s, NaN if it did not
    peak: NDArray[np.float64]  # rad
    impacts: NDArray[np.int64]
    slip: NDArray[np.float64]  # m, so far
    farthest_down: NDArray[np.float64]  # m, <= 0
    farthest_up: NDArray[np.float64]
    lift: NDArray[np.float64]


class Hall(NamedTuple):
    """The motion that the bodies share, and room that is used again and again."""

    push: NDArray[np.float64]
    gravity: NDArray[np.float64]
    demands: NDArray[np.float64]
    time_step: float  # s
    states: NDArray[np.float64]  # (n, 5): of bodies that wait to enter the lanes
    entering: NDArray[np.int64]  # first lane that enters at the start of an interval
    following: NDArray[np.int64]  # next lane in the same list
    course: Course
    log: Log
    trace: Trace


@kernel
def enlist(hall: Hall, lane: int, state: State, i: int) -> None:
    """Let a body enter the lanes at the start of interval i."""
    row = hall.states[lane]
    row[0], row[1], row[2], row[3], row[4] = state
    hall.following[lane], hall.entering[i] = hall.entering[i], lane


@kernel
def waiting_state(hall: Hall, lane: int) -> State:
    row = hall.states[lane]
    return State(row[0], row[1], row[2], row[3], row[4])


@routine
def tally_of(crowd: Crowd, lane: int) -> Tally:
    return Tally(
        crowd.peak[lane],
        crowd.lift[lane],
        crowd.farthest_down[lane],
        crowd.farthest_up[lane],
        crowd.impacts[lane],
        0,
        -1.0,
        False,
    )


@routine
def note(crowd: Crowd, lane: int, stand: Stand, pose: Pose, tally: Tally) -> None:
    """Write down what an interval brought."""
    crowd.peak[lane] = tally.peak
    crowd.lift[lane] = tally.lift
    crowd.farthest_down[lane] = tally.farthest_down
    crowd.farthest_up[lane] = tally.farthest_up
    crowd.impacts[lane] = tally.impacts
    crowd.slip[lane] = slipped(stand, pose)


@kernel
def note_fall(crowd: Crowd, lane: int, rotation: float, time: float) -> None:
    crowd.ending[lane] = OVERTURNED
    crowd.direction[lane] = 1 if rotation > 0.0 else -1
    crowd.overturning_time[lane] = time


@routine
def next_move(resting: Block, polarity: float, hall: Hall, earliest: int) -> int:
    """The first interval from `earliest` on in which a body at rest may move, or NEVER."""
    if resting.left.sine < 0.0:  # downhill it does not rest at all
        return earliest
    return next_lift(resting, polarity, hall.push, hall.gravity, hall.demands, earliest)


@routine
def is_calm(crowd: Crowd, lane: int, stand: Stand, state: State, force: Push, h: float) -> bool:
    """Whether the rocking model may have a body that rests or rocks for an interval."""
    right, left = grip_of(crowd.grips, lane, 1.0), grip_of(crowd.grips, lane, -1.0)
    return calm(stand.block, right, left, state.height, state.rate, h, force)


@routine
def rock_on(crowd: Crowd, lane: int, stand: Stand, state: State, hall: Hall, i: int) -> Passage:
    """Interval i as the rocking model has it, written down."""
    h = hall.time_step
    passage = cross_interval(
        state,
        stand.block,
        hall.push,
        hall.gravity,
        crowd.polarity[lane],
        i,
        i * h,
        h,
        crowd.peak[lane],
        crowd.impacts[lane],
        hall.log.impact_times,
    )
    crowd.peak[lane] = passage.peak
    crowd.impacts[lane] = passage.impacts
    if passage.fallen_at >= 0.0:
        note_fall(crowd, lane, passage.state.side, (i + passage.fallen_at) * h)
    return passage


@routine
def finish(crowd: Crowd, lane: int, stand: Stand, pose: Pose, hall: Hall) -> None:
    """From the motion's end until the body rests or has fallen."""
    h = hall.time_step
    end = (hall.push.size - 1) * h
    pose, tally, ending, time, _ = move_free(
        pose, stand, end, h, tally_of(crowd, lane), hall.trace, hall.log, 0, hall.course
    )
    note(crowd, lane, stand, pose, tally)
    crowd.ending[lane] = ending
    if ending == OVERTURNED:
        note_fall(crowd, lane, pose.rotation, time)


@routine
def run_on(crowd: Crowd, lane: int, pose: Pose, hall: Hall, i: int) -> None:
    """Take one body through the motion from interval i on, phase by phase, until its run is over
    or it rocks without slip: then it is for the lanes."""
    stand, h = stand_of(crowd.stands, lane), hall.time_step
    resting = resting_block(stand)
    shaking = Shaking(hall.push, hall.gravity, crowd.polarity[lane], h)
    while i < hall.push.size - 1:
        if pose.phase == REST:
            i = next_move(resting, shaking.polarity, hall, i)
            if i == NEVER:
                return
            if is_calm(crowd, lane, stand, AT_REST, forcing(shaking, i), h):
                passage = rock_on(crowd, lane, stand, AT_REST, hall, i)
                i += 1
                if passage.fallen_at >= 0.0:
                    return
                if passage.state.side != 0.0:
                    enlist(hall, lane, passage.state, i)
                    return
                continue
        pose, tally = cross_phases(
            pose, stand, shaking, i, i * h, tally_of(crowd, lane), hall.log, hall.course
        )
        note(crowd, lane, stand, pose, tally)
        if tally.fallen_at >= 0.0:
            note_fall(crowd, lane, pose.rotation, (i + tally.fallen_at) * h)
            return
        if tally.exhausted:
            crowd.ending[lane] = UNRESOLVED
            return
        i += 1
        if contact_of(pose.phase) in (RIGHT, LEFT) and slip_of(pose.phase) == 0.0:
            enlist(hall, lane, state_of(stand, pose), i)
            return
    finish(crowd, lane, stand, pose, hall)


@routine
def stays_in_lane(
    crowd: Crowd, lane: int, state: State, hall: Hall, i: int, field: NDArray[np.float64], at: int
) -> bool:
    """Take a body with an event through interval i; whether it goes on from its slot."""
    stand = stand_of(crowd.stands, lane)
    force = push_at(hall.push, hall.gravity, crowd.polarity[lane], i)
    if not is_calm(crowd, lane, stand, state, force, hall.time_step):
        run_on(crowd, lane, pose_of(stand, state, crowd.slip[lane]), hall, i)
        return False
    passage = rock_on(crowd, lane, stand, state, hall, i)
    if passage.fallen_at >= 0.0:
        return False
    if passage.state.side == 0.0:
        run_on(crowd, lane, pose_of(stand, AT_REST, crowd.slip[lane]), hall, i + 1)
        return False
    seat(field, at, crowd, lane, passage.state)
    return True


@routine
def seat(field: NDArray[np.float64], at: int, crowd: Crowd, lane: int, state: State) -> None:
    """Put a body that rocks where a slot begins."""
    block = stand_of(crowd.stands, lane).block
    occupy(field, at, state, block, crowd.peak[lane], crowd.polarity[lane])
    put_grip(field, at + GRIP * LANES, grip_of(crowd.grips, lane, state.side))


@routine
def fill_batch(
    batch: NDArray[np.float64],
    b: int,
    field: NDArray[np.float64],
    slot: int,
    crowd: Crowd,
    lane: int,
) -> None:
    """Copy a body that seems to bounce into place b of the batch."""
    block = stand_of(crowd.stands, lane).block
    side = state_in(field, place(slot, GRIPPED)).side
    here, there = grip_of(crowd.grips, lane, side), grip_of(crowd.grips, lane, -side)
    enter(batch, b, field, place(slot, GRIPPED), block)
    batch[b + KEEP * LANES] = here.keep
    put_grip(batch, b + GRIP_HERE * LANES, here)
    put_grip(batch, b + GRIP_THERE * LANES, there)


@driver
def move_crowd(
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    demands: NDArray[np.float64],
    h: float,
    crowd: Crowd,
) -> None:
    """Simulate every body, at rest at first, under one motion; `gravity` is g + a_y."""
    count = crowd.polarity.size
    groups = (count + LANES - 1) // LANES
    field = np.zeros(groups * GRIPPED * LANES)
    batch = np.zeros(BATCH_FIELDS * LANES)
    lane_of = np.zeros(count, np.int64)
    slots = np.zeros(count, np.int64)  # of the bodies with an event
    nothing, no_codes = np.empty(0), np.empty(0, np.int8)
    hall = Hall(
        push,
        gravity,
        demands,
        h,
        np.zeros((count, STATE_FIELDS)),
        np.full(push.size, NEVER),
        np.full(count, NEVER),
        np.zeros((ROWS, TERMS)),
        Log(nothing, nothing, no_codes, no_codes),
        Trace(nothing, nothing, nothing, nothing, nothing, nothing, nothing, nothing),
    )
    moving = 0
    for lane in range(count):
        run_on(crowd, lane, pose_of(stand_of(crowd.stands, lane), AT_REST, 0.0), hall, 0)

    for i in range(push.size - 1):
        lane = hall.entering[i]
        while lane != NEVER:
            seat(field, place(moving, GRIPPED), crowd, lane, waiting_state(hall, lane))
            lane_of[moving] = lane
            moving += 1
            lane = hall.following[lane]
        force = push_at(push, gravity, 1.0, i)
        for group in range((moving + LANES - 1) // LANES):
            step_group(field, group, h, force, GRIPPED)
        eventful = eventful_slots(field, moving, GRIPPED, slots)
        # from the last slot to the first: a slot is filled with a later one when it is vacated
        for first in range(0, eventful, LANES):
            size = min(LANES, eventful - first)
            for b in range(size):
                slot = slots[eventful - 1 - first - b]
                fill_batch(batch, b, field, slot, crowd, lane_of[slot])
            bounce_group(batch, h, force, GRIPPED)
            for b in range(size):
                slot = slots[eventful - 1 - first - b]
                at, lane = place(slot, GRIPPED), lane_of[slot]
                if batch[b + EVENTFUL * LANES] == 0.0:
                    leave(batch, b, field, at)
                    put_grip(field, at + GRIP * LANES, grip_in(batch, b + GRIP_THERE * LANES))
                    crowd.impacts[lane] += 1
                    continue
                crowd.peak[lane] = field[at + PEAK * LANES]
                if not stays_in_lane(crowd, lane, state_in(field, at), hall, i, field, at):
                    moving -= 1
                    vacate(field, slot, moving, GRIPPED)
                    lane_of[slot] = lane_of[moving]

    for slot in range(moving):
        at, lane = place(slot, GRIPPED), lane_of[slot]
        stand = stand_of(crowd.stands, lane)
        crowd.peak[lane] = field[at + PEAK * LANES]
        finish(crowd, lane, stand, pose_of(stand, state_in(field, at), crowd.slip[lane]), hall)
    lane = hall.entering[push.size - 1]  # what was to enter when the motion ended
    while lane != NEVER:
        stand = stand_of(crowd.stands, lane)
        state = waiting_state(hall, lane)
        finish(crowd, lane, stand, pose_of(stand, state, crowd.slip[lane]), hall)
        lane = hall.following[lane]
