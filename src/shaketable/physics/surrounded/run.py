"""A planar body among its surroundings through a whole motion, and on until it rests or falls."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.physics.plane.codes import BOTH, LEFT, NO_CONTACT, REST, RIGHT, phase_of
from shaketable.physics.plane.forcing import Shaking
from shaketable.physics.surrounded.creep import FELL, GOES_ON, LANDED
from shaketable.physics.surrounded.events import on_support, respond
from shaketable.physics.surrounded.guards import GAP, is_off
from shaketable.physics.surrounded.impacts import kinetic
from shaketable.physics.surrounded.interval import cross_interval
from shaketable.physics.surrounded.modes import SIGN, Force, choose, mode_size, rests
from shaketable.physics.surrounded.scene import (
    AT_SIDES,
    BROKE,
    CHANGES,
    CLOCK,
    CONTACTS,
    EVENTS,
    FALLBACKS,
    FARTHEST_LEFT,
    FARTHEST_RIGHT,
    GLUED,
    IMPACTS,
    LEFT_AT,
    LIFT,
    MOST_FORCE,
    ON_WALLS,
    PASSED,
    PAST,
    PEAK,
    SPIN,
    STATE,
    STEPS,
    TALLY,
    TURN,
    USED,
    V_X,
    V_Y,
    WALL_X,
    Floats,
    Scene,
    Scenes,
    Workspace,
    X,
    Y,
)
from shaketable.physics.surrounded.straps import (
    attach,
    holds_any,
    pull_or_not,
    pulls_any,
    strap_energy,
)
from shaketable.physics.surrounded.touches import look_behind
from shaketable.units import STANDARD_GRAVITY

# How a run ends, as `engine.endings.Ending` numbers it.
STANDING, OVERTURNED, STILL_ROCKING, STILL_SLIDING, UNRESOLVED = range(5)
FREE_STEP = 0.01  # s: least interval after the motion's end
# What still moves so long after it [s], but cannot fall, is given up; so is everything after the
# second, or after so many steps, of which an event counts as ten.
FREE_TIME, FREE_LIMIT = 60.0, 600.0
FREE_STEPS, PER_EVENT = 100_000.0, 10.0
MOST_STEPS, PER_SAMPLE = 1_000_000.0, 10.0  # of a run, and more for each sample
LEANS = 1e-3  # rad: what ends upright, but turned by more, leans
# What hangs in a strap is at rest after so many intervals in which it turned by less [rad], if it
# moves with less energy than that of so small a part of g h.
CALM, HANG_TOLERANCE, HANG_ENERGY = 10, 1e-9, 1e-14
MARGINAL = 1e-8  # m/s²: a slide that is slowed down by less goes on for ever


class SurroundedTrace(NamedTuple):
    """A run's history, as much as fits."""

    state: Floats  # (n, STATE)
    slip: Floats  # (n,): of the lowest corner [m]
    change_times: Floats  # of phase [s]
    phases: NDArray[np.int8]
    impact_times: Floats  # s


class SurroundedSummary(NamedTuple):
    """What a run writes of itself; times, places and angles of the edge are NaN without."""

    ending: float
    direction: float  # +1 if it fell toward +x, -1 toward -x, else 0
    overturning_time: float  # s
    peak: float  # rad
    impacts: float
    samples: float
    slip: float  # m
    lift: float  # m
    farthest_left: float  # m
    farthest_right: float  # m
    changes: float  # of phase
    used: float  # 1 if it touched, or was held by, what surrounds it
    leaning: float  # 1 if it ended upright, but leaning
    off_edge: float  # 1 if it left its support over the edge
    left_at: float  # when it did [s]
    landing_time: float  # s
    landing_x: float  # m, of the centre of gravity
    landing_speed: float  # m/s
    landing_rotation: float  # rad
    fallbacks: float


#: Columns of what is found: after these two of each strap, its largest force and when it broke.
SUMMARY = len(SurroundedSummary._fields)


@kernel
def body_force(scene: Scene, shaking: Shaking, polarity: float, i: int) -> tuple[float, float]:
    """f at a sample; gravity alone after the last one."""
    a_x, g = 0.0, STANDARD_GRAVITY
    if i < shaking.a_x.size:
        a_x, g = polarity * shaking.a_x[i], shaking.g_effective[i]
    sine, cosine = scene.tilt_sine, scene.tilt_cosine
    return -a_x * cosine - g * sine, a_x * sine - g * cosine


@kernel
def phase_code(work: Workspace, edge: float) -> int:
    """The `plane.phases.Phase` of the mode: what its contacts on the support do."""
    if rests(work):
        return REST
    contact, slip = NO_CONTACT, 0.0
    for e in range(mode_size(work)):
        number = work.mode[1 + e, 0]
        if number < ON_WALLS or number == AT_SIDES:
            own = RIGHT if number == 0 or (number == AT_SIDES and edge > 0.0) else LEFT
            contact = own if contact == NO_CONTACT else BOTH
            slip = float(work.mode[1 + e, 1])
    return phase_of(contact, slip)


