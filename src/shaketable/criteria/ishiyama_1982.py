"""The peak acceleration and velocity that overturning needs.

Ishiyama Y. (1982) Motions of rigid bodies and criteria for overturning by earthquake excitations,
Earthquake Engng Struct. Dyn. 10:635-650, as eq. 2 of Boroschek R., Romo D. (2004), 13th WCEE,
paper 295. A body overturns only if both

    a_max >= (B/H) g      and      v_max > 0.4 (1/cos α) √( (8/3) g r (1 - cos α) )

(B/H) g lifts a corner; the velocity is 0.4 times Housner's. Both are necessary: a body below either
of them stands; above both, it may fall.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.criteria import housner_1963
from shaketable.criteria.verdict import Verdict, margin_of
from shaketable.units import CM, STANDARD_GRAVITY

FACTOR = 0.4
REFERENCE = "Ishiyama 1982; Boroschek & Romo 2004, eq. 2"
RANGE = "symmetric homogeneous rectangles on a level support, rocking without sliding"


def overturning_acceleration(arm: ArrayLike, cg_height: ArrayLike) -> NDArray[np.float64]:
    """(b/h) g [m/s²]; for a symmetric body, (B/H) g.

    Args:
        arm: b, from the corner to the foot of the centre of gravity [m]; all shapes broadcast
            together.
        cg_height: h [m].
    """
    b, h = np.asarray(arm, np.float64), np.asarray(cg_height, np.float64)
    return np.asarray(STANDARD_GRAVITY * b / h)


def overturning_velocity(
    arm: ArrayLike, cg_height: ArrayLike, gyration_radius: ArrayLike, factor: float = FACTOR
) -> NDArray[np.float64]:
    """`factor` times Housner's velocity [m/s]; other arguments [m] as in housner_1963."""
    return factor * housner_1963.overturning_velocity(arm, cg_height, gyration_radius)


def may_overturn(
    arm: ArrayLike,
    cg_height: ArrayLike,
    gyration_radius: ArrayLike,
    pga: ArrayLike,
    pgv: ArrayLike,
) -> NDArray[np.bool_]:
    """Whether both conditions of Boroschek and Romo (2004) eq. 2 are met.

    Args:
        arm, cg_height, gyration_radius: [m]; all shapes broadcast together.
        pga: peak ground acceleration [m/s²].
        pgv: peak ground velocity [m/s].
    """
    return (np.asarray(pga) >= overturning_acceleration(arm, cg_height)) & (
        np.asarray(pgv) > overturning_velocity(arm, cg_height, gyration_radius)
    )


def verdict(body: Body, pga: float, pgv: float) -> Verdict:
    """The verdict for the whole base, as if the centre of gravity were in the middle.

    Args:
        body: its eccentricity is not used.
        pga: [m/s²].
        pgv: [m/s].
    """
    shape = (body.base / 2, body.cg_height)
    return both_conditions(
        "Ishiyama",
        float(overturning_acceleration(*shape)),
        float(overturning_velocity(*shape, body.gyration_radius)),
        pga,
        pgv,
        REFERENCE,
        RANGE,
        "" if math.isclose(body.left, body.right) else "the centre of gravity is off centre",
    )


def both_conditions(
    name: str,
    acceleration: float,
    velocity: float,
    pga: float,
    pgv: float,
    reference: str,
    range_: str,
    beyond: str,
) -> Verdict:
    """The verdict of a criterion with a limit of acceleration [m/s²] and one of velocity [m/s]."""
    overturns = pga >= acceleration and pgv > velocity
    numbers = (
        f"PGA {pga / STANDARD_GRAVITY:.3g} of {acceleration / STANDARD_GRAVITY:.3g} g, "
        f"PGV {pgv / CM:.3g} of {velocity / CM:.3g} cm/s"
    )
    if overturns:
        says = "may overturn: both limits are passed"
    elif pga >= acceleration:
        says = "stands: it rocks, but the velocity is too small to overturn it"
    else:
        says = "stands: the acceleration is too small"
    margin = max(margin_of(acceleration, pga), margin_of(velocity, pgv))
    return Verdict(name, overturns, margin, f"{says} ({numbers})", reference, range_, beyond)
