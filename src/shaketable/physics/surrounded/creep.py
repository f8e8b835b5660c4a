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
    Scene,
    Workspace,
    X,
    Y,
)
from shaketable.physics.surrounded.straps import note_rest, pull_or_not, pull_straps
from shaketable.physics.surrounded.touches import gather, look_behind, place_of

GOES_ON, FELL, LANDED = range(3)  # how an interval ends
CREEP = 1e-4  # s: its steps


@routine
def creep(
    scene: Scene, work: Workspace, force: Force, h: float, u: float, impact_times: Floats
) -> int:
    """Step over what is left of an interval in which events pile up (Moreau and Jean).

    Impulses of each step stop what would close in it; what turning drives in is pushed out again.
    """
    work.tally[FALLBACKS] += 1.0
    steps = int(math.ceil((1.0 - u) * h / CREEP))  # noqa: RUF046  a float on a GPU
    du = (1.0 - u) / steps
    s, y = du * h, work.state
    for k in range(steps):
        at = u + (k + 0.5) * du
        f_x, f_y = force_at(force, at)
        work.tally[PASSED] = at * h
        pull_or_not(scene, work)
        note_rest(scene, work)
        pull_straps(scene, work, y)
        y[V_X] += s * (f_x + work.pull[0])
        y[V_Y] += s * (f_y + work.pull[1])
        y[SPIN] += s * work.pull[2] / scene.i2
        touches = gather(scene, work, 0.0, math.inf, s)
        for c in range(touches):
            number = int(work.touch[c, WHICH])
            work.goal[c] = -max(place_of(scene, y, number).gap, 0.0) / s
            if number >= ON_WALLS:
                work.tally[USED] = 1.0
            if number < ON_WALLS or number >= AT_LIP:
                work.tally[LEFT_AT] = work.tally[CLOCK] + work.tally[PASSED]
        put_free(work)
        first = 1 if y[V_X] > 0.0 else -1
        if first_that_fits(scene, work, touches, False, 1e-12, False, first) == NONE_FITS:
            stop_pressing(scene, work, touches)
        keep_after(work)
        y[X] += s * y[V_X]
        y[Y] += s * y[V_Y]
        y[TURN] += s * y[SPIN]
        push_out(scene, work)
        look_behind(scene, work)
        work.tally[PEAK] = max(work.tally[PEAK], abs(y[TURN]))
        note_place(scene, work)
        if not is_off(scene, y) and abs(y[TURN]) >= 0.5 * math.pi:
            work.tally[PEAK] = 0.5 * math.pi
            return FELL
        if is_off(scene, y) and lowest_vertex(scene, y) + scene.drop < 0.0:
            return LANDED
    f_x, f_y = force_at(force, 1.0)
    respond(scene, work, f_x, f_y, GAP, impact_times)
    return GOES_ON
