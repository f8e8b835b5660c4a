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
    TOLD,
    TURN,
    USED,
    V_X,
    V_Y,
    WALL_X,
    Floats,
    Room,
    Scene,
    Scenes,
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
MOST_STEPS, PER_SAMPLE = 200_000.0, 10.0  # of a run, and more for each sample
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
def phase_code(room: Room, edge: float) -> int:
    """The `plane.phases.Phase` of the mode: what its contacts on the support do."""
    if rests(room):
        return REST
    contact, slip = NO_CONTACT, 0.0
    for e in range(mode_size(room)):
        number = room.mode[1 + e, 0]
        if number < ON_WALLS or number == AT_SIDES:
            own = RIGHT if number == 0 or (number == AT_SIDES and edge > 0.0) else LEFT
            contact = own if contact == NO_CONTACT else BOTH
            slip = float(room.mode[1 + e, 1])
    return phase_of(contact, slip)


@routine
def record(
    scene: Scene, room: Room, trace: SurroundedTrace, sample: int, time: float, was: int
) -> int:
    """Write a sample, and the phase if it is another one; returns it."""
    code = phase_code(room, scene.edge)
    if code != was:
        at = int(room.told[CHANGES])
        if at < trace.phases.size:
            trace.phases[at] = code
            trace.change_times[at] = time
        room.told[CHANGES] += 1.0
    if sample < trace.state.shape[0]:
        for j in range(STATE):
            trace.state[sample, j] = room.state[j]
        trace.slip[sample] = slip_of_lowest(scene, room.state)
    return code


@kernel
def slip_of_lowest(scene: Scene, y: Floats) -> float:
    """How far the lowest corner has moved along the support [m]."""
    sine, cosine = math.sin(y[TURN]), math.cos(y[TURN])
    xi = scene.right if y[TURN] >= 0.0 else -scene.left
    return float(y[X] + xi * cosine - scene.h * sine - xi)


@routine
def stand(scene: Scene, room: Room, rotation: float) -> None:
    """Let a body go at a rotation, on the corner that it then stands on, where that stood."""
    for j in range(STATE):
        room.state[j] = 0.0
    room.state[Y] = scene.h
    if rotation != 0.0:
        xi = scene.right if rotation > 0.0 else -scene.left
        sine, cosine = math.sin(rotation), math.cos(rotation)
        room.state[TURN] = rotation
        room.state[X] = xi - (xi * cosine - scene.h * sine)
        room.state[Y] = scene.h * cosine + xi * sine


@routine
def begin(scene: Scene, room: Room) -> None:
    """Nothing has happened yet to the body in the present state."""
    for j in range(TOLD):
        room.told[j] = 0.0
    room.told[PAST] = SIGN
    room.told[PEAK] = abs(room.state[TURN])
    room.mode[0, 0] = 0
    attach(scene, room)
    for k in range(CONTACTS):
        room.behind[k] = 0
    look_behind(scene, room)
    moves = abs(room.state[V_X]) + abs(room.state[V_Y]) + abs(room.state[SPIN])
    if scene.glue > 0.0 and room.state[TURN] == 0.0 and moves == 0.0:
        room.told[GLUED] = room.told[USED] = 1.0


@routine
def cannot_fall(scene: Scene, room: Room, f_x: float, f_y: float) -> bool:
    """Whether the energy of a body is below what its least tipping needs."""
    y = room.state
    energy = kinetic(scene, y[V_X], y[V_Y], y[SPIN]) - f_y * (y[Y] - scene.h)
    if scene.straps > 0:
        energy += strap_energy(scene, room)
    size, least = math.sqrt(f_x * f_x + f_y * f_y), math.inf
    for side in (1.0, -1.0):
        b = scene.right if side > 0.0 else scene.left
        if side == scene.edge:
            b = min(b, scene.edge_at - side * y[X])
        tips = size * math.sqrt(b * b + scene.h * scene.h) + scene.h * f_y + side * b * f_x
        least = min(least, tips)
    return bool(energy < least)


@routine
def slides_on(scene: Scene, room: Room, f_x: float, f_y: float) -> bool:
    """Whether a body slides flat, and nothing slows it down or lies ahead."""
    if mode_size(room) != 2 or room.mode[1, 0] + room.mode[2, 0] != 1 or rests(room):
        return False
    sigma = room.mode[1, 1]
    if scene.edge * sigma > 0.0 or holds_any(scene, room):
        return False
    for k in range(scene.walls):
        if scene.wall[k, WALL_X] * sigma < 0.0:
            return False
    along = scene.b_slip * f_x + sigma * scene.a_slip * f_y
    return bool(sigma * along >= -MARGINAL)


@kernel
def effort(room: Room) -> float:
    """What a run has computed so far, in steps."""
    return float(room.told[STEPS] + PER_EVENT * room.told[EVENTS])


