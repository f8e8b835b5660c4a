"""One step of a planar body among its surroundings, and the event in it."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.surrounded.guards import Guard, least_guard
from shaketable.physics.surrounded.modes import Force, force_at, put_back, rates
from shaketable.physics.surrounded.scene import STATE, Room, Scene

TOLERANCE = 1e-10  # of a step: of lengths [m], angles and velocities, times 1 + their size
LEAST_PART = 1e-12  # of an interval
SAFETY, SHRINK, GROW = 0.8, 0.2, 5.0
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
    for j in range(STATE):
        out[j] = y[j] + s * (0.2 * k[0, j])
    f_x, f_y = force_at(force, u + 0.2 * du)
    rates(scene, room, out, f_x, f_y, k[1])
    for j in range(STATE):
        out[j] = y[j] + s * (3.0 / 40.0 * k[0, j] + 9.0 / 40.0 * k[1, j])
    f_x, f_y = force_at(force, u + 0.3 * du)
    rates(scene, room, out, f_x, f_y, k[2])
    for j in range(STATE):
        out[j] = y[j] + s * (44.0 / 45.0 * k[0, j] - 56.0 / 15.0 * k[1, j] + 32.0 / 9.0 * k[2, j])
    f_x, f_y = force_at(force, u + 0.8 * du)
    rates(scene, room, out, f_x, f_y, k[3])
    for j in range(STATE):
        out[j] = y[j] + s * (
            19372.0 / 6561.0 * k[0, j]
            - 25360.0 / 2187.0 * k[1, j]
            + 64448.0 / 6561.0 * k[2, j]
            - 212.0 / 729.0 * k[3, j]
        )
    f_x, f_y = force_at(force, u + 8.0 / 9.0 * du)
    rates(scene, room, out, f_x, f_y, k[4])
    for j in range(STATE):
        out[j] = y[j] + s * (
            9017.0 / 3168.0 * k[0, j]
            - 355.0 / 33.0 * k[1, j]
            + 46732.0 / 5247.0 * k[2, j]
            + 49.0 / 176.0 * k[3, j]
            - 5103.0 / 18656.0 * k[4, j]
        )
    f_x, f_y = force_at(force, u + du)
    rates(scene, room, out, f_x, f_y, k[5])
    for j in range(STATE):
        out[j] = y[j] + s * (
            35.0 / 384.0 * k[0, j]
            + 500.0 / 1113.0 * k[2, j]
            + 125.0 / 192.0 * k[3, j]
            - 2187.0 / 6784.0 * k[4, j]
            + 11.0 / 84.0 * k[5, j]
        )
    put_back(scene, room, out, False)
    rates(scene, room, out, f_x, f_y, k[6])
    worst = 0.0
    for j in range(STATE):
        error = s * (
            71.0 / 57600.0 * k[0, j]
            - 71.0 / 16695.0 * k[2, j]
            + 71.0 / 1920.0 * k[3, j]
            - 17253.0 / 339200.0 * k[4, j]
            + 22.0 / 525.0 * k[5, j]
            - 1.0 / 40.0 * k[6, j]
        )
        worst = max(worst, abs(error) / (1.0 + abs(out[j])))
    worst /= TOLERANCE
    return worst if worst == worst else math.inf


@kernel
def next_part(du: float, error: float) -> float:
    """The part of an interval to try after a step with this error."""
    if error <= 0.0:
        return GROW * du
    if error == math.inf:
        return SHRINK * du
    return du * min(GROW, max(SHRINK, SAFETY * float(error**-0.2)))


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
