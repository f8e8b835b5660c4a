"""Many bodies under one motion with the general model, on one core.

A body that rocks without slip goes through the vector lanes of the rocking model, with a check
that its corner holds; one at rest waits in the list of the sample at which it may move again.
Everything else is taken through the interval phase by phase, until it rocks without slip or
rests again. Every body's arithmetic is its own: results do not depend on who shares its group.
"""

from __future__ import annotations

import math
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
    HEIGHT,
    KEEP,
    LANES,
    PEAK,
    bounce_group,
    enter,
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
from shaketable.kernels.codes import LEFT, REST, RIGHT, contact_of, phase_of, side_sign, slip_of
from shaketable.kernels.compiled import driver, kernel, routine
from shaketable.kernels.contact import Pose, Stand, corner, on_corner
from shaketable.kernels.course import ROWS, TERMS, Course
from shaketable.kernels.crossing import cross_phases
from shaketable.kernels.events import cross_interval
from shaketable.kernels.holding import calm, resting_block
from shaketable.kernels.resets import Shaking, forcing
from shaketable.kernels.rocking import AT_REST, State, push_at, side_of
from shaketable.kernels.tally import Log, Tally, slipped

POSE_FIELDS = 7
ALWAYS_EVENTFUL = -1.0  # a height that the lanes leave alone


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


class Stage(NamedTuple):
    """What a body does at the end of an interval."""

    kind: int
    state: State  # of a body that ROCKS


OVER, RESTS, ROCKS, AWAY = range(4)  # its run is over; AWAY: its pose is kept in `Scratch.poses`


class Scratch(NamedTuple):
    """Room that is used again and again."""

    poses: NDArray[np.float64]  # (n, POSE_FIELDS): of bodies that neither rest nor just rock
    course: Course
    log: Log


@routine
def pose_of(stand: Stand, state: State, slip: float) -> Pose:
    """The pose of a body that rests or rocks without slip."""
    if state.side == 0.0:
        return Pose(REST, slip, stand.h, 0.0, 0.0, 0.0, 0.0)
    contact = RIGHT if state.side > 0.0 else LEFT
    rotation, spin = state.side * state.height, state.side * state.rate
    X, Y = corner(stand, state.side, rotation)
    x = slip + corner(stand, state.side, 0.0)[0] - X
    pose = Pose(phase_of(contact, 0.0), x, 0.0, rotation, -spin * Y, 0.0, spin)
    return on_corner(stand, pose, state.side)


@routine
def state_of(stand: Stand, pose: Pose) -> State:
    side = side_sign(contact_of(pose.phase))
    height = side * pose.rotation
    phase = side_of(stand.block, side).phase - height
    return State(side, height, side * pose.spin, math.sin(phase), math.cos(phase))


@kernel
def keep_pose(poses: NDArray[np.float64], lane: int, pose: Pose) -> None:
    row = poses[lane]
    row[0], row[1], row[2], row[3] = pose.phase, pose.x, pose.y, pose.rotation
    row[4], row[5], row[6] = pose.x_rate, pose.y_rate, pose.spin


@kernel
def kept_pose(poses: NDArray[np.float64], lane: int) -> Pose:
    row = poses[lane]
    return Pose(int(row[0]), row[1], row[2], row[3], row[4], row[5], row[6])


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
def stage_of(
    crowd: Crowd, lane: int, stand: Stand, pose: Pose, tally: Tally, scratch: Scratch
) -> Stage:
    """What an interval brought, written down."""
    note(crowd, lane, stand, pose, tally)
    if pose.phase == REST:
        return Stage(RESTS, AT_REST)
    if contact_of(pose.phase) in (RIGHT, LEFT) and slip_of(pose.phase) == 0.0:
        return Stage(ROCKS, state_of(stand, pose))
    keep_pose(scratch.poses, lane, pose)
    return Stage(AWAY, AT_REST)


@routine
def cross(
    crowd: Crowd,
    lane: int,
    pose: Pose,
    shaking: Shaking,
    i: int,
    scratch: Scratch,
) -> Stage:
    """Take one body through interval i phase by phase."""
    stand, start = stand_of(crowd.stands, lane), i * shaking.time_step
    pose, tally = cross_phases(
        pose, stand, shaking, i, start, tally_of(crowd, lane), scratch.log, scratch.course
    )
    stage = stage_of(crowd, lane, stand, pose, tally, scratch)
    if tally.fallen_at >= 0.0:
        note_fall(crowd, lane, pose.rotation, start + tally.fallen_at * shaking.time_step)
        return Stage(OVER, AT_REST)
    if tally.exhausted:
        crowd.ending[lane] = UNRESOLVED
        return Stage(OVER, AT_REST)
    return stage


