"""A solid across one interval of its motion, event by event."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.solids.choice import choose
from shaketable.solids.constraints import pulls
from shaketable.solids.contacts import (
    LEVEL,
    axes_at,
    begin_rim,
    find_rim,
    height,
    lies_on_rim,
    lowest,
    on_rim,
    velocity,
)
from shaketable.solids.events import find_event
from shaketable.solids.guards import (
    FALL,
    FORCE,
    FORCE_PAST,
    GAP,
    GAP_SEEN,
    lean,
    lean_rate,
    least_guard,
    peak_between,
    slips_at,
)
from shaketable.solids.impact import collide
from shaketable.solids.rates import rates
from shaketable.solids.rest import rest_until, rests_throughout
from shaketable.solids.room import (
    CLOSED,
    CONE,
    CONE_BEFORE,
    CORNER,
    EVENTS,
    FLAT,
    FLIGHT,
    HOLD,
    IMPACTS,
    KINETIC,
    LIFT,
    NEAR,
    PAST,
    PEAK,
    PRESS,
    PRESS_BEFORE,
    RANK,
    SLIPS,
    STATE,
    STEPS,
    STICKS,
    YAW,
    Q,
    Room,
    Shape,
    W,
    vec,
)
from shaketable.solids.settling import all_but_flat, all_but_leaning, creep, lay_flat, lay_ring
from shaketable.solids.step import Pull, next_part, pull_at, take_step
from shaketable.solids.vectors import dot

GOES_ON, FELL = range(2)  # how an interval ends
LEAST_PART = 1e-12  # of an interval: shorter steps are taken whatever their error
LOST = 0.1  # of a step whose rates are no numbers, as where a circle passes the upright
#: When no other contact mode is admissible, multiply the current mode's violation tolerance by the
#: first, up to the second [m/s²]; beyond it the rest of the interval is stepped over.
DEAFER, MOST_PAST = 10.0, 1e-5
BUDGET = 100  # events in one interval, after which the rest of it is stepped over
STEP_BUDGET = 2_000  # likewise, steps
TIRED, STEP_TIRED = 2_000.0, 15_000.0  # of a run, after which an interval has less of them
LITTLE, STEP_LITTLE = 10, 100
FIRST_SLIP = 0.3  # step times rate of friction's turning, in the first step of a slip
RIM_SHARE = 0.3  # of its nutation, by which a circle's may change in a step


@kernel
def copy(source, target) -> None:  # type: ignore[no-untyped-def]
    for j in range(STATE):
        target[j] = source[j]


@kernel
def is_finite(y) -> bool:  # type: ignore[no-untyped-def]
    total = 0.0
    for j in range(STATE):
        total += y[j]
    return math.isfinite(total)


@kernel
def twist(y) -> float:  # type: ignore[no-untyped-def]
    """Turn about the support's normal (swing and twist), in (-π, π]."""
    angle = 2.0 * math.atan2(y[Q + 3], y[Q])
    return angle - 2.0 * math.pi * math.floor((angle + math.pi) / (2.0 * math.pi))


@routine
def look_at(shape: Shape, room: Room) -> None:
    """Let a step begin with the contact as it is."""
    room.judged[PRESS_BEFORE], room.judged[CONE_BEFORE] = room.judged[PRESS], room.judged[CONE]
    q, y = axes_at(room.state), room.state
    if shape.radius > 0.0:
        begin_rim(room)
        find_rim(shape, room, q, vec(y, W))
    if room.mode[HOLD] == STICKS or room.mode[RANK] == FLIGHT:
        return
    for place in range(room.mode[CLOSED]):
        point = room.closed[place]
        u = velocity(shape, room, q, y, point)
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        if speed > shape.limits.turning:
            room.slip[point, 0] = u.x / speed
            room.slip[point, 1] = u.y / speed


@routine
def accept(shape: Shape, room: Room, h: float) -> None:
    """Take the state on trial, which is h later."""
    tally = room.tally
    tally[PEAK] = max(tally[PEAK], peak_between(room.state, room.trial, h))
    copy(room.trial, room.state)
    if room.mode[RANK] == FLIGHT:
        tally[LIFT] = max(tally[LIFT], lowest(shape, room, axes_at(room.state), room.state))
    change = twist(room.state) - tally[YAW]
    tally[YAW] += change - 2.0 * math.pi * math.floor((change + math.pi) / (2.0 * math.pi))


