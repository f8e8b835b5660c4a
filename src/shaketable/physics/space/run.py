"""A solid through a whole motion, and on until it rests or has fallen."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import LEVEL, arm, axes_at, begin_rim, height, on_rim
from shaketable.physics.space.edge import (
    beyond,
    has_edge,
    is_off,
    look_behind,
    note_past,
    stand_at_edge,
)
from shaketable.physics.space.guards import FORCE_PAST, GAP, peak_between
from shaketable.physics.space.impact import kinetic_energy
from shaketable.physics.space.in_plane import write_in_plane
from shaketable.physics.space.interval import bears, copy, cross_interval, land, twist
from shaketable.physics.space.landing import EDGE as TOLD_OF_EDGE
from shaketable.physics.space.landing import LANDING_TIME, LEFT_AT, write_edge
from shaketable.physics.space.pads import NEVER, glued_until
from shaketable.physics.space.rest import rest_margin
from shaketable.physics.space.rest_beside import judge_rest_beside
from shaketable.physics.space.settling import GOES_ON, LANDED
from shaketable.physics.space.step import Pull, pull_at
from shaketable.physics.space.straps import (
    attach,
    holds_any,
    strap_energy,
    with_straps,
)
from shaketable.physics.space.touches import plane_of, touches_more
from shaketable.physics.space.vectors import Vec, add, cross, dot, subtract, times
from shaketable.physics.space.walls import stand_at_walls
from shaketable.physics.space.workspace import (
    FLAT,
    SLIPS,
    STATE,
    STICKS,
    WALLED,
    Floats,
    P,
    Q,
    SolidParameters,
    V,
    Workspace,
    vec,
)
from shaketable.units import STANDARD_GRAVITY

# How a run ends.
STANDING, OVERTURNED, STILL_MOVING, STILL_SLIDING = range(4)
ON_EDGE = 5  # in a history, beside the kinds of a mode: the edge of the support is touched
#: What to tell the user of the irregular endings, after "the solid" or "3 of 100 simulations".
SENTENCES = {
    STILL_MOVING: "still moved when given up: ten seconds after the motion's end, without the "
    "energy to overturn, or ten minutes or 100,000 steps (20,000 of sliding) after it, or after "
    "200,000 steps and ten for each sample in all; it counts as standing, and its displacement "
    "and turn are those until then. Rolling, contour or drilling friction would bring it to rest",
    STILL_SLIDING: "still slid when the motion had ended, with nothing to stop it: there is too "
    "little kinetic friction for the tilt; its displacement counts until then",
}
SIDE_SLOPE = 0.05  # a side that is more level than this at the fall is the one it fell over
FREE_STEP = 0.01  # s: least interval after the motion's end
FREE_TIME = 10.0  # s after the motion's end: what still moves then but cannot fall is given up
FREE_LIMIT = 600.0  # s: and so is everything
# Steps after the motion's end, which are a few seconds of computing: likewise; fewer where a base
# lies flat and slips, whose steps are dear. An event counts as ten.
FREE_STEPS, FREE_SLIDES, PER_EVENT = 100_000.0, 20_000.0, 10.0
# Steps of a run, and more for each sample: a second of computing, a hundred times a usual run's.
MOST_STEPS, PER_SAMPLE = 200_000.0, 10.0
STICK_TOLERANCE = 1e-9  # m: a sticking body that moved less since the last sample is at rest
# A body that leans on a wall or hangs in a strap is at rest after so many intervals in each of
# which it moved with less energy than so small a part of g h: some 0.04 mm/s. What can fall would
# have gathered speed meanwhile; what swings or slips against a wall does so by ever less.
CALM, CALM_ENERGY = 50, 1e-10
TURNED = 1e-3  # rad: only what ends turned by more, or in motion, can be held up
MARGINAL = 1e-8  # m/s²: a slide that is slowed down by less goes on for ever


class GroundAcceleration(NamedTuple):
    """A motion in the level frame, at its samples."""

    acceleration: Floats  # (n, 3): along X, Y, Z [m/s²]
    time_step: float  # s


class RunSetup(NamedTuple):
    """How one run's body stands, and how the motion meets it."""

    tilt: float  # β [rad]
    azimuth: float  # γ [rad]
    orientation: float  # ψ0 [rad]
    scale: float
    polarity: float  # of both horizontal components


