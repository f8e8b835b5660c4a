"""The direction along which a touch slips against its own friction."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable.physics.space.complementarity import TURN, slip_angle
from shaketable.physics.space.vectors import Sym, Vec

ANGLES = np.linspace(0.0, 2.0 * np.pi, 20_001)


def slips(
    matrix: np.ndarray, free: np.ndarray, mu: float, angle: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Slip across and along directions that friction opposes, and the pressure."""
    x, y = np.cos(angle), np.sin(angle)
    per = matrix[2, 2] - mu * (matrix[2, 0] * x + matrix[2, 1] * y)
    pressure = -free[2] / per
    u = free[:, None] + matrix @ np.array([-mu * pressure * x, -mu * pressure * y, pressure])
    return x * u[1] - y * u[0], x * u[0] + y * u[1], np.where(per > 0.0, pressure, -1.0)


@pytest.mark.parametrize("seed", range(200))
def test_friction_opposes_the_slip_that_follows(seed: int) -> None:
    """Against 20,000 directions: none is found where none does, and the nearest one else.

    Nearest to within a part of the circle that is searched for a change of sign.
    """
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(3, 3))
    m = root @ root.T + 0.1 * np.eye(3)
    free = rng.normal(size=3) * np.array([1.0, 1.0, 0.0]) - np.array([0.0, 0.0, 1.0])
    mu, guess = rng.uniform(0.1, 1.2), rng.uniform(-np.pi, np.pi)
    own = Sym(m[0, 0], m[1, 1], m[2, 2], m[0, 1], m[0, 2], m[1, 2])
    angle, found = slip_angle(own, Vec(*free), 0.0, mu, guess)
    across, along, pressure = slips(m, free, mu, ANGLES)
    turns = across[:-1] * across[1:] <= 0.0
    fits = turns & (along[:-1] >= 0.0) & (pressure[:-1] > 0.0) & (pressure[1:] > 0.0)
    assert found == bool(fits.any())
    if found:
        here, ahead, presses = (float(each[0]) for each in slips(m, free, mu, np.array([angle])))
        assert here == pytest.approx(0.0, abs=1e-13 * (1.0 + ahead) * np.abs(m).max() / m[2, 2])
        assert ahead >= 0.0 < presses
        away = np.abs(np.angle(np.exp(1j * (ANGLES[:-1][fits] - guess)))).min()
        assert abs(math.remainder(angle - guess, 2.0 * math.pi)) < away + TURN
