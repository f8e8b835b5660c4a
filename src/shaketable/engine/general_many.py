"""Many bodies of the general model under one motion, on one core.

A body that can only slide, whatever the motion does, slides through it ahead of all others. A body
that rocks without slip goes through the vector lanes of the rocking model, with a check that its
corner holds. Any other body is taken through the motion ahead of those, phase by phase and from
rest to rest, until it rocks without slip: at that sample it enters the lanes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, driver_part, kernel, routine
from shaketable.engine.batch import (
    NEVER,
    OVER,
    RESULT,
    Batch,
    Entry,
    next_tipping,
    note_fall,
    rock_through,
)
from shaketable.engine.body_tables import BODY, CORNERS, read_body, read_corners
from shaketable.engine.endings import OVERTURNED, STANDING, STILL_SLIDING, UNRESOLVED
from shaketable.engine.general_one import Scratch, Trace, given_up, move_free
from shaketable.engine.lane_loop import run_lanes
from shaketable.engine.lanes import STICKING_FIELDS
from shaketable.engine.one_loop import FREE_LIMIT, GOING_ON, free_steps
from shaketable.physics.plane.codes import LEFT, REST, RIGHT, contact_of, slip_of
from shaketable.physics.plane.contact import ContactBody, Pose
from shaketable.physics.plane.crossing import cross_phases
from shaketable.physics.plane.extremes import ContactPassage, Extremes, Log, slipped
from shaketable.physics.plane.forcing import Interval, Shaking, forcing_at
from shaketable.physics.plane.phase_series import ROWS, TERMS, SeriesTable
from shaketable.physics.plane.rocking import AT_REST, Block, State, rocking_frequency
from shaketable.physics.plane.sliding import only_slides, slide_all
from shaketable.physics.plane.sticking import pose_of, resting_block, state_of, sticks_throughout


@driver_part
def no_scratch(
    nothing: NDArray[np.float64], no_codes: NDArray[np.int8], table: SeriesTable
) -> Scratch:
    """Room for the series of a phase, and none for a history; the first two arrays are empty."""
    return Scratch(
        Trace(nothing, nothing, nothing, nothing, nothing, nothing, nothing, nothing),
        Log(nothing, nothing, no_codes, no_codes),
        table,
    )


@kernel
def body_of(batch: Batch, row: int) -> ContactBody:
    return read_body(batch.bodies[row], 0, BODY)


@routine
def extremes_of(batch: Batch, row: int) -> Extremes:
    """What is known of a body when an interval begins."""
    return Extremes(
        batch.results[row, RESULT.peak],
        batch.results[row, RESULT.lift],
        batch.results[row, RESULT.farthest_left],
        batch.results[row, RESULT.farthest_right],
        int(batch.results[row, RESULT.impacts]),
        0,
        -1.0,
        False,
    )


@routine
def note(batch: Batch, row: int, body: ContactBody, passage: ContactPassage) -> None:
    """Write down what an interval brought."""
    extremes = passage.extremes
    batch.results[row, RESULT.peak] = extremes.peak
    batch.results[row, RESULT.lift] = extremes.lift
    batch.results[row, RESULT.farthest_left] = extremes.farthest_left
    batch.results[row, RESULT.farthest_right] = extremes.farthest_right
    batch.results[row, RESULT.impacts] = extremes.impacts
    batch.results[row, RESULT.slip] = slipped(body, passage.pose)


@routine
def next_move(
    resting: Block,
    polarity: float,
    shaking: Shaking,
    demands: NDArray[np.float64],
    earliest: int,
) -> int:
    """The first interval from `earliest` on in which a body at rest may move, or NEVER."""
    if resting.left.sine < 0.0 or resting.right.sine < 0.0:  # on its tilt it does not rest at all
        return earliest
    return next_tipping(resting, polarity, shaking, demands, earliest)


@routine
def only_rocks(
    batch: Batch, row: int, body: ContactBody, state: State, shaking: Shaking, i: int
) -> bool:
    """Whether the rocking model may take a body that rests or rocks through interval i."""
    corners = read_corners(batch.corners[row], 0, CORNERS)
    force = forcing_at(shaking, i, batch.results[row, RESULT.polarity])
    return sticks_throughout(body.block, corners, state, shaking.time_step, force)


@routine
def move_until_it_rocks(
    batch: Batch,
    row: int,
    shaking: Shaking,
    demands: NDArray[np.float64],
    scratch: Scratch,
    pose: Pose,
    i: int,
) -> Entry:
    """Take a body through the motion from interval i on, phase by phase.

    It stops when the run is over, or when the body rocks without slip.
    """
    body = body_of(batch, row)
    h, polarity = shaking.time_step, batch.results[row, RESULT.polarity]
    resting = resting_block(body)
    while i < shaking.a_x.size - 1:
        if pose.phase == REST:
            i = next_move(resting, polarity, shaking, demands, i)
            if i == NEVER:
                return OVER
            if only_rocks(batch, row, body, AT_REST, shaking, i):
                rocked = rock_through(
                    batch, row, body.block, AT_REST, shaking, i, scratch.log.impact_times
                )
                i += 1
                if rocked.fallen_at >= 0.0:
                    return OVER
                if rocked.state.side != 0.0:
                    return Entry(i, rocked.state)
                continue
        passage = ContactPassage(pose, extremes_of(batch, row))
        interval = Interval(i, i * h, polarity)
        passage = cross_phases(passage, body, shaking, interval, scratch.log, scratch.table)
        pose, extremes = passage
        note(batch, row, body, passage)
        if extremes.fallen_at >= 0.0:
            note_fall(batch, row, pose.rotation, interval.start + extremes.fallen_at * h)
            return OVER
        if extremes.exhausted:
            batch.results[row, RESULT.ending] = UNRESOLVED
            return OVER
        i += 1
        if contact_of(pose.phase) in (RIGHT, LEFT) and slip_of(pose.phase) == 0.0:
            return Entry(i, state_of(body, pose))
    finish_move(batch, row, body, shaking, scratch, pose)
    return OVER


@routine
def finish_move(
    batch: Batch, row: int, body: ContactBody, shaking: Shaking, scratch: Scratch, pose: Pose
) -> None:
    """Take a body on from the motion's end until it rests or has fallen."""
    passage = ContactPassage(pose, extremes_of(batch, row))
    run = move_free(passage, body, shaking, scratch)
    passage = run.passage
    note(batch, row, body, passage)
    batch.results[row, RESULT.ending] = given_up(passage) if run.ending == GOING_ON else run.ending
    if run.ending == OVERTURNED:
        time = run.start + passage.extremes.fallen_at * run.h
        note_fall(batch, row, passage.pose.rotation, time)


