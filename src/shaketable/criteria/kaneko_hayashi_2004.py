"""The share of similar bodies that overturn on a floor, from the floor's peaks.

Kaneko M., Hayashi Y. (2004) A proposal for simple equations to express a relation between
overturning ratios of rigid bodies and input excitations, 13th WCEE, paper 3299, as eqs. 5-7 of
Cimellaro G.P., Domaneschi M., Qu B. (2020), J. Vibration and Control 26(5-6):362-374:

    R = a Φ((ln PFA - λ_A)/ζ_A)   if F_f <= F_b
    R = a Φ((ln PFV - λ_V)/ζ_V)   otherwise
    λ_A = ln((B/H) g (1 + B/H)) ,  λ_V = ln(10 B/√H (1 + B/H)^2.5)      (cm, cm/s², cm/s)
    F_f = PFA/(2π PFV) ,           F_b = 15.6/√H (1 + B/H)^-1.5

F_b is the frequency of the two medians, A50/(2π V50), so that the branch is that of the smaller of
ln(PFA/A50) and ln(PFV/V50). It is chosen so here, which is the same within the rounding of 15.6.

Cimellaro et al. (2020) do not print the log-standard deviations ζ_A, ζ_V nor the slide coefficient
a. ζ_A can be recovered from their table 2: eq. 9 inverted gives the PFA of every channel, and with
ζ_A = 0.195 to 0.200 (and furniture of B/H = 0.276 to 0.292) the simplified risks that are printed
beside it come out to their rounding. The values of ζ that are used where none is given are this
project's fit to simulations, 0.25 and 0.34; `shaketable study cimellaro-2020` repeats the fit and
the recovery. a is 1, as nothing slides.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError
from shaketable.units import CM, STANDARD_GRAVITY

ZETA_A, ZETA_V = 0.25, 0.34  # this project's: fitted to simulations
#: Recovered from table 2 of Cimellaro et al. (2020): ζ_A, and B/H of the furniture it is for.
RECOVERED_ZETA_A, RECOVERED_RATIO = 0.197, 0.286
SLIDE = 1.0

#: Classes of overturning ratio by their upper limits.
RISK_CLASSES = {"low": 0.03, "medium": 0.3, "high": 0.7, "very high": math.inf}


def risk_class(ratio: float) -> str:
    """Low, medium, high or very high, for an overturning ratio in [0, 1].

    Raises:
        InputError: a ratio outside [0, 1].
    """
    if not 0.0 <= ratio <= 1.0:
        raise InputError(f"an overturning ratio must lie in [0, 1], got {ratio!r}")
    return next(name for name, limit in RISK_CLASSES.items() if ratio < limit)


def median_acceleration(base: ArrayLike, height: ArrayLike) -> NDArray[np.float64]:
    """A50 [m/s²], the exponential of λ_A (eq. 6); full sizes [m], all shapes broadcast."""
    ratio = np.asarray(base, np.float64) / np.asarray(height, np.float64)
    return np.asarray(STANDARD_GRAVITY * ratio * (1.0 + ratio))


def median_velocity(base: ArrayLike, height: ArrayLike) -> NDArray[np.float64]:
    """V50 [m/s], the exponential of λ_V (eq. 6); full sizes [m], all shapes broadcast."""
    b, h = np.asarray(base, np.float64) / CM, np.asarray(height, np.float64) / CM
    return np.asarray(CM * 10.0 * b / np.sqrt(h) * (1.0 + b / h) ** 2.5)


def demands(
    base: ArrayLike, height: ArrayLike, pfa: ArrayLike, pfv: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """ln(PFA/A50) and ln(PFV/V50); the smaller one decides.

    Args:
        base, height: full sizes [m]; all shapes broadcast together.
        pfa: peak floor acceleration [m/s²].
        pfv: peak floor velocity [m/s].

    Raises:
        InputError: sizes that are not positive, peaks that are negative or missing (NaN).
    """
    sizes = np.broadcast_arrays(np.asarray(base, np.float64), np.asarray(height, np.float64))
    if not all((np.isfinite(size) & (size > 0.0)).all() for size in sizes):
        raise InputError("Kaneko & Hayashi need a positive base and height [m]")
    for name, unit, value in (("pfa", "m/s²", pfa), ("pfv", "m/s", pfv)):
        if not (np.asarray(value, np.float64) >= 0.0).all():
            raise InputError(
                f"Kaneko & Hayashi need {name} [{unit}], not negative; got {value!r}: integrate "
                "the floor motion for its velocity (shaketable.signal.peaks)"
            )
    with np.errstate(divide="ignore"):
        return (
            np.asarray(np.log(np.asarray(pfa, np.float64) / median_acceleration(base, height))),
            np.asarray(np.log(np.asarray(pfv, np.float64) / median_velocity(base, height))),
        )


def overturning_ratio(
    base: ArrayLike,
    height: ArrayLike,
    pfa: ArrayLike,
    pfv: ArrayLike,
    *,
    zeta_a: float = ZETA_A,
    zeta_v: float = ZETA_V,
    slide: float = SLIDE,
) -> NDArray[np.float64]:
    """R in [0, 1] (eq. 5); arguments as for `demands`.

    Args:
        zeta_a, zeta_v: log-standard deviations; this project's by default.
        slide: coefficient in [0, 1] for bodies that slide.

    Raises:
        InputError: values out of range.
    """
    from scipy.special import ndtr

    if not (zeta_a > 0.0 and zeta_v > 0.0 and 0.0 <= slide <= 1.0):
        raise InputError(
            f"zeta_a and zeta_v must be positive and slide in [0, 1], got {zeta_a!r}, {zeta_v!r}, "
            f"{slide!r}"
        )
    by_acceleration, by_velocity = demands(base, height, pfa, pfv)
    slow = by_acceleration <= by_velocity
    return np.asarray(slide * ndtr(np.where(slow, by_acceleration / zeta_a, by_velocity / zeta_v)))


def body_frequency(base: ArrayLike, height: ArrayLike) -> NDArray[np.float64]:
    """F_b [Hz] with the printed 15.6 (eq. 7); full sizes [m]."""
    b, h = np.asarray(base, np.float64) / CM, np.asarray(height, np.float64) / CM
    return np.asarray(15.6 / np.sqrt(h) * (1.0 + b / h) ** -1.5)


def floor_frequency(pfa: ArrayLike, pfv: ArrayLike) -> NDArray[np.float64]:
    """F_f [Hz] (eq. 7) of a floor's PFA [m/s²] and PFV [m/s]."""
    return np.asarray(np.asarray(pfa, np.float64) / (2.0 * math.pi * np.asarray(pfv, np.float64)))
