"""How a body at rest begins to move: Shenton's criteria and the general model."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, Support, simulate
from shaketable.criteria.shenton_1996 import Mode, initial_mode, shape_of, slip_limit, thresholds
from shaketable.modes import map_modes, simulated_mode
from shaketable.plot import plot_modes

CASES = 400


def test_symmetric_block_is_shentons() -> None:
    # Boroschek and Romo (2004) eq. 23, Shenton's own bound for a rectangle: ((4γ² + 1) μ -
    # 3γ)/((γ² + 4) - 3γμ)
    body = Body.rectangle(0.4, 1.2)
    gamma, kappa = shape_of(body, 1)
    assert kappa == pytest.approx((1 + gamma**2) / 3)
    for mu in (0.4, 0.6, 1.0):
        shenton = ((4 * gamma**2 + 1) * mu - 3 * gamma) / ((gamma**2 + 4) - 3 * gamma * mu)
        assert slip_limit(mu, gamma, kappa) == pytest.approx(shenton, rel=1e-12)


def test_slender_bodies_begin_to_rock_at_equation_26() -> None:
    # at uplift, A = 1/γ, eq. 25 becomes μ >= 1/γ: the bound passes through that point
    gamma, kappa = shape_of(Body.rectangle(0.4, 1.2, eccentricity=0.4), -1)
    assert slip_limit(1 / gamma, gamma, kappa) == pytest.approx(1 / gamma, rel=1e-12)
    below, above = initial_mode(1.001 / gamma, np.array([0.99, 1.01]) / gamma, 0.0, gamma, kappa)
    assert (below, above) == (Mode.SLIDE, Mode.ROCK)


def test_enough_friction_never_slips() -> None:
    # beyond κ + 1 = γ μ the inequality of eq. 24 turns round (theory, section 8)
    gamma, kappa = shape_of(Body.rectangle(0.4, 1.2), 1)
    assert slip_limit(1.01 * (kappa + 1) / gamma, gamma, kappa) == np.inf
    assert initial_mode(50.0, 1.01 * (kappa + 1) / gamma, 0.1, gamma, kappa) == Mode.ROCK


def test_a_map_simulates_first_phases_only(monkeypatch: pytest.MonkeyPatch) -> None:
    # a needle bounces a million times after the motion's end; 484 such runs took 270 s
    monkeypatch.setattr(General, "run_one", None)
    found = map_modes(Body.rectangle(0.1, 45.0), 1, friction=0.4)
    assert set(found.simulated) == {Mode.ROCK, Mode.SLIDE_ROCK}


def test_the_first_phase_is_that_of_a_whole_run() -> None:
    rng = np.random.default_rng(3)
    for _ in range(50):
        model = General(static_friction=rng.uniform(0.05, 1.0))
        body = Body.rectangle(rng.uniform(0.1, 1.5), 1.0)
        motion = Motion(rng.uniform(-15.0, 15.0, 5), 0.01)
        tilt = rng.uniform(0.0, 0.04)
        first = model.first_phase(body, tilt, motion)
        assert first == simulate(body, motion, Support(tilt=tilt), model=model).phases[0]


@pytest.mark.parametrize("kinetic_ratio", [1.0, 0.8])
def test_simulations_begin_as_the_criteria_say(kinetic_ratio: float) -> None:
    rng = np.random.default_rng(8)
    seen = set()
    for _ in range(CASES):
        body = Body.rectangle(rng.uniform(0.1, 1.5), 1.0, eccentricity=rng.uniform(0.3, 0.7))
        direction = int(rng.choice([1, -1]))
        gamma, kappa = shape_of(body, direction)
        a, mu = rng.uniform(0, 3) / gamma, rng.uniform(0, 2) / gamma
        near = initial_mode(a * np.array([0.999, 1.0, 1.001]), mu, kinetic_ratio * mu, gamma, kappa)
        if len(set(near)) > 1:  # on a border both are right
            continue
        found = simulated_mode(body, direction, a, mu, kinetic_ratio * mu)
        assert found == near[1]
        seen.add(found)
    assert seen == set(Mode)


def test_thresholds() -> None:
    shape = shape_of(Body.rectangle(0.4, 1.0), 1)  # 1/γ = 0.4
    assert thresholds(0.3, 0.3, *shape) == [(Mode.SLIDE, 0.3)]
    (rock, at), (slip, limit) = thresholds(0.5, 0.45, *shape)
    assert (rock, slip) == (Mode.ROCK, Mode.SLIDE_ROCK)
    assert at == pytest.approx(0.4)
    assert initial_mode([limit * 0.999, limit * 1.001], 0.5, 0.45, *shape).tolist() == [
        Mode.ROCK,
        Mode.SLIDE_ROCK,
    ]
    assert thresholds(3.0, 3.0, *shape) == [(Mode.ROCK, pytest.approx(0.4))]


def test_the_map_has_areas_and_points() -> None:
    modes = map_modes(Body.rectangle(0.4, 1.0, name="cart"), 1, friction=0.5, kinetic_ratio=0.9)
    assert set(np.unique(modes.modes)) == set(Mode) == set(np.unique(modes.simulated))
    ax = plot_modes(modes, 0.5)
    assert "|a$_x$|/g" in ax.get_xlabel()
    assert "friction" in ax.get_ylabel()
    assert "cart" in ax.get_title()
    assert sum(line.get_xdata().size for line in ax.lines[:4]) == modes.simulated.size


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"direction": 0, "friction": 0.5}, "direction"),
        ({"direction": 1, "friction": 0.0}, "positive"),
        ({"direction": 1, "friction": np.inf}, "at most 1000"),
        ({"direction": 1, "friction": 1e308}, "at most 1000"),
        ({"direction": 1, "friction": 0.5, "kinetic_ratio": 1.2}, r"\[0, 1\]"),
    ],
)
def test_bad_input(given: dict, said: str) -> None:
    with pytest.raises(InputError, match=said):
        map_modes(Body.rectangle(0.4, 1.0), **given)


def test_negative_values_are_refused() -> None:
    for values in ((-0.1, 0.5, 0.5), (0.1, 0.5, 0.6), (0.1, -0.5, -0.5)):
        with pytest.raises(InputError, match="kinetic_friction"):
            initial_mode(*values, 2.0, 1.0)
