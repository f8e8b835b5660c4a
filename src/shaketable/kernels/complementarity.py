"""Which phase follows: the one whose forces and accelerations are admissible (physics.md 3).

A contact presses, sticks inside its friction cone, or slips against its friction; a corner
without a force moves off. Candidates are tried in a fixed order: what sticks first, then what
slips, then flight. It only matters where several are admissible: between static and kinetic
friction, and in Painlevé's indeterminate case.

Symbols as in `contact`. Velocities of the corners in contact normal to the support are zero.
"""

from __future__ import annotations

from shaketable.kernels.codes import (
    BOTH,
    FLIGHT,
    LEFT,
    NO_CONTACT,
    REST,
    RIGHT,
    phase_of,
    side_sign,
)
from shaketable.kernels.compiled import kernel, routine
from shaketable.kernels.contact import (
    Pose,
    Reaction,
    Stand,
    corner,
    corner_speeds,
    flat_pressures,
    jam_limit,
    slip,
    slip_arm,
    stick,
)

NONE = -1  # of the phases tried
JAM_RIGHT = 100  # instead of a phase: this corner jams (Painlevé), an impulse has to decide
JAM_LEFT = 101
SLACK = 1e-10  # m/s²: by so much a force or an acceleration may miss its sign
SLIP_SPEED = 1e-10  # m/s: a slower contact does not slip


@kernel
def in_cone(a: float, b: float, along: float, normal: float, slack: float) -> bool:
    """Whether |T| <= μ N."""
    return a * normal + slack >= b * abs(along)


@kernel
def sticks(stand: Stand, reaction: Reaction, slack: float) -> bool:
    return reaction.normal >= -slack and in_cone(
        stand.a_stick, stand.b_stick, reaction.along, reaction.normal, slack
    )


@routine
def slips(
    stand: Stand,
    X: float,
    Y: float,
    pose: Pose,
    sigma: float,
    moving: bool,
    f_t: float,
    f_n: float,
    slack: float,
) -> tuple[bool, float]:
    """Whether a corner can slip in the direction sigma, and the spin rate ω' if it does.

    A contact that is not `moving` yet must be accelerated that way.
    """
    if (
        slip_arm(stand, X, Y, sigma)[1] <= jam_limit(stand, X, Y)
        or pose.spin * pose.spin * Y - f_n <= 0.0
    ):
        return False, 0.0
    reaction = slip(stand, X, Y, pose.spin, sigma, f_t, f_n)
    return moving or sigma * reaction.slip_rate >= -slack, reaction.spin_rate


@routine
def choose_on_corner(
    stand: Stand, pose: Pose, contact: int, f_t: float, f_n: float, ended: int, slack: float
) -> int:
    """The phase of a body on one corner; `ended` is a phase that it cannot be, or -1."""
    X, Y = corner(stand, side_sign(contact), pose.rotation)
    speed = corner_speeds(pose, X, Y)[0]
    leaves = f_n - pose.spin * pose.spin * Y >= -slack
    if abs(speed) > SLIP_SPEED:
        sigma = 1.0 if speed > 0.0 else -1.0
        phase = phase_of(contact, sigma)
        if phase != ended and slips(stand, X, Y, pose, sigma, True, f_t, f_n, slack)[0]:
            return phase
        if not leaves and slack == 0.0:
            return NONE
        return FLIGHT if leaves else JAM_RIGHT if contact == RIGHT else JAM_LEFT
    reaction = stick(stand, X, Y, pose.spin, f_t, f_n)
    still = phase_of(contact, 0.0)
    if still != ended and sticks(stand, reaction, slack):
        return still
    likely = -1.0 if reaction.along > 0.0 else 1.0
    for sigma in (likely, -likely):
        phase = phase_of(contact, sigma)
        if phase != ended and slips(stand, X, Y, pose, sigma, False, f_t, f_n, slack)[0]:
            return phase
    if not leaves and slack == 0.0:
        return NONE
    return FLIGHT if leaves else still


@routine
def flat_sticking(stand: Stand, f_t: float, f_n: float, ended: int, slack: float) -> int:
    """REST, or rocking off without slip; NONE if neither is admissible."""
    right, left = flat_pressures(stand, -f_t, -f_n)
    pressed = right >= -slack and left >= -slack
    if ended != REST and pressed and in_cone(stand.a_stick, stand.b_stick, f_t, -f_n, slack):
        return REST
    for contact in (RIGHT, LEFT):
        side = side_sign(contact)
        X, Y = corner(stand, side, 0.0)
        reaction = stick(stand, X, Y, 0.0, f_t, f_n)
        tips = side * reaction.spin_rate >= -slack
        if phase_of(contact, 0.0) != ended and tips and sticks(stand, reaction, slack):
            return phase_of(contact, 0.0)
    return NONE


@routine
def flat_slipping(
    stand: Stand,
    pose: Pose,
    sigma: float,
    moving: bool,
    f_t: float,
    f_n: float,
    ended: int,
    slack: float,
) -> int:
    """Sliding in the direction sigma on the whole base or on a corner; a jam; or NONE."""
    if stand.b_slip > 0.0:
        along = stand.a_slip * sigma * f_n / stand.b_slip
        right, left = flat_pressures(stand, along, -f_n)
        pressed = right >= -slack and left >= -slack
        goes = moving or sigma * (f_t + along) >= -slack
        if phase_of(BOTH, sigma) != ended and pressed and goes:
            return phase_of(BOTH, sigma)
    jam = NONE
    for contact in (RIGHT, LEFT):
        side = side_sign(contact)
        X, Y = corner(stand, side, 0.0)
        able, spin_rate = slips(stand, X, Y, pose, sigma, moving, f_t, f_n, slack)
        if phase_of(contact, sigma) != ended and able and side * spin_rate >= -slack:
            return phase_of(contact, sigma)
        if moving and f_n < -SLACK and slip_arm(stand, X, Y, sigma)[1] <= jam_limit(stand, X, Y):
            jam = JAM_RIGHT if contact == RIGHT else JAM_LEFT
    return jam


@routine
def choose_flat(stand: Stand, pose: Pose, f_t: float, f_n: float, ended: int, slack: float) -> int:
    """The phase of a body with both corners on the support that does not turn."""
    moving = abs(pose.x_rate) > SLIP_SPEED
    found = NONE if moving else flat_sticking(stand, f_t, f_n, ended, slack)
    ahead = 1.0 if (pose.x_rate if moving else f_t) > 0.0 else -1.0
    if found == NONE:
        found = flat_slipping(stand, pose, ahead, moving, f_t, f_n, ended, slack)
    if found == NONE and not moving:
        found = flat_slipping(stand, pose, -ahead, moving, f_t, f_n, ended, slack)
    if found == NONE and slack > 0.0:
        found = FLIGHT if f_n >= -slack else REST
    return found


@routine
def choose(stand: Stand, pose: Pose, contact: int, f_t: float, f_n: float, ended: int) -> int:
    """The phase of a body with the given contact, or JAM_RIGHT, JAM_LEFT.

    What is admissible exactly goes before what is so to round-off: where all forces are about to
    vanish everything is, and the sign of the smallest must decide.
    """
    if contact == NO_CONTACT:
        return FLIGHT
    phase = NONE
    for slack in (0.0, SLACK):
        if contact == BOTH:
            phase = choose_flat(stand, pose, f_t, f_n, ended, slack)
        else:
            phase = choose_on_corner(stand, pose, contact, f_t, f_n, ended, slack)
        if phase != NONE:
            break
    return phase
