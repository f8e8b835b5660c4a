"""Curves of the share of falls that go downhill on a tilted support.

Boroschek R., Iruretagoyena A. (2006) Controlled overturning of unanchored rigid bodies, Earthquake
Engng Struct. Dyn. 35(6):695-711.

The share of the overturnings that go downhill, by the tilt β [rad] (eqs. 11 and 13):

    GCOR, SCOR = c2 tanh(β/c1) + 0.5 ,   c2 = 0.48

with c1 = 0.048 for any body (GCOR) or c1 = 0.1136 b/h - 0.0283 r + 0.0279 for a rectangle of the
full sizes b and h [m] and the half diagonal r [m] (SCOR). Both are fits to simulated rectangles
with the centre of gravity in the middle that rock without sliding under 314 ground records; they do
not say whether the body overturns.

Table II was not computed with the c1 = 0.048 that the text prints: 0.046 gives all of its 15
entries, 0.048 gives 7. The abstract's 98 % at 7° is the limit of GCOR, 0.5 + c2; at 7° GCOR is
97.4 %.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_positive
from shaketable.units import STANDARD_GRAVITY

C1 = 0.048  # rad, GCOR as printed
C1_OF_TABLE_2 = 0.046  # rad, what the printed table was computed with
C2 = 0.48


class SizeTerms(NamedTuple):
    """c1 = width_ratio · b/h + size · r + constant [rad], r in m."""

    width_ratio: float
    size: float
    constant: float


SCOR = SizeTerms(0.1136, -0.0283, 0.0279)

#: The sizes of table I, which SCOR was fitted to.
FITTED = {"b/h": (0.20, 0.36), "r [m]": (0.10, 0.77)}


def controlled_rate(tilt: ArrayLike, c1: ArrayLike, c2: ArrayLike = C2) -> NDArray[np.float64]:
    """Share of the overturnings that go downhill (eq. 11).

    Args:
        tilt: β [rad], any shape; a negative one tilts the support the other way, and downhill
            with it.
        c1: [rad]; NaN gives NaN, and so does a c1 that is not positive.
        c2: the limit of the share, less one half.
    """
    scale = np.asarray(c1, np.float64)
    scale = np.where(scale > 0.0, scale, np.nan)
    part = np.tanh(np.abs(np.asarray(tilt, np.float64)) / scale)
    return np.asarray(0.5 + np.asarray(c2, np.float64) * part)


def tilt_for(control: float, c1: float, c2: float = C2) -> float:
    """The tilt [rad] at which the share is `control`; infinite if it never is, NaN if c1 <= 0.

    Raises:
        InputError: control outside [0.5, 1).
    """
    if not 0.5 <= control < 1.0:
        raise InputError(f"control must lie in [0.5, 1), got {control!r}")
    if not c1 > 0.0:
        return math.nan
    part = (control - 0.5) / c2
    return c1 * math.atanh(part) if part < 1.0 else math.inf


def gcor(tilt: ArrayLike) -> NDArray[np.float64]:
    """The general controlled overturning rate (eq. 11) at `tilt` [rad], as printed."""
    return controlled_rate(tilt, C1)


def size_measures(base: float, height: float) -> NDArray[np.float64]:
    """b/h, r [m] and 1 of a rectangle of full sizes [m], by which the terms of c1 are multiplied.

    Raises:
        InputError: a size that is not positive and finite.
    """
    require_positive("base [m]", base)
    require_positive("height [m]", height)
    return np.array([base / height, math.hypot(base, height) / 2, 1.0])


def scor_c1(base: float, height: float) -> float:
    """c1 [rad] of the specific rate (eq. 13) of a rectangle of full sizes [m].

    It falls to zero and below as bodies grow; there is no rate for those.
    """
    return float(size_measures(base, height) @ np.array(SCOR))


def scor(tilt: ArrayLike, base: float, height: float) -> NDArray[np.float64]:
    """The specific controlled overturning rate (eq. 13); NaN where c1 is not positive.

    Args:
        tilt: β [rad], any shape.
        base, height: full sizes [m].
    """
    return controlled_rate(tilt, scor_c1(base, height))


def outside_of_scor(base: float, height: float) -> list[str]:
    """Which measures of a rectangle of full sizes [m] lie outside those that SCOR was fitted to."""
    return [
        f"{name} = {size:.3g} is outside {low:.2f} to {high:.2f}"
        for size, (name, (low, high)) in zip(
            size_measures(base, height), FITTED.items(), strict=False
        )
        if not low - 0.005 <= size <= high + 0.005  # the limits are rounded
    ]


def uplift_acceleration(
    body: Body, tilt: ArrayLike, vertical: ArrayLike = 0.0
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """|a_x| [m/s²] beyond which a body at rest begins to rock downhill, and uphill (eq. 1).

    Args:
        body: symmetric or not.
        tilt: β [rad], any shape; downhill is toward -x, or toward +x where it is negative.
        vertical: a_y [m/s²], up positive.
    """
    weight, beta = STANDARD_GRAVITY + np.asarray(vertical), np.asarray(tilt, np.float64)
    toward_left = weight * np.tan(body.slenderness_left - beta)
    toward_right = weight * np.tan(body.slenderness_right + beta)
    return (
        np.where(beta < 0.0, toward_right, toward_left),
        np.where(beta < 0.0, toward_left, toward_right),
    )


def slide_acceleration(
    friction: float, tilt: ArrayLike, vertical: ArrayLike = 0.0
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """|a_x| [m/s²] beyond which a body at rest would slide downhill, and uphill.

    From eqs. 3 and 4, with R_y = (g + a_y) cos β - a_x sin β (its sign is wrong in print).
    Downhill it is negative where the body slides by itself; uphill, infinite where friction holds
    always.

    Args:
        friction: μ_s.
        tilt: β [rad], any shape; downhill is toward -x, or toward +x where it is negative.
        vertical: a_y [m/s²], up positive.
    """
    if not friction >= 0.0:
        raise InputError(f"friction must not be negative, got {friction!r}")
    weight, steep = STANDARD_GRAVITY + np.asarray(vertical), np.abs(np.asarray(tilt, np.float64))
    holds = math.atan(friction)
    uphill = holds + steep
    return weight * np.tan(holds - steep), np.where(
        uphill < np.pi / 2, weight * np.tan(np.minimum(uphill, np.pi / 2)), np.inf
    )


def curve_error(found: ArrayLike, fitted: ArrayLike) -> float:
    """How far a fitted curve is from the values found: √(Σ(X_i - X_f)²/ΣX_f²) (eq. 12).

    Args:
        found: X_i, shape (n,); NaN is left out.
        fitted: X_f, shape (n,).
    """
    x, f = np.asarray(found, np.float64), np.asarray(fitted, np.float64)
    known = np.isfinite(x)
    x, f = x[known], f[known]
    return float(np.sqrt(np.sum((x - f) ** 2) / np.sum(f**2)))
