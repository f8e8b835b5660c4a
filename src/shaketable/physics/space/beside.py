"""Which mode follows where walls, or the edge of the support, may be touched.

What walls do not press is left to the support alone: that mode is tried first, and holds where no
point that touches a wall would go into it. Else, and at an edge, all touches decide together: as
they move, letting those slip that need more friction; held at rest by some reactions; by the
reactions that a search finds; plane by plane. Where friction allows both rest and motion a body
rests.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.choice import choose_on_support
from shaketable.physics.space.closing import close_carrying
from shaketable.physics.space.complementarity import (
    MAX_UNCONVERGED,
    push_together,
    write_free,
)
from shaketable.physics.space.constraints import free_turning
from shaketable.physics.space.contacts import axes_at, lies_on_rim
from shaketable.physics.space.edge import has_edge
from shaketable.physics.space.holding import try_holding_touches
from shaketable.physics.space.modes import lay_ring, stand_on_rim
from shaketable.physics.space.rates import rates
from shaketable.physics.space.straps import with_straps
from shaketable.physics.space.touches import (
    drop_touch,
    frame_of,
    gather_touches,
    is_at_edge,
    look_at_touches,
    note_moving,
    plane_of,
    point_of,
    touch_acceleration,
    touch_gap,
    touch_velocity,
    touches_more,
)
from shaketable.physics.space.tries import (
    SLACK,
    STARTS,
    let_slip,
    try_by_planes,
    try_letting_slip,
)
from shaketable.physics.space.vectors import ZERO, Axes, Vec, add, on_support, times
from shaketable.physics.space.walled import (
    MAY_PRESS,
    PRESSES,
    put_back_at_walls,
    write_mode,
)
from shaketable.physics.space.workspace import (
    SLIPS,
    STATE,
    STICKS,
    WALLED,
    Floats,
    P,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)

JAMS = 10.0  # of `turning`: a slip that has nowhere to go is ended if it is not faster
# Of the search for reactions, and by what they grow; once it often finds none, fewer rounds.
FIRST_SWEEPS, MORE_SWEEPS, ROUNDS, FEWER_ROUNDS = 20, 4, 3, 1


@routine
def choose(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Find and begin the mode that follows, for the points on the support (`near`) and walls."""
    within = shape.limits.landing
    if not touches_more(shape) or (
        gather_touches(shape, work, within, shape.limits.leaving, 0.0) == 0
    ):
        choose_on_support(shape, work, f)
        return
    if is_at_edge(shape, work):  # the support alone is not what its base could stand on
        choose_together(shape, work, f)
        return
    for j in range(STATE):
        work.kept_state[j] = work.state[j]
    choose_on_support(shape, work, f)
    if try_letting_walls_be(shape, work, f):
        return
    for j in range(STATE):
        work.state[j] = work.kept_state[j]
    gather_touches(shape, work, within, shape.limits.leaving, 0.0)
    choose_together(shape, work, f)


