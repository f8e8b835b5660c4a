"""A solid across one interval of its motion, event by event."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.dormand_prince import next_part
from shaketable.physics.space.beside import choose, choose_together
from shaketable.physics.space.constraints import pulls
from shaketable.physics.space.contacts import (
    LEVEL,
    axes_at,
    begin_rim,
    find_rim,
    lies_on_rim,
    on_rim,
    velocity,
)
from shaketable.physics.space.edge import (
    PAST,
    clearance,
    hangs_over,
    has_edge,
    is_of_base,
    line_plane,
    look_behind,
    note_past,
    past_line,
    support_gap,
)
from shaketable.physics.space.events import find_event
from shaketable.physics.space.guards import (
    FALL,
    FORCE,
    FORCE_PAST,
    GAP,
    GAP_SEEN,
    LANDING,
    PASS,
    SLIP,
    WALL,
    lean,
    lean_rate,
    least_guard,
    peak_between,
)
from shaketable.physics.space.impact import collide, kinetic_energy, lose_spin
from shaketable.physics.space.in_plane import keep_in_plane, note_slips_in_plane
from shaketable.physics.space.modes import end_slow_slips, lay_ring
from shaketable.physics.space.rates import rates
from shaketable.physics.space.rest import NEVER, rest_margin, rest_until, rests_throughout
from shaketable.physics.space.rest_beside import rest_beside_until
from shaketable.physics.space.settling import (
    FELL,
    GOES_ON,
    LANDED,
    all_but_flat,
    creep,
    gather_leaning,
    gather_settling_at_edge,
    lay_flat,
)
from shaketable.physics.space.step import Pull, pull_at, take_step
from shaketable.physics.space.straps import hold_on, note_forces, pull_or_not, with_straps
from shaketable.physics.space.touches import (
    add_near,
    begin_list,
    closed_on_support,
    gather_touches,
    is_at_edge,
    is_closed,
    note_slips,
    plane_of,
    point_of,
    slip_velocity,
    slips_at,
    touch_velocity,
    touches_more,
)
from shaketable.physics.space.vectors import dot
from shaketable.physics.space.walls import push_out
from shaketable.physics.space.workspace import (
    CORNER,
    FLAT,
    FLIGHT,
    SLIPS,
    STATE,
    STICKS,
    WALLED,
    Floats,
    P,
    Q,
    SolidParameters,
    W,
    Workspace,
    vec,
)

LEAST_PART = 1e-12  # of an interval: shorter steps are taken whatever their error
#: Shrink the step to this share when the rates are NaN (a disc that passes through vertical).
STEP_SHRINK_ON_NAN = 0.1
#: When no other contact mode is admissible, multiply the current mode's violation tolerance by the
#: first, up to the second [m/s²]; beyond it the rest of the interval is stepped over.
TOLERANCE_RELAXATION, MOST_PAST = 10.0, 1e-5
BUDGET = 100  # events in one interval, after which the rest of it is stepped over
STEP_BUDGET = 2_000  # likewise, steps
#: After this many events (steps) in one run, intervals get the reduced budget.
LONG_RUN_EVENTS, LONG_RUN_STEPS = 2_000.0, 15_000.0
REDUCED_EVENTS, REDUCED_STEPS = 10, 100
NO_MOTION = 1e-24  # m²/s²: kinetic energy, by the mass, of what does not move
FIRST_SLIP = 0.3  # rad: greatest turn of friction's direction in the first step of a slip
RIM_SHARE = 0.3  # greatest relative change of a rolling circle's nutation in a step


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
def look_at(shape: SolidParameters, work: Workspace) -> None:
    """Store reactions and slip directions at the start of a step."""
    work.judged.press_before, work.judged.cone_before = work.judged.press, work.judged.cone
    q, y = axes_at(work.state), work.state
    if shape.radius > 0.0:
        begin_rim(work)
        find_rim(shape, work, q, vec(y, W))
    if work.mode.grip != STICKS:
        note_slips(shape, work, q)


@routine
def accept(shape: SolidParameters, work: Workspace, h: float) -> None:
    """Accept the trial state after h [s]; update peak, lift, yaw and how far it came."""
    tally = work.tally
    if shape.straps > 0:
        note_forces(shape, work, h)
    tally.peak = max(tally.peak, peak_between(work.state, work.trial, h))
    copy(work.trial, work.state)
    q = axes_at(work.state)
    if work.mode.kind == FLIGHT and not hangs_over(shape, work):
        tally.lift = max(tally.lift, clearance(shape, work, q, work.state))
    if has_edge(shape):
        look_behind(shape, work)
        if shape.radius > 0.0:
            note_rolling_past(shape, work)
        note_tipping(shape, work)
    if shape.planar:
        keep_in_plane(work.state)
        note_slips_in_plane(shape, work)
    x = work.state[P] - shape.h * q.x.z - tally.start_x
    y = work.state[P + 1] - shape.h * q.y.z - tally.start_y
    tally.farthest = max(tally.farthest, x * x + y * y)
    change = twist(work.state) - tally.yaw
    tally.yaw += change - 2.0 * math.pi * math.floor((change + math.pi) / (2.0 * math.pi))


@routine
def collect_contacts(shape: SolidParameters, work: Workspace, leaving: float) -> None:
    """List the points that are on the support and do not leave it faster than `leaving`.

    The lowest point of a rim comes last; a circle that lies flat has its ring of points instead.
    """
    y = work.state
    q = axes_at(y)
    leans = shape.radius > 0.0 and q.z.x**2 + q.z.y**2 > LEVEL * LEVEL
    if leans:
        find_rim(shape, work, q, vec(y, W))
    first = shape.contacts if leans and lies_on_rim(shape) else 0
    begin_list(work)
    for point in range(first, shape.contacts + (1 if leans else 0)):
        if (
            support_gap(shape, work, q, y, point) <= shape.limits.landing
            and velocity(shape, work, q, y, point).z <= leaving
        ):
            add_near(work, point)


@routine
def land(  # type: ignore[no-untyped-def]
    shape: SolidParameters, work: Workspace, f, kind: int, impact_times: Floats
) -> None:
    """Resolve a landing, or what meets a wall (`kind` of guard), and choose the next mode."""
    if lies_on_rim(shape) and kind == GAP:
        q = axes_at(work.state)
        sine = math.sqrt(q.z.x**2 + q.z.y**2)
        if work.mode.kind == CORNER and sine > 2.0 * LEVEL:  # it has rolled past its bottom
            begin_rim(work)
            find_rim(shape, work, q, vec(work.state, W))
            return
        if sine <= 2.0 * LEVEL:
            lay_ring(shape, work)
            lay_flat(shape, work)
            work.mode.kind = FLAT
    collect_contacts(shape, work, math.inf)
    number = int(work.tally.impacts)
    if number < impact_times.size:
        impact_times[number] = work.clock.begun + work.clock.passed
    work.tally.impacts += 1.0
    beside = touches_more(shape)
    if beside and gather_touches(shape, work, shape.limits.landing, math.inf, 0.0) > 0:
        work.tally.met = 1.0
        if shape.walls > 0:
            push_out(shape, work)
    collide(shape, work)
    if shape.planar:
        lose_spin(shape, work)
        keep_in_plane(work.state)
    pull_or_not(shape, work)
    if all_but_flat(shape, work, 0.0):
        if lies_on_rim(shape):
            lay_ring(shape, work)
        lay_flat(shape, work)
    elif gather_settling_at_edge(shape, work):
        choose_together(shape, work, f)
        return
    elif not gather_leaning(shape, work, 0.0):
        collect_contacts(shape, work, shape.limits.leaving)
    choose(shape, work, f)


@routine
def gather_what_meets(shape: SolidParameters, work: Workspace) -> bool:
    """List what touches after a passage of the edge; whether any of it is struck."""
    collect_contacts(shape, work, math.inf)
    gather_touches(shape, work, shape.limits.landing, math.inf, 0.0)
    q, found = axes_at(work.state), False
    for place in range(work.mode.touches):
        u = touch_velocity(work, q, work.state, place)
        found = found or u.z < -shape.limits.leaving
    return found


@routine
def bears(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a body stands on its support, or with its base on the edge of it."""
    if work.mode.kind != WALLED:
        return bool(work.mode.kind != FLIGHT)
    found = False
    for place in range(work.mode.touches):
        plane = plane_of(work, place)
        on_edge = plane > shape.walls and not is_upright_side(shape, work, place)
        found = found or (work.touches[place].carries > 0 and (plane == 0 or on_edge))
    return found


