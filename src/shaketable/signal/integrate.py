"""Velocity and displacement of an acceleration that is linear between its samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def velocity(
    acceleration: NDArray[np.float64], time_step: float, *, start: float = 0.0
) -> NDArray[np.float64]:
    """Velocity [m/s], shape (n,), from `start` on; the trapezoidal rule is exact here.

    Args:
        acceleration: [m/s²], shape (n,).
        time_step: [s].
    """
    steps = 0.5 * time_step * (acceleration[1:] + acceleration[:-1])
    return start + np.concatenate([[0.0], np.cumsum(steps)])


def displacement(
    acceleration: NDArray[np.float64], time_step: float, *, start: float = 0.0
) -> NDArray[np.float64]:
    """Displacement [m], shape (n,), from rest at `start` on: u1 = u0 + v0 h + (2 a0 + a1) h²/6.

    Args:
        acceleration: [m/s²], shape (n,).
        time_step: [s].
    """
    v = velocity(acceleration, time_step)
    steps = time_step * v[:-1] + time_step**2 / 6.0 * (2.0 * acceleration[:-1] + acceleration[1:])
    return start + np.concatenate([[0.0], np.cumsum(steps)])
