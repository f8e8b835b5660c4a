"""A planar body among its surroundings across one interval of its motion, event by event."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.hermite import top_of
from shaketable.physics.surrounded.admissible import NONE_FITS, first_that_fits
from shaketable.physics.surrounded.guards import (
    FALL,
    FORCE,
    GAP,
    LANDING,
    Guard,
    dips,
    is_off,
    least_guard,
)
from shaketable.physics.surrounded.impacts import (
    bring_to_rest,
    collide,
    put_free,
    rock_with_losses,
    stop_pressing,
)
from shaketable.physics.surrounded.modes import (
    Force,
    choose,
    force_at,
    mode_size,
    push_out,
    put_back,
    rates,
    rests,
)
from shaketable.physics.surrounded.scene import (
    A_STICK,
    B_STICK,
    CLOCK,
    EVENTS,
    FALLBACKS,
    FARTHEST_LEFT,
    FARTHEST_RIGHT,
    IMPACTS,
    LEFT_AT,
    LIFT,
    ON_WALLS,
    PASSED,
    PAST,
    PEAK,
    SPIN,
    STATE,
    STEPS,
    STICK,
    TOUCH,
    TURN,
    U_N,
    V_X,
    V_Y,
    Floats,
    Room,
    Scene,
    X,
    Y,
)
from shaketable.physics.surrounded.straps import note_forces, note_rest, pull_or_not, pull_straps
from shaketable.physics.surrounded.touches import CLOSED, gather, look_behind, place_of

GOES_ON, FELL, LANDED = range(3)  # how an interval ends
TOLERANCE = 1e-10  # of a step: of lengths [m], angles and velocities, times 1 + their size
LEAST_PART = 1e-12  # of an interval
SAFETY, SHRINK, GROW = 0.8, 0.2, 5.0
SEARCHES = 60  # of an event
NARROW = 1e-13  # s: how far apart its ends are then
BUDGET = 200  # events in an interval, after which the rest of it is stepped over
CREEP = 2e-5  # s: steps of it
SETTLED_NEAR = 0.01  # m: what is farther is not struck in one of these
NEVER = 2.0
SHORT_DIP = 1e-5  # s: a contact that closes for less is not looked for


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

    By regula falsi (Illinois); `trial` is the state there.
    """
    low, high, at_low, at_high, kind = 0.0, du, 0.0, end.least, end.kind
    known = False
    for k in range(SEARCHES):
        if (high - low) * h <= NARROW or at_high > -1e-15:
            break
        middle = 0.5 * (low + high)
        if known and k % 3 != 2 and at_low > 0.0:
            middle = high - (high - low) * at_high / (at_high - at_low)
            middle = min(max(middle, low + 0.01 * (high - low)), high - 1e-3 * (high - low))
        take_step(scene, room, force, h, u, middle)
        guard = least_guard(scene, room, room.trial)
        if not guard.least >= 0.0:  # nor if it is no number
            high, at_high, kind = middle, guard.least, guard.kind
        else:
            low, at_low, known = middle, min(guard.least, 1.0), True
    take_step(scene, room, force, h, u, high)
    return high, kind


@routine
def accept(scene: Scene, room: Room, h: float) -> None:
    """Accept the trial state after h [s]; update the extremes."""
    told, before, after = room.told, room.state, room.trial
    if scene.straps > 0:
        note_forces(scene, room, h)
    for side in (1.0, -1.0):
        top = top_of(
            side * before[TURN], side * after[TURN], side * h * before[SPIN],
            side * h * after[SPIN],
        )  # fmt: skip
        told[PEAK] = max(told[PEAK], top)
    for j in range(STATE):
        room.state[j] = room.trial[j]
    look_behind(scene, room)
    note_place(scene, room)


@routine
def note_place(scene: Scene, room: Room) -> None:
    """Note how far corners on the support are from where they stood, and a clearance under both."""
    told, y = room.told, room.state
    right, left = place_of(scene, y, 0), place_of(scene, y, 1)
    for number in range(2):
        place = right if number == 0 else left
        if place.gap <= CLOSED:
            slip = y[X] + place.q_x - (scene.right if number == 0 else -scene.left)
            told[FARTHEST_LEFT] = min(told[FARTHEST_LEFT], slip)
            told[FARTHEST_RIGHT] = max(told[FARTHEST_RIGHT], slip)
    clearance = min(right.gap, left.gap)
    if clearance < math.inf and not is_off(scene, y):
        told[LIFT] = max(told[LIFT], clearance)


