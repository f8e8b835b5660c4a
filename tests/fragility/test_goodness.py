"""How well a lognormal fits: what is lognormal passes, what is not is seen."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ndtr

from shaketable import Body
from shaketable.fragility.curve import Curve
from shaketable.fragility.goodness import goodness, monotone
from shaketable.fragility.limit_states import limit_state
from shaketable.fragility.lognormal import Points, fit_many
from shaketable.signal import measure_named


def points(chance: object, seed: int = 1, number: int = 4000) -> Points:
    rng = np.random.default_rng(seed)
    level = np.exp(rng.uniform(-1.2, 1.2, number))
    reached = (rng.random(number) < chance(level)).astype(np.int64)  # type: ignore[operator]
    return Points(level, reached, np.ones(number, np.int64), np.arange(number) % 40)


def curve(given: Points) -> Curve:
    return Curve(
        body=Body.rectangle(0.3, 1.8), state=limit_state("overturns"),
        measure=measure_named("PGV"), fits=fit_many(given, np.ones((1, 40))), data=given,
        falls=None, recording_names=tuple(map(str, range(40))), event=np.arange(40),
    )  # fmt: skip


def test_what_is_lognormal_fits() -> None:
    found = goodness(curve(points(lambda x: ndtr(np.log(x) / 0.4))))
    assert found.curvature_p > 0.01
    assert found.departure < 0.1  # isotonic steps of 4,000 points waver by some 5 %
    assert found.logistic_median == pytest.approx(1.0, rel=0.03)
    assert found.monotone_median == pytest.approx(1.0, rel=0.06)
    assert found.deviance < found.logistic_deviance


def test_regressions_are_those_of_statsmodels() -> None:
    """Both maximise the same likelihoods; theirs stops where the deviance moves by 1e-8."""
    import statsmodels.api as sm

    given = points(lambda x: ndtr(np.log(x) / 0.4), seed=3, number=300)
    given = given._replace(reached=2 * given.reached + 1, trials=np.full(300, 3))
    found = goodness(curve(given))
    counts = np.column_stack([given.reached, given.trials - given.reached])
    line = sm.add_constant(np.log(given.intensity))
    links = sm.families.links
    fits = [
        sm.GLM(counts, line, family=sm.families.Binomial(link)).fit()
        for link in (links.Probit(), links.Logit())
    ]
    assert found.deviance == pytest.approx(fits[0].deviance, rel=1e-7)
    assert found.logistic_deviance == pytest.approx(fits[1].deviance, rel=1e-7)
    a, b = fits[1].params
    assert found.logistic_median == pytest.approx(np.exp(-a / b), rel=1e-6)


def test_what_is_not_is_seen() -> None:
    found = goodness(curve(points(lambda x: np.where(x < 1.0, 0.0, 0.25 + 0.1 * np.log(x)))))
    assert found.curvature_p < 0.002  # the least that 1,999 drawn signs can tell
    assert found.departure > 0.08


def test_a_monotone_function_is_the_pooled_mean_of_what_falls() -> None:
    """Pool adjacent violators by hand (Barlow and others 1972, section 1.2)."""
    level = np.array([1.0, 2.0, 2.0, 3.0, 4.0])
    given = Points(level, np.array([0, 2, 1, 0, 2]), np.full(5, 2), np.zeros(5, np.intp))
    levels, rising = monotone(given)
    assert levels.tolist() == [1.0, 2.0, 3.0, 4.0]
    assert rising == pytest.approx([0.0, 0.5, 0.5, 1.0])  # 3 of 4, then 0 of 2: 3 of 6
