"""A solid through a whole motion, and on until it rests or has fallen."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import LEVEL, axes_at, begin_rim, foot_of, twist
from shaketable.physics.space.edge import has_edge, look_behind, note_past, stand_at_edge
from shaketable.physics.space.ending import (
    FREE_LIMIT,
    FREE_STEP,
    MOST_STEPS,
    PER_SAMPLE,
    cannot_fall,
    effort,
    ending_after,
    is_before_tipping,
)
from shaketable.physics.space.found import NOT_YET, OVERTURNED, STANDING, STILL_MOVING, SolidTrace
from shaketable.physics.space.ground import GroundAcceleration, RunSetup, force_at, seen, tilted
from shaketable.physics.space.guards import FORCE_PAST, GAP, peak_between
from shaketable.physics.space.interval import cross_interval
from shaketable.physics.space.landing import land
from shaketable.physics.space.noting import copy
from shaketable.physics.space.pads import glued_until
from shaketable.physics.space.rest import last_of_rest
from shaketable.physics.space.settling import GOES_ON, LANDED
from shaketable.physics.space.step import NEVER, Pull, pull_at
from shaketable.physics.space.straps import attach
from shaketable.physics.space.telling import has_left
from shaketable.physics.space.touches import plane_of
from shaketable.physics.space.vectors import Vec, subtract, times
from shaketable.physics.space.walls import stand_at_walls
from shaketable.physics.space.workspace import (
    STATE,
    WALLED,
    Floats,
    P,
    Q,
    SolidParameters,
    Workspace,
)
from shaketable.units import STANDARD_GRAVITY

ON_EDGE = 5  # in a history, beside the kinds of a mode: the edge of the support is touched
TURNED = 1e-3  # rad: only what ends turned by more, or in motion, can be held up


@routine
def place(shape: SolidParameters, work: Workspace, orientation: float) -> None:
    """Stand a solid at rest on its base."""
    for j in range(STATE):
        work.state[j] = 0.0
    work.state[P + 2] = shape.h
    work.state[Q] = math.cos(0.5 * orientation)
    work.state[Q + 3] = math.sin(0.5 * orientation)


@routine
def begin(shape: SolidParameters, work: Workspace, f: Vec, impact_times: Floats) -> None:
    """Find what a solid does from its state on, which may be any above the support."""
    tally = work.tally
    tally.events = tally.steps = tally.energy_cuts = tally.fallbacks = 0
    tally.lift = tally.farthest = tally.left_at = tally.tips = 0.0
    tally.slip_back = tally.slip_front = 0.0
    tally.shaken_x = tally.shaken_y = tally.shaken_yaw = tally.ended = 0.0
    tally.calm = tally.swings = tally.landed = tally.samples = 0
    tally.ending, tally.was_x, tally.was_y = NOT_YET, math.nan, math.nan
    tally.looked_at, tally.lively, tally.was_lively = 0.0, 0.0, math.inf
    tally.met = 1 if shape.glue > 0.0 else 0
    tally.yaw = tally.start_yaw = twist(work.state)
    tally.yaw_w, tally.yaw_z = work.state[Q], work.state[Q + 3]
    tally.peak = peak_between(work.state, work.state, 0.0)
    foot = foot_of(shape, work)
    tally.start_x, tally.start_y = foot.x, foot.y
    work.judged.past = FORCE_PAST
    work.mode.kind = work.mode.closed = work.mode.rolls = 0
    n = axes_at(work.state).z
    sine = math.sqrt(n.x * n.x + n.y * n.y)
    work.rim.x, work.rim.y = (-n.x / sine, -n.y / sine) if sine > LEVEL else (1.0, 0.0)
    begin_rim(work)
    work.clock.begun = work.clock.passed = 0.0
    attach(shape, work)
    if has_edge(shape):
        stand_at_edge(shape, work)
        note_past(shape, work, True)
        look_behind(shape, work)
    land(shape, work, f, GAP, impact_times)
    work.tally.impacts = 0


@routine
def is_on_edge(shape: SolidParameters, work: Workspace) -> bool:
    """Whether the edge of the support, or its lip, is touched and no wall."""
    edge, wall = False, False
    for place in range(work.mode.touches if work.mode.kind == WALLED else 0):
        edge = edge or plane_of(work, place) > shape.walls
        wall = wall or 0 < plane_of(work, place) <= shape.walls
    return edge and not wall


@routine
def record(shape: SolidParameters, trace: SolidTrace, sample: int, work: Workspace) -> None:
    if sample < trace.state.shape[0]:
        copy(work.state, trace.state[sample])
        trace.rank[sample] = ON_EDGE if is_on_edge(shape, work) else work.mode.kind
        trace.hold[sample] = work.mode.grip


@routine
def run(
    shape: SolidParameters,
    work: Workspace,
    ground: GroundAcceleration,
    stand: RunSetup,
    trace: SolidTrace,
) -> None:
    """Simulate one solid from its state on; write its history, and the tally of what is told."""
    samples, sample, tally = ground.acceleration.shape[0], 0, work.tally
    frame = tilted(stand)
    before = force_at(ground, 0, stand, frame)
    stand_at_walls(shape, work, frame.axis, frame.sine, frame.cosine)
    begin(shape, work, before, trace.impact_times)
    ending, h, start, first = NOT_YET, ground.time_step, 0.0, 1.0
    glued, span, passed, done, how = shape.glue > 0.0, ground.time_step, 0.0, 0, GOES_ON
    end = (samples - 1) * ground.time_step
    free_h = max(ground.time_step, FREE_STEP)
    last = samples - 1 + math.ceil(FREE_LIMIT / free_h)
    i = -1
    while i + 1 < last:
        i += 1
        rests = last_of_rest(shape, work, ground, stand, frame, i)
        if rests > i:
            first, before = 1.0, force_at(ground, rests, stand, frame)
        while i < rests:
            record(shape, trace, sample, work)
            sample, i = sample + 1, i + 1
        record(shape, trace, sample, work)
        sample += 1
        free = i >= samples - 1
        if i == samples - 1:
            h, done = free_h, effort(work)
            note_shaken(shape, work)
        start = i * h if not free else end + (i - samples + 1) * h
        after = force_at(ground, i + 1 if not free else samples, stand, frame)
        work.clock.begun, work.clock.passed = start, 0.0
        if free:
            before = after
            ending = ending_after(shape, work, after, start - end, effort(work) - done)
        if ending != NOT_YET or effort(work) > MOST_STEPS + PER_SAMPLE * samples:
            break
        pull, span = Pull(before, subtract(after, before), h), h
        before = after
        if glued:
            part = glued_until(shape, work, pull)
            if part >= NEVER and not free:
                continue
            if part >= NEVER:  # nothing changes any more
                ending = STANDING
                break
            glued = False
            start, span = start + part * h, (1.0 - part) * h
            work.clock.begun = start
            pull = Pull(pull_at(pull, part), times(1.0 - part, pull.change), span)
        how, passed, first = cross_interval(shape, work, pull, first, trace.impact_times)
        if how != GOES_ON:
            ending = OVERTURNED
            record(shape, trace, sample, work)
            sample += 1
            break
    if start < end:
        note_shaken(shape, work)
    tally.ending = STILL_MOVING if ending == NOT_YET else ending
    tally.ended, tally.landed = start + passed * span, 1 if how == LANDED else 0
    tally.samples = sample


@kernel
def note_shaken(shape: SolidParameters, work: Workspace) -> None:
    """Note where a body is as the motion ends, or before, where its run does."""
    tally, foot = work.tally, foot_of(shape, work)
    tally.shaken_x, tally.shaken_y = foot.x - tally.start_x, foot.y - tally.start_y
    tally.shaken_yaw = tally.yaw - tally.start_yaw


@routine
def try_released(
    alone: SolidParameters,
    work: Workspace,
    still: GroundAcceleration,
    stand: RunSetup,
    trace: SolidTrace,
    ending: int,
) -> bool:
    """Try whether a solid that has not fallen would, if nothing but its support were there.

    The run goes on from its last state, which this overwrites, with the ground at rest. What is
    turned too little to have tipped over, and has too little energy to do so, needs no run, unless
    it may slide over an edge.

    Args:
        alone: the solid without its walls, straps and pads.
        work: as the run left it.
        still: a motion of zeros.
        stand: of the run.
        trace: without samples.
        ending: of the run.
    """
    turned = math.acos(min(1.0, axes_at(work.state).z.z))
    if ending == OVERTURNED or not (turned > TURNED or ending == STILL_MOVING):
        return False
    gravity = seen(tilted(stand), Vec(0.0, 0.0, -STANDARD_GRAVITY))
    if (
        is_before_tipping(alone, work, gravity)
        and not has_edge(alone)
        and cannot_fall(alone, work, gravity)
    ):
        return False
    run(alone, work, still, stand, trace)
    return bool(work.tally.ending == OVERTURNED or has_left(alone, work))
