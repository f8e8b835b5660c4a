"""Taylor series of a body's motion in its phase, and of the guards that end it.

Between two samples f_t and f_n are linear in time; with u ∈ [0, 1] the time over a span h every
phase of `phases.TABLE` obeys an ordinary differential equation, so that the coefficients of its
series follow one from another (symbols and equations: `contact`; theory, section 3):

    all        X' = W Y,  Y' = -W X,  θ' = W = h ω
    ROCK       W' = h² (X f_n - Y f_t)/(i² + X² + Y²),  T = -X''/h² - f_t,  N = -Y''/h² - f_n
    SLIDE_ROCK λ = (ω² Y - f_n)/(b + X A/i²),  W' = -h² A λ/i²,  x'' = h² (f_t - a σ λ)
    SLIDE      x'' = h² (f_t + μ_k σ f_n)
    FLIGHT     x'' = h² f_t,  y'' = h² f_n,  W constant

A table holds coefficients 0 to 9, with a row for each quantity. Guards are in the rows from GUARDS
on, in the order that `phases.TABLE` gives for their phase, each in its own unit.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.codes import (
    BOTH,
    MOST_GUARDS,
    NO_CONTACT,
    contact_of,
    side_sign,
    slip_of,
)
from shaketable.physics.plane.contact import (
    ContactBody,
    Force,
    Pose,
    corner,
    flat_pressures,
    jam_limit,
)
from shaketable.physics.plane.taylor import Series

TERMS = 10
ROTATION, SPIN, ALONG, NORMAL = range(4)  # θ, W, x, y
GUARDS = 4  # the first row of the guards
ROWS = GUARDS + MOST_GUARDS + 8
X_ROW, Y_ROW, OTHER_X, OTHER_Y, ARM, RATIO, SIZE, SQUARE = range(GUARDS + MOST_GUARDS, ROWS)
TRUNCATION = 1e-13  # rad: the largest last term of a converged rotation
SeriesTable = NDArray[np.float64]


@kernel
def series(table: SeriesTable, row: int) -> Series:
    c = table[row]
    return Series(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9])


@kernel
def product(table: SeriesTable, one: int, two: int, k: int) -> float:
    """Coefficient k of the product of two rows."""
    total = 0.0
    for j in range(k + 1):
        total += table[one, j] * table[two, k - j]
    return total


@kernel
def times_force(table: SeriesTable, row: int, at_start: float, change: float, k: int) -> float:
    """Coefficient k of a row times a linear force."""
    of_start: float = table[row, k] * at_start
    return of_start + (table[row, k - 1] * change if k > 0 else 0.0)


@kernel
def term(at_start: float, change: float, k: int) -> float:
    """Coefficient k of a linear force."""
    return at_start if k == 0 else change if k == 1 else 0.0


@routine
def expand_turn(table: SeriesTable, k: int) -> None:
    """Coefficient k + 1 of θ, X and Y from those up to k."""
    over = 1.0 / (k + 1)
    table[ROTATION, k + 1] = table[SPIN, k] * over
    table[X_ROW, k + 1] = product(table, SPIN, Y_ROW, k) * over
    table[Y_ROW, k + 1] = -product(table, SPIN, X_ROW, k) * over


@routine
def expand_rock(
    table: SeriesTable, body: ContactBody, pose: Pose, side: float, force: Force, h: float
) -> None:
    X, Y = corner(body, side, pose.rotation)
    table[X_ROW, 0], table[Y_ROW, 0] = X, Y
    turn = h * h / (body.i2 + X * X + Y * Y)
    for k in range(TERMS - 1):
        expand_turn(table, k)
        moment = times_force(table, X_ROW, force.normal, force.normal_change, k)
        moment -= times_force(table, Y_ROW, force.along, force.along_change, k)
        table[SPIN, k + 1] = turn * moment / (k + 1)
    over = 1.0 / (h * h)
    for k in range(TERMS):
        # no term of order 8 or 9: two derivatives were taken
        along = normal = 0.0
        if k + 2 < TERMS:
            twice = over * (k + 1) * (k + 2)
            along = -twice * table[X_ROW, k + 2]
            normal = -twice * table[Y_ROW, k + 2]
        along -= term(force.along, force.along_change, k)
        normal -= term(force.normal, force.normal_change, k)
        table[GUARDS, k] = body.a_stick * normal + body.b_stick * along
        table[GUARDS + 1, k] = body.a_stick * normal - body.b_stick * along
        table[GUARDS + 2, k] = side * table[ROTATION, k]
        table[ALONG, k] = -table[X_ROW, k]
    table[ALONG, 0] += pose.x + X


@routine
def expand_slide_rock(
    table: SeriesTable,
    body: ContactBody,
    pose: Pose,
    side: float,
    sigma: float,
    force: Force,
    h: float,
) -> None:
    X, Y = corner(body, side, pose.rotation)
    table[X_ROW, 0], table[Y_ROW, 0] = X, Y
    table[ALONG, 0], table[ALONG, 1] = pose.x, h * pose.x_rate
    pressure, over_h2 = GUARDS + 1, 1.0 / (h * h)
    for k in range(TERMS):
        table[ARM, k] = body.b_slip * table[X_ROW, k] + body.a_slip * sigma * table[Y_ROW, k]
        table[RATIO, k] = product(table, X_ROW, ARM, k) / body.i2
        table[SQUARE, k] = product(table, SPIN, SPIN, k)
        table[pressure, k] = product(table, SQUARE, Y_ROW, k) * over_h2
        table[pressure, k] -= term(force.normal, force.normal_change, k)
        if k == 0:
            table[RATIO, 0] += body.b_slip
        size = table[pressure, k]
        for j in range(1, k + 1):
            size -= table[RATIO, j] * table[SIZE, k - j]
        table[SIZE, k] = size / table[RATIO, 0]
        if k + 1 < TERMS:
            expand_turn(table, k)
            turn = product(table, ARM, SIZE, k)
            table[SPIN, k + 1] = -h * h / body.i2 * turn / (k + 1)
        if k + 2 < TERMS:
            along = term(force.along, force.along_change, k)
            along -= body.a_slip * sigma * table[SIZE, k]
            table[ALONG, k + 2] = h * h * along / ((k + 1) * (k + 2))
    for k in range(TERMS):
        moved = table[ALONG, k + 1] + table[X_ROW, k + 1] if k + 1 < TERMS else 0.0
        table[GUARDS, k] = sigma * (k + 1) * moved / h
        table[GUARDS + 2, k] = table[RATIO, k]
        table[GUARDS + 3, k] = side * table[ROTATION, k]
    table[GUARDS + 2, 0] -= jam_limit(body, X, Y)


@routine
def expand_flat(
    table: SeriesTable, body: ContactBody, pose: Pose, sigma: float, force: Force, h: float
) -> None:
    """REST and SLIDE: forces are linear, and so are their guards."""
    table[ALONG, 0] = pose.x
    ratio = body.a_slip / body.b_slip if body.b_slip > 0.0 else 0.0
    for k in range(2):
        along = term(force.along, force.along_change, k)
        normal = -term(force.normal, force.normal_change, k)
        held = -along if sigma == 0.0 else -ratio * sigma * normal
        right, left = flat_pressures(body, held, normal)
        if sigma == 0.0:
            table[GUARDS, k] = body.a_stick * normal + body.b_stick * held
            table[GUARDS + 1, k] = body.a_stick * normal - body.b_stick * held
            table[GUARDS + 2, k], table[GUARDS + 3, k] = right, left
        else:
            table[ALONG, k + 2] = h * h * (along + held) / ((k + 1) * (k + 2))
            table[GUARDS + 1, k], table[GUARDS + 2, k] = right, left
    if sigma != 0.0:
        table[ALONG, 1] = h * pose.x_rate
        for k in range(3):
            table[GUARDS, k] = sigma * (k + 1) * table[ALONG, k + 1] / h


@routine
def expand_flight(
    table: SeriesTable, body: ContactBody, pose: Pose, force: Force, h: float
) -> None:
    table[X_ROW, 0], table[Y_ROW, 0] = corner(body, 1.0, pose.rotation)
    table[OTHER_X, 0], table[OTHER_Y, 0] = corner(body, -1.0, pose.rotation)
    table[ALONG, 0], table[ALONG, 1] = pose.x, h * pose.x_rate
    table[NORMAL, 0], table[NORMAL, 1] = pose.y, h * pose.y_rate
    for k in range(2):
        each = h * h / ((k + 1) * (k + 2))
        table[ALONG, k + 2] = each * term(force.along, force.along_change, k)
        table[NORMAL, k + 2] = each * term(force.normal, force.normal_change, k)
    turn = table[SPIN, 0]
    table[ROTATION, 1] = turn
    for k in range(TERMS - 1):
        each = turn / (k + 1)
        table[X_ROW, k + 1] = each * table[Y_ROW, k]
        table[Y_ROW, k + 1] = -each * table[X_ROW, k]
        table[OTHER_X, k + 1] = each * table[OTHER_Y, k]
        table[OTHER_Y, k + 1] = -each * table[OTHER_X, k]
    for k in range(TERMS):
        table[GUARDS, k] = table[NORMAL, k] + table[Y_ROW, k]
        table[GUARDS + 1, k] = table[NORMAL, k] + table[OTHER_Y, k]


@routine
def expand(table: SeriesTable, body: ContactBody, pose: Pose, force: Force, h: float) -> None:
    """Write the table of a pose over a span h."""
    for row in range(ROWS):
        for k in range(TERMS):
            table[row, k] = 0.0
    table[ROTATION, 0], table[SPIN, 0] = pose.rotation, h * pose.spin
    contact, sigma = contact_of(pose.phase), slip_of(pose.phase)
    if contact == NO_CONTACT:
        expand_flight(table, body, pose, force, h)
    elif contact == BOTH:
        table[SPIN, 0] = 0.0
        expand_flat(table, body, pose, sigma, force, h)
    elif sigma == 0.0:
        expand_rock(table, body, pose, side_sign(contact), force, h)
    else:
        expand_slide_rock(table, body, pose, side_sign(contact), sigma, force, h)


@routine
def converged_part(table: SeriesTable, size: float) -> float:
    """The largest part of the span, at most 1, over which the table is at round-off.

    Its last terms are then below TRUNCATION; dividing an offset by `size` makes it an angle.
    """
    last = max(
        max(abs(table[ROTATION, 9]), 0.1 * abs(table[ROTATION, 8])),
        max(abs(table[X_ROW, 9]), 0.1 * abs(table[X_ROW, 8])) / size,
    )
    if last <= TRUNCATION:
        return 1.0
    return 0.9 * math.pow(TRUNCATION / last, 1.0 / 9.0)
