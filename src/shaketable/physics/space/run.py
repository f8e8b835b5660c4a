"""A solid through a whole motion, and on until it rests or has fallen."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import LEVEL, arm, axes_at, begin_rim, height, on_rim
from shaketable.physics.space.edge import LANDING_TIME, leaves_support, write_edge
from shaketable.physics.space.guards import FORCE_PAST, GAP, peak_between
from shaketable.physics.space.impact import kinetic_energy
from shaketable.physics.space.interval import GOES_ON, copy, cross_interval, land, twist
from shaketable.physics.space.pads import NEVER, glued_until
from shaketable.physics.space.rest import rest_margin
from shaketable.physics.space.rest_beside import rests_beside
from shaketable.physics.space.step import Pull, pull_at
from shaketable.physics.space.straps import (
    attach,
    holds_any,
    strap_energy,
    with_straps,
)
from shaketable.physics.space.vectors import Vec, add, cross, dot, subtract, times
from shaketable.physics.space.walls import stand_at_walls
from shaketable.physics.space.workspace import (
    BROKE,
    CLOCK,
    CLOSED,
    CONTACT_KIND,
    EVENTS,
    FARTHEST,
    FLAT,
    FORCE_PEAK,
    FRICTION_STATE,
    IMPACTS,
    KINETIC,
    LIFT,
    PAST,
    PEAK,
    SLIPS,
    START_X,
    START_Y,
    STATE,
    STEPS,
    STICKS,
    TALLY,
    WALLED,
    YAW,
    Floats,
    P,
    Q,
    SolidParameters,
    Workspace,
    X,
    Y,
    vec,
)
from shaketable.units import STANDARD_GRAVITY

# How a run ends.
STANDING, OVERTURNED, STILL_MOVING, STILL_SLIDING = range(4)
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
def begin(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Find what a solid does from its state on, which may be any above the support."""
    for j in range(TALLY):
        work.tally[j] = 0.0
    work.tally[YAW] = twist(work.state)
    work.tally[PEAK] = peak_between(work.state, work.state, 0.0)
    foot = foot_of(shape, work)
    work.tally[START_X], work.tally[START_Y] = foot.x, foot.y
    for k in range(shape.contacts + 1):
        work.moving[k] = 0
    work.judged[PAST] = FORCE_PAST
    work.mode[CONTACT_KIND] = work.mode[CLOSED] = 0
    n = axes_at(work.state).z
    sine = math.sqrt(n.x * n.x + n.y * n.y)
    work.rim[0], work.rim[1] = (-n.x / sine, -n.y / sine) if sine > LEVEL else (1.0, 0.0)
    begin_rim(work)
    work.clock[CLOCK] = work.clock[CLOCK + 1] = 0.0
    attach(shape, work)
    land(shape, work, f, GAP)
    work.tally[IMPACTS] = 0.0


@kernel
def record(trace: SolidTrace, sample: int, work: Workspace) -> None:
    if sample < trace.state.shape[0]:
        copy(work.state, trace.state[sample])
        trace.rank[sample] = work.mode[CONTACT_KIND]
        trace.hold[sample] = work.mode[FRICTION_STATE]


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
    if shape.radius > 0.0:  # over its rim, which stands lower than before by the rise
        along = math.sqrt(f.x * f.x + f.y * f.y)
        least = tipping_energy(shape.radius, shape.h - shape.rise, along, -f.z) + shape.rise * f.z
    else:
        f_x, f_y = q.x.x * f.x + q.y.x * f.y, q.x.y * f.x + q.y.y * f.y
        for k in range(shape.hull):
            j = k + 1 if k + 1 < shape.hull else 0
            dx = work.points[j, X] - work.points[k, X]
            dy = work.points[j, Y] - work.points[k, Y]
            length = math.sqrt(dx * dx + dy * dy)
            out_x, out_y = dy / length, -dx / length
            distance = out_x * work.points[k, X] + out_y * work.points[k, Y]
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
    """Whether a body slides flat and nothing slows it down."""
    if work.mode[CONTACT_KIND] != FLAT or work.mode[FRICTION_STATE] != SLIPS:
        return False
    if holds_any(shape, work):
        return False
    most = 0.0
    for k in range(shape.contacts):
        most = max(most, work.points[k, KINETIC])
    return math.sqrt(f.x * f.x + f.y * f.y) + most * f.z >= -MARGINAL


