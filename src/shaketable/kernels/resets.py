"""What follows when a guard has fired: complementarity for forces, an impact for a landing.

A phase that a guard has ended cannot follow itself. Endings of sequences that would go on for ever
(Zeno): a landing slower than `bounce_speed` does not bounce; a body that rocks in place settles as
in `events.settles`; one that slides settles when the corner that lifts is slower than
`settle_speed`. Verdicts do not hang on them (tests).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.kernels.codes import (
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
from shaketable.kernels.compiled import kernel, routine
from shaketable.kernels.complementarity import JAM_LEFT, JAM_RIGHT, SLIP_SPEED, choose
from shaketable.kernels.contact import (
    Force,
    Pose,
    Stand,
    corner,
    corner_speeds,
    force_of,
    on_corner,
)
from shaketable.kernels.course import GUARDS, Course, series
from shaketable.kernels.events import settles
from shaketable.kernels.guards import GUARD_SLACK
from shaketable.kernels.impact import arrest, collide, struck
from shaketable.kernels.rocking import Push, push_at, rest_of, side_of
from shaketable.kernels.taylor import value

MARGINAL = 1e-8  # m/s²: a slide that is slowed down by less goes on for ever
LEAVING = 1e-12  # m/s: a corner that lifts more slowly stays


class Shaking(NamedTuple):
    """A motion as one body meets it."""

    push: NDArray[np.float64]  # a_x [m/s²]
    gravity: NDArray[np.float64]  # g + a_y
    polarity: float  # factor on a_x
    time_step: float  # s


@kernel
def forcing(shaking: Shaking, i: int) -> Push:
    return push_at(shaking.push, shaking.gravity, shaking.polarity, i)


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
    if phase in (JAM_RIGHT, JAM_LEFT):
        contact = RIGHT if phase == JAM_RIGHT else LEFT
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
def after_impact(stand: Stand, pose: Pose, contact: int) -> tuple[Pose, int]:
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
    return RIGHT if guard_at(pose.phase, place) == GAP_RIGHT else LEFT


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
        if guard_at(pose.phase, place) == SLIP:
            Y = corner(stand, side_sign(contact), pose.rotation)[1]
            pose = with_rates(pose, -pose.spin * Y, pose.y_rate, pose.spin)
        return into_phase(stand, pose, contact, force, pose.phase), False
    closed = landed(course, pose, place, at)
    rotation = 0.0 if closed == BOTH else pose.rotation
    y = -corner(stand, side_sign(closed), rotation)[1]
    pose = Pose(pose.phase, pose.x, y, rotation, pose.x_rate, pose.y_rate, pose.spin)
    pose, contact = after_impact(stand, pose, closed)
    turning = closed == BOTH and contact in (RIGHT, LEFT)
    if turning and stays_down(stand, pose, contact, force, shaking, i, u, peak):
        X, Y = corner(stand, side_sign(contact), 0.0)
        slips = abs(corner_speeds(pose, X, Y)[0]) > SLIP_SPEED
        # a body that slides on keeps its momentum: the corner's speed would change its energy
        pose, contact = flat(stand, pose, pose.x_rate if slips else 0.0), BOTH
    return into_phase(stand, pose, contact, force, -1), True


@routine
def let_go(stand: Stand, shaking: Shaking, rotation: float) -> Pose:
    """The pose of a body let go at `rotation`, with its corner where it is at rest."""
    force = force_of(stand, forcing(shaking, 0))
    if rotation == 0.0:
        upright = Pose(REST, 0.0, stand.h, 0.0, 0.0, 0.0, 0.0)
        return into_phase(stand, upright, BOTH, force, -1)
    contact = RIGHT if rotation > 0.0 else LEFT
    side = side_sign(contact)
    x = corner(stand, side, 0.0)[0] - corner(stand, side, rotation)[0]
    let = on_corner(stand, Pose(REST, x, 0.0, rotation, 0.0, 0.0, 0.0), side)
    return into_phase(stand, let, contact, force, -1)


@routine
def slides_on(stand: Stand, pose: Pose, shaking: Shaking, i: int) -> bool:
    """Whether a body slides under gravity alone and nothing slows it down."""
    sigma = slip_of(pose.phase)
    if contact_of(pose.phase) != BOTH or sigma == 0.0:
        return False
    force = force_of(stand, forcing(shaking, i))
    friction = sigma * stand.a_slip * force.normal
    return sigma * (stand.b_slip * force.along + friction) >= -MARGINAL
