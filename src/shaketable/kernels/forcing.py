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

    push: NDArray[np.float64]  # a_x [m/s²]
    gravity: NDArray[np.float64]  # g + a_y [m/s²]
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

    gravity: float  # g + a_y
    gravity_change: float
    push: float  # a_x, or s a_x as seen from side s
    push_change: float


@kernel
def forcing_at(shaking: Shaking, i: int, sign: float) -> Forcing:
    """The forcing in interval i, its push times `sign`; gravity alone once the motion has ended."""
    push, gravity = shaking.push, shaking.gravity
    if i + 1 >= push.size:
        return Forcing(STANDARD_GRAVITY, 0.0, 0.0, 0.0)
    return Forcing(
        gravity[i],
        gravity[i + 1] - gravity[i],
        sign * push[i],
        sign * (push[i + 1] - push[i]),
    )


@kernel
def forcing_from(shaking: Shaking, at: Instant) -> Forcing:
    """The forcing in what is left of an interval."""
    return rest_of(forcing_at(shaking, at.i, at.polarity), at.u)


@kernel
def seen_from(forcing: Forcing, sign: float) -> Forcing:
    """The forcing with its push times `sign`."""
    return Forcing(
        forcing.gravity, forcing.gravity_change, sign * forcing.push, sign * forcing.push_change
    )


@kernel
def rest_of(forcing: Forcing, u: float) -> Forcing:
    """The forcing in what is left of its interval after the fraction u."""
    left = 1.0 - u
    return Forcing(
        forcing.gravity + u * forcing.gravity_change,
        left * forcing.gravity_change,
        forcing.push + u * forcing.push_change,
        left * forcing.push_change,
    )
