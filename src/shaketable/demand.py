"""The friction that a body asks for while it rocks.

Boroschek R., Romo D. (2004) Overturning criteria for non-anchored non-symmetric rigid bodies, 13th
WCEE, paper 295: to rock without sliding, |R_x|/R_y must not exceed the static friction at rest
(1/γ <= μ, eq. 26) nor at any time while the body rocks (eq. 20, "limit to avoid sliding from
rocking"). The second is known only once the motion is simulated.

With θ about the corner at (X, Y) from the centre of gravity (theory, section 3), per unit mass:

    x'' = -θ'' Y + θ'² X ,   y'' = θ'' X + θ'² Y ,   R_x = x'' - f_t ,   R_y = y'' - f_n
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.response import PlanarResponse
from shaketable.units import STANDARD_GRAVITY


def friction_demand(response: PlanarResponse) -> NDArray[np.float64]:
    """|R_x|/R_y at the samples while the body rocks, NaN while it rests, shape (n,).

    Infinite where R_y is not positive: the body would jump. Impacts are no part of it: their
    impulses ask for friction of their own.

    Args:
        response: of a model in which nothing slides.

    Raises:
        InputError: the model lets the body slide: then friction is what it is, not what is needed.
    """
    if response.model.slides:
        raise InputError(
            "friction_demand needs a run without sliding: simulate with the rocking model"
        )
    body, motion, tilt = response.body, response.motion, response.support.tilt
    time, theta, omega = response.time, response.rotation, response.angular_velocity
    a_x = np.interp(time, motion.time, motion.horizontal, right=0.0)
    vertical = np.zeros(motion.horizontal.size) if motion.vertical is None else motion.vertical
    a_y = np.interp(time, motion.time, vertical, right=0.0)
    weight = STANDARD_GRAVITY + a_y
    f_t = -a_x * math.cos(tilt) - weight * math.sin(tilt)
    f_n = a_x * math.sin(tilt) - weight * math.cos(tilt)
    arm = np.where(theta > 0.0, body.right, -body.left)
    x = arm * np.cos(theta) - body.cg_height * np.sin(theta)
    y = -arm * np.sin(theta) - body.cg_height * np.cos(theta)
    inertia = body.gyration_radius**2 + x * x + y * y
    # moments about the corner: (i² + r²) θ'' = -(Y f_t - X f_n)
    alpha = (x * f_n - y * f_t) / inertia
    r_x = -alpha * y + omega * omega * x - f_t
    r_y = alpha * x + omega * omega * y - f_n
    with np.errstate(divide="ignore", invalid="ignore"):
        demand = np.where(r_y > 0.0, np.abs(r_x) / r_y, np.inf)
    return np.where(theta == 0.0, np.nan, demand)


def largest_demand(response: PlanarResponse) -> float:
    """The static friction with which the body rocks without sliding at every sample, 0 at rest.

    Only while its centre of gravity has not passed over the corner, |θ| <= α: from there on it
    falls, with friction or without.
    """
    body = response.body
    demand, theta = friction_demand(response), response.rotation
    alpha = np.where(theta > 0.0, body.slenderness_right, body.slenderness_left)
    known = demand[~np.isnan(demand) & (np.abs(theta) <= alpha)]
    return float(known.max()) if known.size else 0.0
