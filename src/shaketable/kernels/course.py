"""Taylor series of a body's motion in its phase, and of the guards that end it.

Between two samples f_t and f_n are linear in time; with u ∈ [0, 1] the time over a span h every
phase of `phases.TABLE` is an ordinary differential equation whose coefficients follow one from
the other (symbols and equations: `contact`; physics.md section 3):

    all        X' = W Y,  Y' = -W X,  θ' = W = h ω
    ROCK       W' = h² (X f_n - Y f_t)/(i² + X² + Y²),  T = -X''/h² - f_t,  N = -Y''/h² - f_n
    SLIDE_ROCK λ = (ω² Y - f_n)/(b + X A/i²),  W' = -h² A λ/i²,  x'' = h² (f_t - a σ λ)
    SLIDE      x'' = h² (f_t + μ_k σ f_n)
    FLIGHT     x'' = h² f_t,  y'' = h² f_n,  W constant

A course is a table of coefficients 0 to 9, a row for each quantity. Guards stand from row GUARDS
on, in the order of their phase in `phases.TABLE`, each over its own unit.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.kernels.codes import (
    BOTH,
    MOST_GUARDS,
    NO_CONTACT,
    contact_of,
    side_sign,
    slip_of,
)
from shaketable.kernels.compiled import kernel, routine
from shaketable.kernels.contact import Force, Pose, Stand, corner, flat_pressures, jam_limit
from shaketable.kernels.taylor import Series

TERMS = 10
ROTATION, SPIN, ALONG, NORMAL = range(4)  # θ, W, x, y
GUARDS = 4  # the first of their rows
ROWS = GUARDS + MOST_GUARDS + 8
X_ROW, Y_ROW, OTHER_X, OTHER_Y, ARM, RATIO, SIZE, SQUARE = range(GUARDS + MOST_GUARDS, ROWS)
TRUNCATION = 1e-13  # rad: the largest last term of a rotation that is good enough
Course = NDArray[np.float64]


@kernel
def series(course: Course, row: int) -> Series:
    c = course[row]
    return Series(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9])


@kernel
def product(course: Course, one: int, two: int, k: int) -> float:
    """Coefficient k of the product of two rows."""
    total = 0.0
    for j in range(k + 1):
        total += course[one, j] * course[two, k - j]
    return total


@kernel
def times_force(course: Course, row: int, at_start: float, change: float, k: int) -> float:
    """Coefficient k of a row times a linear force."""
    of_start: float = course[row, k] * at_start
    return of_start + (course[row, k - 1] * change if k > 0 else 0.0)


@kernel
def term(at_start: float, change: float, k: int) -> float:
    """Coefficient k of a linear force."""
    return at_start if k == 0 else change if k == 1 else 0.0


@routine
def lay_turn(course: Course, k: int) -> None:
    """Coefficient k + 1 of θ, X and Y from those up to k."""
    over = 1.0 / (k + 1)
    course[ROTATION, k + 1] = course[SPIN, k] * over
    course[X_ROW, k + 1] = product(course, SPIN, Y_ROW, k) * over
    course[Y_ROW, k + 1] = -product(course, SPIN, X_ROW, k) * over


@routine
def lay_rock(course: Course, stand: Stand, pose: Pose, side: float, force: Force, h: float) -> None:
    X, Y = corner(stand, side, pose.rotation)
    course[X_ROW, 0], course[Y_ROW, 0] = X, Y
    turn = h * h / (stand.i2 + X * X + Y * Y)
    for k in range(TERMS - 1):
        lay_turn(course, k)
        moment = times_force(course, X_ROW, force.normal, force.normal_change, k)
        moment -= times_force(course, Y_ROW, force.along, force.along_change, k)
        course[SPIN, k + 1] = turn * moment / (k + 1)
    over = 1.0 / (h * h)
    for k in range(TERMS):
        # no term of order 8 or 9: two derivatives were taken
        along = normal = 0.0
        if k + 2 < TERMS:
            twice = over * (k + 1) * (k + 2)
            along = -twice * course[X_ROW, k + 2]
            normal = -twice * course[Y_ROW, k + 2]
        along -= term(force.along, force.along_change, k)
        normal -= term(force.normal, force.normal_change, k)
        course[GUARDS, k] = stand.a_stick * normal + stand.b_stick * along
        course[GUARDS + 1, k] = stand.a_stick * normal - stand.b_stick * along
        course[GUARDS + 2, k] = side * course[ROTATION, k]
        course[ALONG, k] = -course[X_ROW, k]
    course[ALONG, 0] += pose.x + X


@routine
def lay_slide_rock(
    course: Course, stand: Stand, pose: Pose, side: float, sigma: float, force: Force, h: float
) -> None:
    X, Y = corner(stand, side, pose.rotation)
    course[X_ROW, 0], course[Y_ROW, 0] = X, Y
    course[ALONG, 0], course[ALONG, 1] = pose.x, h * pose.x_rate
    pressure, over_h2 = GUARDS + 1, 1.0 / (h * h)
    for k in range(TERMS):
        course[ARM, k] = stand.b_slip * course[X_ROW, k] + stand.a_slip * sigma * course[Y_ROW, k]
        course[RATIO, k] = product(course, X_ROW, ARM, k) / stand.i2
        course[SQUARE, k] = product(course, SPIN, SPIN, k)
        course[pressure, k] = product(course, SQUARE, Y_ROW, k) * over_h2
        course[pressure, k] -= term(force.normal, force.normal_change, k)
        if k == 0:
            course[RATIO, 0] += stand.b_slip
        size = course[pressure, k]
        for j in range(1, k + 1):
            size -= course[RATIO, j] * course[SIZE, k - j]
        course[SIZE, k] = size / course[RATIO, 0]
        if k + 1 < TERMS:
            lay_turn(course, k)
            turn = product(course, ARM, SIZE, k)
            course[SPIN, k + 1] = -h * h / stand.i2 * turn / (k + 1)
        if k + 2 < TERMS:
            along = term(force.along, force.along_change, k)
            along -= stand.a_slip * sigma * course[SIZE, k]
            course[ALONG, k + 2] = h * h * along / ((k + 1) * (k + 2))
    for k in range(TERMS):
        moved = course[ALONG, k + 1] + course[X_ROW, k + 1] if k + 1 < TERMS else 0.0
        course[GUARDS, k] = sigma * (k + 1) * moved / h
        course[GUARDS + 2, k] = course[RATIO, k]
        course[GUARDS + 3, k] = side * course[ROTATION, k]
    course[GUARDS + 2, 0] -= jam_limit(stand, X, Y)


@routine
def lay_flat(
    course: Course, stand: Stand, pose: Pose, sigma: float, force: Force, h: float
) -> None:
    """REST and SLIDE: forces are linear, and so are their guards."""
    course[ALONG, 0] = pose.x
    ratio = stand.a_slip / stand.b_slip if stand.b_slip > 0.0 else 0.0
    for k in range(2):
        along = term(force.along, force.along_change, k)
        normal = -term(force.normal, force.normal_change, k)
        held = -along if sigma == 0.0 else -ratio * sigma * normal
        right, left = flat_pressures(stand, held, normal)
        if sigma == 0.0:
            course[GUARDS, k] = stand.a_stick * normal + stand.b_stick * held
            course[GUARDS + 1, k] = stand.a_stick * normal - stand.b_stick * held
            course[GUARDS + 2, k], course[GUARDS + 3, k] = right, left
        else:
            course[ALONG, k + 2] = h * h * (along + held) / ((k + 1) * (k + 2))
            course[GUARDS + 1, k], course[GUARDS + 2, k] = right, left
    if sigma != 0.0:
        course[ALONG, 1] = h * pose.x_rate
        for k in range(3):
            course[GUARDS, k] = sigma * (k + 1) * course[ALONG, k + 1] / h


@routine
def lay_flight(course: Course, stand: Stand, pose: Pose, force: Force, h: float) -> None:
    course[X_ROW, 0], course[Y_ROW, 0] = corner(stand, 1.0, pose.rotation)
    course[OTHER_X, 0], course[OTHER_Y, 0] = corner(stand, -1.0, pose.rotation)
    course[ALONG, 0], course[ALONG, 1] = pose.x, h * pose.x_rate
    course[NORMAL, 0], course[NORMAL, 1] = pose.y, h * pose.y_rate
    for k in range(2):
        each = h * h / ((k + 1) * (k + 2))
        course[ALONG, k + 2] = each * term(force.along, force.along_change, k)
        course[NORMAL, k + 2] = each * term(force.normal, force.normal_change, k)
    turn = course[SPIN, 0]
    course[ROTATION, 1] = turn
    for k in range(TERMS - 1):
        each = turn / (k + 1)
        course[X_ROW, k + 1] = each * course[Y_ROW, k]
        course[Y_ROW, k + 1] = -each * course[X_ROW, k]
        course[OTHER_X, k + 1] = each * course[OTHER_Y, k]
        course[OTHER_Y, k + 1] = -each * course[OTHER_X, k]
    for k in range(TERMS):
        course[GUARDS, k] = course[NORMAL, k] + course[Y_ROW, k]
        course[GUARDS + 1, k] = course[NORMAL, k] + course[OTHER_Y, k]


@routine
def lay(course: Course, stand: Stand, pose: Pose, force: Force, h: float) -> None:
    """Write the course of a pose over a span h."""
    course[:] = 0.0
    course[ROTATION, 0], course[SPIN, 0] = pose.rotation, h * pose.spin
    contact, sigma = contact_of(pose.phase), slip_of(pose.phase)
    if contact == NO_CONTACT:
        lay_flight(course, stand, pose, force, h)
    elif contact == BOTH:
        course[SPIN, 0] = 0.0
        lay_flat(course, stand, pose, sigma, force, h)
    elif sigma == 0.0:
        lay_rock(course, stand, pose, side_sign(contact), force, h)
    else:
        lay_slide_rock(course, stand, pose, side_sign(contact), sigma, force, h)


@routine
def trusted(course: Course, size: float) -> float:
    """The largest part of the span, at most 1, over which the course is at round-off.

    Its last terms are then below TRUNCATION; `size` makes an angle of the corners' offsets.
    """
    last = max(
        max(abs(course[ROTATION, 9]), 0.1 * abs(course[ROTATION, 8])),
        max(abs(course[X_ROW, 9]), 0.1 * abs(course[X_ROW, 8])) / size,
    )
    if last <= TRUNCATION:
        return 1.0
    return 0.9 * math.pow(TRUNCATION / last, 1.0 / 9.0)