class RunSummary(NamedTuple):
    """What a run writes of itself."""

    ending: float
    time: float  # of the fall [s], NaN if there was none
    fall_azimuth: float  # of the body's axis then [rad], NaN if there was none
    peak: float  # nutation [rad]
    lift: float  # m
    yaw: float  # rad
    displacement_x: float  # of the foot of the centre of gravity [m]
    displacement_y: float
    impacts: float
    events: float
    steps: float
    energy_cuts: float
    fallbacks: float
    samples: float
    lowest: float  # row of the lowest corner at the fall, -1 without
    beside: float  # row of the other corner of the side that it fell over, -1 for a corner alone
    shaken_x: float  # displacement and yaw at the motion's end, or at a fall before it [m, m, rad]
    shaken_y: float
    shaken_yaw: float
    farthest: float  # that the foot comes from where it stood [m]


#: Columns of what is found: after these those of straps, see `write_straps`.
SUMMARY = len(RunSummary._fields)


class SolidTrace(NamedTuple):
    """Samples of a run, as many as fit."""

    state: Floats  # (n, STATE)
    rank: np.ndarray  # (n,) int8
    hold: np.ndarray  # (n,) int8
    impact_times: Floats  # s; as many as fit


def make_trace(samples: int, impacts: int = 0) -> SolidTrace:
    """An empty trace with room for so many samples and times of impacts."""
    rank, hold = np.zeros((2, samples), np.int8)
    return SolidTrace(np.full((samples, STATE), np.nan), rank, hold, np.full(impacts, np.nan))


class Tilted(NamedTuple):
    """How the level frame is seen from the support."""

    axis: Vec  # about which it is tilted
    sine: float
    cosine: float


@kernel
def tilted(stand: RunSetup) -> Tilted:
    axis = Vec(-math.sin(stand.azimuth), math.cos(stand.azimuth), 0.0)
    return Tilted(axis, math.sin(stand.tilt), math.cos(stand.tilt))


@kernel
def seen(frame: Tilted, a: Vec) -> Vec:
    """A vector of the level frame in the support's: Rᵀ a (Rodrigues)."""
    along = times(dot(frame.axis, a) * (1.0 - frame.cosine), frame.axis)
    return add(subtract(times(frame.cosine, a), times(frame.sine, cross(frame.axis, a))), along)


