"""Conversions at the borders: everything inside is SI (m, s, m/s², rad)."""

from __future__ import annotations

import math

from shaketable.errors import InputError, quoted

STANDARD_GRAVITY = 9.80665  # m/s²
CM = 0.01  # m

#: Units of acceleration that the command line and its errors offer.
OFFERED_UNITS = ("g", "m/s2", "cm/s2", "gal")

#: m/s² in one unit of acceleration, by every spelling that is accepted.
ACCELERATION_UNITS = {
    "g": STANDARD_GRAVITY,
    "m/s2": 1.0,
    "m/s²": 1.0,
    "m/s^2": 1.0,
    "m/s**2": 1.0,
    "cm/s2": CM,
    "cm/s²": CM,
    "cm/s^2": CM,
    "cm/s**2": CM,
    "gal": CM,
    "mm/s2": 0.1 * CM,
    "g/10": 0.1 * STANDARD_GRAVITY,
}


def acceleration_factor(unit: str) -> float:
    """m/s² in one `unit` of acceleration; InputError names the accepted spellings."""
    try:
        spelled = unit.strip().lower().replace("sec", "s").replace("/s/s", "/s2")
        return ACCELERATION_UNITS[spelled]
    except KeyError:
        accepted = ", ".join(ACCELERATION_UNITS)
        raise InputError(
            f"unknown unit of acceleration {quoted(unit)}; accepted: {accepted}"
        ) from None


def radians(degrees: float) -> float:
    return math.radians(degrees)


def degrees(radians: float) -> float:
    return math.degrees(radians)
