"""One step of a planar body among its surroundings, and the event in it."""

from __future__ import annotations

import math

from shaketable.compiled import routine
from shaketable.physics.dormand_prince import NODES, error_of, to_stage
from shaketable.physics.surrounded.guards import Guard, least_guard
from shaketable.physics.surrounded.modes import Force, force_at, put_back, rates
from shaketable.physics.surrounded.scene import STATE, Room, Scene

TOLERANCE = 1e-10  # of a step: of lengths [m], angles and velocities, times 1 + their size
LEAST_PART = 1e-12  # of an interval
SEARCHES = 100  # of an event
NARROW = 1e-13  # s: how far apart its ends are then
ON_GUARD = 1e-13  # m, m/s, m/s²: nor does a guard need to be nearer to zero
MOST_GUARD, EDGE = 1.0, 1e-3  # of what is infinite; how near to an end a secant may lead


@routine
def take_step(scene: Scene, room: Room, force: Force, h: float, u: float, du: float) -> float:
    """Write the state after the part du of an interval of h [s] to `trial`; the step's error.

    Dormand and Prince's 5(4); the first stage has to hold the rates at u. An error below 1 is
    accepted. The reactions at the end are left in `room.reaction`.
    """
    s, y, k, out = du * h, room.state, room.stages, room.trial
    for stage in range(1, 6):
        to_stage(STATE, stage, s, y, k, out)
        f_x, f_y = force_at(force, u + NODES[stage - 1] * du)
        rates(scene, room, out, f_x, f_y, k[stage])
    to_stage(STATE, 6, s, y, k, out)
    put_back(scene, room, out, False)
    f_x, f_y = force_at(force, u + du)
    rates(scene, room, out, f_x, f_y, k[6])
    worst = error_of(STATE, s, k, out) / TOLERANCE
    return worst if worst == worst else math.inf


@routine
def find_event(
    scene: Scene, room: Room, force: Force, h: float, u: float, du: float, end: Guard
) -> tuple[float, int]:
    """The part after which the least guard has fallen through zero, and which it was.

    By secants and bisections; `trial` is the state there.
    """
    low, high, at_high, kind = 0.0, du, end.least, end.kind
    f_x, f_y = force_at(force, u)
    rates(scene, room, room.state, f_x, f_y, room.stages[6])
    at_low = min(least_guard(scene, room, room.state).least, MOST_GUARD)
    for k in range(SEARCHES):
        if (high - low) * h <= NARROW or at_high > -ON_GUARD:
            break
        middle = 0.5 * (low + high)
        if k % 2 == 0 and at_low > 0.0 and at_high > -math.inf:
            middle = high - (high - low) * at_high / (at_high - at_low)
            middle = min(max(middle, low + EDGE * (high - low)), high - EDGE * (high - low))
        take_step(scene, room, force, h, u, middle)
        guard = least_guard(scene, room, room.trial)
        if not guard.least >= 0.0:  # nor if it is no number
            high, at_high, kind = middle, guard.least, guard.kind
        else:
            low, at_low = middle, min(guard.least, MOST_GUARD)
    take_step(scene, room, force, h, u, high)
    return high, kind