@kernel
def force_at(ground: GroundAcceleration, i: int, stand: RunSetup, frame: Tilted) -> Vec:
    """f at a sample; gravity alone after the last one."""
    a = Vec(0.0, 0.0, -STANDARD_GRAVITY)
    if i < ground.acceleration.shape[0]:
        flat, given = stand.scale * stand.polarity, ground.acceleration
        a = Vec(
            -flat * given[i, 0], -flat * given[i, 1], -stand.scale * given[i, 2] - STANDARD_GRAVITY
        )
    return seen(frame, a)


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
    tally.lift = tally.events = tally.steps = 0.0
    tally.energy_cuts = tally.fallbacks = tally.farthest = tally.left_at = tally.tips = 0.0
    tally.slip_back = tally.slip_front = 0.0
    tally.met = 1.0 if shape.glue > 0.0 else 0.0
    tally.yaw = twist(work.state)
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
    work.tally.impacts = 0.0


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
def cannot_fall(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Whether the energy of a body is below what its least tipping needs.

    It counts from where the body stands flat with its foot where it is now; what tips over a side
    stands with its foot farther back by (1 - cos θ) of the distance, at the most. What a strap
    stores counts as its own; of what is tipped over already and hangs in its straps nobody asks.
    """
    q, foot = axes_at(work.state), foot_of(shape, work)
    raised = subtract(vec(work.state, P), Vec(foot.x, foot.y, shape.h))
    back = math.sqrt(f.x * f.x + f.y * f.y) * shape.reach * (1.0 - q.z.z)
    energy = kinetic_energy(shape, work.state) - dot(f, raised) + back
    if shape.straps > 0:
        energy += strap_energy(shape, work)
    least = math.inf
    if has_edge(shape):
        out = shape.edge_x * f.x + shape.edge_y * f.y
        least = tipping_energy(-beyond(shape, foot), shape.h, out, -f.z)
    if shape.radius > 0.0:  # over its rim, which stands lower than before by the rise
        along = math.sqrt(f.x * f.x + f.y * f.y)
        rim = tipping_energy(shape.radius, shape.h - shape.rise, along, -f.z)
        least = min(least, rim + shape.rise * f.z)
    else:
        f_x, f_y = q.x.x * f.x + q.y.x * f.y, q.x.y * f.x + q.y.y * f.y
        for k in range(shape.hull):
            j = k + 1 if k + 1 < shape.hull else 0
            dx = work.points[j].x - work.points[k].x
            dy = work.points[j].y - work.points[k].y
            length = math.sqrt(dx * dx + dy * dy)
            out_x, out_y = dy / length, -dx / length
            distance = out_x * work.points[k].x + out_y * work.points[k].y
            out = out_x * f_x + out_y * f_y
            least = min(least, tipping_energy(distance, shape.h, out, -f.z))
    return bool(energy < least)


@kernel
def tipping_energy(distance: float, h: float, out: float, down: float) -> float:
    """What tipping about a line takes, the force along its outward normal and down given."""
    return math.sqrt((out * out + down * down) * (distance * distance + h * h)) - (
        h * down - distance * out
    )


@kernel
def slides_on(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Whether a body slides flat, and nothing slows it down or lies ahead."""
    if work.mode.kind != FLAT or work.mode.grip != SLIPS:
        return False
    if holds_any(shape, work):
        return False
    v = vec(work.state, V)
    ahead = has_edge(shape) and shape.edge_x * v.x + shape.edge_y * v.y > 0.0
    for wall in range(1, shape.walls + 1):
        ahead = ahead or dot(vec(work.planes[wall].normal, 0), v) < 0.0
    if ahead:
        return False
    most = 0.0
    for k in range(shape.contacts):
        most = max(most, work.points[k].kinetic)
    return math.sqrt(f.x * f.x + f.y * f.y) + most * f.z >= -MARGINAL


@kernel
def effort(work: Workspace) -> float:
    """What a run has computed so far, in steps."""
    return float(work.tally.steps + PER_EVENT * work.tally.events)


@routine
def run(
    shape: SolidParameters,
    work: Workspace,
    ground: GroundAcceleration,
    stand: RunSetup,
    trace: SolidTrace,
    found: Floats,
) -> None:
    """Simulate one solid from its state on; write its history and what was found."""
    samples, sample = ground.acceleration.shape[0], 0
    frame = tilted(stand)
    before = force_at(ground, 0, stand, frame)
    origin = foot_of(shape, work)
    stand_at_walls(shape, work, frame.axis, frame.sine, frame.cosine)
    begin(shape, work, before, trace.impact_times)
    start_yaw = work.tally.yaw
    ending, h, start, first = STILL_MOVING, ground.time_step, 0.0, 1.0
    glued, span = shape.glue > 0.0, ground.time_step
    passed, done, was_x, was_y = 0.0, 0.0, math.nan, math.nan
    calm, least = 0, CALM_ENERGY * STANDARD_GRAVITY * shape.h
    shaken, shaken_yaw, how = origin, start_yaw, GOES_ON
    end = (samples - 1) * ground.time_step
    free_h = max(ground.time_step, FREE_STEP)
    last = samples - 1 + math.ceil(FREE_LIMIT / free_h)
    for i in range(last):
        record(shape, trace, sample, work)
        sample += 1
        free = i >= samples - 1
        if i == samples - 1:
            h, done = free_h, effort(work)
            shaken, shaken_yaw = foot_of(shape, work), work.tally.yaw
        start = i * h if not free else end + (i - samples + 1) * h
        after = force_at(ground, i + 1 if not free else samples, stand, frame)
        work.clock.begun, work.clock.passed = start, 0.0
        if free:
            before = after
            if (shape.straps > 0 or touches_more(shape)) and work.mode.kind != FLAT:
                calm = calm + 1 if kinetic_energy(shape, work.state) < least else 0
                if calm >= CALM:
                    ending = STANDING
                    break
            if work.mode.kind == FLAT:
                x, y = work.state[P], work.state[P + 1]
                stays = abs(x - was_x) + abs(y - was_y) < STICK_TOLERANCE
                was_x, was_y = x, y
                held = with_straps(shape, work, after)
                rests = not on_rim(work) and rest_margin(shape, work, held) >= 0.0
                if work.mode.grip == STICKS and (stays or rests):
                    ending = STANDING
                    break
                if slides_on(shape, work, after):
                    ending = STILL_SLIDING
                    break
            at_rest = work.mode.kind == WALLED and work.mode.grip == STICKS
            if at_rest and judge_rest_beside(shape, work, after):
                ending = STANDING
                break
            late = start - end > FREE_TIME and not is_off(shape, work.state)
            if late and cannot_fall(shape, work, after):
                break
            most = FREE_SLIDES if work.mode.kind == FLAT else FREE_STEPS
            if effort(work) - done > most:
                break
        if effort(work) > MOST_STEPS + PER_SAMPLE * samples:
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
    landed = how == LANDED
    # what hangs past the edge in a strap has left its support, too
    hangs = ending != OVERTURNED and is_off(shape, work.state) and not bears(shape, work)
    gone = landed or hangs
    now = start + passed * span
    write_found(shape, work, OVERTURNED if gone else ending, now, sample, found)
    write_straps(shape, work, found)
    columns = SUMMARY + 1 + 2 * shape.straps
    if shape.planar:
        write_in_plane(shape, work, found, columns + (TOLD_OF_EDGE if has_edge(shape) else 0))
    if has_edge(shape):
        write_edge(shape, work, gone, landed, now, found, columns)
        if gone:  # it fell to the side of the edge, when it came down
            found[1] = found[columns + (LANDING_TIME if landed else LEFT_AT)]
            found[2] = math.atan2(shape.edge_y, shape.edge_x)
            found[14] = found[15] = -1.0
    found[5] -= start_yaw
    found[6] -= origin.x
    found[7] -= origin.y
    if start < end:
        found[16], found[17], found[18] = found[6], found[7], found[5]
    else:
        found[16], found[17] = shaken.x - origin.x, shaken.y - origin.y
        found[18] = shaken_yaw - start_yaw


@kernel
def write_straps(shape: SolidParameters, work: Workspace, found: Floats) -> None:
    """Write each strap's force and breaking after a RunSummary and the column of `held_up`."""
    for k in range(shape.straps):
        found[SUMMARY + 1 + 2 * k] = work.straps[k].force_peak
        found[SUMMARY + 2 + 2 * k] = work.straps[k].broke_at


@routine
def try_released(
    alone: SolidParameters,
    work: Workspace,
    still: GroundAcceleration,
    stand: RunSetup,
    trace: SolidTrace,
    ending: float,
    found: Floats,
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
        found: written, a RunSummary and the columns of an edge.
    """
    turned = math.acos(min(1.0, axes_at(work.state).z.z))
    if ending == OVERTURNED or not (turned > TURNED or ending == STILL_MOVING):
        return False
    gravity = seen(tilted(stand), Vec(0.0, 0.0, -STANDARD_GRAVITY))
    before_tipping = turned + stand.tilt < math.atan2(alone.inscribed, alone.h)
    if before_tipping and not has_edge(alone) and cannot_fall(alone, work, gravity):
        return False
    run(alone, work, still, stand, trace, found)
    return bool(found[0] == OVERTURNED)


@kernel
def foot_of(shape: SolidParameters, work: Workspace) -> Vec:
    """Foot of the centre of gravity on the base."""
    q = axes_at(work.state)
    axis = Vec(q.x.z, q.y.z, q.z.z)
    return subtract(vec(work.state, P), times(shape.h, axis))


@routine
def write_found(
    shape: SolidParameters,
    work: Workspace,
    ending: int,
    time: float,
    samples: int,
    found: Floats,
) -> None:
    """Write a RunSummary."""
    q, y = axes_at(work.state), work.state
    axis = Vec(q.x.z, q.y.z, q.z.z)
    fell = ending == OVERTURNED
    found[0] = float(ending)
    found[1] = time if fell else math.nan
    found[2] = math.atan2(axis.y, axis.x) if fell else math.nan
    found[3] = math.asin(min(1.0, math.sqrt(max(work.tally.peak, 0.0))))
    found[4] = work.tally.lift
    foot = foot_of(shape, work)
    found[5], found[6], found[7] = work.tally.yaw, foot.x, foot.y
    found[8], found[9], found[10] = work.tally.impacts, work.tally.events, work.tally.steps
    found[11], found[12] = work.tally.energy_cuts, work.tally.fallbacks
    found[13] = float(samples)
    found[14] = -1.0
    found[15] = -1.0
    if fell and shape.radius == 0.0:
        lowest, beside = 0, -1
        for k in range(shape.hull):
            if height(shape, work, q, y, k) < height(shape, work, q, y, lowest):
                lowest = k
        for k in (lowest + 1, lowest + shape.hull - 1):
            j = k % shape.hull
            rise = height(shape, work, q, y, j) - height(shape, work, q, y, lowest)
            r, s = arm(shape, work, j), arm(shape, work, lowest)
            span = subtract(r, s)
            if rise < SIDE_SLOPE * math.sqrt(dot(span, span)):
                beside = j
        found[14] = float(lowest)
        found[15] = float(beside)
    found[19] = math.sqrt(work.tally.farthest)
