"""Buildings that sway and twist."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from shaketable import InputError, Motion, floor_motions
from shaketable.synthesis import TorsionalBuilding, edge_motions


def pulse(count: int = 400, h: float = 0.01) -> Motion:
    times = np.arange(count) * h
    return Motion(np.sin(2 * np.pi * 1.5 * times) * (times < 2.0), h, name="pulse")


def test_without_eccentricity_it_is_a_shear_building() -> None:
    building = TorsionalBuilding(storeys=3, first_period=0.5, plan=(20.0, 12.0))
    rest = Motion(np.zeros(400), 0.01, name="rest")
    found = edge_motions(building, pulse(), rest)
    expected = floor_motions(building.sway(), pulse())
    for one in found:
        if one.direction == "x":
            # round-off of a product of modes
            assert one.motion.horizontal == pytest.approx(
                expected[one.floor - 1].horizontal, abs=1e-12
            )
        else:
            assert np.abs(one.motion.horizontal).max() < 1e-12


def test_one_floor_against_an_integrator() -> None:
    """One floor with eccentricity in both directions, by DOP853 from the equations of motion.

    Damping is that of the modes: C = M Φ diag(2 ζ w) Φᵀ M.
    """
    building = TorsionalBuilding(
        storeys=1, first_period=0.6, plan=(20.0, 12.0), eccentricity=(0.1, -0.2),
        torsional_ratio=1.1, damping=0.04,
    )  # fmt: skip
    rho2 = (20.0**2 + 12.0**2) / 12.0
    e_x, e_y = 2.0, -2.4
    k = (2 * math.pi / 0.6) ** 2
    mass = np.diag([1.0, 1.0, rho2])
    stiffness = k * np.array(
        [[1, 0, -e_y], [0, 1, e_x], [-e_y, e_x, e_x**2 + e_y**2 + 1.21 * rho2]]
    )
    squares, shapes = building.floor_modes()
    w = np.sqrt(k * squares)
    damping = mass @ shapes @ np.diag(2 * 0.04 * w) @ shapes.T @ mass
    along, across = pulse(), Motion(0.5 * np.cos(pulse().time), 0.01, name="cos")
    times = along.time

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        ground = np.array(
            [np.interp(t, times, along.horizontal), np.interp(t, times, across.horizontal), 0.0]
        )
        push = -mass @ ground - damping @ y[3:] - stiffness @ y[:3]
        return np.concatenate([y[3:], np.linalg.solve(mass, push)])

    run = solve_ivp(rate, (0, 3.5), np.zeros(6), "DOP853", rtol=1e-10, atol=1e-12, max_step=0.005,
                    t_eval=times[:350:10])  # fmt: skip
    ends = np.linalg.solve(mass, -(damping @ run.y[3:] + stiffness @ run.y[:3]))
    found = {(one.direction, one.at): one.motion.horizontal[:350:10]
             for one in edge_motions(building, along, across)}  # fmt: skip
    for key, expected in {
        ("x", "-"): ends[0] + 6.0 * ends[2],
        ("x", "+"): ends[0] - 6.0 * ends[2],
        ("y", "-"): ends[1] - 10.0 * ends[2],
        ("y", "+"): ends[1] + 10.0 * ends[2],
    }.items():
        # the integrator meets the corners of the ground's straight pieces between its steps
        assert found[key] == pytest.approx(expected, abs=2e-5), key


def test_bad_input() -> None:
    good = {"storeys": 2, "first_period": 0.5, "plan": (10.0, 10.0)}
    for change, message in (
        ({"plan": (0.0, 1.0)}, "plan"),
        ({"eccentricity": (0.6, 0.0)}, "within the plan"),
        ({"torsional_ratio": 0.0}, "torsional_ratio"),
        ({"storeys": 0}, "storeys"),
    ):
        with pytest.raises(InputError, match=message):
            TorsionalBuilding(**{**good, **change})
    with pytest.raises(InputError, match="time step"):
        edge_motions(TorsionalBuilding(**good), pulse(), pulse(h=0.02))
