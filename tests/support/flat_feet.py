"""Feet that slide on a level support without lifting: an independent time stepping.

Implicit in velocities and friction (Moreau), of first order. The motion of each step makes

    ½ (v - v_free)ᵀ M (v - v_free) + h Σ μ_i N_i |v_i|

least over the base's two velocities and its spin, with the pressures of least ΣN² under the moment
of the friction; |v_i| is rounded off, less and less. Nothing here is shared with the package.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

GRAVITY = 9.80665
ROUNDING = 1e-10  # m/s


@njit  # type: ignore[untyped-decorator]
def _step(free, inertia, arms, most):  # type: ignore[no-untyped-def]
    x, rounding = np.zeros(3), 1.0
    while True:
        for _ in range(60):
            g = np.array([x[0] - free[0], x[1] - free[1], inertia * (x[2] - free[2])])
            h = np.diag(np.array([1.0, 1.0, inertia]))
            for i in range(len(most)):
                u, v = x[0] - x[2] * arms[i, 1], x[1] + x[2] * arms[i, 0]
                size = math.sqrt(u * u + v * v + rounding * rounding)
                j = np.array([[1.0, 0.0, -arms[i, 1]], [0.0, 1.0, arms[i, 0]]])
                along = np.array([u, v]) / size
                g += most[i] * (j.T @ along)
                h += most[i] / size * (j.T @ (np.eye(2) - np.outer(along, along)) @ j)
            d = -np.linalg.solve(h, g)
            part = 1.0
            for _ in range(40):  # until the slope along the step is small or below zero
                y = x + part * d
                slope = (y[0] - free[0]) * d[0] + (y[1] - free[1]) * d[1]
                slope += inertia * (y[2] - free[2]) * d[2]
                for i in range(len(most)):
                    u, v = y[0] - y[2] * arms[i, 1], y[1] + y[2] * arms[i, 0]
                    size = math.sqrt(u * u + v * v + rounding * rounding)
                    du, dv = d[0] - d[2] * arms[i, 1], d[1] + d[2] * arms[i, 0]
                    slope += most[i] * (u * du + v * dv) / size
                if slope <= -0.5 * np.dot(g, d):
                    break
                part *= 0.5
            x = x + part * d
            if np.abs(part * d).max() < 1e-3 * rounding:
                break
        if rounding <= ROUNDING:
            return x
        rounding = max(ROUNDING, 0.05 * rounding)


@njit  # type: ignore[untyped-decorator]
def _run(feet, frictions, h, inertia, acceleration, dt, parts):  # type: ignore[no-untyped-def]
    basis = np.ones((len(feet), 3))
    basis[:, 1:] = feet
    share = basis @ np.linalg.inv(basis.T @ basis)
    place, v, pull, step = np.zeros(3), np.zeros(3), np.zeros(2), dt / parts
    for k in range(len(acceleration) - 1):
        for s in range(parts):
            u = (s + 1.0) / parts
            a = acceleration[k] * (1 - u) + acceleration[k + 1] * u
            c, d = math.cos(place[2]), math.sin(place[2])
            free = np.array([v[0] - step * a[0], v[1] - step * a[1], v[2]])
            arms = feet @ np.array([[c, d], [-d, c]])
            for _ in range(40):
                own = np.array([c * pull[0] + d * pull[1], -d * pull[0] + c * pull[1]])
                pressures = share @ np.array([GRAVITY, -h * own[0], -h * own[1]])
                x = _step(free, inertia, arms, frictions * np.maximum(pressures, 0.0) * step)
                now = (x[:2] - free[:2]) / step
                done = np.abs(now - pull).max() < 1e-9
                pull = now
                if done:
                    break
            v = x
            place = place + step * v
    return place


def slide(
    feet: NDArray[np.float64],
    frictions: NDArray[np.float64],
    cg_height: float,
    inertia: float,
    acceleration: NDArray[np.float64],
    time_step: float,
    parts: int,
) -> NDArray[np.float64]:
    """Where a base ends: its displacement [m] and its turn [rad], (3,).

    Args:
        feet: from the foot of the centre of gravity [m], (n, 2).
        frictions: of each.
        cg_height: [m].
        inertia: about the normal, per mass [m²].
        acceleration: of the ground [m/s²], (samples, 2).
        time_step: between them [s].
        parts: steps to a sample.
    """
    found: NDArray[np.float64] = _run(
        np.ascontiguousarray(feet), frictions, cg_height, inertia, acceleration, time_step, parts
    )
    return found
