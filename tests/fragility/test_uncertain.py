"""Objects that are not known exactly."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import norm

from shaketable import Body, General, InputError, Motion, fragility, suite
from shaketable.fragility import Uncertain, UncertainBody, uncertain_fragility

SCALES = 2.0 ** np.arange(-2.0, 3.25, 0.5)


@pytest.fixture(scope="module")
def far_field() -> list[Motion]:
    return suite("fema-p695-far-field")


def test_quantiles() -> None:
    share = np.array([0.1, 0.5, 0.9])
    assert Uncertain.normal(1.0, 0.2).at(share) == pytest.approx(norm(1.0, 0.2).ppf(share))
    assert Uncertain.uniform(1.0, 3.0).at(share) == pytest.approx([1.2, 2.0, 2.8])
    logs = np.log(Uncertain.lognormal(2.0, 0.3).at(share))
    assert logs == pytest.approx(norm(np.log(2.0), 0.3).ppf(share))


def test_a_sample_is_a_latin_hypercube() -> None:
    body = UncertainBody(base=Uncertain.uniform(0.3, 0.4), height=Uncertain.normal(1.8, 0.1))
    sample = [one for one, _ in body.drawn(40, seed=3)]
    strata = np.floor((np.array([one.base for one in sample]) - 0.3) / 0.1 * 40)
    assert sorted(strata.tolist()) == list(range(40))  # one in each fortieth
    again = [one for one, _ in body.drawn(40, seed=3)]
    assert sample == again
    assert sample != [one for one, _ in body.drawn(40, seed=4)]
    lifted = UncertainBody(base=0.3, height=1.0, cg_height=Uncertain.uniform(0.3, 0.4))
    assert all(0.3 <= one.cg_height <= 0.4 for one, _ in lifted.drawn(5))


def test_what_is_certain_is_the_function_of_one_body(far_field: list[Motion]) -> None:
    certain = UncertainBody(base=0.32, height=1.8)
    found = uncertain_fragility(certain, far_field, scales=SCALES, members=3, draws=0)
    one = fragility(Body.rectangle(0.32, 1.8), far_field, scales=SCALES, draws=0)
    assert found.curve.median == pytest.approx(one.median, rel=1e-9)
    assert found.curve.beta == pytest.approx(one.beta, rel=1e-9)
    assert found.beta_body == pytest.approx(0.0, abs=1e-12)
    assert found.beta_motions == pytest.approx(one.beta, rel=1e-9)


def test_variances_add(far_field: list[Motion]) -> None:
    """The law of total variance; to 10 %, as a pooled probit is no moment of capacities."""
    doubtful = UncertainBody(base=Uncertain.lognormal(0.32, 0.25), height=1.8)
    found = uncertain_fragility(doubtful, far_field, scales=SCALES, members=48, draws=40)
    assert found.beta_body > 0.15
    total = np.hypot(found.beta_body, found.beta_motions)
    assert found.curve.beta == pytest.approx(total, rel=0.1)
    low, high = found.curve.median_interval
    assert low < found.curve.median < high


def test_friction(far_field: list[Motion]) -> None:
    body = UncertainBody(
        base=0.32, height=1.8, static_friction=Uncertain.uniform(0.1, 0.4), name="shelf"
    )
    found = uncertain_fragility(
        body, far_field[:10], limit_state="slides 0.05 m", model=General(), scales=SCALES,
        members=6, draws=0,
    )  # fmt: skip
    assert np.isfinite(found.medians).any()
    assert found.curve.body.name == "shelf"
    with pytest.raises(InputError, match="static_friction= is for the general model"):
        uncertain_fragility(body, far_field[:2], members=2)


def test_bad_input(far_field: list[Motion]) -> None:
    with pytest.raises(InputError, match="the second not below 0"):
        Uncertain.normal(1.0, -0.1)
    with pytest.raises(InputError, match="median must be above 0"):
        Uncertain.lognormal(0.0, 0.1)
    with pytest.raises(InputError, match="must not be above"):
        Uncertain.uniform(2.0, 1.0)
    wide = UncertainBody(base=Uncertain.normal(0.1, 0.3), height=1.0, name="shelf")
    with pytest.raises(InputError, match="shelf: drawn as base"):
        uncertain_fragility(wide, far_field[:2], members=16)
    with pytest.raises(InputError, match="members must be a positive whole number"):
        wide.drawn(0)
