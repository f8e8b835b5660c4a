"""Fits of lognormal functions: against statsmodels, and against what data were drawn from."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ndtr
from scipy.stats import norm

from shaketable.fragility.lognormal import (
    Capacities,
    Points,
    fit_capacities,
    fit_many,
    probability,
    scored,
)

ONCE = np.ones((1, 1))


def drawn(number: int, median: float, beta: float, seed: int, trials: int = 1) -> Points:
    """Outcomes at intensities from a third to three times the median."""
    rng = np.random.default_rng(seed)
    im = median * np.exp(rng.uniform(-1.1, 1.1, number))
    reached = rng.binomial(trials, ndtr(np.log(im / median) / beta))
    return Points(im, reached, np.full(number, trials), np.zeros(number, np.intp))


def test_a_fit_is_that_of_statsmodels() -> None:
    """Both maximise one likelihood, which has one maximum (Wedderburn 1976)."""
    import statsmodels.api as sm

    for seed in range(5):
        points = drawn(200, 3.0, 0.5, seed, trials=2)
        fits = fit_many(points, ONCE)
        counts = np.column_stack([points.reached, points.trials - points.reached])
        family = sm.families.Binomial(sm.families.links.Probit())
        x = sm.add_constant(np.log(points.intensity))
        a, b = sm.GLM(counts, x, family=family).fit(tol=1e-13, tol_criterion="params").params
        assert fits.median[0] == pytest.approx(np.exp(-a / b), rel=1e-9)
        assert fits.beta[0] == pytest.approx(1.0 / b, rel=1e-9)


@pytest.mark.parametrize(("median", "beta"), [(0.4, 0.3), (3.0, 0.5), (0.02, 0.8)])
def test_what_outcomes_were_drawn_from_is_found_again(median: float, beta: float) -> None:
    """At 10⁵ draws its standard errors are some 0.3 and 0.6 %: 2 and 5 % are far outside."""
    fits = fit_many(drawn(100_000, median, beta, 1), ONCE)
    assert fits.median[0] == pytest.approx(median, rel=0.02)
    assert fits.beta[0] == pytest.approx(beta, rel=0.05)


def test_weights_count_as_often() -> None:
    points = drawn(60, 1.0, 0.4, 3)
    points = points._replace(recording=np.arange(60) % 3)
    weights = np.array([[2.0, 0.0, 1.0], [1.0, 1.0, 1.0]])
    fits = fit_many(points, weights)
    often = np.repeat(np.arange(60), weights[0, points.recording].astype(int))
    several = Points(*(np.asarray(one)[often] for one in points))
    again = fit_many(several._replace(recording=np.zeros(often.size, np.intp)), ONCE)
    assert fits.median[0] == pytest.approx(again.median[0], rel=1e-9)
    assert fits.beta[0] == pytest.approx(again.beta[0], rel=1e-9)
    assert fits.median[1] == pytest.approx(fit_many(points, np.ones((1, 3))).median[0], rel=1e-12)


def test_what_cannot_be_fitted() -> None:
    def fit(reached: list[int]) -> tuple[float, float]:
        im = np.array([1.0, 2.0, 3.0, 4.0])
        points = Points(im, np.array(reached), np.ones(4, np.int64), np.zeros(4, np.intp))
        fits = fit_many(points, ONCE)
        return float(fits.median[0]), float(fits.beta[0])

    assert np.isnan(fit([0, 0, 0, 0])).all()
    assert np.isnan(fit([1, 1, 1, 1])).all()
    assert fit([0, 0, 1, 1]) == (pytest.approx(np.sqrt(6.0)), 0.0)  # in order: between 2 and 3
    assert np.isnan(fit([1, 1, 0, 0])).all()  # less likely the stronger


def test_capacities_are_a_sample() -> None:
    rng = np.random.default_rng(2)
    level = 0.5 * np.exp(0.4 * rng.normal(size=500))
    whole = Capacities(level, np.ones(500, np.bool_), np.zeros(500, np.intp))
    fits = fit_capacities(whole, ONCE)
    assert fits.median[0] == pytest.approx(np.exp(np.log(level).mean()), rel=1e-12)
    assert fits.beta[0] == pytest.approx(np.log(level).std(), rel=1e-9)


@pytest.mark.parametrize("limit", [0.4, 0.6])
def test_capacities_that_are_cut_off(limit: float) -> None:
    """The likelihood of Baker (2015) eqs. 3-4, maximised by SciPy instead."""
    from scipy.optimize import minimize

    rng = np.random.default_rng(2)
    level = 0.5 * np.exp(0.4 * rng.normal(size=300))
    reached = level <= limit
    cut = Capacities(np.where(reached, level, limit), reached, np.zeros(300, np.intp))
    fits = fit_capacities(cut, ONCE)

    def unlikely(at: np.ndarray) -> float:
        mean, spread = at[0], np.exp(at[1])
        known = norm.logpdf(np.log(level[reached]), mean, spread).sum()
        return -float(known + (~reached).sum() * norm.logsf(np.log(limit), mean, spread))

    best = minimize(
        unlikely, [0.0, 0.0], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}
    )
    assert fits.median[0] == pytest.approx(np.exp(best.x[0]), rel=1e-6)
    assert fits.beta[0] == pytest.approx(np.exp(best.x[1]), rel=1e-6)


def test_probabilities() -> None:
    levels = np.array([0.5, 1.0, 2.0])
    found = probability(levels, np.float64(1.0), np.float64(0.5))
    assert found == pytest.approx(norm.cdf(np.log(levels) / 0.5))
    assert probability(levels, np.float64(1.5), np.float64(0.0)).tolist() == [0.0, 0.0, 1.0]


def test_what_cannot_be_scored_is_not_a_number() -> None:
    """A draw in which all, or none, or nothing at all was seen has no coefficients; others do."""
    x = np.linspace(-1.0, 1.0, 40)
    columns = np.stack([np.ones(40), x])
    total = np.full((4, 40), 10.0)
    reached = np.stack([np.zeros(40), total[0], np.rint(10.0 * ndtr(x / 0.5)), np.zeros(40)])
    total[3] = 0.0
    found = scored(columns, reached, total)
    assert np.isnan(found[[0, 1, 3]]).all()
    assert found[2] == pytest.approx([0.0, 2.0], abs=0.1)  # rounded shares
