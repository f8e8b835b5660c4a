"""What a solid loses as it rolls and turns: torques in proportion to the pressure."""

from __future__ import annotations

import math

from shaketable.compiled import kernel
from shaketable.physics.space.contacts import LEVEL
from shaketable.physics.space.vectors import ZERO, Axes, Vec, on_body, on_support
from shaketable.physics.space.workspace import SolidParameters
from shaketable.units import STANDARD_GRAVITY

#: Rolling, contour and drilling friction grow to their full size about this rate [rad/s], or at
#: the one that they would stop in STOPS [s], if that is more: what is as small as a coin would be
#: stiff.
SLOW, STOPS = 1e-3, 5e-4


@kernel
def loses(shape: SolidParameters) -> bool:
    """Whether it loses anything as it rolls and turns."""
    return shape.rolling > 0.0 or shape.contour > 0.0 or shape.drilling > 0.0


@kernel
def resistance(shape: SolidParameters, q: Axes, spin: Vec) -> Vec:
    """The torque against rolling and drilling for a unit of pressure, in the body's frame."""
    if not loses(shape):
        return ZERO
    turn = on_support(q, spin)
    least = min(shape.inertia.xx, shape.inertia.yy)
    rolls = max(SLOW, shape.rolling * STANDARD_GRAVITY * STOPS / least)
    drills = max(SLOW, shape.drilling * STANDARD_GRAVITY * STOPS / shape.inertia.zz)
    rolling = shape.rolling / math.sqrt(turn.x * turn.x + turn.y * turn.y + rolls * rolls)
    drilling = shape.drilling / math.sqrt(turn.z * turn.z + drills * drills)
    around = contour_resistance(shape, q, turn, least) if shape.contour > 0.0 else ZERO
    return on_body(
        q, Vec(around.x - rolling * turn.x, around.y - rolling * turn.y, -drilling * turn.z)
    )


@kernel
def contour_resistance(shape: SolidParameters, q: Axes, turn: Vec, least: float) -> Vec:
    """The torque against the way of a rim's contact around it, for a unit of pressure (Leine 2009).

    The contact moves around the rim at the rate ψ̇ = ω_e / sin φ, e the horizontal direction toward
    which the axis leans: a loss of δ N |ψ̇| is a torque δ N / sin φ about e. It is the pressure's
    distance from the lowest point along the rim, and no pressure lies beyond the radius.

    Args:
        turn: the angular velocity in the support's frame.
        least: moment of inertia per unit mass [m²], which says how small a rate is none.
    """
    x, y = q.x.z, q.y.z
    sine = math.sqrt(x * x + y * y)
    if sine <= LEVEL:
        return ZERO
    x, y = x / sine, y / sine
    most = min(shape.contour / sine, shape.radius)
    rate = turn.x * x + turn.y * y
    slow = max(SLOW * sine, most * STANDARD_GRAVITY * STOPS / least)
    size = -most * rate / math.sqrt(rate * rate + slow * slow)
    return Vec(size * x, size * y, 0.0)
