"""One function of two dimensionless measures, for bodies of all sizes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import statsmodels.api as sm

from shaketable import Body, General, InputError, Motion, simulate_many, suite
from shaketable.fragility import vector_fragility
from shaketable.fragility.two_measures import BOTH
from shaketable.plot import plot_two_measures
from shaketable.signal import intensity_measures
from shaketable.synthesis import one_sine
from shaketable.units import STANDARD_GRAVITY

BODIES = [
    Body.rectangle(0.32, 1.8), Body.rectangle(0.15, 0.6), Body.rectangle(0.5, 1.7),
    Body.rectangle(0.5, 1.2, eccentricity=0.35),
]  # fmt: skip
SCALES = (0.5, 1.0, 2.0, 4.0)


def housner(body: Body) -> tuple[float, float]:
    """p and α by hand: that of the nearer corner, p² = g r/(i² + r²), 3g/4r of a rectangle."""
    near = min(body.left, body.right)
    r2 = near**2 + body.cg_height**2
    p2 = STANDARD_GRAVITY * np.sqrt(r2) / (body.gyration_radius**2 + r2)
    if body.left == body.right:
        assert p2 == pytest.approx(0.75 * STANDARD_GRAVITY / np.sqrt(r2))
    return np.sqrt(p2), np.arctan(near / body.cg_height)


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
        # of homogeneous rectangles (Housner 1963), by the nearer corner
        p, alpha = housner(body)
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
        vector_fragility(BODIES[:3], far_field[:4], limit_state="uplift")
    with pytest.raises(InputError, match="none of the simulations in which a body can move reach"):
        vector_fragility(BODIES, far_field[:4], scales=(1e-3,))
    with pytest.raises(InputError, match="slides before it rocks"):
        vector_fragility(BODIES, far_field[:4], model=General(static_friction=0.2))
    with pytest.raises(InputError, match="sliding depends on friction"):
        vector_fragility(BODIES, far_field[:4], limit_state="slides 0.1 m")
    with pytest.raises(InputError, match="parted sharply"):
        # one pulse at two levels: nothing is left to chance
        vector_fragility(BODIES[0], [one_sine(1.0, 1.0)], scales=(2.0, 40.0), polarities=[1])


def test_what_is_not_known_is_not_zero(
    far_field: list[Motion], caplog: pytest.LogCaptureFixture
) -> None:
    found = vector_fragility(BODIES, far_field, scales=SCALES, draws=0)
    assert np.isnan(found.probability(BODIES[0], 1.0, np.nan))
    assert not caplog.text
    with pytest.raises(InputError, match="must not be negative"):
        found.probability(BODIES[0], -1.0, 3.0)
    found.probability(Body.rectangle(5.0, 1.0, name="slab"), 1.0, 3.0)
    assert "slab: α [rad] is 1.37, those of the bodies that were simulated" in caplog.text


def test_a_vertical_motion_changes_only_its_own(far_field: list[Motion]) -> None:
    """One of next to nothing changes next to nothing; a strong one lets bodies tip earlier."""
    bare = vector_fragility(BODIES, far_field, scales=SCALES, draws=0)
    first = far_field[0]
    for share, least in ((1e-6, 1.0), (0.5, 0.96)):
        up = Motion(
            first.horizontal, first.time_step, vertical=share * np.abs(first.horizontal),
            name=first.name, origin=first.origin,
        )  # fmt: skip
        down = Motion(
            first.horizontal, first.time_step, vertical=-share * np.abs(first.horizontal),
            name=first.name, origin=first.origin,
        )  # fmt: skip
        found = vector_fragility(BODIES, [down, *far_field[1:]], scales=SCALES, draws=0)
        assert found.least <= least
        # a tenth is a third of the bootstrap's standard error: one of 44 motions has changed
        assert found.coefficients[0] == pytest.approx(bare.coefficients[0], abs=0.1)
        # upward acceleration presses a body down: it does not tip earlier than others
        pressed = vector_fragility(BODIES, [up, *far_field[1:]], scales=SCALES, draws=0)
        assert pressed.least == pytest.approx(1.0)


def test_the_interval_of_a_coefficient_is_the_basic_one() -> None:
    """2 ĉ less the quantiles of the draws, and not these: of draws that lie to one side of ĉ."""
    draws = 1.0 + 0.01 * np.arange(400)  # 1.00 to 4.99 about an estimate of 2
    coefficients = np.vstack([[2.0, 5.0, 7.0], np.column_stack([draws, 3 * draws, 7.0 - draws])])
    found = replace(
        vector_fragility(BODIES, suite("fema-p695-far-field"), scales=SCALES, draws=0),
        coefficients=coefficients,
    )
    low, high = 2.0 - (draws - 2.0)[[-11, 10]]  # 2.5 % of 400 on either side
    assert found.intervals[0] == pytest.approx((low, high), abs=0.02)
    assert found.intervals[0, 1] == pytest.approx(2 * 2.0 - 1.1, abs=0.02)