@kernel
def effort(work: Workspace) -> float:
    """What a run has computed so far, in steps."""
    return float(work.tally[STEPS] + PER_EVENT * work.tally[EVENTS])


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
    if shape.walls > 0:
        stand_at_walls(shape, work, frame.axis, frame.sine, frame.cosine)
    begin(shape, work, before)
    start_yaw = work.tally[YAW]
    ending, h, start, first = STILL_MOVING, ground.time_step, 0.0, 1.0
    glued, span = shape.glue > 0.0, ground.time_step
    passed, done, was_x, was_y = 0.0, 0.0, math.nan, math.nan
    calm, least = 0, CALM_ENERGY * STANDARD_GRAVITY * shape.h
    shaken, shaken_yaw, left = origin, start_yaw, False
    end = (samples - 1) * ground.time_step
    free_h = max(ground.time_step, FREE_STEP)
    last = samples - 1 + int(math.ceil(FREE_LIMIT / free_h))  # noqa: RUF046  a float on a GPU
    for i in range(last):
        record(trace, sample, work)
        sample += 1
        free = i >= samples - 1
        if i == samples - 1:
            h, done = free_h, effort(work)
            shaken, shaken_yaw = foot_of(shape, work), work.tally[YAW]
        start = i * h if not free else end + (i - samples + 1) * h
        after = force_at(ground, i + 1 if not free else samples, stand, frame)
        work.clock[CLOCK], work.clock[CLOCK + 1] = start, 0.0
        if free:
            before = after
            if shape.straps + shape.walls > 0 and work.mode[CONTACT_KIND] != FLAT:
                calm = calm + 1 if kinetic_energy(shape, work.state) < least else 0
                if calm >= CALM:
                    ending = STANDING
                    break
            if work.mode[CONTACT_KIND] == FLAT:
                x, y = work.state[P], work.state[P + 1]
                stays = abs(x - was_x) + abs(y - was_y) < STICK_TOLERANCE
                was_x, was_y = x, y
                held = with_straps(shape, work, after)
                rests = not on_rim(shape, work) and rest_margin(shape, work, held) >= 0.0
                if work.mode[FRICTION_STATE] == STICKS and (stays or rests):
                    ending = STANDING
                    break
                if slides_on(shape, work, after):
                    ending = STILL_SLIDING
                    break
            at_rest = work.mode[CONTACT_KIND] == WALLED and work.mode[FRICTION_STATE] == STICKS
            if at_rest and rests_beside(shape, work, after):
                ending = STANDING
                break
            if start - end > FREE_TIME and cannot_fall(shape, work, after):
                break
            most = FREE_SLIDES if work.mode[CONTACT_KIND] == FLAT else FREE_STEPS
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
            work.clock[CLOCK] = start
            pull = Pull(pull_at(pull, part), times(1.0 - part, pull.change), span)
        how, passed, first = cross_interval(shape, work, pull, first)
        if how == GOES_ON and shape.edge_at < math.inf:
            left = leaves_support(shape, work, after)
        if how != GOES_ON or left:
            ending = OVERTURNED
            record(trace, sample, work)
            sample += 1
            break
    write_found(shape, work, ending, start + passed * span, sample, found)
    write_straps(shape, work, found)
    if shape.edge_at < math.inf:
        columns = SUMMARY + 1 + 2 * shape.straps
        gravity = seen(frame, Vec(0.0, 0.0, -STANDARD_GRAVITY))
        write_edge(shape, work, left, start + passed * span, gravity, found, columns)
        if left:  # it fell to the side of the edge, when it came down
            found[1] = found[columns + LANDING_TIME]
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
        found[SUMMARY + 1 + 2 * k] = work.straps[k, FORCE_PEAK]
        found[SUMMARY + 2 + 2 * k] = work.straps[k, BROKE]


@routine
def is_held_up(
    alone: SolidParameters,
    work: Workspace,
    still: GroundAcceleration,
    stand: RunSetup,
    trace: SolidTrace,
    ending: float,
    found: Floats,
) -> bool:
    """Whether a solid that has not fallen would, if nothing but its support were there.

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
    if before_tipping and alone.edge_at == math.inf and cannot_fall(alone, work, gravity):
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
    found[3] = math.asin(min(1.0, math.sqrt(max(work.tally[PEAK], 0.0))))
    found[4] = work.tally[LIFT]
    foot = foot_of(shape, work)
    found[5], found[6], found[7] = work.tally[YAW], foot.x, foot.y
    for k in range(5):
        found[8 + k] = work.tally[IMPACTS + k]
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
    found[19] = math.sqrt(work.tally[FARTHEST])
