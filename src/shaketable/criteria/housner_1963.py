"""The velocity at which half of the bodies overturn.

Housner G.W. (1963) The behavior of inverted pendulum structures during earthquakes, Bull. Seism.
Soc. Am. 53(2):403-417, as eq. 1 of Boroschek R., Romo D. (2004), 13th WCEE, paper 295:

    S_v = (1/cos α) √( (8/3) g r (1 - cos α) )

for a homogeneous rectangle, and for any radius of gyration i, from the energy that lifts the
centre of gravity above the corner,

    S_v = (1/cos α) √( 2 g (i² + r²)(1 - cos α)/r )

with tan α = b/h, r² = b² + h², b the distance of the corner from the centre of gravity's foot and
h its height. It is the velocity of an impulse that just overturns the body; under white noise with
that pseudo-velocity, Housner expects half of the bodies to fall.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.criteria.verdict import Verdict, margin_of
from shaketable.units import CM, STANDARD_GRAVITY

REFERENCE = "Housner 1963; Boroschek & Romo 2004, eq. 1"
RANGE = "level support, rocking without sliding; any shape and radius of gyration"


def overturning_velocity(
    arm: ArrayLike, cg_height: ArrayLike, gyration_radius: ArrayLike
) -> NDArray[np.float64]:
    """S_v [m/s] (Boroschek and Romo (2004) eq. 1, for any radius of gyration).

    Args:
        arm: b, from the corner to the foot of the centre of gravity [m]; all shapes broadcast
            together.
        cg_height: h [m].
        gyration_radius: i [m]; √((B² + H²)/12) for a rectangle.
    """
    b, h, i = (np.asarray(value, np.float64) for value in (arm, cg_height, gyration_radius))
    r = np.hypot(b, h)
    rise = b * b / (r * (r + h))  # 1 - cos α, without cancellation
    return np.asarray(r / h * np.sqrt(2.0 * STANDARD_GRAVITY * (i * i + r * r) * rise / r))


def verdict(body: Body, pga: float, pgv: float) -> Verdict:
    """The verdict on the side that is easier to overturn; the peak velocity stands in for S_v.

    Args:
        body: symmetric or not.
        pga: not used; all criteria take the same arguments.
        pgv: peak ground velocity [m/s].
    """
    limit = float(
        overturning_velocity(min(body.left, body.right), body.cg_height, body.gyration_radius)
    )
    says = "more than half of such bodies fall" if pgv >= limit else "fewer than half fall"
    return Verdict(
        "Housner",
        pgv >= limit,
        margin_of(limit, pgv),
        f"{says}: {pgv / CM:.3g} of the {limit / CM:.3g} cm/s that overturn half of them",
        REFERENCE,
        RANGE,
    )