@routine
def run(
    scene: Scene,
    room: Room,
    shaking: Shaking,
    polarity: float,
    trace: SurroundedTrace,
    found: Floats,
) -> None:
    """Simulate one body from its state on; write its history and what was found."""
    samples = shaking.a_x.size
    begin(scene, room)
    f_x, f_y = body_force(scene, shaking, polarity, 0)
    respond(scene, room, f_x, f_y, GAP, trace.impact_times)
    room.told[IMPACTS] = 0.0
    end = (samples - 1) * shaking.time_step
    free_h = max(shaking.time_step, FREE_STEP)
    last = samples - 1 + int(math.ceil(FREE_LIMIT / free_h))  # noqa: RUF046  a float on a GPU
    ending, part, done, h, phase = GOES_ON, 1.0, 0.0, shaking.time_step, -1
    sample, how, calm, was = 0, -1, 0, math.nan
    for i in range(last):
        free = i >= samples - 1
        if i == samples - 1:
            h, done = free_h, effort(room)
        start = i * h if not free else end + (i - samples + 1) * h
        room.told[CLOCK], room.told[PASSED] = start, 0.0
        phase = record(scene, room, trace, sample, start, phase)
        sample += 1
        after_x, after_y = body_force(scene, shaking, polarity, samples if free else i + 1)
        if free:
            f_x, f_y = after_x, after_y
            if rests(room):
                pull_or_not(scene, room)
                choose(scene, room, f_x, f_y, False)
                if rests(room):
                    how = STANDING
                    break
            y = room.state
            calm = calm + 1 if abs(y[TURN] - was) < HANG_TOLERANCE else 0
            was = y[TURN]
            moves = kinetic(scene, y[V_X], y[V_Y], y[SPIN])
            if calm >= CALM and pulls_any(scene, room) and moves < HANG_ENERGY * scene.h:
                how = STANDING
                break
            if slides_on(scene, room, f_x, f_y):
                how = STILL_SLIDING
                break
            off = is_off(scene, room.state)
            if not off and start - end > FREE_TIME and cannot_fall(scene, room, f_x, f_y):
                how = STILL_ROCKING
                break
            if effort(room) - done > FREE_STEPS:
                how = STILL_ROCKING
                break
        if effort(room) > MOST_STEPS + PER_SAMPLE * samples:
            how = UNRESOLVED
            break
        force = Force(f_x, after_x - f_x, f_y, after_y - f_y)
        ending, part = cross_interval(scene, room, force, h, part, trace.impact_times)
        f_x, f_y = after_x, after_y
        if ending != GOES_ON:
            how = OVERTURNED
            break
    write_found(scene, room, how if how >= 0 else STILL_ROCKING, ending, sample, found)


@routine
def write_found(
    scene: Scene, room: Room, how: int, ending: int, samples: int, found: Floats
) -> None:
    """Write a SurroundedSummary, and what the straps bore."""
    y, told = room.state, room.told
    for j in range(found.size):
        found[j] = 0.0
    fell, landed = ending == FELL, ending == LANDED
    # what hangs past the edge in a strap has left its support, too
    gone = landed or (not fell and is_off(scene, y) and not on_support(room))
    time = told[CLOCK] + told[PASSED]
    found[0] = float(OVERTURNED if gone else how)
    if fell:
        found[1] = 1.0 if y[TURN] > 0.0 else -1.0
    elif gone:
        found[1] = scene.edge
    found[2] = time if fell or landed else told[LEFT_AT] if gone else math.nan
    found[3] = min(told[PEAK], 0.5 * math.pi)  # in the air it may turn on
    found[4], found[5] = told[IMPACTS], float(samples)
    found[6], found[7] = slip_of_lowest(scene, y), told[LIFT]
    found[8], found[9], found[10] = told[FARTHEST_LEFT], told[FARTHEST_RIGHT], told[CHANGES]
    found[11] = 1.0 if gone or is_off(scene, y) else told[USED]
    around = scene.walls + scene.straps > 0 or scene.edge != 0.0
    leans = how == STANDING and not gone and abs(y[TURN]) > LEANS
    found[12] = 1.0 if leans and around else 0.0
    found[13] = 1.0 if gone else 0.0
    found[14] = told[LEFT_AT] if gone else math.nan
    for j in range(15, 19):
        found[j] = math.nan
    if landed:
        found[15], found[16] = time, y[X]
        found[17] = math.sqrt(y[V_X] * y[V_X] + y[V_Y] * y[V_Y])
        found[18] = y[TURN]
    found[19] = told[FALLBACKS]
    for k in range(scene.straps):
        found[SUMMARY + 2 * k] = room.strap[k, MOST_FORCE]
        found[SUMMARY + 2 * k + 1] = room.strap[k, BROKE]


@driver
def move_surrounded(
    scenes: Scenes,
    rooms: Scenes,
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
        rooms: room for one run.
        shaking: the motion.
        polarity: of each, (n,).
        rotation: at which they are let go [rad].
        as_is: whether they begin in the state that the room holds, which may be any above the
            support, rather than so.
        trace: room for the history of the last one, which may have no samples.
        found: room for what was found, (n, SUMMARY + 2 straps).
    """
    for k in range(scenes.shape[0]):
        if not as_is:
            stand(scenes[k], rooms[0], rotation)
        run(scenes[k], rooms[0], shaking, polarity[k], trace, found[k])
