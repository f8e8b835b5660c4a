"""The general model across one interval of the motion, phase by phase.

`cross_phases` finds the first guard that falls through zero (`first_guard`), takes the body
there (`advanced`), and lets the reset of that guard decide what follows (`after_guard`):
complementarity for forces, an impact for a corner that lands. A guard fires once it is below
-GUARD_SLACK, so that a quantity that starts at zero needs no care, and the phase that it has
ended cannot follow itself.

Endings of sequences that would go on for ever (Zeno): a landing slower than `bounce_speed` does
not bounce; a body that rocks in place settles as in `events.settles`; one that slides settles
when the corner that lifts is slower than `settle_speed`. Verdicts do not hang on them (tests).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.kernels.codes import (
    BOTH,
    FLIGHT,
    LEFT,
    NO_CONTACT,
    RIGHT,
    contact_of,
    side_sign,
    slip_of,
)
from shaketable.kernels.compiled import kernel, routine
from shaketable.kernels.complementarity import JAM, JAM_LEFT, SLIP_SPEED, choose
from shaketable.kernels.contact import (
    Force,
    Pose,
    Stand,
    corner,
    corner_speeds,
    force_of,
    on_corner,
)
from shaketable.kernels.course import (
    ALONG,
    GUARDS,
    NORMAL,
    ROTATION,
    SPIN,
    TERMS,
    Course,
    lay,
    series,
    trusted,
)
from shaketable.kernels.events import (
    EVENT_BUDGET,
    NO_LIFT,
    contact_at,
    fall_at,
    negated,
    peak_within,
    settles,
)
from shaketable.kernels.impact import arrest, collide, struck
from shaketable.kernels.rocking import RIGHT_ANGLE, Push, push_at, rest_of, side_of
from shaketable.kernels.taylor import NO_ROOT, Series, first_root, lowest, slope, value

GUARD_SLACK = 1e-12  # of each guard's unit: m, m/s, m/s², rad
BOUNCED = 1e-12  # m in the interval: a corner that has taken off with a speed, not a force
LEAVING = 1e-12  # m/s: a corner that lifts more slowly stays
NO_GUARD = -1


class Shaking(NamedTuple):
    """A motion as one body meets it."""

    push: NDArray[np.float64]  # a_x [m/s²]
    gravity: NDArray[np.float64]  # g + a_y
    polarity: float  # factor on a_x
    time_step: float  # s


class Tally(NamedTuple):
    """What has become of a body so far."""

    peak: float  # rad, the largest |θ|
    lift: float  # m, the largest clearance under the whole base
    farthest_down: float  # m, the most that a corner in contact has moved downhill, <= 0
    farthest_up: float
    impacts: int
    changes: int  # of phase
    fallen_at: float  # fraction of the interval at which |θ| reached π/2, or -1
    exhausted: bool  # the event budget was


class Log(NamedTuple):
    """Where impacts and changes of phase are written to, as many as fit."""

    impact_times: NDArray[np.float64]
    change_times: NDArray[np.float64]
    phases: NDArray[np.int8]
    guards: NDArray[np.int8]  # what ended the phase before, by its place in phases.TABLE


@kernel
def forcing(shaking: Shaking, i: int) -> Push:
    return push_at(shaking.push, shaking.gravity, shaking.polarity, i)


@kernel
def raised(q: Series, by: float) -> Series:
    return Series(q.c0 + by, q.c1, q.c2, q.c3, q.c4, q.c5, q.c6, q.c7, q.c8, q.c9)


@kernel
def is_landing(phase: int, place: int) -> bool:
    """Whether the guard at `place` of a phase is one of a corner that lands."""
    contact = contact_of(phase)
    if contact == NO_CONTACT:
        return True
    return contact != BOTH and place == (2 if slip_of(phase) == 0.0 else 3)


@routine
def fires_at(guard: Series, phase: int, place: int) -> float:
    """The u at which a guard fires, or NO_ROOT.

    Heights are taken exactly wherever the start is told from a contact: a slack would feed the
    smallest bounces.
    """
    slack = raised(guard, GUARD_SLACK)
    if lowest(slack) > 0.0:
        return NO_ROOT
    if phase == FLIGHT and guard.c0 > GUARD_SLACK:
        return first_root(guard, 0.0)
    bounced = phase == FLIGHT and guard.c0 == 0.0 and guard.c1 > BOUNCED
    if bounced or (phase != FLIGHT and is_landing(phase, place)):
        u = contact_at(guard, False)
        return 0.0 if u == NO_LIFT else u
    return first_root(slack, 0.0)


@routine
def first_guard(course: Course, phase: int, guards: int) -> tuple[float, int]:
    """(u, place) of the first guard to fire, or (1, NO_GUARD)."""
    first, which = NO_ROOT, NO_GUARD
    for place in range(guards):
        u = fires_at(series(course, GUARDS + place), phase, place)
        if u < first:
            first, which = u, place
    return (first, which) if which != NO_GUARD else (1.0, NO_GUARD)


@routine
def advanced(course: Course, stand: Stand, pose: Pose, u: float, h: float) -> Pose:
    """The pose at u, with what its contact implies."""
    contact = contact_of(pose.phase)
    along = series(course, ALONG)
    x, x_rate = value(along, u), slope(along, u) / h
    if contact == BOTH:
        return Pose(pose.phase, x, stand.h, 0.0, x_rate, 0.0, 0.0)
    rotation = value(series(course, ROTATION), u)
    spin = value(series(course, SPIN), u) / h
    if contact == NO_CONTACT:
        normal = series(course, NORMAL)
        return Pose(pose.phase, x, value(normal, u), rotation, x_rate, slope(normal, u) / h, spin)
    side = side_sign(contact)
    if slip_of(pose.phase) == 0.0:
        x_rate = -spin * corner(stand, side, rotation)[1]
    return on_corner(stand, Pose(pose.phase, x, 0.0, rotation, x_rate, 0.0, spin), side)


@kernel
def slipped(stand: Stand, pose: Pose) -> float:
    """How far the lowest corner has moved along the support [m]."""
    contact = contact_of(pose.phase)
    side = side_sign(contact)
    if side == 0.0:
        side = 1.0 if pose.rotation >= 0.0 else -1.0
    return (
        pose.x
        + corner(stand, side, pose.rotation)[0]
        - side * (stand.right if side > 0.0 else stand.left)
    )


@routine
def clearance(course: Course, until: float) -> float:
    """The largest height of the lower corner on [0, until]: at its end, a turn, or where both
    are level."""
    top = 0.0
    for place in range(2):
        gap = series(course, GUARDS + place)
        other = series(course, GUARDS + 1 - place)
        rise = Series(
            gap.c1, 2 * gap.c2, 3 * gap.c3, 4 * gap.c4, 5 * gap.c5,
            6 * gap.c6, 7 * gap.c7, 8 * gap.c8, 9 * gap.c9, 0.0,
        )  # fmt: skip
        turn = first_root(rise, 0.0) if rise.c0 > 0.0 else NO_ROOT
        level = first_root(series(course, ROTATION), 0.0)
        if place == 1:
            level = first_root(negated(series(course, ROTATION)), 0.0)
        for u in (turn, level, until):
            if u <= until:
                top = max(top, min(value(gap, u), value(other, u)))
    return top


@kernel
def leaning(course: Course, pose: Pose) -> tuple[Series, Series]:
    """Rate and angle of the rotation, seen from the side that the body turns to or leans to."""
    turn, angle = series(course, SPIN), series(course, ROTATION)
    side = side_sign(contact_of(pose.phase))
    if side < 0.0 or (side == 0.0 and pose.spin < 0.0):
        return negated(turn), negated(angle)
    return turn, angle


@routine
def peak_until(course: Course, pose: Pose, until: float, peak: float) -> float:
    """The larger of `peak` and the largest |θ| on [0, until] of the phase that begins in `pose`."""
    contact = contact_of(pose.phase)
    if contact == BOTH:
        return peak
    turn, angle = leaning(course, pose)
    if contact == NO_CONTACT:  # it turns steadily
        return max(peak, value(angle, until))
    return peak_within(turn, angle, until, peak)


@routine
def tallied(
    course: Course, stand: Stand, after: Pose, until: float, peak: float, lands: bool, tally: Tally
) -> Tally:
    """With the motion on [0, until] of a phase, which ends in the pose `after`."""
    lift, down, up = tally.lift, tally.farthest_down, tally.farthest_up
    if after.phase == FLIGHT:
        lift = max(lift, clearance(course, until))
    if after.phase != FLIGHT or lands:
        place = slipped(stand, after)
        down, up = min(down, place), max(up, place)
    return Tally(peak, lift, down, up, tally.impacts, tally.changes, -1.0, tally.exhausted)


@kernel
def with_rates(pose: Pose, x_rate: float, y_rate: float, spin: float) -> Pose:
    return Pose(pose.phase, pose.x, pose.y, pose.rotation, x_rate, y_rate, spin)


@kernel
def flat(stand: Stand, pose: Pose, x_rate: float) -> Pose:
    """The pose with its whole base on the support."""
    return Pose(pose.phase, pose.x, stand.h, 0.0, x_rate, 0.0, 0.0)


@routine
def into_phase(stand: Stand, pose: Pose, contact: int, force: Force, ended: int) -> Pose:
    """The pose in the phase that contact and forces admit (`complementarity`).

    A slipping corner that jams (Painlevé) stops at once, by an impulse inside its friction cone.
    """
    phase = choose(stand, pose, contact, force.along, force.normal, ended)
    if phase in (JAM, JAM_LEFT):
        contact = RIGHT if phase == JAM else LEFT
        X, Y = corner(stand, side_sign(contact), pose.rotation)
        along, normal = arrest(stand, pose, X, Y, 0.0)
        x_rate, y_rate, spin = struck(stand, pose, X, Y, along, normal)
        pose = with_rates(pose, x_rate, y_rate, spin)
        phase = choose(stand, pose, contact, force.along, force.normal, -1)
    x_rate = pose.x_rate
    if slip_of(phase) == 0.0 and phase != FLIGHT:  # what sticks has no slip at all
        side = side_sign(contact_of(phase))
        x_rate = 0.0 if side == 0.0 else -pose.spin * corner(stand, side, pose.rotation)[1]
    return Pose(phase, pose.x, pose.y, pose.rotation, x_rate, pose.y_rate, pose.spin)


@routine
def after_impact(stand: Stand, pose: Pose, contact: int, force: Force) -> tuple[Pose, int]:
    """The pose after the impact of the closed corners, and the contact that is left."""
    rebound = collide(stand, pose, contact)
    pose = with_rates(pose, rebound.x_rate, rebound.y_rate, rebound.spin)
    left = NO_CONTACT
    for side in (1.0, -1.0):
        own = RIGHT if side > 0.0 else LEFT
        if contact in (BOTH, own):
            X, Y = corner(stand, side, pose.rotation)
            if corner_speeds(pose, X, Y)[1] <= LEAVING:
                left = own if left == NO_CONTACT else BOTH
    if left == BOTH:
        return flat(stand, pose, pose.x_rate), left
    if left != NO_CONTACT:
        pose = on_corner(stand, pose, side_sign(left))
    return pose, left


@routine
def stays_down(
    stand: Stand,
    pose: Pose,
    contact: int,
    force: Force,
    shaking: Shaking,
    i: int,
    u: float,
    peak: float,
) -> bool:
    """Whether a flat body that turns about a corner after an impact may as well stay flat."""
    speed = abs(pose.spin)
    X, Y = corner(stand, side_sign(contact), 0.0)
    if abs(corner_speeds(pose, X, Y)[0]) <= SLIP_SPEED:
        side = side_sign(contact)
        return settles(
            speed,
            side_of(stand.block, side),
            side_of(stand.block, -side),
            shaking.push,
            shaking.gravity,
            shaking.polarity,
            i,
            u,
            shaking.time_step,
            peak,
        )
    if speed * (stand.right + stand.left) > stand.settle_speed:
        return False
    level = flat(stand, pose, pose.x_rate)
    return contact_of(choose(stand, level, BOTH, force.along, force.normal, -1)) == BOTH


@kernel
def landed(course: Course, pose: Pose, place: int, u: float) -> int:
    """The corners that are on the support when a LANDING or GAP guard has fired."""
    if contact_of(pose.phase) != NO_CONTACT:
        return BOTH
    other = value(series(course, GUARDS + 1 - place), u)
    if other <= 2.0 * GUARD_SLACK:
        return BOTH
    return RIGHT if place == 0 else LEFT


@kernel
def write_change(log: Log, change: int, time: float, phase: int, guard: int) -> None:
    if change < log.phases.size:
        log.change_times[change] = time
        log.phases[change] = phase
        log.guards[change] = guard


@routine
def lay_trusted(
    course: Course, stand: Stand, pose: Pose, force: Force, h: float
) -> tuple[int, float]:
    """The number of guards, and the part of the span over which the course holds.

    A part of the span makes the course a polynomial in the time over that part.
    """
    guards = lay(course, stand, pose, force, h)
    part = trusted(course, stand.h + stand.right + stand.left)
    if part < 1.0:
        power = 1.0
        for k in range(TERMS):
            course[:, k] *= power
            power *= part
        course[SPIN] *= part
    return guards, part


@routine
def after_guard(
    course: Course,
    stand: Stand,
    pose: Pose,
    place: int,
    at: float,
    shaking: Shaking,
    i: int,
    u: float,
    peak: float,
) -> tuple[Pose, bool]:
    """The pose after a guard has fired at u of interval i, and whether there was an impact.

    `at` is the same time as a part of the course.
    """
    force = force_of(stand, rest_of(forcing(shaking, i), u))
    contact = contact_of(pose.phase)
    if not is_landing(pose.phase, place):
        if slip_of(pose.phase) != 0.0 and place == 0:  # SLIP
            Y = corner(stand, side_sign(contact), pose.rotation)[1]
            pose = with_rates(pose, -pose.spin * Y, pose.y_rate, pose.spin)
        return into_phase(stand, pose, contact, force, pose.phase), False
    closed = landed(course, pose, place, at)
    rotation = 0.0 if closed == BOTH else pose.rotation
    y = -corner(stand, side_sign(closed), rotation)[1]
    pose = Pose(pose.phase, pose.x, y, rotation, pose.x_rate, pose.y_rate, pose.spin)
    pose, contact = after_impact(stand, pose, closed, force)
    turning = closed == BOTH and contact in (RIGHT, LEFT)
    if turning and stays_down(stand, pose, contact, force, shaking, i, u, peak):
        X, Y = corner(stand, side_sign(contact), 0.0)
        pose, contact = flat(stand, pose, corner_speeds(pose, X, Y)[0]), BOTH
    return into_phase(stand, pose, contact, force, -1), True


@routine
def cross_phases(
    pose: Pose,
    stand: Stand,
    shaking: Shaking,
    i: int,
    start: float,
    tally: Tally,
    log: Log,
    course: Course,
) -> tuple[Pose, Tally]:
    """Take a body through interval i of the motion, which begins at time `start`."""
    whole, h = forcing(shaking, i), shaking.time_step
    elapsed = 0.0
    impacts, changes, fallen_at = tally.impacts, tally.changes, -1.0
    for _ in range(EVENT_BUDGET):
        left = 1.0 - elapsed
        force = force_of(stand, rest_of(whole, elapsed))
        guards, part = lay_trusted(course, stand, pose, force, left * h)
        left *= part
        u, place = first_guard(course, pose.phase, guards)
        peak = peak_until(course, pose, u, tally.peak)
        if peak >= RIGHT_ANGLE:
            peak, u, place = RIGHT_ANGLE, fall_at(leaning(course, pose)[1]), NO_GUARD
            fallen_at = elapsed + u * left
        after = advanced(course, stand, pose, u, left * h)
        tally = tallied(course, stand, after, u, peak, place != NO_GUARD, tally)
        if fallen_at >= 0.0:
            pose = after
            break
        elapsed += u * left
        pose = after
        if place != NO_GUARD:
            pose, impact = after_guard(
                course, stand, after, place, u, shaking, i, elapsed, tally.peak
            )
            if impact:
                if impacts < log.impact_times.size:
                    log.impact_times[impacts] = start + elapsed * h
                impacts += 1
            if pose.phase != after.phase:
                write_change(log, changes, start + elapsed * h, pose.phase, place)
                changes += 1
        if elapsed >= 1.0:
            break
    return pose, Tally(
        tally.peak,
        tally.lift,
        tally.farthest_down,
        tally.farthest_up,
        impacts,
        changes,
        fallen_at,
        elapsed < 1.0 and fallen_at < 0.0,
    )