@routine
def record(
    scene: Scene, work: Workspace, trace: SurroundedTrace, sample: int, time: float, was: int
) -> int:
    """Write a sample, and the phase if it is another one; returns it."""
    code = phase_code(work, scene.edge)
    if code != was:
        at = int(work.tally[CHANGES])
        if at < trace.phases.size:
            trace.phases[at] = code
            trace.change_times[at] = time
        work.tally[CHANGES] += 1.0
    if sample < trace.state.shape[0]:
        for j in range(STATE):
            trace.state[sample, j] = work.state[j]
        trace.slip[sample] = slip_of_lowest(scene, work.state)
    return code


@kernel
def slip_of_lowest(scene: Scene, y: Floats) -> float:
    """How far the lowest corner has moved along the support [m]."""
    sine, cosine = math.sin(y[TURN]), math.cos(y[TURN])
    xi = scene.right if y[TURN] >= 0.0 else -scene.left
    return float(y[X] + xi * cosine - scene.h * sine - xi)


@routine
def stand(scene: Scene, work: Workspace, rotation: float) -> None:
    """Let a body go at a rotation, on the corner that it then stands on, where that stood."""
    for j in range(STATE):
        work.state[j] = 0.0
    work.state[Y] = scene.h
    if rotation != 0.0:
        xi = scene.right if rotation > 0.0 else -scene.left
        sine, cosine = math.sin(rotation), math.cos(rotation)
        work.state[TURN] = rotation
        work.state[X] = xi - (xi * cosine - scene.h * sine)
        work.state[Y] = scene.h * cosine + xi * sine


@routine
def begin(scene: Scene, work: Workspace) -> None:
    """Nothing has happened yet to the body in the present state."""
    for j in range(TALLY):
        work.tally[j] = 0.0
    work.tally[PAST] = SIGN
    work.tally[PEAK] = abs(work.state[TURN])
    work.mode[0, 0] = 0
    attach(scene, work)
    for k in range(CONTACTS):
        work.behind[k] = 0
    look_behind(scene, work)
    moves = abs(work.state[V_X]) + abs(work.state[V_Y]) + abs(work.state[SPIN])
    if scene.glue > 0.0 and work.state[TURN] == 0.0 and moves == 0.0:
        work.tally[GLUED] = work.tally[USED] = 1.0


@routine
def cannot_fall(scene: Scene, work: Workspace, f_x: float, f_y: float) -> bool:
    """Whether the energy of a body is below what its least tipping needs."""
    y = work.state
    energy = kinetic(scene, y[V_X], y[V_Y], y[SPIN]) - f_y * (y[Y] - scene.h)
    if scene.straps > 0:
        energy += strap_energy(scene, work)
    size, least = math.sqrt(f_x * f_x + f_y * f_y), math.inf
    for side in (1.0, -1.0):
        b = scene.right if side > 0.0 else scene.left
        if side == scene.edge:
            b = min(b, scene.edge_at - side * y[X])
        tips = size * math.sqrt(b * b + scene.h * scene.h) + scene.h * f_y + side * b * f_x
        least = min(least, tips)
    return bool(energy < least)


@routine
def slides_on(scene: Scene, work: Workspace, f_x: float, f_y: float) -> bool:
    """Whether a body slides flat, and nothing slows it down or lies ahead."""
    if mode_size(work) != 2 or work.mode[1, 0] + work.mode[2, 0] != 1 or rests(work):
        return False
    sigma = work.mode[1, 1]
    if scene.edge * sigma > 0.0 or holds_any(scene, work):
        return False
    for k in range(scene.walls):
        if scene.wall[k, WALL_X] * sigma < 0.0:
            return False
    along = scene.b_slip * f_x + sigma * scene.a_slip * f_y
    return bool(sigma * along >= -MARGINAL)


@kernel
def effort(work: Workspace) -> float:
    """What a run has computed so far, in steps."""
    return float(work.tally[STEPS] + PER_EVENT * work.tally[EVENTS])


