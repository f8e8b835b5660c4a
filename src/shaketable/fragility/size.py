"""The size and the slenderness of a body that rocks: all that its equation holds of it."""

from __future__ import annotations

import math

from shaketable.body import Body
from shaketable.units import STANDARD_GRAVITY


def size_of(body: Body) -> tuple[float, float]:
    """The frequency parameter p [rad/s] and the slenderness α [rad] of the more slender side.

    p² = g r/(i² + r²), of which 3g/4r is that of a homogeneous rectangle (Housner 1963).
    """
    arm = min(body.left, body.right)
    r2 = body.cg_height**2 + arm**2
    p = math.sqrt(STANDARD_GRAVITY * math.sqrt(r2) / (body.gyration_radius**2 + r2))
    return p, math.atan2(arm, body.cg_height)
