"""A solid across one interval of its motion, event by event."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.dormand_prince import next_part
from shaketable.physics.space.beside import choose
from shaketable.physics.space.choice import PULLED_ON
from shaketable.physics.space.constraints import pulls
from shaketable.physics.space.contacts import LEVEL, axes_at, lies_on_rim
from shaketable.physics.space.edge import look_behind, note_past
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
)
from shaketable.physics.space.landing import (
    bears,
    collect_contacts,
    gather_closed,
    gather_what_meets,
    land,
)
from shaketable.physics.space.modes import end_slow_slips
from shaketable.physics.space.noting import accept, copy, is_finite, look_at, look_on
from shaketable.physics.space.rates import rates
from shaketable.physics.space.rest import comes_to_rest, is_at_rest, rest_ends
from shaketable.physics.space.settling import FELL, GOES_ON, LANDED, creep
from shaketable.physics.space.step import Pull, pull_at, take_step
from shaketable.physics.space.straps import pull_or_not
from shaketable.physics.space.touches import slip_velocity, slips_at
from shaketable.physics.space.vectors import dot
from shaketable.physics.space.workspace import (
    CORNER,
    FLAT,
    FLIGHT,
    SLIPS,
    STICKS,
    WALLED,
    Floats,
    SolidParameters,
    Workspace,
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
LONG_RUN_EVENTS, LONG_RUN_STEPS = 2_000, 15_000
REDUCED_EVENTS, REDUCED_STEPS = 10, 100
#: After so many fallbacks in one run, the first event leads to time stepping.
MANY_FALLBACKS = 300
FIRST_SLIP = 0.3  # rad: greatest turn of friction's direction in the first step of a slip
RIM_SHARE = 0.3  # greatest relative change of a rolling circle's nutation in a step


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
    if work.tally.fallbacks > MANY_FALLBACKS:
        most = 0
    slides = work.mode.kind == FLAT  # sliding on a flat base needs the most steps
    most_steps = REDUCED_STEPS if slides and work.tally.steps >= LONG_RUN_STEPS else STEP_BUDGET
    while u < 1.0:
        if u == 0.0 and events == 0 and may_change(shape, work):
            work.judged.past = FORCE_PAST
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
            work.tally.events += 1
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
        work.tally.steps += 1
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
            work.tally.events += 1
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
            work.tally.events += 1
            fresh, part = True, max(part, 1e-3)
            continue
        copy(work.stages[6], work.stages[0])
        look_on(shape, work)
    return GOES_ON, 1.0, part


@kernel
def may_change(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a mode ends without an event: nothing moves any more, or what stayed may let go."""
    return comes_to_rest(shape, work) or work.judged.past >= PULLED_ON


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
        work.tally.met = 1
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
    if kind == FORCE and was == signature(work) and work.judged.past < PULLED_ON:
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
def signature(work: Workspace) -> int:
    """A number that tells the mode: which touches are closed, and which of them slip."""
    number = 3 * work.mode.kind + work.mode.grip
    for k in range(work.mode.closed):
        place = work.closed[k]
        touch = work.touches[place]
        each = 2 * (64 * touch.plane + touch.point) + slips_at(work, place)
        number = 31 * number + each + 1
    return number


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
