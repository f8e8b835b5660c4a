"""One body of the general model, with its history."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.engine.body_tables import BODY, read_body
from shaketable.engine.endings import (
    OVERTURNED,
    STANDING,
    STILL_ROCKING,
    STILL_SLIDING,
    UNRESOLVED,
)
from shaketable.engine.one_loop import (
    GOING_ON,
    MOST_IMPACTS,
    PlanarSummary,
    Run,
    no_push,
    shake_free,
    shake_one,
    write_summary,
)
from shaketable.physics.plane.codes import BOTH, REST, contact_of
from shaketable.physics.plane.contact import ContactBody, force_of
from shaketable.physics.plane.crossing import cross_phases
from shaketable.physics.plane.extremes import (
    ContactPassage,
    Extremes,
    Log,
    one_change_more,
    slipped,
    write_change,
)
from shaketable.physics.plane.forcing import Interval, Shaking, forcing_at
from shaketable.physics.plane.guards import NO_GUARD
from shaketable.physics.plane.phase_series import SeriesTable
from shaketable.physics.plane.resets import into_phase, let_go, slides_on
from shaketable.physics.plane.rocking import rocking_frequency


class Trace(NamedTuple):
    """Samples of one body's run, as many as fit."""

    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    along: NDArray[np.float64]
    normal: NDArray[np.float64]
    along_rate: NDArray[np.float64]
    normal_rate: NDArray[np.float64]
    slip: NDArray[np.float64]


class Scratch(NamedTuple):
    """The arrays into which one body's run and the series of its phases are written."""

    trace: Trace
    log: Log
    table: SeriesTable


@kernel
def write(
    scratch: Scratch, sample: int, time: float, body: ContactBody, passage: ContactPassage
) -> None:
    trace, pose = scratch.trace, passage.pose
    if sample < trace.time.size:
        trace.time[sample] = time
        trace.rotation[sample] = pose.rotation
        trace.angular_velocity[sample] = pose.spin
        trace.along[sample] = pose.x
        trace.normal[sample] = pose.y
        trace.along_rate[sample] = pose.x_rate
        trace.normal_rate[sample] = pose.y_rate
        trace.slip[sample] = slipped(body, pose)


@routine
def cross(
    passage: ContactPassage,
    body: ContactBody,
    shaking: Shaking,
    interval: Interval,
    scratch: Scratch,
) -> tuple[ContactPassage, int]:
    """Take a body through one interval, phase by phase."""
    passage = cross_phases(passage, body, shaking, interval, scratch.log, scratch.table)
    extremes = passage.extremes
    if extremes.fallen_at >= 0.0:
        return passage, OVERTURNED
    if extremes.exhausted:
        return passage, UNRESOLVED
    if extremes.impacts > MOST_IMPACTS and no_push(shaking, interval.i):
        return passage, given_up(passage)
    return passage, GOING_ON


@kernel
def given_up(passage: ContactPassage) -> int:
    """The ending of a body that still moved when it was given up."""
    return STILL_SLIDING if contact_of(passage.pose.phase) == BOTH else STILL_ROCKING


@routine
def settle(
    passage: ContactPassage,
    body: ContactBody,
    shaking: Shaking,
    interval: Interval,
    scratch: Scratch,
) -> tuple[ContactPassage, int]:
    """Whether a body rests, or slides, for good under gravity alone."""
    pose, extremes = passage
    if pose.phase == REST:
        pose = into_phase(
            body, pose, BOTH, force_of(body, forcing_at(shaking, interval.i, 1.0)), -1
        )
        if pose.phase == REST:
            return passage, STANDING
        write_change(scratch.log, extremes.changes, interval.start, pose.phase, NO_GUARD)
        extremes = one_change_more(extremes)
    passage = ContactPassage(pose, extremes)
    return passage, STILL_SLIDING if slides_on(body, pose, shaking, interval.i) else GOING_ON


@routine
def move_free(
    passage: ContactPassage, body: ContactBody, shaking: Shaking, scratch: Scratch
) -> Run:
    """Go on from the motion's end until rest, overturning, an endless slide or FREE_LIMIT."""
    frequency = rocking_frequency(body.block)
    return shake_free(passage, body, shaking, scratch, frequency, write, cross, settle)


@driver
def begin_one(
    shaking: Shaking,
    row: NDArray[np.float64],
    initial_rotation: float,
    phase: NDArray[np.int8],
) -> None:
    """Write the phase in which one body begins to `phase`, (1,); arguments as for `move_one`."""
    phase[0] = let_go(read_body(row, 0, BODY), shaking, initial_rotation).phase


@driver
def move_one(
    shaking: Shaking,
    row: NDArray[np.float64],
    initial_rotation: float,
    scratch: Scratch,
    summary: NDArray[np.float64],
) -> None:
    """Simulate one body let go at a rotation; write its history and its Summary.

    Args:
        shaking: the motion.
        row: the numbers of a ContactBody.
        initial_rotation: θ [rad].
        scratch, summary: arrays that are written.
    """
    body = read_body(row, 0, BODY)
    pose = let_go(body, shaking, initial_rotation)
    write_change(scratch.log, 0, 0.0, pose.phase, NO_GUARD)
    extremes = Extremes(abs(initial_rotation), 0.0, 0.0, 0.0, 0, 1, -1.0, False)
    passage, frequency = ContactPassage(pose, extremes), rocking_frequency(body.block)
    run = shake_one(passage, body, shaking, scratch, frequency, write, cross, settle)
    (pose, extremes), ending = run.passage, run.ending
    direction, time = 0.0, np.nan
    if ending == OVERTURNED:
        direction = 1.0 if pose.rotation > 0.0 else -1.0
        time = run.start + extremes.fallen_at * run.h
    elif ending == GOING_ON:
        ending = given_up(run.passage)
    found = PlanarSummary(
        float(ending), direction, time, extremes.peak, float(extremes.impacts),
        float(run.samples), slipped(body, pose), extremes.lift, extremes.farthest_left,
        extremes.farthest_right, float(extremes.changes),
    )  # fmt: skip
    write_summary(summary, found)