@kernel
def is_upright_side(shape: SolidParameters, work: Workspace, place: int) -> bool:
    """Whether a touch is the line of the edge at a side that is none of the base."""
    line = plane_of(work, place) == line_plane(shape)
    return line and not is_of_base(shape, point_of(work, place))


@routine
def note_rolling_past(shape: SolidParameters, work: Workspace) -> None:
    """Note which points of a circle are past the edge; of those that touch their guards decide."""
    q = axes_at(work.state)
    for point in range(shape.contacts + 1):
        if not is_closed(work, 0, point):
            off = past_line(shape, work, q, work.state, point)
            work.past[point] = 1 if off > PAST else 0


@kernel
def note_tipping(shape: SolidParameters, work: Workspace) -> None:
    """Note how far the axis has turned toward the edge, turn by turn."""
    q = axes_at(work.state)
    angle = math.atan2(shape.edge_x * q.x.z + shape.edge_y * q.y.z, q.z.z)
    change = angle - work.tally.tips
    work.tally.tips += change - 2.0 * math.pi * math.floor((change + math.pi) / (2.0 * math.pi))


@routine
def respond(  # type: ignore[no-untyped-def]
    shape: SolidParameters, work: Workspace, f, kind: int, impact_times: Floats
) -> bool:
    """Choose the contact mode after an event; return True if none is admissible."""
    before, was = work.judged.past, signature(work)
    work.judged.past = FORCE_PAST
    if kind in (GAP, WALL):
        land(shape, work, f, kind, impact_times)
        return False
    if kind == PASS:
        work.tally.met = 1.0
        note_past(shape, work, False)
        look_behind(shape, work)  # sides that can be met now
    if kind == PASS and gather_what_meets(shape, work):
        land(shape, work, f, WALL, impact_times)
        return False
    pull_or_not(shape, work)
    if kind == SLIP and work.mode.kind != FLAT:
        end_slow_slips(shape, work)
    if kind == PASS:
        collect_contacts(shape, work, shape.limits.leaving)
    else:
        gather_closed(shape, work)
    choose(shape, work, f)
    if kind == FORCE and was == signature(work):
        if before >= MOST_PAST:
            return True
        work.judged.past = (
            before * TOLERANCE_RELAXATION
        )  # no other mode is admissible: this one goes on
        if work.mode.kind == FLAT and work.mode.grip != STICKS:
            rates(shape, work, work.state, f, True, work.stages[0])
            return pulls(work)
    return False


