"""Criteria for bodies whose centre of gravity is off centre.

Boroschek R., Romo D. (2004) Overturning criteria for non-anchored non-symmetric rigid bodies, 13th
WCEE, paper 295. ν is the distance of the centre of gravity's foot from the nearer corner over the
base, at most 0.5.

- ν known: Ishiyama's conditions with B' = 2 ν B in place of B and the body's own inertia.
- ν unknown, but at least 0.3: Ishiyama's velocity with the whole base and a factor of 0.2 instead
  of 0.4 (the text says "eccentricity of less than 0.3 B", and means no nearer to a corner).

With γ = h/(ν_S B), κ = i²/(ν_S B)² and A = |a_x|/(g + a_y), for rocking about the corner at ν_S B::

    μ >= (A κ + A + γ)/(κ + A γ + γ²)    keeps it from slipping as it lifts     (eq. 25)
    μ >= 1/γ                             as it just begins to rock, A = 1/γ     (eq. 26)
    δE = (i² + h² - (1 - ν_S) ν_S B²)² /
         ((i² + h² + (1 - ν_S)² B²)(i² + h² + ν_S² B²))     energy kept         (eq. 38)

The print has lost the square of δE's numerator; it follows from eqs. 34 to 36.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.criteria import ishiyama_1982
from shaketable.criteria.verdict import Verdict, margin_of, outside
from shaketable.units import CM

UNKNOWN_FACTOR = 0.2
LEAST_ECCENTRICITY = 0.3  # in the rule for an unknown one
STUDIED = (0.2, 0.5)  # ν
KNOWN_NAME = "Boroschek & Romo, known eccentricity"
REFERENCE = "Boroschek & Romo 2004"
KNOWN_RANGE = "rectangles with ν 0.2 to 0.5 on a level support, rocking without sliding"
UNKNOWN_RANGE = (
    f"rectangles with an unknown ν of at least {LEAST_ECCENTRICITY:g} on a level support, rocking "
    "without sliding"
)


def nearer_arm(body: Body) -> float:
    """ν B [m], the distance of the nearer corner from the foot of the centre of gravity."""
    return min(body.left, body.right)


def may_overturn_known(
    base: ArrayLike,
    eccentricity: ArrayLike,
    cg_height: ArrayLike,
    gyration_radius: ArrayLike,
    pga: ArrayLike,
    pgv: ArrayLike,
) -> NDArray[np.bool_]:
    """Ishiyama's conditions with B' = 2 ν B.

    Args:
        base: B [m]; all shapes broadcast together.
        eccentricity: ν or 1 - ν [-].
        cg_height, gyration_radius: [m].
        pga: [m/s²].
        pgv: [m/s].
    """
    nu = np.asarray(eccentricity, np.float64)
    arm = np.minimum(nu, 1.0 - nu) * np.asarray(base, np.float64)
    return ishiyama_1982.may_overturn(arm, cg_height, gyration_radius, pga, pgv)


def may_overturn_unknown(
    base: ArrayLike, cg_height: ArrayLike, gyration_radius: ArrayLike, pgv: ArrayLike
) -> NDArray[np.bool_]:
    """PGV >= 0.2 times Housner's velocity of the symmetric body.

    Args:
        base, cg_height, gyration_radius: [m]; all shapes broadcast together.
        pgv: [m/s].
    """
    limit = ishiyama_1982.overturning_velocity(
        np.asarray(base, np.float64) / 2, cg_height, gyration_radius, UNKNOWN_FACTOR
    )
    return np.asarray(pgv) >= limit


def friction_needed(
    acceleration: ArrayLike, height_ratio: ArrayLike, inertia: ArrayLike
) -> NDArray[np.float64]:
    """The static friction that keeps a body from slipping as it begins to rock (eq. 25).

    Args:
        acceleration: A = |a_x|/(g + a_y) >= 1/γ [-]; all shapes broadcast together.
        height_ratio: γ = h/(ν_S B).
        inertia: κ = i²/(ν_S B)².
    """
    a, gamma, kappa = (
        np.asarray(value, np.float64) for value in (acceleration, height_ratio, inertia)
    )
    return np.asarray((a * kappa + a + gamma) / (kappa + a * gamma + gamma**2))


def energy_kept(
    arm: ArrayLike, other: ArrayLike, cg_height: ArrayLike, gyration_radius: ArrayLike
) -> NDArray[np.float64]:
    """δE, the share of the energy that an impact leaves (eq. 38).

    Args:
        arm, other: distances of the two corners from the foot of the centre of gravity [m]; it does
            not matter which corner is hit.
        cg_height, gyration_radius: [m].
    """
    b, c, h, i = (
        np.asarray(value, np.float64) for value in (arm, other, cg_height, gyration_radius)
    )
    both = i * i + h * h
    return np.asarray((both - b * c) ** 2 / ((both + b * b) * (both + c * c)))


def known_verdict(body: Body, pga: float, pgv: float) -> Verdict:
    """The rule for a known eccentricity; pga [m/s²], pgv [m/s]."""
    shape = (nearer_arm(body), body.cg_height)
    return ishiyama_1982.both_conditions(
        KNOWN_NAME,
        float(ishiyama_1982.overturning_acceleration(*shape)),
        float(ishiyama_1982.overturning_velocity(*shape, body.gyration_radius)),
        pga,
        pgv,
        REFERENCE,
        KNOWN_RANGE,
        "; ".join(outside("ν", nearer_arm(body) / body.base, STUDIED)),
    )


def unknown_verdict(body: Body, pga: float, pgv: float) -> Verdict:
    """The rule for an unknown eccentricity; pga is not used, pgv [m/s]."""
    limit = float(
        ishiyama_1982.overturning_velocity(
            body.base / 2, body.cg_height, body.gyration_radius, UNKNOWN_FACTOR
        )
    )
    says = "may overturn" if pgv >= limit else "stands"
    return Verdict(
        "Boroschek & Romo, unknown eccentricity",
        pgv >= limit,
        margin_of(limit, pgv),
        f"{says}: PGV {pgv / CM:.3g} of {limit / CM:.3g} cm/s",
        REFERENCE,
        UNKNOWN_RANGE,
        "; ".join(outside("ν", nearer_arm(body) / body.base, (LEAST_ECCENTRICITY, 0.5))),
    )
