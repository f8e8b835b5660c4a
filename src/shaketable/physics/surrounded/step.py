"""One step of a planar body among its surroundings, and the event in it."""

from __future__ import annotations

import math

from shaketable.compiled import routine
from shaketable.physics.dormand_prince import NODES, error_of, to_stage
from shaketable.physics.surrounded.guards import GAP, OF_GAPS, OF_MODE, Guard, least_guard
from shaketable.physics.surrounded.modes import Force, force_at, put_back, rates
from shaketable.physics.surrounded.scene import STATE, Scene, Workspace
from shaketable.physics.surrounded.touches import closing, place_of

TOLERANCE = 1e-10  # of a step: of lengths [m], angles and velocities, times 1 + their size
LEAST_PART = 1e-12  # of an interval
SEARCHES = 100  # of an event
NARROW = 1e-13  # s: how far apart its ends are then
ON_GUARD = 1e-13  # m, m/s, m/s²: nor does a guard need to be nearer to zero
EDGE = 1e-7  # of what is left: how near to an end of it a secant may lead


@routine
def take_step(scene: Scene, work: Workspace, force: Force, h: float, u: float, du: float) -> float:
    """Write the state after the part du of an interval of h [s] to `trial`; the step's error.

    Dormand and Prince's 5(4); the first stage has to hold the rates at u. An error below 1 is
    accepted. The reactions at the end are left in `work.reaction`.
    """
    s, y, k, out = du * h, work.state, work.stages, work.trial
    for stage in range(1, 6):
        to_stage(STATE, stage, s, y, k, out)
        f_x, f_y = force_at(force, u + NODES[stage - 1] * du)
        rates(scene, work, out, f_x, f_y, k[stage])
    to_stage(STATE, 6, s, y, k, out)
    put_back(scene, work, out, False)
    f_x, f_y = force_at(force, u + du)
    rates(scene, work, out, f_x, f_y, k[6])
    worst = error_of(STATE, s, k, out) / TOLERANCE
    return worst if worst == worst else math.inf


@routine
def newton(scene: Scene, work: Workspace, at: float, h: float, value: float, which: int) -> float:
    """Where the gap with this number closes, from its value and rate on trial, `at` a part of h.

    NaN of any other guard.
    """
    if not OF_GAPS <= which < OF_MODE:
        return math.nan
    place = place_of(scene, work.trial, which - OF_GAPS)
    return at - (value + 0.5 * ON_GUARD) / (closing(work.trial, place) * h)  # just beyond


@routine
def find_event(
    scene: Scene, work: Workspace, force: Force, h: float, u: float, du: float, end: Guard
) -> tuple[float, int]:
    """The part after which the least guard has fallen through zero, and which it was.

    By Newton's method for a gap, else by secants of that guard, and bisections; `trial` is the
    state there.
    """
    low, high, at_high, kind, which = 0.0, du, end.least, end.kind, end.which
    f_x, f_y = force_at(force, u)
    rates(scene, work, work.state, f_x, f_y, work.stages[6])
    at_low, bisects = least_guard(scene, work, work.state, which).of_one, False
    if at_low < 0.0 and kind != GAP:  # no other mode was found: it ends at once
        high = min(high, LEAST_PART)
    ahead = newton(scene, work, high, h, at_high, which)
    for _ in range(SEARCHES):
        width = high - low
        if width * h <= NARROW or at_high > -ON_GUARD:
            break
        middle = low + 0.5 * width
        if not bisects and low < ahead < high:
            middle = ahead
        elif not bisects and 0.0 < at_low < math.inf and at_high > -math.inf:
            middle = high - width * (at_high + 0.5 * ON_GUARD) / (at_high - at_low)  # just beyond
            middle = min(max(middle, low + EDGE * width), high - EDGE * width)
        take_step(scene, work, force, h, u, middle)
        guard = least_guard(scene, work, work.trial, which)
        if not guard.least >= 0.0:  # nor if it is no number
            if guard.which != which:  # another one falls before it: of that nothing is known at low
                at_low = math.inf
            high, at_high, kind, which = middle, guard.least, guard.kind, guard.which
            ahead = newton(scene, work, middle, h, at_high, which)
        else:
            low, at_low = middle, guard.of_one
            ahead = newton(scene, work, middle, h, at_low, which)
        bisects = high - low > 0.5 * width and not low < ahead < high
    take_step(scene, work, force, h, u, high)
    return high, kind