@routine
def run(
    scene: Scene,
    work: Workspace,
    shaking: Shaking,
    polarity: float,
    trace: SurroundedTrace,
    found: Floats,
) -> None:
    """Simulate one body from its state on; write its history and what was found."""
    samples = shaking.a_x.size
    begin(scene, work)
    f_x, f_y = body_force(scene, shaking, polarity, 0)
    respond(scene, work, f_x, f_y, GAP, trace.impact_times)
    work.tally[IMPACTS] = 0.0
    end = (samples - 1) * shaking.time_step
    free_h = max(shaking.time_step, FREE_STEP)
    last = samples - 1 + int(math.ceil(FREE_LIMIT / free_h))  # noqa: RUF046  a float on a GPU
    ending, part, done, h, phase = GOES_ON, 1.0, 0.0, shaking.time_step, -1
    sample, how, calm, was = 0, -1, 0, math.nan
    for i in range(last):
        free = i >= samples - 1
        if i == samples - 1:
            h, done = free_h, effort(work)
        start = i * h if not free else end + (i - samples + 1) * h
        work.tally[CLOCK], work.tally[PASSED] = start, 0.0
        phase = record(scene, work, trace, sample, start, phase)
        sample += 1
        after_x, after_y = body_force(scene, shaking, polarity, samples if free else i + 1)
        if free:
            f_x, f_y = after_x, after_y
            if rests(work):
                pull_or_not(scene, work)
                choose(scene, work, f_x, f_y, False)
                if rests(work):
                    how = STANDING
                    break
            y = work.state
            calm = calm + 1 if abs(y[TURN] - was) < HANG_TOLERANCE else 0
            was = y[TURN]
            moves = kinetic(scene, y[V_X], y[V_Y], y[SPIN])
            if calm >= CALM and pulls_any(scene, work) and moves < HANG_ENERGY * scene.h:
                how = STANDING
                break
            if slides_on(scene, work, f_x, f_y):
                how = STILL_SLIDING
                break
            off = is_off(scene, work.state)
            if not off and start - end > FREE_TIME and cannot_fall(scene, work, f_x, f_y):
                how = STILL_ROCKING
                break
            if effort(work) - done > FREE_STEPS:
                how = STILL_ROCKING
                break
        if effort(work) > MOST_STEPS + PER_SAMPLE * samples:
            how = UNRESOLVED
            break
        force = Force(f_x, after_x - f_x, f_y, after_y - f_y)
        ending, part = cross_interval(scene, work, force, h, part, trace.impact_times)
        f_x, f_y = after_x, after_y
        if ending != GOES_ON:
            how = OVERTURNED
            break
    write_found(scene, work, how if how >= 0 else STILL_ROCKING, ending, sample, found)


@routine
def write_found(
    scene: Scene, work: Workspace, how: int, ending: int, samples: int, found: Floats
) -> None:
    """Write a SurroundedSummary, and what the straps bore."""
    y, tally = work.state, work.tally
    fell, landed = ending == FELL, ending == LANDED
    # what hangs past the edge in a strap has left its support, too
    gone = landed or (not fell and is_off(scene, y) and not on_support(work))
    now = tally[CLOCK] + tally[PASSED]
    direction = scene.edge if gone else 0.0
    if fell:
        direction = 1.0 if y[TURN] > 0.0 else -1.0
    surrounded = scene.walls + scene.straps > 0 or scene.edge != 0.0
    leans = surrounded and how == STANDING and not gone and abs(y[TURN]) > LEANS
    fell_at = now if fell or landed else tally[LEFT_AT] if gone else math.nan
    landed_at, landed_x, landed_with, landed_turned = math.nan, math.nan, math.nan, math.nan
    if landed:
        landed_at, landed_x, landed_turned = now, y[X], y[TURN]
        landed_with = math.sqrt(y[V_X] * y[V_X] + y[V_Y] * y[V_Y])
    left_at = tally[LEFT_AT] if gone else math.nan
    used = 1.0 if gone or is_off(scene, y) else tally[USED]
    peak = min(tally[PEAK], 0.5 * math.pi)  # in the air it may turn on
    summary = SurroundedSummary(
        float(OVERTURNED if gone else how), direction, fell_at, peak, tally[IMPACTS],
        float(samples), slip_of_lowest(scene, y), tally[LIFT], tally[FARTHEST_LEFT],
        tally[FARTHEST_RIGHT], tally[CHANGES], used, 1.0 if leans else 0.0, 1.0 if gone else 0.0,
        left_at, landed_at, landed_x, landed_with, landed_turned, tally[FALLBACKS],
    )  # fmt: skip
    for k in range(len(summary)):
        found[k] = summary[k]
    for k in range(scene.straps):
        found[SUMMARY + 2 * k] = work.strap[k, MOST_FORCE]
        found[SUMMARY + 2 * k + 1] = work.strap[k, BROKE]


@driver
def move_surrounded(
    scenes: Scenes,
    workspaces: Scenes,
    shaking: Shaking,
    polarity: Floats,
    rotation: float,
    as_is: bool,
    trace: SurroundedTrace,
    found: Floats,
) -> None:
    """Simulate bodies, each in its own surroundings.

    Args:
        scenes: of each, (n,).
        workspaces: that of one run.
        shaking: the motion.
        polarity: of each, (n,).
        rotation: at which they are let go [rad].
        as_is: whether they begin in the state that the workspace holds, which may be any above the
            support, rather than so.
        trace: array for the history of the last one; may have no samples.
        found: array for the results, (n, SUMMARY + 2 straps).
    """
    for k in range(scenes.shape[0]):
        if not as_is:
            stand(scenes[k], workspaces[0], rotation)
        run(scenes[k], workspaces[0], shaking, polarity[k], trace, found[k])
