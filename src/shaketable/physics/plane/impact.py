"""Impact of one or both corners: Newton's restitution, Coulomb's friction (theory, section 4).

At each closed corner the normal velocity after the impact is at least its target, e times the
speed of approach, and equals it where there is an impulse; the tangential impulse stays in the
friction cone, and lies on it, against the slip, where the corner slips afterwards. Both corners
are solved together. Their tangential velocities are the same, so that there are only ten modes:
no impulse, or impulses at both, the right or the left corner, with sticking or slip either way.
They are tried in this order and the first admissible one holds.

With e = 0 no such impact raises the energy. With e > 0 and friction Newton's law can (Kane &
Levinson 1985); e is then lowered to the largest value that does not.

Impulses (P, Q) along and normal are per unit mass [m/s], other symbols as in `contact`.
"""

from __future__ import annotations

from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.codes import BOTH, LEFT, NO_CONTACT, RIGHT, side_sign
from shaketable.physics.plane.contact import ContactBody, Pose, corner, corner_speeds

ROUND_OFF = 1e-12  # of the speeds involved
ENERGY_SLACK = 1e-12  # of the energy
HALVINGS = 50


class Rebound(NamedTuple):
    """Velocities after an impact, and the corners at which there was an impulse."""

    x_rate: float
    y_rate: float
    spin: float
    contact: int
    sticks: bool
    found: bool


@kernel
def energy(body: ContactBody, x_rate: float, y_rate: float, spin: float) -> float:
    """Kinetic energy per unit mass [m²/s²]."""
    return 0.5 * (x_rate * x_rate + y_rate * y_rate + body.i2 * spin * spin)


@kernel
def struck(
    body: ContactBody, pose: Pose, X: float, Y: float, along: float, normal: float
) -> tuple[float, float, float]:
    """x', y', ω after the impulse (along, normal) at the offset (X, Y)."""
    return (
        pose.x_rate + along,
        pose.y_rate + normal,
        pose.spin + (Y * along - X * normal) / body.i2,
    )


@routine
def arrest(body: ContactBody, pose: Pose, X: float, Y: float, target: float) -> tuple[float, float]:
    """Impulse (P, Q) after which the corner has no slip and the normal velocity `target`."""
    along, normal = corner_speeds(pose, X, Y)
    m_tt, m_nn = 1.0 + Y * Y / body.i2, 1.0 + X * X / body.i2
    m_tn = -X * Y / body.i2
    determinant = 1.0 + (X * X + Y * Y) / body.i2
    d_t, d_n = -along, target - normal
    return (m_nn * d_t - m_tn * d_n) / determinant, (m_tt * d_n - m_tn * d_t) / determinant


@routine
def at_one(
    body: ContactBody,
    pose: Pose,
    contact: int,
    target: float,
    sigma: float,
    slack: float,
) -> Rebound:
    """Impulse at one corner that sticks (sigma 0) or slips; `found` says if it is admissible."""
    X, Y = corner(body, side_sign(contact), pose.rotation)
    if sigma == 0.0:
        along, normal = arrest(body, pose, X, Y, target)
        fits = body.b_stick * abs(along) <= body.a_stick * normal + slack
    else:
        missing = target - corner_speeds(pose, X, Y)[1]
        per_size = body.b_slip * (1.0 + X * X / body.i2)
        per_size += body.a_slip * sigma * X * Y / body.i2
        size = missing / per_size if per_size > 0.0 else -1.0
        along, normal = -body.a_slip * sigma * size, body.b_slip * size
        fits = size >= -slack
    x_rate, y_rate, spin = struck(body, pose, X, Y, along, normal)
    fits = fits and normal >= -slack and sigma * (x_rate + spin * Y) >= -slack
    return Rebound(x_rate, y_rate, spin, contact, sigma == 0.0, fits)


@routine
def at_both(
    body: ContactBody,
    pose: Pose,
    right_target: float,
    left_target: float,
    sigma: float,
    slack: float,
) -> Rebound:
    """Impulses at both corners of a flat body that stick (sigma 0) or slip."""
    base = body.right + body.left
    spin = (left_target - right_target) / base
    y_rate = right_target + spin * body.right
    normal = y_rate - pose.y_rate
    if sigma == 0.0:
        along = spin * body.h - pose.x_rate
        fits = body.b_stick * abs(along) <= body.a_stick * normal + slack
    else:
        along = -body.a_slip * sigma * normal / body.b_slip if body.b_slip > 0.0 else 0.0
        fits = body.b_slip > 0.0 and sigma * (pose.x_rate + along - spin * body.h) >= -slack
    turn = body.h * along + body.i2 * (spin - pose.spin)
    right = (body.left * normal - turn) / base
    left = (body.right * normal + turn) / base
    fits = fits and right >= -slack and left >= -slack
    return Rebound(pose.x_rate + along, y_rate, spin, BOTH, sigma == 0.0, fits)


