"""Which phase follows: the one whose forces and accelerations are admissible (theory, section 3).

A contact presses, sticks inside its friction cone, or slips against its friction; a corner
without a force moves off. Candidates are tried in a fixed order: first those that stick, then
those that slip, then flight. The order matters only where several are admissible: between static
and kinetic friction, and in Painlevé's indeterminate case.

Symbols as in `contact`. Velocities of the corners in contact normal to the support are zero.
"""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.codes import (
    BOTH,
    FLIGHT,
    LEFT,
    NO_CONTACT,
    REST,
    RIGHT,
    phase_of,
    side_sign,
)
from shaketable.physics.plane.contact import (
    ContactBody,
    Force,
    Pose,
    Reaction,
    corner,
    corner_speeds,
    flat_pressures,
    jam_limit,
    slip,
    slip_arm,
    stick,
)

NONE = -1  # none of the phases tried is admissible
JAM_RIGHT = 100  # instead of a phase: this corner jams (Painlevé) and an impulse has to decide
JAM_LEFT = 101
SLACK = 1e-10  # m/s²: a force or an acceleration may miss its sign by this much
SLIP_SPEED = 1e-10  # m/s: a slower contact does not slip


@kernel
def in_cone(a: float, b: float, along: float, normal: float, slack: float) -> bool:
    """Whether |T| <= μ N."""
    return a * normal + slack >= b * abs(along)


@kernel
def sticks(body: ContactBody, reaction: Reaction, slack: float) -> bool:
    return reaction.normal >= -slack and in_cone(
        body.a_stick, body.b_stick, reaction.along, reaction.normal, slack
    )


@routine
def slips(
    body: ContactBody,
    X: float,
    Y: float,
    pose: Pose,
    sigma: float,
    moving: bool,
    force: Force,
    slack: float,
) -> tuple[bool, float]:
    """Whether a corner can slip in the direction sigma, and the spin rate ω' if it does.

    A contact that is not `moving` yet must be accelerated in that direction.
    """
    if (
        slip_arm(body, X, Y, sigma)[1] <= jam_limit(body, X, Y)
        or pose.spin * pose.spin * Y - force.normal <= 0.0
    ):
        return False, 0.0
    reaction = slip(body, X, Y, pose.spin, sigma, force)
    return moving or sigma * reaction.slip_rate >= -slack, reaction.spin_rate


@routine
def choose_on_corner(
    body: ContactBody, pose: Pose, contact: int, force: Force, ended: int, slack: float
) -> int:
    """The phase of a body on one corner; `ended` is a phase that is ruled out, or -1."""
    X, Y = corner(body, side_sign(contact), pose.rotation)
    speed = corner_speeds(pose, X, Y)[0]
    leaves = force.normal - pose.spin * pose.spin * Y >= -slack
    if abs(speed) > SLIP_SPEED:
        sigma = 1.0 if speed > 0.0 else -1.0
        phase = phase_of(contact, sigma)
        if phase != ended and slips(body, X, Y, pose, sigma, True, force, slack)[0]:
            return phase
        if not leaves and slack == 0.0:
            return NONE
        return FLIGHT if leaves else JAM_RIGHT if contact == RIGHT else JAM_LEFT
    reaction = stick(body, X, Y, pose.spin, force)
    still = phase_of(contact, 0.0)
    if still != ended and sticks(body, reaction, slack):
        return still
    likely = -1.0 if reaction.along > 0.0 else 1.0
    for sigma in (likely, -likely):
        phase = phase_of(contact, sigma)
        if phase != ended and slips(body, X, Y, pose, sigma, False, force, slack)[0]:
            return phase
    if not leaves and slack == 0.0:
        return NONE
    return FLIGHT if leaves else still


@routine
def flat_sticking(body: ContactBody, force: Force, ended: int, slack: float) -> int:
    """REST, or rocking from rest without slip; NONE if neither is admissible."""
    right, left = flat_pressures(body, -force.along, -force.normal)
    pressed = right >= -slack and left >= -slack
    if (
        ended != REST
        and pressed
        and in_cone(body.a_stick, body.b_stick, force.along, -force.normal, slack)
    ):
        return REST
    for contact in (RIGHT, LEFT):
        side = side_sign(contact)
        X, Y = corner(body, side, 0.0)
        reaction = stick(body, X, Y, 0.0, force)
        tips = side * reaction.spin_rate >= -slack
        if phase_of(contact, 0.0) != ended and tips and sticks(body, reaction, slack):
            return phase_of(contact, 0.0)
    return NONE


@routine
def flat_slipping(
    body: ContactBody,
    pose: Pose,
    sigma: float,
    moving: bool,
    force: Force,
    ended: int,
    slack: float,
) -> int:
    """Sliding in the direction sigma on the whole base or on a corner; a jam; or NONE."""
    if body.b_slip > 0.0:
        along = body.a_slip * sigma * force.normal / body.b_slip
        right, left = flat_pressures(body, along, -force.normal)
        pressed = right >= -slack and left >= -slack
        goes = moving or sigma * (force.along + along) >= -slack
        if phase_of(BOTH, sigma) != ended and pressed and goes:
            return phase_of(BOTH, sigma)
    jam = NONE
    for contact in (RIGHT, LEFT):
        side = side_sign(contact)
        X, Y = corner(body, side, 0.0)
        able, spin_rate = slips(body, X, Y, pose, sigma, moving, force, slack)
        if phase_of(contact, sigma) != ended and able and side * spin_rate >= -slack:
            return phase_of(contact, sigma)
        if (
            moving
            and force.normal < -SLACK
            and slip_arm(body, X, Y, sigma)[1] <= jam_limit(body, X, Y)
        ):
            jam = JAM_RIGHT if contact == RIGHT else JAM_LEFT
    return jam


@routine
def choose_flat(body: ContactBody, pose: Pose, force: Force, ended: int, slack: float) -> int:
    """The phase of a body that has both corners on the support and does not turn."""
    moving = abs(pose.x_rate) > SLIP_SPEED
    found = NONE if moving else flat_sticking(body, force, ended, slack)
    ahead = 1.0 if (pose.x_rate if moving else force.along) > 0.0 else -1.0
    if found == NONE:
        found = flat_slipping(body, pose, ahead, moving, force, ended, slack)
    if found == NONE and not moving:
        found = flat_slipping(body, pose, -ahead, moving, force, ended, slack)
    if found == NONE and slack > 0.0:
        found = FLIGHT if force.normal >= -slack else REST
    return found


@routine
def choose(body: ContactBody, pose: Pose, contact: int, force: Force, ended: int) -> int:
    """The phase of a body with the given contact, or JAM_RIGHT or JAM_LEFT.

    A phase that is exactly admissible goes before one that is admissible only to round-off: where
    all forces are about to vanish, every phase is, and the sign of the smallest force must decide.
    """
    if contact == NO_CONTACT:
        return FLIGHT
    phase = NONE
    for slack in (0.0, SLACK):
        if contact == BOTH:
            phase = choose_flat(body, pose, force, ended, slack)
        else:
            phase = choose_on_corner(body, pose, contact, force, ended, slack)
        if phase != NONE:
            break
    return phase