@routine
def begin(
    batch: Batch, row: int, shaking: Shaking, demands: NDArray[np.float64], scratch: Scratch
) -> Entry:
    """Take a body ahead from its initial rest, until it rocks without slip."""
    body, polarity = body_of(batch, row), batch.results[row, RESULT.polarity]
    if only_slides(body, shaking, polarity):
        h, steps = free_steps(shaking.time_step, rocking_frequency(body.block))
        slide = slide_all(body, shaking, polarity, min(FREE_LIMIT, steps * h))
        batch.results[row, RESULT.slip] = slide.x
        batch.results[row, RESULT.farthest_left] = slide.farthest_left
        batch.results[row, RESULT.farthest_right] = slide.farthest_right
        batch.results[row, RESULT.ending] = STANDING if slide.x_rate == 0.0 else STILL_SLIDING
        return OVER
    pose = pose_of(body, AT_REST, 0.0)
    return move_until_it_rocks(batch, row, shaking, demands, scratch, pose, 0)


@routine
def resolve(
    batch: Batch,
    row: int,
    shaking: Shaking,
    demands: NDArray[np.float64],
    scratch: Scratch,
    state: State,
    i: int,
) -> Entry:
    """Take a body with an event through interval i, and ahead until it rocks without slip."""
    body, slip = body_of(batch, row), batch.results[row, RESULT.slip]
    if not only_rocks(batch, row, body, state, shaking, i):
        pose = pose_of(body, state, slip)
        return move_until_it_rocks(batch, row, shaking, demands, scratch, pose, i)
    times = scratch.log.impact_times
    passage = rock_through(batch, row, body.block, state, shaking, i, times)
    if passage.fallen_at >= 0.0:
        return OVER
    if passage.state.side == 0.0:
        pose = pose_of(body, AT_REST, slip)
        return move_until_it_rocks(batch, row, shaking, demands, scratch, pose, i + 1)
    return Entry(i + 1, passage.state)


@routine
def finish(batch: Batch, row: int, shaking: Shaking, scratch: Scratch, state: State) -> None:
    body = body_of(batch, row)
    pose = pose_of(body, state, batch.results[row, RESULT.slip])
    finish_move(batch, row, body, shaking, scratch, pose)


@driver
def move_many(shaking: Shaking, demands: NDArray[np.float64], batch: Batch) -> None:
    """Simulate every body, initially at rest, under one motion; arguments as for `rock_many`."""
    scratch = no_scratch(np.empty(0), np.empty(0, np.int8), np.zeros((ROWS, TERMS)))
    run_lanes(batch, shaking, demands, scratch, STICKING_FIELDS, begin, resolve, finish)