@kernel
def target(speed: float, restitution: float, bounce_speed: float) -> float:
    """Least normal velocity after an impact of a corner that has the normal velocity `speed`."""
    return -restitution * speed if speed < -bounce_speed else 0.0


@routine
def solve(body: ContactBody, pose: Pose, contact: int, restitution: float) -> Rebound:
    """The admissible mode of an impact at the closed corners."""
    X_r, Y_r = corner(body, 1.0, pose.rotation)
    X_l, Y_l = corner(body, -1.0, pose.rotation)
    v_r = corner_speeds(pose, X_r, Y_r)[1]
    v_l = corner_speeds(pose, X_l, Y_l)[1]
    t_r = target(v_r, restitution, body.bounce_speed)
    t_l = target(v_l, restitution, body.bounce_speed)
    reach = abs(X_r) + abs(X_l) + abs(Y_r) + abs(Y_l)
    slack = ROUND_OFF * (abs(pose.x_rate) + abs(pose.y_rate) + abs(pose.spin) * reach)
    right_closed, left_closed = contact != LEFT, contact != RIGHT
    if not (right_closed and v_r < t_r) and not (left_closed and v_l < t_l):
        return Rebound(pose.x_rate, pose.y_rate, pose.spin, NO_CONTACT, False, True)
    first = 1.0 if pose.x_rate + pose.spin * Y_r > 0.0 else -1.0
    for sigma in (0.0, first, -first):
        if contact == BOTH:
            both = at_both(body, pose, t_r, t_l, sigma, slack)
            if both.found:
                return both
        if right_closed:
            one = at_one(body, pose, RIGHT, t_r, sigma, slack)
            if one.found and not (left_closed and one.y_rate - one.spin * X_l < t_l - slack):
                return one
        if left_closed:
            one = at_one(body, pose, LEFT, t_l, sigma, slack)
            if one.found and not (right_closed and one.y_rate - one.spin * X_r < t_r - slack):
                return one
    return Rebound(pose.x_rate, pose.y_rate, pose.spin, contact, False, False)


@routine
def collide(body: ContactBody, pose: Pose, contact: int) -> Rebound:
    """The impact at the closed corners, with the restitution that its energy allows."""
    after = solve(body, pose, contact, body.normal_restitution)
    if body.normal_restitution == 0.0:
        return after
    allowed = energy(body, pose.x_rate, pose.y_rate, pose.spin) * (1.0 + ENERGY_SLACK)
    if energy(body, after.x_rate, after.y_rate, after.spin) <= allowed and after.found:
        return after
    low, high = 0.0, body.normal_restitution
    after = solve(body, pose, contact, 0.0)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        trial = solve(body, pose, contact, middle)
        if energy(body, trial.x_rate, trial.y_rate, trial.spin) <= allowed and trial.found:
            low, after = middle, trial
        else:
            high = middle
    return after


@routine
def lossy(body: ContactBody, pose: Pose, side: float) -> Pose:
    """The pose after a rocking impact, its spin multiplied by the restitution factor.

    The corner on that side stays closed and keeps its velocity, and that of the centre of gravity
    follows. With a corner that slips, part of the energy does not fall with the spin: below the
    spin ω* of least energy at this velocity of the corner, less spin would mean more energy. The
    factor is then raised to the least one that adds no energy, 2 ω*/ω - 1.
    """
    factor = body.restitution_factor
    if factor == 1.0:
        return pose
    X, Y = corner(body, side, pose.rotation)
    along, normal = corner_speeds(pose, X, Y)
    calmest = (Y * along - X * normal) / (body.i2 + X * X + Y * Y)
    if pose.spin != 0.0:
        factor = min(1.0, max(factor, 2.0 * calmest / pose.spin - 1.0))
    spin = factor * pose.spin
    return Pose(
        pose.phase, pose.x, pose.y, pose.rotation, along - spin * Y, normal + spin * X, spin
    )
