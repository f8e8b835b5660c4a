"""The risk that furniture overturns, as a polynomial in its shape and the floor's acceleration.

Cimellaro G.P., Domaneschi M., Qu B. (2020) Overturning risk of furniture in earthquake-affected
areas, J. Vibration and Control 26(5-6):362-374, eq. 9, with PFA in cm/s²:

    OR = a + b/(B/H) + c PFA + d/(B/H)² + e PFA² + f PFA/(B/H)

The sign of d is garbled in print; -0.018590461 gives all 27 entries of table 3. OR is a fitted
surface, not a probability: it is clipped to [0, 1] here. It is 0.28 for B/H = 0.14 without any
motion, and beyond some acceleration it falls as the motion grows. The body's size is not in it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.criteria.verdict import outside
from shaketable.errors import InputError
from shaketable.units import CM


class Surface(NamedTuple):
    """Coefficients of eq. 9, for PFA in cm/s²."""

    a: float
    b: float
    c: float
    d: float
    e: float
    f: float


PRINTED = Surface(-0.97758451, 0.30856415, 0.0032112873, -0.018590461, -0.000001941, -0.00010152672)
#: B/H of the blocks of table 3; the paper does not give the shapes that OR was fitted to.
SHOWN = (0.14, 0.39)


def surface(width_ratio: ArrayLike, pfa: ArrayLike, of: Surface = PRINTED) -> NDArray[np.float64]:
    """OR by eq. 9, not clipped.

    Args:
        width_ratio: B/H [-]; all shapes broadcast together.
        pfa: peak floor acceleration [m/s²].

    Raises:
        InputError: a B/H that is not positive, a PFA that is negative or missing (NaN).
    """
    ratio, y = np.asarray(width_ratio, np.float64), np.asarray(pfa, np.float64) / CM
    if not (np.isfinite(ratio) & (ratio > 0.0)).all():
        raise InputError(f"width_ratio B/H must be positive, got {width_ratio!r}")
    if not (y >= 0.0).all():
        raise InputError(f"pfa [m/s²] must not be negative, got {pfa!r}")
    x = 1.0 / ratio
    return np.asarray(of.a + of.b * x + of.c * y + of.d * x**2 + of.e * y**2 + of.f * x * y)


def overturning_ratio(
    width_ratio: ArrayLike, pfa: ArrayLike, of: Surface = PRINTED
) -> NDArray[np.float64]:
    """OR clipped to [0, 1]; arguments as for `surface`."""
    return np.clip(surface(width_ratio, pfa, of), 0.0, 1.0)


def turning_acceleration(width_ratio: ArrayLike, of: Surface = PRINTED) -> NDArray[np.float64]:
    """The PFA [m/s²] beyond which OR falls as the motion grows."""
    x = 1.0 / np.asarray(width_ratio, np.float64)
    return np.asarray(CM * -(of.c + of.f * x) / (2.0 * of.e))


def acceleration_of(
    width_ratio: ArrayLike, ratio: ArrayLike, of: Surface = PRINTED
) -> NDArray[np.float64]:
    """The PFA [m/s²] at which OR has a value, on its rising part; NaN where it never has.

    Args:
        width_ratio: B/H [-]; all shapes broadcast together.
        ratio: OR, not clipped.
    """
    x = 1.0 / np.asarray(width_ratio, np.float64)
    slope = of.c + of.f * x
    rest = of.a + of.b * x + of.d * x**2 - np.asarray(ratio, np.float64)
    with np.errstate(invalid="ignore"):
        root = np.sqrt(slope * slope - 4.0 * of.e * rest)
    return np.asarray(CM * (root - slope) / (2.0 * of.e))


def out_of_range(width_ratio: float, pfa: float) -> list[str]:
    """The reasons why OR should not be believed for a body and a floor; empty if there are none."""
    reasons = outside("B/H", width_ratio, SHOWN)
    raw, turns = float(surface(width_ratio, pfa)), float(turning_acceleration(width_ratio))
    if not 0.0 <= raw <= 1.0:
        reasons.append(f"eq. 9 gives {raw:.2f}, which is not a probability")
    if pfa > turns:
        reasons.append(f"beyond {turns:.3g} m/s² OR falls as the motion grows")
    return reasons
