"""One body under the general model, sample by sample, with its history."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.endings import (
    OVERTURNED,
    STANDING,
    STILL_ROCKING,
    STILL_SLIDING,
    UNRESOLVED,
)
from shaketable.engine.single import FREE_PHASE, FREE_ROCKING_LIMIT
from shaketable.engine.stands import stand_of
from shaketable.kernels.codes import (
    BOTH,
    REST,
    contact_of,
)
from shaketable.kernels.compiled import driver, kernel, routine
from shaketable.kernels.contact import Pose, Stand, force_of
from shaketable.kernels.course import ROWS, TERMS, Course
from shaketable.kernels.crossing import cross_phases
from shaketable.kernels.guards import NO_GUARD
from shaketable.kernels.resets import Shaking, forcing, into_phase, let_go, slides_on
from shaketable.kernels.rocking import rocking_frequency
from shaketable.kernels.tally import Log, Tally, one_change_more, slipped, write_change
from shaketable.kernels.taylor import MAX_PHASE

MOST_IMPACTS = 1_000_000  # what still bounces then after the motion's end is given up


class Trace(NamedTuple):
    """Where one body's run is written to, as much of it as fits."""

    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    along: NDArray[np.float64]
    normal: NDArray[np.float64]
    along_rate: NDArray[np.float64]
    normal_rate: NDArray[np.float64]
    slip: NDArray[np.float64]


class Finish(NamedTuple):
    """How one body's run ended, and how long a history it needs."""

    ending: int
    direction: int
    overturning_time: float
    slip: float  # m, at the end
    tally: Tally
    samples: int


@kernel
def write(trace: Trace, sample: int, time: float, stand: Stand, pose: Pose) -> None:
    if sample < trace.time.size:
        trace.time[sample] = time
        trace.rotation[sample] = pose.rotation
        trace.angular_velocity[sample] = pose.spin
        trace.along[sample] = pose.x
        trace.normal[sample] = pose.y
        trace.along_rate[sample] = pose.x_rate
        trace.normal_rate[sample] = pose.y_rate
        trace.slip[sample] = slipped(stand, pose)


@routine
def move_free(
    pose: Pose,
    stand: Stand,
    end: float,
    h: float,
    tally: Tally,
    trace: Trace,
    log: Log,
    sample: int,
    course: Course,
) -> tuple[Pose, Tally, int, float, int]:
    """Go on under gravity alone until rest, overturning, an endless slide or FREE_ROCKING_LIMIT.

    Returns pose, tally, how it ended, the overturning time and the number of samples.
    """
    frequency = rocking_frequency(stand.block)
    h = min(max(h, FREE_PHASE / frequency), MAX_PHASE / frequency)
    shaking = Shaking(np.empty(0), np.empty(0), 1.0, h)
    for i in range(math.ceil(FREE_ROCKING_LIMIT / h)):
        start = end + i * h
        write(trace, sample, start, stand, pose)
        sample += 1
        if pose.phase == REST:  # under gravity alone too? then for good
            pose = into_phase(stand, pose, BOTH, force_of(stand, forcing(shaking, i)), -1)
            if pose.phase != REST:
                write_change(log, tally.changes, start, pose.phase, NO_GUARD)
                tally = one_change_more(tally)
        if pose.phase == REST:
            return pose, tally, STANDING, np.nan, sample
        if slides_on(stand, pose, shaking, i):
            return pose, tally, STILL_SLIDING, np.nan, sample
        pose, tally = cross_phases(pose, stand, shaking, i, start, tally, log, course)
        if tally.fallen_at >= 0.0:
            return pose, tally, OVERTURNED, start + tally.fallen_at * h, sample
        if tally.exhausted:
            return pose, tally, UNRESOLVED, np.nan, sample
        if tally.impacts > MOST_IMPACTS:
            break
    sliding = contact_of(pose.phase) == BOTH
    return pose, tally, STILL_SLIDING if sliding else STILL_ROCKING, np.nan, sample


@driver
def move_one(
    push: NDArray[np.float64],
    gravity: NDArray[np.float64],
    h: float,
    stands: NDArray[np.float64],
    initial_rotation: float,
    trace: Trace,
    log: Log,
) -> Finish:
    """One body, sample by sample, until the motion has ended and it rests or has fallen."""
    stand = stand_of(stands, 0)
    course = np.zeros((ROWS, TERMS))
    shaking = Shaking(push, gravity, 1.0, h)
    pose = let_go(stand, shaking, initial_rotation)
    write_change(log, 0, 0.0, pose.phase, NO_GUARD)
    tally = Tally(abs(initial_rotation), 0.0, 0.0, 0.0, 0, 1, -1.0, False)
    samples = push.size - 1
    for i in range(samples):
        write(trace, i, i * h, stand, pose)
        pose, tally = cross_phases(pose, stand, shaking, i, i * h, tally, log, course)
        if tally.fallen_at >= 0.0:
            direction = 1 if pose.rotation > 0.0 else -1
            time = (i + tally.fallen_at) * h
            return Finish(OVERTURNED, direction, time, slipped(stand, pose), tally, i + 1)
        if tally.exhausted:
            return Finish(UNRESOLVED, 0, np.nan, slipped(stand, pose), tally, i + 1)
    pose, tally, ending, time, samples = move_free(
        pose, stand, samples * h, h, tally, trace, log, samples, course
    )
    direction = 0
    if ending == OVERTURNED:
        direction = 1 if pose.rotation > 0.0 else -1
    return Finish(ending, direction, time, slipped(stand, pose), tally, samples)