@routine
def cross_from(
    crowd: Crowd,
    lane: int,
    state: State,
    shaking: Shaking,
    i: int,
    scratch: Scratch,
) -> Stage:
    """Take a body that rests or rocks through interval i: as the rocking model does, if it may."""
    stand, h = stand_of(crowd.stands, lane), shaking.time_step
    right, left = grip_of(crowd.grips, lane, 1.0), grip_of(crowd.grips, lane, -1.0)
    force = forcing(shaking, i)
    if not calm(stand.block, right, left, state.height, state.rate, h, force):
        pose = pose_of(stand, state, crowd.slip[lane])
        return cross(crowd, lane, pose, shaking, i, scratch)
    passage = cross_interval(
        state,
        stand.block,
        shaking.push,
        shaking.gravity,
        shaking.polarity,
        i,
        i * h,
        h,
        crowd.peak[lane],
        crowd.impacts[lane],
        scratch.log.impact_times,
    )
    crowd.peak[lane] = passage.peak
    crowd.impacts[lane] = passage.impacts
    if passage.fallen_at >= 0.0:
        note_fall(crowd, lane, passage.state.side, (i + passage.fallen_at) * h)
        return Stage(OVER, AT_REST)
    return Stage(RESTS if passage.state.side == 0.0 else ROCKS, passage.state)


@routine
def seat(field: NDArray[np.float64], slot: int, crowd: Crowd, lane: int, stage: Stage) -> None:
    """Put a body in motion into a slot; the lanes leave one alone that does not just rock."""
    block = stand_of(crowd.stands, lane).block
    peak, polarity, at = crowd.peak[lane], crowd.polarity[lane], place(slot, GRIPPED)
    if stage.kind == ROCKS:
        occupy(field, at, stage.state, block, peak, polarity)
        put_grip(field, at + GRIP * LANES, grip_of(crowd.grips, lane, stage.state.side))
    else:
        occupy(field, at, State(1.0, ALWAYS_EVENTFUL, 0.0, 0.0, 1.0), block, peak, polarity)


@routine
def wait(
    crowd: Crowd,
    lane: int,
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    demands: NDArray[np.float64],
    earliest: int,
    waiting: NDArray[np.int64],
    following: NDArray[np.int64],
) -> None:
    """Enter a body at rest in the list of the interval in which it may move, if there is one."""
    block = resting_block(stand_of(crowd.stands, lane))
    if block.left.sine < 0.0:  # downhill it does not rest at all
        i = earliest
    else:
        i = next_lift(block, crowd.polarity[lane], push, gravity, demands, earliest)
    if i != NEVER:
        following[lane], waiting[i] = waiting[i], lane


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
    waiting = np.full(push.size, NEVER)  # first lane that may move in an interval
    following = np.full(count, NEVER)  # next lane in the same list
    nothing, no_codes = np.empty(0), np.empty(0, np.int8)
    scratch = Scratch(
        np.zeros((count, POSE_FIELDS)),
        np.zeros((ROWS, TERMS)),
        Log(nothing, nothing, no_codes, no_codes),
    )
    moving = 0
    for lane in range(count):
        wait(crowd, lane, push, gravity, demands, 0, waiting, following)

    for i in range(push.size - 1):
        force = push_at(push, gravity, 1.0, i)
        for group in range((moving + LANES - 1) // LANES):
            step_group(field, group, h, force, GRIPPED)
        eventful = 0
        for slot in range(moving):
            if field[place(slot, GRIPPED) + EVENTFUL * LANES] != 0.0:
                slots[eventful] = slot
                eventful += 1
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
                shaking = Shaking(push, gravity, crowd.polarity[lane], h)
                if field[at + HEIGHT * LANES] == ALWAYS_EVENTFUL:
                    pose = kept_pose(scratch.poses, lane)
                    stage = cross(crowd, lane, pose, shaking, i, scratch)
                else:
                    stage = cross_from(crowd, lane, state_in(field, at), shaking, i, scratch)
                if stage.kind in (ROCKS, AWAY):
                    seat(field, slot, crowd, lane, stage)
                    continue
                moving -= 1
                vacate(field, slot, moving, GRIPPED)
                lane_of[slot] = lane_of[moving]
                if stage.kind == RESTS:
                    wait(crowd, lane, push, gravity, demands, i + 1, waiting, following)
        lane = waiting[i]
        while lane != NEVER:
            coming = following[lane]
            shaking = Shaking(push, gravity, crowd.polarity[lane], h)
            stage = cross_from(crowd, lane, AT_REST, shaking, i, scratch)
            if stage.kind in (ROCKS, AWAY):
                seat(field, moving, crowd, lane, stage)
                lane_of[moving] = lane
                moving += 1
            elif stage.kind == RESTS:
                wait(crowd, lane, push, gravity, demands, i + 1, waiting, following)
            lane = coming

    no_trace = Trace(nothing, nothing, nothing, nothing, nothing, nothing, nothing, nothing)
    end = (push.size - 1) * h
    for slot in range(moving):
        at, lane = place(slot, GRIPPED), lane_of[slot]
        stand = stand_of(crowd.stands, lane)
        crowd.peak[lane] = field[at + PEAK * LANES]
        if field[at + HEIGHT * LANES] == ALWAYS_EVENTFUL:
            pose = kept_pose(scratch.poses, lane)
        else:
            pose = pose_of(stand, state_in(field, at), crowd.slip[lane])
        pose, tally, ending, time, _ = move_free(
            pose, stand, end, h, tally_of(crowd, lane), no_trace, scratch.log, 0, scratch.course
        )
        note(crowd, lane, stand, pose, tally)
        crowd.ending[lane] = ending
        if ending == OVERTURNED:
            note_fall(crowd, lane, pose.rotation, time)
