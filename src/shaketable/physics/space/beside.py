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
from shaketable.physics.space.holding import hold_touches
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
from shaketable.physics.space.walled import put_back_at_walls, write_mode
from shaketable.physics.space.workspace import (
    MAY_PRESS,
    PRESSES,
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
SINKS = 1e-10  # m/s: a touch may be left with less speed into its surface
NEARLY_HELD = 1e-2  # m/s²: what is held all but this may be held
HOLD_SWEEPS = 80  # to see whether it is
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
    past = work.judged.past
    choose_on_support(shape, work, f)
    if try_letting_walls_be(shape, work, f):
        return
    work.judged.past = past
    for j in range(STATE):
        work.state[j] = work.kept_state[j]
    gather_touches(shape, work, within, shape.limits.leaving, 0.0)
    choose_together(shape, work, f)


@routine
def try_letting_walls_be(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Try whether no touch on a wall goes into it in the mode that is written."""
    y, dy = work.state, work.stages[0]
    rates(shape, work, y, f, False, dy)
    q, found = axes_at(y), True
    look_at_touches(shape, work, q, y)
    for place in range(work.mode.touches):
        if plane_of(work, place) > 0:
            a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
            speed = touch_velocity(work, q, y, place).z
            found = found and a.z >= -SLACK and speed >= -shape.limits.slipping
    return found


@routine
def choose_together(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Let all touches decide together, and begin the mode beside a wall that follows.

    First it is tried whether they go on as they move.
    """
    q = axes_at(work.state)
    face_wall(shape, work, q)
    note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
    stop_slow(shape, work, q)
    note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
    for place in range(work.mode.touches):
        work.touches[place].carries = PRESSES
    if try_letting_slip(shape, work, q, f):
        drop_leaving(shape, work, q)
        begin_beside(shape, work, f, still_at(shape, work, q))
        return
    note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
    if nothing_moves(shape, work, q) and try_holding(shape, work, q, f):
        begin_beside(shape, work, f, True)
        return
    for place in range(work.mode.touches):
        put(work.touches[place].share, 0, ZERO)
    sweeps, found = FIRST_SWEEPS, False
    for _ in range(ROUNDS if work.tally.fallbacks < MAX_UNCONVERGED else FEWER_ROUNDS):
        note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
        converged = push_together(shape, work, q, f, work.mode.touches, sweeps)
        found = try_found_forces(shape, work, q, f)
        if found or converged:
            break
        sweeps *= MORE_SWEEPS
    if not found:
        found = try_by_planes(shape, work, q, f)
    if not found:
        work.tally.fallbacks += 1
        jams = try_stopping_slips(shape, work, q)
        note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
        if not (jams and try_letting_slip(shape, work, q, f)):
            push_together(shape, work, q, f, work.mode.touches, FIRST_SWEEPS)
            try_found_forces(shape, work, q, f)
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
        found = found and max(math.hypot(u.x, u.y), abs(u.z)) <= shape.limits.slow
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
        work.touches[place].moves = 0
    left = hold_touches(shape, work, STARTS)
    if left <= STARTS or left > NEARLY_HELD:
        return bool(left <= STARTS)
    push_together(shape, work, q, f, work.mode.touches, HOLD_SWEEPS)  # from there, to be sure
    write_rates_of_all(shape, work, q, f)
    return is_small(shape, work.stages[0])


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
    """End what is left of slips that are none, and of speeds into surfaces.

    All that touches stays in its place meanwhile. Ended with what carries alone, others would be
    driven into their surface.
    """
    ends = False
    for place in range(work.mode.touches):
        touch, u = work.touches[place], touch_velocity(work, q, work.state, place)
        slips = math.sqrt(u.x * u.x + u.y * u.y) > shape.limits.slipping
        if touch.static == 0.0:  # it may slip as slowly as it does
            touch.moves = 1
        ends = ends or (slips and touch.moves == 0) or u.z < -SINKS
        touch.carries = PRESSES
    if ends:
        write_mode(shape, work, q)
        put_back_at_walls(shape, work, work.state)


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
        put(work.state, V, ZERO)
        put(work.state, W, ZERO)
