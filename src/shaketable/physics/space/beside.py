"""Which mode follows where walls may be touched.

What walls do not press is left to the support alone: that mode is tried first, and holds where no
point that touches a wall would go into it. Else all touches decide together. Where friction allows
both rest and motion a body rests.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space import choice
from shaketable.physics.space.complementarity import MAX_UNCONVERGED
from shaketable.physics.space.constraints import free_turning
from shaketable.physics.space.contacts import axes_at, lies_on_rim
from shaketable.physics.space.losses import resistance
from shaketable.physics.space.modes import lay_ring, stand_on_rim
from shaketable.physics.space.rates import rates
from shaketable.physics.space.straps import with_straps
from shaketable.physics.space.together import balance_touches
from shaketable.physics.space.touches import (
    add_touch,
    drop_touch,
    frame_of,
    gather_touches,
    look_at_touches,
    note_moving,
    plane_of,
    point_of,
    touch_acceleration,
    touch_velocity,
)
from shaketable.physics.space.vectors import ZERO, Axes, Vec, add, on_support
from shaketable.physics.space.walled import (
    FOLLOWS,
    MAY_PRESS,
    PRESSES,
    PULLS,
    put_back_at_walls,
    write_mode,
)
from shaketable.physics.space.workspace import (
    CARRIES,
    CLOSED,
    CONE,
    CONTACT_KIND,
    FALLBACKS,
    FRICTION_STATE,
    KINETIC_AT,
    MOVES,
    NEAR,
    PRESS,
    SLIP_DIRECTION,
    SLIPS,
    STATE,
    STATIC_AT,
    STICKS,
    TOUCHES,
    WALLED,
    Floats,
    SolidParameters,
    V,
    W,
    Workspace,
    X,
    Y,
    put,
    vec,
)

SLACK = 1e-9  # m/s²: a touch may be accelerated into its plane by this much
AT_EDGE = 1e-6  # of the friction: a touch whose reaction is further inside its cone sticks
STARTS = 1e-6  # m/s²: what is accelerated by less neither slips, nor leaves, nor ends its rest
MOST_TRIES = 8  # to find which touches carry, and which slip
JAMS = 10.0  # of `turning`: a slip that has nowhere to go is ended if it is not faster
# Of the search for reactions, and by what they grow; once it often finds none, fewer rounds.
FIRST_SWEEPS, MORE_SWEEPS, ROUNDS, FEWER_ROUNDS = 20, 4, 3, 1


@routine
def choose(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Find and begin the mode that follows, for the points on the support (`near`) and walls."""
    within, near = shape.limits.landing, work.mode[NEAR]
    if shape.walls == 0 or gather_touches(shape, work, within, shape.limits.leaving, 0.0) == 0:
        choice.choose(shape, work, f)
        return
    for j in range(STATE):
        work.kept_state[j] = work.state[j]
    choice.choose(shape, work, f)
    if lets_walls_be(shape, work, f):
        return
    for j in range(STATE):
        work.state[j] = work.kept_state[j]
    work.mode[NEAR] = near
    gather_touches(shape, work, within, shape.limits.leaving, 0.0)
    choose_together(shape, work, f)