@routine
def gather(shape: Shape, room: Room, leaving: float) -> None:
    """Note which points are on the support and do not leave it faster than `leaving`.

    The lowest point of a rim comes last; a circle that lies flat has its ring of points instead.
    """
    y, n = room.state, 0
    q = axes_at(y)
    leans = shape.radius > 0.0 and q.z.x**2 + q.z.y**2 > LEVEL * LEVEL
    if leans:
        find_rim(shape, room, q, vec(y, W))
    first = shape.contacts if leans and lies_on_rim(shape) else 0
    for point in range(first, shape.contacts + (1 if leans else 0)):
        if (
            height(shape, room, q, y, point) <= shape.limits.landing
            and velocity(shape, room, q, y, point).z <= leaving
        ):
            room.near[n] = point
            n += 1
    room.mode[NEAR] = n


@routine
def land(shape: Shape, room: Room, f) -> None:  # type: ignore[no-untyped-def]
    """What follows where a point has landed."""
    if lies_on_rim(shape):
        q = axes_at(room.state)
        sine = math.sqrt(q.z.x**2 + q.z.y**2)
        if room.mode[RANK] == CORNER and sine > 2.0 * LEVEL:  # it has rolled past its bottom
            begin_rim(room)
            find_rim(shape, room, q, vec(room.state, W))
            return
        if sine <= 2.0 * LEVEL:
            lay_ring(shape, room)
            lay_flat(shape, room)
            room.mode[RANK] = FLAT
    gather(shape, room, math.inf)
    room.tally[IMPACTS] += 1.0
    collide(shape, room)
    if all_but_flat(shape, room, 0.0):
        if lies_on_rim(shape):
            lay_ring(shape, room)
        lay_flat(shape, room)
    elif not all_but_leaning(shape, room, 0.0):
        gather(shape, room, shape.limits.leaving)
    choose(shape, room, f)


@routine
def respond(shape: Shape, room: Room, f, kind: int) -> bool:  # type: ignore[no-untyped-def]
    """Choose the contact mode after an event; return True if none is admissible."""
    before = room.judged[PAST]
    room.judged[PAST] = FORCE_PAST
    if kind == GAP:
        land(shape, room, f)
        return False
    gather_closed(room)
    rank, hold, first = room.mode[RANK], room.mode[HOLD], room.closed[0]
    n = room.mode[CLOSED]
    choose(shape, room, f)
    same = rank == room.mode[RANK] and hold == room.mode[HOLD] and n == room.mode[CLOSED]
    if kind == FORCE and same and first == room.closed[0]:
        if before >= MOST_PAST:
            return True
        room.judged[PAST] = before * DEAFER  # no other mode is admissible: this one goes on
        if rank == FLAT and hold != STICKS:
            rates(shape, room, room.state, f, True, room.stages[0])
            return pulls(room)
    return False


@routine
def gather_closed(room: Room) -> None:
    for place in range(room.mode[CLOSED]):
        room.near[place] = room.closed[place]
    room.mode[NEAR] = room.mode[CLOSED]


