"""What the spectra of motions should be like."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import InputError

pytest.importorskip("pygmm")

from shaketable.hazard import Scenario, conditional_target, scenario, target_of
from shaketable.hazard.spectral_target import PERIODS


@pytest.fixture(scope="module")
def quake() -> Scenario:
    return scenario(7.0, 20.0, 400.0)


def test_an_earthquakes_own_spectra(quake: Scenario) -> None:
    found = target_of(quake)
    mean, sigma = np.array([quake.of(f"SA({period!r})") for period in PERIODS.tolist()]).T
    assert found.mean == pytest.approx(mean)
    assert found.sigma == pytest.approx(sigma)


def test_a_conditional_spectrum_is_that_of_the_drawn_ones(quake: Scenario) -> None:
    """Against regression over 200,000 spectra drawn without any condition.

    ln spectra are normal, so that the conditional mean is the regression on the ordinate at 1 s and
    the conditional spread that of its residuals; 5 standard errors (σ/√n about 0.0015).
    """
    periods = np.array([0.1, 0.3, 1.0, 3.0])
    free = target_of(quake, periods).draws(200_000, np.random.default_rng(0))
    at = free[:, 2] - free[:, 2].mean()
    slope = at @ (free - free.mean(axis=0)) / (at @ at)
    left = free - np.outer(at, slope)
    level = 0.3 * 9.80665
    found = conditional_target(quake, 1.0, level=level, periods=periods)
    expected = free.mean(axis=0) + slope * (np.log(level) - free[:, 2].mean())
    assert found.mean == pytest.approx(expected, abs=0.01)
    assert found.covariance == pytest.approx(np.cov(left.T), abs=0.01)
    assert found.sigma[2] == 0.0
    assert found.mean[2] == pytest.approx(np.log(level), abs=1e-12)
    drawn = found.draws(50, np.random.default_rng(1))
    assert drawn[:, 2] == pytest.approx(np.full(50, np.log(level)), abs=1e-7)


def test_level_and_epsilon_say_the_same(quake: Scenario) -> None:
    one = conditional_target(quake, 0.5, epsilon=1.0)
    mean, sigma = quake.of("SA(0.5)")
    other = conditional_target(quake, 0.5, level=float(np.exp(mean + sigma)))
    assert one.mean == pytest.approx(other.mean, abs=1e-12)
    assert "epsilon 1" in one.name
    assert 0.5 in one.periods


def test_refused(quake: Scenario) -> None:
    with pytest.raises(InputError, match="one of both"):
        conditional_target(quake, 1.0)
    with pytest.raises(InputError, match="one of both"):
        conditional_target(quake, 1.0, level=1.0, epsilon=1.0)
    with pytest.raises(InputError, match=r"between 0\.05 and 5"):
        conditional_target(quake, 8.0, epsilon=1.0)
    with pytest.raises(InputError, match="level"):
        conditional_target(quake, 1.0, level=-1.0)
    with pytest.raises(InputError, match=r"periods from 0\.01 to 10 s, asked for 1 to 20 s"):
        target_of(quake, np.array([1.0, 20.0]))
