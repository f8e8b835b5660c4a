"""One function of two dimensionless measures, for bodies of all sizes."""

from __future__ import annotations

import numpy as np
import pytest
import statsmodels.api as sm

from shaketable import Body, InputError, Motion, simulate_many, suite
from shaketable.fragility import vector_fragility
from shaketable.fragility.size import size_of
from shaketable.fragility.two_measures import BOTH
from shaketable.plot import plot_two_measures
from shaketable.signal import intensity_measures
from shaketable.synthesis import one_sine
from shaketable.units import STANDARD_GRAVITY

BODIES = [Body.rectangle(0.32, 1.8), Body.rectangle(0.15, 0.6), Body.rectangle(0.5, 1.7)]
SCALES = (0.5, 1.0, 2.0, 4.0)


@pytest.fixture(scope="module")
def far_field() -> list[Motion]:
    return suite("fema-p695-far-field")


def test_it_is_the_probit_regression_of_statsmodels(far_field: list[Motion]) -> None:
    """Of the same simulations, to 1e-5: statsmodels stops where the deviance moves by 1e-8."""
    found = vector_fragility(BODIES, far_field, scales=SCALES, draws=0)
    runs = simulate_many(BODIES, far_field, scales=SCALES, progress=False)
    measures = [intensity_measures(motion) for motion in far_field]
    rows, counts = [], []
    for b, body in enumerate(BODIES):
        p, alpha = size_of(body)
        for m, each in enumerate(measures):
            for k, scale in enumerate(SCALES):
                acceleration = scale * each["PGA"] / (STANDARD_GRAVITY * np.tan(alpha))
                if acceleration <= 1.0:  # nothing moves
                    continue
                velocity = p * scale * each["PGV"] / (STANDARD_GRAVITY * np.tan(alpha))
                fell = int((runs.outcome.values[b, m, :, 0, k] != 0).sum())
                rows.append([1.0, np.log(velocity), np.log(acceleration)])
                counts.append([fell, 2 - fell])
    family = sm.families.Binomial(sm.families.links.Probit())
    fit = sm.GLM(np.array(counts), np.array(rows), family=family).fit()
    assert found.coefficients[0] == pytest.approx(fit.params, rel=1e-5)
    assert found.dispersion == pytest.approx(1.0 / fit.params[1:].sum(), rel=1e-5)


def test_scaling_a_body_and_a_motion_alike_changes_nothing(far_field: list[Motion]) -> None:
    """A body four times as large has half the p: under twice the PGV it is the same block."""
    found = vector_fragility(BODIES, far_field, scales=SCALES, draws=0)
    small, large = Body.rectangle(0.2, 1.0), Body.rectangle(0.8, 4.0)
    of_small = found.probability(small, [0.2, 0.4], [3.0, 5.0])
    assert found.probability(large, [0.4, 0.8], [3.0, 5.0]) == pytest.approx(of_small, rel=1e-12)
    # and none moves below PGA = g tan α, 1.96 m/s² of these
    assert found.probability(small, 9.0, [1.9, 2.1]).tolist() == [0.0, pytest.approx(1.0, abs=0.1)]


def test_both_measures_tell_more_than_one(far_field: list[Motion]) -> None:
    """Of bodies of different sizes; the interval of the difference is not asked for."""
    found = vector_fragility(BODIES, far_field, draws=60)
    table = found.compared.set_index("measure")
    assert table["dispersion"].idxmin() == BOTH
    assert table.loc["PGA/(g tan α)", "dispersion"] < table.loc["PGA", "dispersion"]
    assert table.loc["p·PGV/(g tan α)", "dispersion"] < table.loc["PGV", "dispersion"]
    assert ((table["low"] < table["dispersion"]) & (table["dispersion"] < table["high"])).all()
    low, high = found.intervals.T
    assert ((low < found.coefficients[0]) & (found.coefficients[0] < high)).all()
    ax = plot_two_measures(found)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("p·PGV/(g tan α)", "PGA/(g tan α)")


def test_bad_input(far_field: list[Motion]) -> None:
    with pytest.raises(InputError, match="all of the simulations in which a body can move reach"):
        vector_fragility(BODIES, far_field[:4], limit_state="uplift")
    with pytest.raises(InputError, match="none of the simulations in which a body can move reach"):
        vector_fragility(BODIES, far_field[:4], scales=(1e-3,))
    with pytest.raises(InputError, match="sliding depends on friction"):
        vector_fragility(BODIES, far_field[:4], limit_state="slides 0.1 m")
    with pytest.raises(InputError, match="parted sharply"):
        # one pulse at two levels: nothing is left to chance
        vector_fragility(BODIES[0], [one_sine(1.0, 1.0)], scales=(2.0, 40.0), polarities=[1])
