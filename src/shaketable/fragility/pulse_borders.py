"""Where a pulse overturns a slender block, in closed form.

The equation of a slender block is linear while it rocks on one corner (sin α ≈ α):
θ'' = p² (θ - α - ü/g). A block that does not come back overturns without an impact. On the border
of that it takes the solution that neither grows nor comes back: ∫ e^{-p t} (ü/(α g) - 1) dt = 0
from uplift on (Housner 1963; Shi, Anooshehpoor, Zeng and Brune 1996; Makris and Roussos 2000). With
w = ω_p/p and k = a_p/(α g), uplift is at sin ψ = 1/k:

    half sine     cos ψ + e^{-(π-ψ)/w} = w sin ψ
    one sine      cos ψ - e^{-(2π-ψ)/w} = w sin ψ
    one cosine    k = (1 + w²)/(1 - e^{-2π/w})
    rectangular   k = 1/(1 - e^{-π/w}), a constant for half a period
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

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


def without_impact(pulse: str, frequencies: ArrayLike) -> NDArray[np.float64] | None:
    """The least k at which a pulse overturns without an impact, at each w; None without a form.

    Args:
        pulse: as for `overturning_spectrum`.
        frequencies: w = ω_p/p, above 0.
    """
    borders: dict[str, Callable[[float], float]] = {
        "half sine": lambda w: _at_uplift(w, math.pi, 1.0),
        "sine": lambda w: _at_uplift(w, 2.0 * math.pi, -1.0),
        "cosine": lambda w: (1.0 + w * w) / -math.expm1(-2.0 * math.pi / w),
        "rectangular": lambda w: -1.0 / math.expm1(-math.pi / w),
    }
    if pulse not in borders:
        return None
    border = borders[pulse]
    return np.array([border(w) for w in np.atleast_1d(np.asarray(frequencies, float)).tolist()])


def _at_uplift(w: float, end: float, sign: float) -> float:
    """k where cos ψ + sign e^{-(end - ψ)/w} = w sin ψ."""
    from scipy.optimize import brentq

    def left_over(psi: float) -> float:
        return math.cos(psi) + sign * math.exp((psi - end) / w) - w * math.sin(psi)

    return 1.0 / math.sin(float(brentq(left_over, 1e-12, math.pi / 2, xtol=1e-15)))
