"""The ground's acceleration as a body meets it, in one interval between two samples.

Symbols as in `rocking`. An interval is one time step of the motion, in which both accelerations
are linear; a part of it is again such an interval.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import kernel
from shaketable.units import STANDARD_GRAVITY


class Shaking(NamedTuple):
    """A motion at its samples."""

    a_x: NDArray[np.float64]  # of the support [m/s²]
    g_effective: NDArray[np.float64]  # g + a_y [m/s²]
    time_step: float  # s


class Interval(NamedTuple):
    """One interval of a motion as one body meets it."""

    i: int  # its number; beyond the motion's end there is only gravity
    start: float  # s
    polarity: float  # factor on a_x


class Instant(NamedTuple):
    """A time within an interval."""

    i: int
    u: float  # the fraction of it that has passed
    polarity: float


class Forcing(NamedTuple):
    """Ground acceleration in an interval: at its start, and its change until its end [m/s²]."""

    g_effective: float  # g + a_y
    g_effective_change: float
    a_x: float  # or s a_x as seen from side s
    a_x_change: float


@kernel
def forcing_at(shaking: Shaking, i: int, sign: float) -> Forcing:
    """The forcing in interval i, its a_x times `sign`; gravity alone once the motion has ended."""
    a_x, g_effective = shaking.a_x, shaking.g_effective
    if i + 1 >= a_x.size:
        return Forcing(STANDARD_GRAVITY, 0.0, 0.0, 0.0)
    return Forcing(
        g_effective[i],
        g_effective[i + 1] - g_effective[i],
        sign * a_x[i],
        sign * (a_x[i + 1] - a_x[i]),
    )


@kernel
def forcing_from(shaking: Shaking, at: Instant) -> Forcing:
    """The forcing in what is left of an interval."""
    return rest_of(forcing_at(shaking, at.i, at.polarity), at.u)


@kernel
def seen_from(forcing: Forcing, sign: float) -> Forcing:
    """The forcing with its a_x times `sign`."""
    return Forcing(
        forcing.g_effective,
        forcing.g_effective_change,
        sign * forcing.a_x,
        sign * forcing.a_x_change,
    )


@kernel
def rest_of(forcing: Forcing, u: float) -> Forcing:
    """The forcing in what is left of its interval after the fraction u."""
    left = 1.0 - u
    return Forcing(
        forcing.g_effective + u * forcing.g_effective_change,
        left * forcing.g_effective_change,
        forcing.a_x + u * forcing.a_x_change,
        left * forcing.a_x_change,
    )