@kernel
def is_at_rest(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a body lies flat and sticks, or is held beside a wall."""
    flat = work.mode.kind == FLAT and not on_rim(work)
    sticks = work.mode.grip == STICKS
    return sticks and (flat or work.mode.kind == WALLED)


@routine
def rest_ends(shape: SolidParameters, work: Workspace, pull: Pull, u: float) -> float:
    """The u in the interval at which a body leaves its rest, or may, or NEVER."""
    plain = shape.straps == 0 and work.mode.kind == FLAT
    if plain and u == 0.0 and rests_throughout(shape, pull):
        return NEVER
    if shape.straps > 0:
        hold_on(shape, work)
    if work.mode.kind == WALLED:
        holds = judge_support(shape, work, pull, u)
        if holds:  # without its walls; what touches a lip stays as it is
            return NEVER if is_at_edge(shape, work) else u
        return rest_beside_until(shape, work, pull, u)
    held = pull
    if shape.straps > 0:  # it does not move: the straps' force stays as it is
        held = Pull(with_straps(shape, work, pull.start), pull.change, pull.length)
    return rest_until(shape, work, held, u)


@kernel
def comes_to_rest(shape: SolidParameters, work: Workspace) -> bool:
    """Whether nothing moves any more beside a wall, though its mode is not that of rest."""
    moves = work.mode.kind == WALLED and work.mode.grip != STICKS
    return moves and kinetic_energy(shape, work.state) < NO_MOTION


@routine
def judge_support(shape: SolidParameters, work: Workspace, pull: Pull, u: float) -> bool:
    """Judge whether the support alone holds a flat body through what is left of an interval.

    Rests end where sliding begins, so that a margin of none is none.
    """
    if closed_on_support(work) < shape.contacts or on_rim(work):
        return False
    start = with_straps(shape, work, pull_at(pull, u))
    end = with_straps(shape, work, pull_at(pull, 1.0))
    return min(rest_margin(shape, work, start), rest_margin(shape, work, end)) > 0.0


@kernel
def signature(work: Workspace) -> int:
    """A number that tells the mode: which touches are closed, and which of them slip."""
    number = 3 * work.mode.kind + work.mode.grip
    for k in range(work.mode.closed):
        place = work.closed[k]
        touch = work.touches[place]
        each = 2 * (64 * touch.plane + touch.point) + slips_at(work, place)
        number = 31 * number + each + 1
    return number


@routine
def gather_closed(shape: SolidParameters, work: Workspace) -> None:
    """List the closed points on the support alone; beside a wall some may have left it."""
    q, beside = axes_at(work.state), work.mode.kind == WALLED
    if beside and on_rim(work):
        find_rim(shape, work, q, vec(work.state, W))
    n = work.mode.touches if beside else work.mode.closed
    begin_list(work)
    for k in range(n):
        touch = work.touches[k if beside else work.closed[k]]
        plane, point = touch.plane, touch.point
        near = not beside or support_gap(shape, work, q, work.state, point) <= shape.limits.landing
        if plane == 0 and near:
            add_near(work, point)


@routine
def cross_interval(
    shape: SolidParameters, work: Workspace, pull: Pull, first: float, impact_times: Floats
) -> tuple[int, float, float]:
    """Take a solid through an interval.

    Args:
        first: part of the interval that its first step tries.
        impact_times: where those of impacts are written [s], as many as fit.

    Returns: how it ended (GOES_ON or FELL), the part that has passed, and the part that
        the next interval's first step may try.
    """
    u, part, fresh, events, steps = 0.0, first, True, 0, 0
    most = BUDGET if work.tally.events < LONG_RUN_EVENTS else REDUCED_EVENTS
    slides = work.mode.kind == FLAT  # sliding on a flat base needs the most steps
    most_steps = REDUCED_STEPS if slides and work.tally.steps >= LONG_RUN_STEPS else STEP_BUDGET
    while u < 1.0:
        if u == 0.0 and events == 0 and comes_to_rest(shape, work):
            gather_closed(shape, work)
            choose(shape, work, pull_at(pull, u))
        if is_at_rest(shape, work):
            u_rest = rest_ends(shape, work, pull, u)
            if u_rest > 1.0:
                return GOES_ON, 1.0, 1.0
            u = u_rest
            gather_closed(shape, work)
            work.judged.past = FORCE_PAST
            choose(shape, work, pull_at(pull, u))
            fresh, part = True, 1.0 - u
            work.tally.events += 1.0
            events += 1
            if u >= 1.0:
                break
            if work.mode.kind == WALLED:  # other rows may hold it on
                if events > most:
                    return creep(shape, work, pull, u), 1.0, part
                continue
        if fresh:
            rates(shape, work, work.state, pull_at(pull, u), True, work.stages[0])
            look_at(shape, work)
        du = min(part, 1.0 - u)
        if shape.radius > 0.0 and work.mode.kind == CORNER:
            du = min(du, rim_part(work, pull))
        if fresh and work.mode.grip == SLIPS and work.mode.kind != FLIGHT:
            du = min(du, slip_part(shape, work, pull, u))
        fresh = False
        du = max(du, LEAST_PART)
        error = take_step(shape, work, pull, u, du)
        work.tally.steps += 1.0
        steps += 1
        if steps > most_steps:
            return creep(shape, work, pull, u), 1.0, part
        if not error <= 1.0 and du > LEAST_PART:  # nor if it is no number
            part = next_part(du, error) if error > 1.0 else STEP_SHRINK_ON_NAN * du
            continue
        if not is_finite(work.trial):
            return creep(shape, work, pull, u), 1.0, STEP_SHRINK_ON_NAN * part
        guard = least_guard(shape, work, work.trial, work.stages[6], GAP_SEEN, du * pull.length)
        if guard.least < 0.0:
            du, kind = find_event(shape, work, pull, u, du, guard)
            if not is_finite(work.trial):
                return creep(shape, work, pull, u), 1.0, STEP_SHRINK_ON_NAN * part
            accept(shape, work, du * pull.length)
            u += du
            work.clock.passed = u * pull.length
            if kind == FALL:
                work.tally.peak = 1.0
                return FELL, u, part
            if kind == LANDING:
                return LANDED, u, part
            stood = bears(shape, work)
            f = pull_at(pull, min(u, 1.0))
            jams = respond(shape, work, f, kind, impact_times)
            if stood and not bears(shape, work):
                work.tally.left_at = work.clock.begun + work.clock.passed
            work.tally.events += 1.0
            events += 1
            if jams or events > most:
                return creep(shape, work, pull, u), 1.0, part
            fresh, part = True, max(part, 1e-3)
            continue
        accept(shape, work, du * pull.length)
        part = max(part if du < part else 0.0, next_part(du, error))  # a step may be cut short
        u = 1.0 if 1.0 - u - du < LEAST_PART else u + du
        if wobbles_out(shape, work):
            land(shape, work, pull_at(pull, u), GAP, impact_times)
            work.tally.events += 1.0
            fresh, part = True, max(part, 1e-3)
            continue
        copy(work.stages[6], work.stages[0])
        look_at(shape, work)
    return GOES_ON, 1.0, part


@kernel
def wobbles_out(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a circle that loses energy as it rolls has come to lie all but flat."""
    loses = lies_on_rim(shape) and (shape.rolling > 0.0 or shape.contour > 0.0)
    low = loses and work.mode.kind == CORNER and lean(work.state) <= 4.0 * LEVEL * LEVEL
    return low and lean_rate(work.state) < 0.0


@kernel
def rim_part(work: Workspace, pull: Pull) -> float:
    """The part of an interval in which a rolling circle's nutation changes by a share of itself."""
    size, rate = lean(work.state), abs(lean_rate(work.state))
    if size <= LEVEL * LEVEL or rate == 0.0:
        return 1.0
    return RIM_SHARE * 2.0 * size / (rate * pull.length)


@kernel
def slip_part(shape: SolidParameters, work: Workspace, pull: Pull, u: float) -> float:
    """The first step of a slip, as a part of the interval: short enough to follow friction's turn.

    Across its slip a point is slowed down at the rate μ N W / |u| [1/s]; W is its acceleration by a
    force, times the body's mass [1].
    """
    q, y, fastest = axes_at(work.state), work.state, 0.0
    f = pull_at(pull, u)
    size = math.sqrt(dot(f, f))
    across = max(shape.mobility.xx, shape.mobility.yy)
    give = 1.0 + across * shape.h * shape.h + shape.mobility.zz * shape.reach * shape.reach
    for k in range(work.mode.closed):
        place = work.closed[k]
        if slips_at(work, place):
            v = slip_velocity(shape, work, q, y, place)
            speed = max(shape.limits.turning, math.sqrt(v.x * v.x + v.y * v.y))
            fastest = max(fastest, work.touches[place].kinetic * size * give / speed)
    return FIRST_SLIP / (fastest * pull.length) if fastest > 0.0 else 1.0
