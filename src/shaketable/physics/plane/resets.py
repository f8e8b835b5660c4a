"""What follows when a guard has fired: complementarity for forces, an impact for a landing.

A phase that a guard has ended cannot follow itself. Sequences that would go on for ever (Zeno) are
cut short: a landing slower than `bounce_speed` does not bounce; a body that rocks in place settles
as in `events.settles`; one that slides settles when the corner that lifts is slower than
`settle_speed`. Verdicts do not depend on this (tests).
"""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.codes import (
    BOTH,
    FLIGHT,
    GAP_RIGHT,
    LEFT,
    NO_CONTACT,
    REST,
    RIGHT,
    SLIP,
    contact_of,
    guard_at,
    is_landing,
    side_sign,
    slip_of,
)
from shaketable.physics.plane.complementarity import JAM_LEFT, JAM_RIGHT, SLIP_SPEED, choose
from shaketable.physics.plane.contact import (
    ContactBody,
    Force,
    Pose,
    corner,
    corner_speeds,
    force_of,
    on_corner,
)
from shaketable.physics.plane.events import settles
from shaketable.physics.plane.forcing import Instant, Shaking, forcing_at, forcing_from
from shaketable.physics.plane.guards import GUARD_SLACK
from shaketable.physics.plane.impact import arrest, collide, lossy, struck
from shaketable.physics.plane.phase_series import GUARDS, SeriesTable, series
from shaketable.physics.plane.rocking import side_of
from shaketable.physics.plane.taylor import value

MARGINAL = 1e-8  # m/s²: a slide that is slowed down by less goes on for ever
LEAVING = 1e-12  # m/s: a corner that lifts more slowly stays


@kernel
def with_rates(pose: Pose, x_rate: float, y_rate: float, spin: float) -> Pose:
    return Pose(pose.phase, pose.x, pose.y, pose.rotation, x_rate, y_rate, spin)


@kernel
def flat(body: ContactBody, pose: Pose, x_rate: float) -> Pose:
    """The pose with its whole base on the support."""
    return Pose(pose.phase, pose.x, body.h, 0.0, x_rate, 0.0, 0.0)


@routine
def into_phase(body: ContactBody, pose: Pose, contact: int, force: Force, ended: int) -> Pose:
    """The pose in the phase that contact and forces admit (`complementarity`).

    A slipping corner that jams (Painlevé) stops at once, by an impulse inside its friction cone.
    """
    phase = choose(body, pose, contact, force, ended)
    if phase in (JAM_RIGHT, JAM_LEFT):
        contact = RIGHT if phase == JAM_RIGHT else LEFT
        X, Y = corner(body, side_sign(contact), pose.rotation)
        along, normal = arrest(body, pose, X, Y, 0.0)
        x_rate, y_rate, spin = struck(body, pose, X, Y, along, normal)
        pose = with_rates(pose, x_rate, y_rate, spin)
        phase = choose(body, pose, contact, force, -1)
    x_rate = pose.x_rate
    if slip_of(phase) == 0.0 and phase != FLIGHT:  # a contact that sticks has no slip at all
        side = side_sign(contact_of(phase))
        x_rate = 0.0 if side == 0.0 else -pose.spin * corner(body, side, pose.rotation)[1]
    return Pose(phase, pose.x, pose.y, pose.rotation, x_rate, pose.y_rate, pose.spin)


@routine
def after_impact(body: ContactBody, pose: Pose, contact: int) -> tuple[Pose, int]:
    """The pose after the impact of the closed corners, and the contact that is left."""
    rebound = collide(body, pose, contact)
    pose = with_rates(pose, rebound.x_rate, rebound.y_rate, rebound.spin)
    left = NO_CONTACT
    for side in (1.0, -1.0):
        own = RIGHT if side > 0.0 else LEFT
        if contact in (BOTH, own):
            X, Y = corner(body, side, pose.rotation)
            if corner_speeds(pose, X, Y)[1] <= LEAVING:
                left = own if left == NO_CONTACT else BOTH
    if left == BOTH:
        return flat(body, pose, pose.x_rate), left
    if left != NO_CONTACT:
        if contact == BOTH:
            pose = lossy(body, pose, side_sign(left))
        pose = on_corner(body, pose, side_sign(left))
    return pose, left