@routine
def lets_walls_be(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Whether no touch on a wall is accelerated into it in the mode that is written."""
    y, dy = work.state, work.stages[0]
    rates(shape, work, y, f, False, dy)
    q, found = axes_at(y), True
    look_at_touches(shape, work, q, y)
    for place in range(work.mode[TOUCHES]):
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
    note_moving(shape, work, q, shape.limits.slow)
    for place in range(work.mode[TOUCHES]):
        work.touches[place, CARRIES] = MAY_PRESS
    if lets_go(shape, work, q, f):
        drop_leaving(shape, work, q)
        begin_beside(shape, work, f, still_at(shape, work, q))
        return
    for place in range(work.mode[TOUCHES]):
        put(work.shares[place], 0, ZERO)
    sweeps, found = FIRST_SWEEPS, False
    for _ in range(ROUNDS if work.tally[FALLBACKS] < MAX_UNCONVERGED else FEWER_ROUNDS):
        converged = push_together(shape, work, q, f, sweeps)
        found = follows(shape, work, q, f)
        if found or converged:
            break
        sweeps *= MORE_SWEEPS
    if not found:
        work.tally[FALLBACKS] += 1.0
        if stops_slipping(shape, work, q):
            note_moving(shape, work, q, shape.limits.slow)
            found = lets_go(shape, work, q, f)
            if not found:
                push_together(shape, work, q, f, FIRST_SWEEPS)
                follows(shape, work, q, f)
    drop_leaving(shape, work, q)
    walls = 0
    for place in range(work.mode[TOUCHES]):
        walls += plane_of(work, place) > 0
    if walls == 0:
        note_support(shape, work)
        choice.choose(shape, work, f)
        return
    begin_beside(shape, work, f, still_at(shape, work, q))


@routine
def face_wall(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Turn the ring of points on which a circle lies flat so that one is toward a wall it touches.

    There, and opposite, it tips.
    """
    if not lies_on_rim(shape) or work.mode[NEAR] < shape.hull:
        return
    for place in range(work.mode[TOUCHES]):
        if plane_of(work, place) > 0:
            n = frame_of(work, place).z
            size = math.sqrt(n.x * n.x + n.y * n.y)
            if size > 0.0:
                work.rim[0], work.rim[1] = n.x / size, n.y / size
                lay_ring(shape, work)
                look_at_touches(shape, work, q, work.state)
            return


@routine
def follows(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Write the mode that the reactions found by `push_together` tell; whether it is admissible.

    The reactions are left as they were.
    """
    n = work.mode[TOUCHES]
    write_rates_of_all(shape, work, q, f)
    note_moving(shape, work, q, shape.limits.slow)
    let_slip(shape, work, q)
    for place in range(n):
        work.touches[place, CARRIES] = PRESSES if work.shares[place, 2] > SLACK else MAY_PRESS
        put(work.effects[place], 0, vec(work.shares[place], 0))
    if still_at(shape, work, q):  # these reactions hold it
        return True
    found = lets_go(shape, work, q, f)
    for place in range(n):
        put(work.shares[place], 0, vec(work.effects[place], 0))
    return found


@routine
def stops_slipping(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """End all slips at once, by impulses, if they are slow; whether they were.

    Where friction leaves no reaction with which they go on (Painlevé's paradox), a body jams.
    """
    fastest = 0.0
    for place in range(work.mode[TOUCHES]):
        u = touch_velocity(work, q, work.state, place)
        fastest = max(fastest, math.sqrt(u.x * u.x + u.y * u.y))
    if fastest > JAMS * shape.limits.turning:
        return False
    for place in range(work.mode[TOUCHES]):
        work.touches[place, MOVES] = 0.0
        work.touches[place, CARRIES] = MAY_PRESS
    write_mode(shape, work, q)
    put_back_at_walls(shape, work, work.state)
    for place in range(work.mode[TOUCHES]):
        work.touches[place, CARRIES] = MAY_PRESS
    return True


@routine
def lets_go(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Whether all touches go on, those beginning to slip that would need more friction to hold.

    They slip against the friction that would hold them. Writes that mode.
    """
    for _ in range(min(work.mode[TOUCHES], MOST_TRIES) + 1):
        if goes_on(shape, work, q, f):
            return True
        if work.judged[PRESS] < -SLACK or work.judged[CONE] >= -SLACK:
            break
        for place in range(work.mode[TOUCHES]):
            touch, share = work.touches[place], work.shares[place]
            pull = math.sqrt(share[0] * share[0] + share[1] * share[1])
            if touch[CARRIES] > 0.0 and touch[MOVES] == 0.0 and pull > touch[STATIC_AT] * share[2]:
                begin_slip(shape, work, q, place)
            touch[CARRIES] = MAY_PRESS
    return False


@routine
def begin_slip(shape: SolidParameters, work: Workspace, q: Axes, place: int) -> None:
    """Let a touch slip: as it moves, or if it does not, against the friction that would hold it.

    Without such friction it goes where it is accelerated.
    """
    touch, share = work.touches[place], work.shares[place]
    u = touch_velocity(work, q, work.state, place)
    x, y = u.x, u.y
    if math.sqrt(x * x + y * y) <= shape.limits.slipping:
        x, y = -share[0], -share[1]
        if x == 0.0 and y == 0.0:
            dy = work.stages[0]
            a = touch_acceleration(work, q, work.state, vec(dy, V), vec(dy, W), place)
            x, y = a.x, a.y
    size = math.sqrt(x * x + y * y)
    touch[MOVES] = 1.0
    touch[SLIP_DIRECTION], touch[SLIP_DIRECTION + 1] = x / size, y / size


@routine
def goes_on(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Whether all touches press, hold and let none sink, slipping as is noted; writes that mode."""
    y, dy = work.state, work.stages[0]
    work.mode[CONTACT_KIND], work.mode[FRICTION_STATE] = WALLED, SLIPS
    for _ in range(min(work.mode[TOUCHES], MOST_TRIES)):
        write_mode(shape, work, q)
        rates(shape, work, y, f, True, dy)
        if work.judged[PRESS] >= -SLACK or not drop_pull(work):
            break
    found = work.judged[PRESS] >= -SLACK and work.judged[CONE] >= -SLACK
    for place in range(work.mode[TOUCHES]):
        a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
        found = found and a.z >= -SLACK
        touch, u = work.touches[place], touch_velocity(work, q, y, place)
        if touch[MOVES] > 0.0 and math.sqrt(u.x * u.x + u.y * u.y) <= shape.limits.slipping:
            along = a.x * touch[SLIP_DIRECTION] + a.y * touch[SLIP_DIRECTION + 1]
            found = found and along >= -choice.BACKWARD_SLIP_TOLERANCE
    return bool(found)


@routine
def still_at(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """Whether nothing moves that touches, nor is anything accelerated by the rates found last."""
    dy, found = work.stages[0], True
    for place in range(work.mode[TOUCHES]):
        u = touch_velocity(work, q, work.state, place)
        found = found and work.touches[place, MOVES] == 0.0 and abs(u.z) <= shape.limits.slow
    spin = vec(work.state, W)
    most = max(abs(spin.x), abs(spin.y), abs(spin.z))
    return bool(found and shape.reach * most <= shape.limits.slow and is_small(shape, dy))


@kernel
def is_small(shape: SolidParameters, dy: Floats) -> bool:
    """Whether accelerations are as good as none."""
    linear = max(abs(dy[V]), abs(dy[V + 1]), abs(dy[V + 2]))
    turns = shape.reach * max(abs(dy[W]), abs(dy[W + 1]), abs(dy[W + 2]))
    return bool(max(linear, turns) <= STARTS)


@routine
def write_rates_of_all(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> None:
    """Write the accelerations with the reactions that `push_together` has found to `stages`."""
    linear = add(with_straps(shape, work, f), on_support(q, vec(work.solved, 0)))
    turn = add(free_turning(shape, work, vec(work.state, W)), vec(work.solved, 3))
    put(work.stages[0], V, linear)
    put(work.stages[0], W, turn)


@routine
def push_together(shape: SolidParameters, work: Workspace, q: Axes, f: Vec, sweeps: int) -> bool:
    """Find the forces of all touches in so many sweeps; they begin with what they were."""
    write_free(shape, work, q, f)
    resists = resistance(shape, q, vec(work.state, W))
    return balance_touches(shape, work, True, resists, sweeps)


@routine
def write_free(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> None:
    """Write what the accelerations of the touches would be without reactions."""
    y = work.state
    f = with_straps(shape, work, f)
    spin = vec(y, W)
    free = free_turning(shape, work, spin)
    for place in range(work.mode[TOUCHES]):
        put(work.free[place], 0, touch_acceleration(work, q, y, f, free, place))
        work.goal[place] = 0.0


@routine
def drop_leaving(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Drop the touches that carry nothing and leave their plane at the rates found last."""
    y, dy, place = work.state, work.stages[0], 0
    while place < work.mode[TOUCHES]:
        a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
        if a.z > STARTS and work.touches[place, CARRIES] != PRESSES:
            drop_touch(work, place)
        else:
            place += 1


@routine
def let_slip(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Let those touches begin to slip whose reaction is at its cone's edge and that accelerate."""
    y, dy = work.state, work.stages[0]
    for place in range(work.mode[TOUCHES]):
        touch, share = work.touches[place], work.shares[place]
        a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
        along = math.sqrt(a.x * a.x + a.y * a.y)
        pull = math.sqrt(share[0] * share[0] + share[1] * share[1])
        inside = pull < (1.0 - AT_EDGE) * min(touch[STATIC_AT], touch[KINETIC_AT]) * share[2]
        if touch[MOVES] > 0.0 or along <= STARTS or inside or touch[STATIC_AT] == math.inf:
            continue
        begin_slip(shape, work, q, place)


@routine
def note_support(shape: SolidParameters, work: Workspace) -> None:
    """Note the touches on the support (`near`, `closed`); a tipping circle gets its rim there."""
    n, ring, x, y = 0, 0, 0.0, 0.0
    for place in range(work.mode[TOUCHES]):
        if plane_of(work, place) == 0:
            point = point_of(work, place)
            work.near[n] = work.closed[n] = point
            n += 1
            if point < shape.contacts:
                ring += 1
                x, y = x + work.points[point, X], y + work.points[point, Y]
    work.mode[NEAR] = work.mode[CLOSED] = n
    size = math.sqrt(x * x + y * y)
    tips = lies_on_rim(shape) and 0 < ring < shape.contacts and size > 1e-6 * shape.radius * ring
    if tips:
        place = 0
        while place < work.mode[TOUCHES]:
            if plane_of(work, place) == 0:
                drop_touch(work, place)
            else:
                place += 1
        stand_on_rim(shape, work, x / size, y / size)
        work.near[0], work.mode[NEAR] = shape.contacts, 1
        add_touch(work, 0, shape.contacts)
        work.touches[work.mode[TOUCHES] - 1, CARRIES] = MAY_PRESS
        q = axes_at(work.state)
        look_at_touches(shape, work, q, work.state)
        note_moving(shape, work, q, shape.limits.slipping)


@routine
def begin_beside(shape: SolidParameters, work: Workspace, f: Vec, still: bool) -> None:
    """Begin the mode of the touches: put the state on them, at rest if nothing moves it.

    Args:
        still: whether the reactions that were found hold it, if the rows alone do not.
    """
    note_support(shape, work)
    write_mode(shape, work, axes_at(work.state))
    work.mode[CONTACT_KIND], work.mode[FRICTION_STATE] = WALLED, SLIPS
    put_back_at_walls(shape, work, work.state)
    q = axes_at(work.state)
    if not still:
        rates(shape, work, work.state, f, True, work.stages[0])
        holds = work.judged[PRESS] >= -SLACK and work.judged[CONE] >= -SLACK
        still = holds and still_at(shape, work, q)
    if still:
        work.mode[FRICTION_STATE] = STICKS
        for j in range(V, STATE):
            work.state[j] = 0.0


@routine
def drop_pull(work: Workspace) -> bool:
    """Let the touch that pulls most carry nothing; False if none pulls."""
    worst, least = -1, -SLACK
    for place in range(work.mode[TOUCHES]):
        if work.shares[place, 2] < least:
            worst, least = place, work.shares[place, 2]
    for place in range(work.mode[TOUCHES]):
        if work.touches[place, CARRIES] == FOLLOWS:
            work.touches[place, CARRIES] = MAY_PRESS
    if worst >= 0:
        work.touches[worst, CARRIES] = PULLS
    return worst >= 0