@routine
def cross_interval(shape: Shape, room: Room, pull: Pull, first: float) -> tuple[int, float, float]:
    """Take a solid through an interval.

    Args:
        first: part of the interval that its first step tries.

    Returns: how it ended (GOES_ON or FELL), the part that has passed, and the part that
        the next interval's first step may try.
    """
    u, part, fresh, events, steps = 0.0, first, True, 0, 0
    most = BUDGET if room.tally[EVENTS] < TIRED else LITTLE
    slides = room.mode[RANK] == FLAT  # the dearest steps, where feet slip in and out
    most_steps = STEP_LITTLE if slides and room.tally[STEPS] >= STEP_TIRED else STEP_BUDGET
    while u < 1.0:
        if room.mode[RANK] == FLAT and room.mode[HOLD] == STICKS and not on_rim(shape, room):
            if u == 0.0 and rests_throughout(shape, pull):
                return GOES_ON, 1.0, 1.0
            u_rest = rest_until(shape, room, pull, u)
            if u_rest > 1.0:
                return GOES_ON, 1.0, 1.0
            u = u_rest
            gather_closed(room)
            room.judged[PAST] = FORCE_PAST
            choose(shape, room, pull_at(pull, u))
            fresh, part = True, 1.0 - u
            room.tally[EVENTS] += 1.0
            events += 1
            if u >= 1.0:
                break
        if fresh:
            rates(shape, room, room.state, pull_at(pull, u), True, room.stages[0])
            look_at(shape, room)
        du = min(part, 1.0 - u)
        if shape.radius > 0.0 and room.mode[RANK] == CORNER:
            du = min(du, rim_part(room, pull))
        if fresh and room.mode[HOLD] == SLIPS and room.mode[RANK] != FLIGHT:
            du = min(du, slip_part(shape, room, pull, u))
        fresh = False
        du = max(du, LEAST_PART)
        error = take_step(shape, room, pull, u, du)
        room.tally[STEPS] += 1.0
        steps += 1
        if steps > most_steps:
            return FELL if creep(shape, room, pull, u) else GOES_ON, 1.0, part
        if not error <= 1.0 and du > LEAST_PART:  # nor if it is no number
            part = next_part(du, error) if error > 1.0 else LOST * du
            continue
        if not is_finite(room.trial):
            return FELL if creep(shape, room, pull, u) else GOES_ON, 1.0, LOST * part
        guard = least_guard(shape, room, room.trial, room.stages[6], GAP_SEEN, du * pull.length)
        if guard.least < 0.0:
            du, kind = find_event(shape, room, pull, u, du, guard)
            if not is_finite(room.trial):
                return FELL if creep(shape, room, pull, u) else GOES_ON, 1.0, LOST * part
            accept(shape, room, du * pull.length)
            u += du
            if kind == FALL:
                room.tally[PEAK] = 1.0
                return FELL, u, part
            jams = respond(shape, room, pull_at(pull, min(u, 1.0)), kind)
            room.tally[EVENTS] += 1.0
            events += 1
            if jams or events > most:
                return FELL if creep(shape, room, pull, u) else GOES_ON, 1.0, part
            fresh, part = True, max(part, 1e-3)
            continue
        accept(shape, room, du * pull.length)
        part = max(part if du < part else 0.0, next_part(du, error))  # a step may be cut short
        u = 1.0 if 1.0 - u - du < LEAST_PART else u + du
        if wobbles_out(shape, room):
            land(shape, room, pull_at(pull, u))
            room.tally[EVENTS] += 1.0
            fresh, part = True, max(part, 1e-3)
            continue
        copy(room.stages[6], room.stages[0])
        look_at(shape, room)
    return GOES_ON, 1.0, part


@kernel
def wobbles_out(shape: Shape, room: Room) -> bool:
    """Whether a circle that loses energy as it rolls has come to lie all but flat."""
    loses = lies_on_rim(shape) and (shape.rolling > 0.0 or shape.contour > 0.0)
    low = loses and room.mode[RANK] == CORNER and lean(room.state) <= 4.0 * LEVEL * LEVEL
    return low and lean_rate(room.state) < 0.0


@kernel
def rim_part(room: Room, pull: Pull) -> float:
    """The part of an interval in which a rolling circle's nutation changes by a share of itself."""
    size, rate = lean(room.state), abs(lean_rate(room.state))
    if size <= LEVEL * LEVEL or rate == 0.0:
        return 1.0
    return RIM_SHARE * 2.0 * size / (rate * pull.length)


@kernel
def slip_part(shape: Shape, room: Room, pull: Pull, u: float) -> float:
    """The part of an interval that the first step of a slip tries, in which friction may yet turn.

    Across its slip a point is slowed down at the rate μ N W / |u|, W its response to a force.
    """
    q, y, fastest = axes_at(room.state), room.state, 0.0
    f = pull_at(pull, u)
    size = math.sqrt(dot(f, f))
    across = max(shape.mobility.xx, shape.mobility.yy)
    give = 1.0 + across * shape.h * shape.h + shape.mobility.zz * shape.reach * shape.reach
    for place in range(room.mode[CLOSED]):
        point = room.closed[place]
        if slips_at(room, point):
            v = velocity(shape, room, q, y, point)
            speed = max(shape.limits.turning, math.sqrt(v.x * v.x + v.y * v.y))
            fastest = max(fastest, room.points[point, KINETIC] * size * give / speed)
    return FIRST_SLIP / (fastest * pull.length) if fastest > 0.0 else 1.0
