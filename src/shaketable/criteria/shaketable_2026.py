"""The chance that a body overturns, from two peaks of the motion: a rule of this project.

    P = 1/(1 + e^-x) ,   x = c_0 + c_v ln V + c_a ln(1 - 1/A) + c_ν ν
    V = p PGV/(g tan α) ,   A = PGA/(g tan α) ,   P = 0 for A <= 1

V is the velocity over the one that an impulse needs to overturn the body, A the acceleration over
the one that lifts the nearer corner, below which nothing moves; p² = g r/(i² + r²). All are taken
about the corner that is nearer to the foot of the centre of gravity, with ν = b/B.

The rule was fitted by logistic regression to the 192 bodies of the study of Boroschek and Romo
(2004) under the 100 components of FEMA P-695 in both directions. `shaketable study
boroschek-romo-2004` repeats the fit and tests the rule on recordings that it was not fitted to.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.criteria.verdict import Verdict, margin_of, outside
from shaketable.units import CM, STANDARD_GRAVITY


class Coefficients(NamedTuple):
    constant: float
    velocity: float
    acceleration: float
    eccentricity: float


FITTED = Coefficients(1.143, 3.404, 3.046, 2.718)
SAFE = 0.03  # a body below this chance is called safe: wrong as rarely as by the known-ν rule
#: Sizes of the bodies that the rule was fitted to.
FITTED_TO = {"CG height [m]": (0.25, 4.0), "B/2h": (0.16, 0.4375), "ν": (0.2, 0.5)}
NAME = "shaketable"
REFERENCE = "shaketable, fitted to FEMA P-695"
RANGE = (
    "rectangles with CG heights of 0.25 to 4 m, B/2h 0.16 to 0.44 and ν 0.2 to 0.5 on a level "
    "support, rocking without sliding; PGA and PGV of recorded ground motions"
)


class Measures(NamedTuple):
    """Dimensionless measures of a motion for a body; all shapes broadcast together."""

    velocity: NDArray[np.float64]
    acceleration: NDArray[np.float64]
    eccentricity: NDArray[np.float64]

    def terms(self) -> NDArray[np.float64]:
        """ln V, ln(1 - 1/A) and ν, shape (..., 3); -inf in the second where nothing moves."""
        with np.errstate(divide="ignore", over="ignore"):  # where next to nothing moves
            lifted = np.log(np.maximum(1.0 - 1.0 / self.acceleration, 0.0))
            return np.stack(
                np.broadcast_arrays(np.log(self.velocity), lifted, self.eccentricity), -1
            )


def measures(
    base: ArrayLike,
    eccentricity: ArrayLike,
    cg_height: ArrayLike,
    gyration_radius: ArrayLike,
    pga: ArrayLike,
    pgv: ArrayLike,
) -> Measures:
    """V, A and ν about the nearer corner.

    Args:
        base: B [m]; all shapes broadcast together.
        eccentricity: ν or 1 - ν [-].
        cg_height, gyration_radius: [m].
        pga: [m/s²].
        pgv: [m/s].
    """
    nu = np.asarray(eccentricity, np.float64)
    nu = np.minimum(nu, 1.0 - nu)
    h, i = np.asarray(cg_height, np.float64), np.asarray(gyration_radius, np.float64)
    arm = nu * np.asarray(base, np.float64)
    r = np.hypot(arm, h)
    p = np.sqrt(STANDARD_GRAVITY * r / (i * i + r * r))
    lifts = STANDARD_GRAVITY * arm / h
    with np.errstate(divide="ignore"):
        return Measures(
            np.asarray(p * np.asarray(pgv) / lifts), np.asarray(np.asarray(pga) / lifts), nu
        )


def overturning_chance(found: Measures, coefficients: Coefficients = FITTED) -> NDArray[np.float64]:
    """P in [0, 1], of the shape of the measures."""
    terms = found.terms()
    with np.errstate(invalid="ignore", over="ignore"):
        x = coefficients.constant + terms @ np.array(coefficients[1:])
        chance = 1.0 / (1.0 + np.exp(-x))
    return np.where((found.acceleration > 1.0) & (found.velocity > 0.0), chance, 0.0)


def verdict(body: Body, pga: float, pgv: float) -> Verdict:
    """The body is safe where the chance is below SAFE. The margin is that of the velocity at this
    PGA, or that of the acceleration where it lifts no corner."""
    found = measures(
        body.base, body.left / body.base, body.cg_height, body.gyration_radius, pga, pgv
    )
    chance = float(overturning_chance(found))
    limit = velocity_limit(body, pga)
    lifts = STANDARD_GRAVITY * min(body.left, body.right) / body.cg_height
    if math.isinf(limit):
        sentence = "stands: the acceleration is too small to lift a corner"
    else:
        sentence = (
            f"{'may overturn' if chance >= SAFE else 'stands'}: it overturns with a chance of "
            f"{100 * chance:.2g} % (PGV {pgv / CM:.3g} of {limit / CM:.3g} cm/s at this PGA for "
            f"{100 * SAFE:g} %)"
        )
    sizes = {
        "CG height [m]": body.cg_height,
        "B/2h": body.base / (2 * body.cg_height),
        "ν": float(found.eccentricity),
    }
    beyond = [
        said for name, limits in FITTED_TO.items() for said in outside(name, sizes[name], limits)
    ]
    return Verdict(
        NAME,
        chance >= SAFE,
        margin_of(lifts, pga) if math.isinf(limit) else margin_of(limit, pgv),
        sentence,
        REFERENCE,
        RANGE,
        "; ".join(beyond),
    )


def velocity_limit(body: Body, pga: float, chance: float = SAFE) -> float:
    """The PGV [m/s] that gives `chance` at a PGA [m/s²]; infinite if none does."""
    one = measures(body.base, body.left / body.base, body.cg_height, body.gyration_radius, pga, 1.0)
    if not float(one.acceleration) > 1.0:
        return math.inf
    _, lifted, nu = one.terms()
    wanted = np.log(chance / (1.0 - chance)) - FITTED.constant
    rest = wanted - FITTED.acceleration * lifted - FITTED.eccentricity * nu
    return float(np.exp(rest / FITTED.velocity) / one.velocity)
