"""Floor motions against a direct integration of the whole building and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import eigh, expm

from shaketable import InputError, Motion
from shaketable.signal import response_spectrum
from shaketable.synthesis import ShearBuilding, floor_motions


def direct(building: ShearBuilding, ground: Motion) -> np.ndarray:
    """Absolute floor accelerations by the state-space matrix exponential: no modes.

    x' = A x + B a_g with a_g linear in a step is integrated exactly by the exponential of the
    matrix that also holds a_g and its slope. Damping: C = Φ^-T diag(2 ζ w) Φ^-1.
    """
    n = building.storeys
    m, storeys = np.diag(building.masses), np.array(building.stiffnesses)
    k = np.diag(storeys + np.append(storeys[1:], 0.0))
    k -= np.diag(storeys[1:], 1) + np.diag(storeys[1:], -1)
    k *= (2 * math.pi / building.first_period) ** 2 / eigh(k, m, eigvals_only=True)[0]
    squares, shapes = eigh(k, m)
    inverse = np.linalg.inv(shapes)
    c = inverse.T @ np.diag(2 * building.damping * np.sqrt(squares)) @ inverse
    a = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]])
    b = np.concatenate([np.zeros(n), -np.ones(n)])[:, None]
    h = ground.time_step
    whole = np.zeros((2 * n + 2, 2 * n + 2))
    whole[: 2 * n, : 2 * n] = a
    whole[: 2 * n, 2 * n : 2 * n + 1] = b
    whole[2 * n, 2 * n + 1] = 1.0
    step = expm(whole * h)[: 2 * n]
    x = np.zeros(2 * n)
    found = np.zeros((n, ground.horizontal.size))
    for i in range(ground.horizontal.size):
        found[:, i] = (a @ x)[n:]  # relative acceleration less -a_g is the absolute one
        if i + 1 < ground.horizontal.size:
            slope = (ground.horizontal[i + 1] - ground.horizontal[i]) / h
            x = step @ np.concatenate([x, [ground.horizontal[i], slope]])
    return found


@pytest.mark.parametrize(
    "building",
    [
        ShearBuilding(storeys=6, first_period=0.65),
        ShearBuilding(storeys=3, first_period=0.4, damping=0.02, masses=[2.0, 1.5, 1.0]),
        ShearBuilding(storeys=4, first_period=1.3, damping=0.1, stiffnesses=[4, 3, 2, 1]),
        ShearBuilding(storeys=1, first_period=0.2),
    ],
    ids=["six", "masses", "stiffnesses", "one"],
)
def test_against_direct_integration(building: ShearBuilding, p695: list[Motion]) -> None:
    ground = p695[0]
    found = floor_motions(building, ground)
    expected = direct(building, ground)
    count = ground.horizontal.size
    for motion, series in zip(found, expected, strict=True):
        # both are exact; 3000 steps of round-off
        assert motion.horizontal[:count] == pytest.approx(series, abs=1e-8)


def test_uniform_building_in_closed_form() -> None:
    # T_n/T_1 = sin(π/(2(2N+1)))/sin((2n-1)π/(2(2N+1)))
    N = 6
    periods, shares = ShearBuilding(storeys=N, first_period=1.0).modes()
    angle = math.pi / (2 * (2 * N + 1))
    expected = [math.sin(angle) / math.sin((2 * n - 1) * angle) for n in range(1, N + 1)]
    assert periods == pytest.approx(expected)
    assert shares.sum(axis=1) == pytest.approx(np.ones(N))


def test_stiff_building_follows_the_ground(p695: list[Motion]) -> None:
    ground = p695[0]
    roof = floor_motions(ShearBuilding(storeys=5, first_period=1e-3), ground)[-1]
    count = ground.horizontal.size
    # quasi-static: off by (T/2π h)² of the jumps of slope
    assert roof.horizontal[1:count] == pytest.approx(ground.horizontal[1:], abs=0.01)


def test_one_storey_is_the_oscillator_of_the_spectrum(p695: list[Motion]) -> None:
    ground, T, z = p695[2], 0.7, 0.02
    (floor,) = floor_motions(ShearBuilding(storeys=1, first_period=T, damping=z), ground)
    # absolute against pseudo-acceleration: √(1 + 4ζ²) at most; peaks at samples: (wh)²/8 = 1e-3
    assert floor.peak_ground_acceleration == pytest.approx(
        response_spectrum(ground, [T], damping=z).acceleration[0], rel=3e-3
    )


def test_what_travels_along(p695: list[Motion]) -> None:
    ground = Motion(
        p695[0].horizontal,
        p695[0].time_step,
        vertical=p695[1].horizontal,
        name="a",
        origin=p695[0].origin,
    )
    floors = floor_motions(ShearBuilding(storeys=2, first_period=0.5), ground)
    assert [floor.name for floor in floors] == ["a floor 1", "a floor 2"]
    assert floors[1].origin.location == "floor 2"
    assert "linear shear building" in floors[1].origin.processing[-1]
    count = ground.horizontal.size
    np.testing.assert_array_equal(floors[0].vertical[:count], ground.vertical)
    # ten first periods more, of which 5 % damping leaves e^{-π}: 4 %
    assert floors[1].duration == pytest.approx(ground.duration + 5.0, abs=0.011)
    end = np.abs(floors[1].horizontal[-20:]).max()
    assert end < 0.043 * floors[1].peak_ground_acceleration


@pytest.mark.parametrize(
    "bad",
    [
        {"storeys": 0},
        {"storeys": 2.5},
        {"first_period": 0.0},
        {"damping": 1.0},
        {"masses": [1.0]},
        {"masses": [1.0, -1.0, 1.0]},
        {"stiffnesses": [1.0, math.nan, 1.0]},
    ],
)
def test_buildings_are_checked(bad: dict) -> None:
    with pytest.raises(InputError):
        ShearBuilding(**{"storeys": 3, "first_period": 0.5, **bad})