@routine
def stays_down(
    body: ContactBody,
    pose: Pose,
    contact: int,
    force: Force,
    shaking: Shaking,
    at: Instant,
    peak: float,
) -> bool:
    """Whether a flat body that turns about a corner after an impact may as well stay flat."""
    speed = abs(pose.spin)
    X, Y = corner(body, side_sign(contact), 0.0)
    if abs(corner_speeds(pose, X, Y)[0]) <= SLIP_SPEED:
        side = side_sign(contact)
        return settles(
            speed,
            side_of(body.block, side),
            side_of(body.block, -side),
            shaking,
            at,
            peak,
        )
    if speed * (body.right + body.left) > body.settle_speed:
        return False
    level = flat(body, pose, pose.x_rate)
    return contact_of(choose(body, level, BOTH, force, -1)) == BOTH


@kernel
def landed(table: SeriesTable, pose: Pose, place: int, u: float) -> int:
    """The corners that are on the support when a LANDING or GAP guard has fired."""
    if contact_of(pose.phase) != NO_CONTACT:
        return BOTH
    other = value(series(table, GUARDS + 1 - place), u)
    if other <= 2.0 * GUARD_SLACK:
        return BOTH
    return RIGHT if guard_at(pose.phase, place) == GAP_RIGHT else LEFT


@routine
def after_guard(
    table: SeriesTable,
    body: ContactBody,
    pose: Pose,
    place: int,
    u: float,
    shaking: Shaking,
    at: Instant,
    peak: float,
) -> tuple[Pose, bool]:
    """The pose after the guard at `place` in its phase's row has fired, and whether by an impact.

    The guard fired `at` an instant of the motion, which is at u in the table's span.
    """
    force = force_of(body, forcing_from(shaking, at))
    contact = contact_of(pose.phase)
    if not is_landing(pose.phase, place):
        if guard_at(pose.phase, place) == SLIP:
            Y = corner(body, side_sign(contact), pose.rotation)[1]
            pose = with_rates(pose, -pose.spin * Y, pose.y_rate, pose.spin)
        return into_phase(body, pose, contact, force, pose.phase), False
    closed = landed(table, pose, place, u)
    rotation = 0.0 if closed == BOTH else pose.rotation
    y = -corner(body, side_sign(closed), rotation)[1]
    pose = Pose(pose.phase, pose.x, y, rotation, pose.x_rate, pose.y_rate, pose.spin)
    pose, contact = after_impact(body, pose, closed)
    turning = closed == BOTH and contact in (RIGHT, LEFT)
    if turning and stays_down(body, pose, contact, force, shaking, at, peak):
        X, Y = corner(body, side_sign(contact), 0.0)
        slips = abs(corner_speeds(pose, X, Y)[0]) > SLIP_SPEED
        # a body that slides on keeps its momentum: the speed of the corner would change its energy
        pose, contact = flat(body, pose, pose.x_rate if slips else 0.0), BOTH
    return into_phase(body, pose, contact, force, -1), True


@routine
def let_go(body: ContactBody, shaking: Shaking, rotation: float) -> Pose:
    """The pose of a body let go at `rotation`, with its corner where it is when at rest."""
    force = force_of(body, forcing_at(shaking, 0, 1.0))
    if rotation == 0.0:
        upright = Pose(REST, 0.0, body.h, 0.0, 0.0, 0.0, 0.0)
        return into_phase(body, upright, BOTH, force, -1)
    contact = RIGHT if rotation > 0.0 else LEFT
    side = side_sign(contact)
    x = corner(body, side, 0.0)[0] - corner(body, side, rotation)[0]
    let = on_corner(body, Pose(REST, x, 0.0, rotation, 0.0, 0.0, 0.0), side)
    return into_phase(body, let, contact, force, -1)


@routine
def slides_on(body: ContactBody, pose: Pose, shaking: Shaking, i: int) -> bool:
    """Whether a body slides under gravity alone and nothing slows it down."""
    sigma = slip_of(pose.phase)
    if contact_of(pose.phase) != BOTH or sigma == 0.0:
        return False
    force = force_of(body, forcing_at(shaking, i, 1.0))
    friction = sigma * body.a_slip * force.normal
    return sigma * (body.b_slip * force.along + friction) >= -MARGINAL