@routine
def respond(
    scene: Scene, room: Room, f_x: float, f_y: float, kind: int, impact_times: Floats
) -> None:
    """What follows an event: an impact where contacts have closed, and the next mode."""
    touched = on_support(scene, room)
    touches = gather(scene, room, CLOSED, math.inf)
    struck = collide(scene, room, touches)
    if struck:
        hit = int(room.told[IMPACTS]) - 1
        if hit < impact_times.size:
            impact_times[hit] = room.told[CLOCK] + room.told[PASSED]
        rock_with_losses(scene, room, touches)
    pull_or_not(scene, room)
    if struck and touches > 1 and settles(scene, room, touches, f_x, f_y):
        return
    choose(scene, room, f_x, f_y, kind == FORCE and not struck)
    if touched and not on_support(scene, room):
        room.told[LEFT_AT] = room.told[CLOCK] + room.told[PASSED]


@kernel
def on_support(scene: Scene, room: Room) -> bool:
    """Whether the mode is on the support or its edge."""
    found = False
    for e in range(mode_size(room)):
        number = room.mode[1 + e, 0]
        found = found or number < ON_WALLS or number >= ON_WALLS + 16
    return found


@routine
def settles(scene: Scene, room: Room, touches: int, f_x: float, f_y: float) -> bool:
    """Whether a body whose closed contacts all but stay is held on two of them; then it is."""
    for j in range(STATE):
        room.kept[j] = room.state[j]
    if bring_to_rest(scene, room, touches):
        choose(scene, room, f_x, f_y, False)
        if mode_size(room) > 1:
            return True
    for j in range(STATE):
        room.state[j] = room.kept[j]
    return False


@routine
def rest_until(scene: Scene, room: Room, force: Force, u: float) -> float:
    """The u at which the forces of a mode of rest leave their cones, or NEVER.

    They are linear in the body force, as straps pull alike all the while.
    """
    count, past, until = mode_size(room), room.told[PAST], NEVER
    f_x, f_y = force_at(force, u)
    rates(scene, room, room.state, f_x, f_y, room.stages[1])
    for j in range(3):
        room.stages[2, j] = room.reaction[j]
    f_x, f_y = force_at(force, 1.0)
    rates(scene, room, room.state, f_x, f_y, room.stages[1])
    at = 0
    for e in range(count):
        a, b = room.touch[e, A_STICK], room.touch[e, B_STICK]
        until = min(until, falls_at(room.stages[2, at], room.reaction[at], past, u))
        if room.mode[1 + e, 1] == STICK:
            for side in (1.0, -1.0):
                before = a * room.stages[2, at] - side * b * room.stages[2, at + 1]
                after = a * room.reaction[at] - side * b * room.reaction[at + 1]
                until = min(until, falls_at(before, after, past, u))
            at += 1
        at += 1
    return until


@kernel
def falls_at(before: float, after: float, past: float, u: float) -> float:
    """Where a number that is linear between u and 1 falls below -past."""
    if not after < -past:
        return NEVER
    if before <= -past:
        return u
    return u + (1.0 - u) * (before + past) / (before - after)


