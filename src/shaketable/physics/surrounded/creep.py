"""The way out where events pile up: time stepping."""

from __future__ import annotations

import math

from shaketable.compiled import routine
from shaketable.physics.surrounded.admissible import NONE_FITS, first_that_fits
from shaketable.physics.surrounded.events import note_place, respond
from shaketable.physics.surrounded.guards import GAP, is_off, lowest_vertex
from shaketable.physics.surrounded.impacts import keep_after, put_free, stop_pressing
from shaketable.physics.surrounded.modes import Force, force_at, push_out
from shaketable.physics.surrounded.scene import (
    AT_LIP,
    CLOCK,
    FALLBACKS,
    LEFT_AT,
    ON_WALLS,
    PASSED,
    PEAK,
    SPIN,
    TURN,
    USED,
    V_X,
    V_Y,
    WHICH,
    Floats,
    Room,
    Scene,
    X,
    Y,
)
from shaketable.physics.surrounded.straps import note_rest, pull_or_not, pull_straps
from shaketable.physics.surrounded.touches import gather, look_behind, place_of

GOES_ON, FELL, LANDED = range(3)  # how an interval ends
CREEP = 1e-4  # s: its steps


@routine
def creep(scene: Scene, room: Room, force: Force, h: float, u: float, impact_times: Floats) -> int:
    """Step over what is left of an interval in which events pile up (Moreau and Jean).

    Impulses of each step stop what would close in it; what turning drives in is pushed out again.
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
        touches = gather(scene, room, 0.0, math.inf, s)
        for c in range(touches):
            number = int(room.touch[c, WHICH])
            room.goal[c] = -max(place_of(scene, y, number).gap, 0.0) / s
            if number >= ON_WALLS:
                room.told[USED] = 1.0
            if number < ON_WALLS or number >= AT_LIP:
                room.told[LEFT_AT] = room.told[CLOCK] + room.told[PASSED]
        put_free(room)
        first = 1 if y[V_X] > 0.0 else -1
        if first_that_fits(scene, room, touches, False, 1e-12, False, first) == NONE_FITS:
            stop_pressing(scene, room, touches)
        keep_after(room)
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
        if is_off(scene, y) and lowest_vertex(scene, y) + scene.drop < 0.0:
            return LANDED
    f_x, f_y = force_at(force, 1.0)
    respond(scene, room, f_x, f_y, GAP, impact_times)
    return GOES_ON