@routine
def try_letting_walls_be(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Try whether no touch on a wall is accelerated into it in the mode that is written."""
    y, dy = work.state, work.stages[0]
    rates(shape, work, y, f, False, dy)
    q, found = axes_at(y), True
    look_at_touches(shape, work, q, y)
    for place in range(work.mode.touches):
        if plane_of(work, place) > 0:
            a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
            found = found and a.z >= -SLACK
    return found


@routine
def choose_together(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Let all touches decide together, and begin the mode beside a wall that follows.

    First it is tried whether they go on as they move.
    """
    q = axes_at(work.state)
    face_wall(shape, work, q)
    note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
    for place in range(work.mode.touches):
        work.touches[place].carries = PRESSES
    if try_letting_slip(shape, work, q, f):
        stop_slow(shape, work, q)
        drop_leaving(shape, work, q)
        begin_beside(shape, work, f, still_at(shape, work, q))
        return
    note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
    if nothing_moves(shape, work, q) and try_holding(shape, work, q, f):
        stop_slow(shape, work, q)
        begin_beside(shape, work, f, True)
        return
    for place in range(work.mode.touches):
        put(work.touches[place].share, 0, ZERO)
    sweeps, found = FIRST_SWEEPS, False
    for _ in range(ROUNDS if work.tally.fallbacks < MAX_UNCONVERGED else FEWER_ROUNDS):
        converged = push_together(shape, work, q, f, work.mode.touches, sweeps)
        found = try_found_forces(shape, work, q, f)
        if found or converged:
            break
        sweeps *= MORE_SWEEPS
    if not found:
        found = try_by_planes(shape, work, q, f)
    if not found:
        work.tally.fallbacks += 1.0
        if try_stopping_slips(shape, work, q):
            note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
            found = try_letting_slip(shape, work, q, f)
            if not found:
                push_together(shape, work, q, f, work.mode.touches, FIRST_SWEEPS)
                try_found_forces(shape, work, q, f)
    stop_slow(shape, work, q)
    drop_leaving(shape, work, q)
    walls = 0
    for place in range(work.mode.touches):
        walls += plane_of(work, place) > 0
    if walls == 0:
        tip_on_rim(shape, work)
        choose_on_support(shape, work, f)
        return
    begin_beside(shape, work, f, still_at(shape, work, q))


@routine
def face_wall(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Turn the ring of points on which a circle lies flat so that one is toward a wall it touches.

    There, and opposite, it tips.
    """
    if not lies_on_rim(shape) or work.mode.near < shape.hull:
        return
    for place in range(work.mode.touches):
        if plane_of(work, place) > 0:
            n = frame_of(work, place).z
            size = math.sqrt(n.x * n.x + n.y * n.y)
            if size > 0.0:
                work.rim.x, work.rim.y = n.x / size, n.y / size
                lay_ring(shape, work)
                look_at_touches(shape, work, q, work.state)
            return


@routine
def try_found_forces(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Write the mode that the reactions found by `push_together` tell; whether it is admissible.

    The reactions are left as they were.
    """
    n = work.mode.touches
    write_rates_of_all(shape, work, q, f)
    note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
    let_slip(shape, work, q)
    for place in range(n):
        touch = work.touches[place]
        touch.carries = PRESSES if touch.share[2] > SLACK else MAY_PRESS
        put(touch.found, 0, vec(touch.share, 0))
    if still_at(shape, work, q):  # these reactions hold it
        return True
    found = try_letting_slip(shape, work, q, f)
    for place in range(n):
        put(work.touches[place].share, 0, vec(work.touches[place].found, 0))
    return found


@routine
def try_stopping_slips(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """End all slips at once, by impulses, if they are slow; whether they were.

    Where friction leaves no reaction with which they go on (Painlevé's paradox), a body jams.
    """
    fastest = 0.0
    for place in range(work.mode.touches):
        u = touch_velocity(work, q, work.state, place)
        fastest = max(fastest, math.sqrt(u.x * u.x + u.y * u.y))
    if fastest > JAMS * shape.limits.turning:
        return False
    for place in range(work.mode.touches):
        work.touches[place].moves = 0
        work.touches[place].carries = MAY_PRESS
    write_mode(shape, work, q)
    put_back_at_walls(shape, work, work.state)
    for place in range(work.mode.touches):
        work.touches[place].carries = MAY_PRESS
    return True


@routine
def still_at(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """Whether nothing moves that touches, nor is anything accelerated by the rates found last."""
    return nothing_moves(shape, work, q) and is_small(shape, work.stages[0])


@routine
def nothing_moves(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """Whether a body stands still where it touches, and does not turn."""
    found = True
    for place in range(work.mode.touches):
        u = touch_velocity(work, q, work.state, place)
        found = found and work.touches[place].moves == 0 and abs(u.z) <= shape.limits.slow
    spin = vec(work.state, W)
    most = max(abs(spin.x), abs(spin.y), abs(spin.z))
    return bool(found and shape.reach * most <= shape.limits.slow)


@routine
def try_holding(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Try whether some reactions of all touches hold a body under a force, as where it is wedged.

    They all carry then.
    """
    write_free(shape, work, q, f)
    for place in range(work.mode.touches):
        work.touches[place].carries = PRESSES
    return try_holding_touches(shape, work, STARTS)


@kernel
def is_small(shape: SolidParameters, dy: Floats) -> bool:
    """Whether accelerations are as good as none."""
    linear = max(abs(dy[V]), abs(dy[V + 1]), abs(dy[V + 2]))
    turns = shape.reach * max(abs(dy[W]), abs(dy[W + 1]), abs(dy[W + 2]))
    return bool(max(linear, turns) <= STARTS)


@routine
def write_rates_of_all(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> None:
    """Write the accelerations with the reactions that `push_together` has found to `stages`."""
    linear = add(with_straps(shape, work, f), on_support(q, vec(work.change, 0)))
    turn = add(free_turning(shape, work, vec(work.state, W)), vec(work.change, 3))
    put(work.stages[0], V, linear)
    put(work.stages[0], W, turn)


@routine
def stop_slow(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """End what is left of a slip where one sticks, with all that touches in its place.

    Ended with what carries alone, it might drive others into their surface.
    """
    slips = False
    for place in range(work.mode.touches):
        u = touch_velocity(work, q, work.state, place)
        fast = math.sqrt(u.x * u.x + u.y * u.y) > shape.limits.slipping
        slips = slips or (fast and work.touches[place].moves == 0)
    if not slips:
        return
    for place in range(work.mode.touches):
        work.touches[place].carried = work.touches[place].carries
        work.touches[place].carries = PRESSES
    write_mode(shape, work, q)
    put_back_at_walls(shape, work, work.state)
    for place in range(work.mode.touches):
        work.touches[place].carries = work.touches[place].carried


@routine
def drop_leaving(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Drop the touches that carry nothing and leave at the rates found last; put them outside."""
    y, dy, place = work.state, work.stages[0], 0
    while place < work.mode.touches:
        a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
        if a.z > STARTS and work.touches[place].carries != PRESSES:
            gap = touch_gap(shape, work, q, y, place)
            if gap < 0.0:  # what leaves from there would meet it again at once
                out = on_support(q, frame_of(work, place).z)
                put(y, P, add(vec(y, P), times(-gap, out)))
            drop_touch(work, place)
        else:
            place += 1


@routine
def tip_on_rim(shape: SolidParameters, work: Workspace) -> None:
    """Let a circle that has left a part of its ring stand on its rim there."""
    ring, x, y = 0, 0.0, 0.0
    for place in range(work.mode.touches):
        point = point_of(work, place)
        if plane_of(work, place) == 0 and point < shape.contacts:
            ring += 1
            x, y = x + work.points[point].x, y + work.points[point].y
    size = math.sqrt(x * x + y * y)
    lies = shape.contacts  # where it lies flat, less what is past the edge of the support
    for point in range(shape.contacts if has_edge(shape) else 0):
        lies -= work.past[point]
    tips = lies_on_rim(shape) and 0 < ring < lies and size > 1e-6 * shape.radius * ring
    if tips:
        place = 0
        while place < work.mode.touches:
            if plane_of(work, place) == 0:
                drop_touch(work, place)
            else:
                place += 1
        stand_on_rim(shape, work, x / size, y / size)
        work.touches[work.mode.touches - 1].carries = MAY_PRESS
        work.mode.near = 1 if work.mode.touches == 1 else 0
        q = axes_at(work.state)
        look_at_touches(shape, work, q, work.state)
        note_moving(shape, work, q, work.mode.touches, shape.limits.slipping)


@routine
def begin_beside(shape: SolidParameters, work: Workspace, f: Vec, still: bool) -> None:
    """Begin the mode of the touches: put the state on them, at rest if nothing moves it.

    Args:
        still: whether the reactions that were found hold it, if the rows alone do not.
    """
    tip_on_rim(shape, work)
    write_mode(shape, work, axes_at(work.state))
    close_carrying(shape, work)
    work.mode.kind, work.mode.grip = WALLED, SLIPS
    put_back_at_walls(shape, work, work.state)
    q = axes_at(work.state)
    if not still:
        rates(shape, work, work.state, f, True, work.stages[0])
        holds = work.judged.press >= -SLACK and work.judged.cone >= -SLACK
        still = holds and still_at(shape, work, q)
    if still:
        work.mode.grip = STICKS
        for j in range(V, STATE):
            work.state[j] = 0.0