@routine
def cross_interval(
    scene: Scene, room: Room, force: Force, h: float, first: float, impact_times: Floats
) -> tuple[int, float]:
    """Take a body through an interval of h [s]; how it ends, and the part its last step took.

    Args:
        first: part of the interval that its first step tries.
        impact_times: where those of impacts are written [s], as many as fit.
    """
    u, part, fresh, events = 0.0, first, True, 0
    told = room.told
    told[PASSED] = 0.0
    while u < 1.0:
        if events > BUDGET:
            return creep(scene, room, force, h, u, impact_times), first
        if rests(room):
            pull_or_not(scene, room)
            note_rest(scene, room)
            u = rest_until(scene, room, force, u)
            if u >= 1.0:
                return GOES_ON, 1.0
            told[PASSED] = u * h
            f_x, f_y = force_at(force, u)
            choose(scene, room, f_x, f_y, True)
            events += 1
            told[EVENTS] += 1.0
            fresh, part = True, 1.0
            continue
        if fresh:
            f_x, f_y = force_at(force, u)
            rates(scene, room, room.state, f_x, f_y, room.stages[0])
            fresh = False
        du = max(min(part, 1.0 - u), LEAST_PART)
        error = take_step(scene, room, force, h, u, du)
        told[STEPS] += 1.0
        if error > 1.0 and du > LEAST_PART:
            part = next_part(du, error)
            continue
        if error == math.inf:
            return creep(scene, room, force, h, u, impact_times), first
        guard = least_guard(scene, room, room.trial)
        if guard.least < 0.0:
            du, kind = find_event(scene, room, force, h, u, du, guard)
            accept(scene, room, du * h)
            u += du
            told[PASSED] = u * h
            if kind == FALL:
                told[PEAK] = 0.5 * math.pi
                return FELL, part
            if kind == LANDING:
                return LANDED, part
            f_x, f_y = force_at(force, min(u, 1.0))
            respond(scene, room, f_x, f_y, kind, impact_times)
            events += 1
            told[EVENTS] += 1.0
            fresh, part = True, max(part, 1e-3)
            continue
        if du * h > SHORT_DIP and dips(scene, room, du * h):
            part = 0.5 * du
            continue
        accept(scene, room, du * h)
        part = max(part if du < part else 0.0, next_part(du, error))
        u = 1.0 if 1.0 - u - du < LEAST_PART else u + du
        told[PASSED] = u * h
        for j in range(STATE):
            room.stages[0, j] = room.stages[6, j]
    return GOES_ON, part


@routine
def creep(scene: Scene, room: Room, force: Force, h: float, u: float, impact_times: Floats) -> int:
    """Step over what is left of an interval in which events pile up (Moreau and Jean).

    Impulses of each step stop what would close in it; nothing is driven in.
    """
    room.told[FALLBACKS] += 1.0
    steps = int(math.ceil((1.0 - u) * h / CREEP))  # noqa: RUF046  a float on a GPU
    du = (1.0 - u) / steps
    s, y = du * h, room.state
    for k in range(steps):
        at = u + (k + 0.5) * du
        f_x, f_y = force_at(force, at)
        room.told[PASSED] = at * h
        pull_or_not(scene, room)
        note_rest(scene, room)
        pull_straps(scene, room, y)
        y[V_X] += s * (f_x + room.pull[0])
        y[V_Y] += s * (f_y + room.pull[1])
        y[SPIN] += s * room.pull[2] / scene.i2
        touches = gather(scene, room, SETTLED_NEAR, math.inf)
        kept = 0
        for c in range(touches):
            gap = place_of(scene, y, int(room.touch[c, 0])).gap
            if gap + s * room.touch[c, U_N] <= 0.0:
                for j in range(TOUCH):
                    room.touch[kept, j] = room.touch[c, j]
                room.goal[kept] = -max(gap, 0.0) / s
                kept += 1
        put_free(room)
        first = 1 if y[V_X] > 0.0 else -1
        if first_that_fits(scene, room, kept, False, 1e-12, False, first) == NONE_FITS:
            stop_pressing(scene, room, kept)
        y[V_X], y[V_Y], y[SPIN] = room.after[0], room.after[1], room.after[2]
        y[X] += s * y[V_X]
        y[Y] += s * y[V_Y]
        y[TURN] += s * y[SPIN]
        push_out(scene, room)
        look_behind(scene, room)
        room.told[PEAK] = max(room.told[PEAK], abs(y[TURN]))
        note_place(scene, room)
        if not is_off(scene, y) and abs(y[TURN]) >= 0.5 * math.pi:
            room.told[PEAK] = 0.5 * math.pi
            return FELL
    f_x, f_y = force_at(force, 1.0)
    respond(scene, room, f_x, f_y, GAP, impact_times)
    return GOES_ON
