"""Rates of falls: fragility functions over hazard curves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from shaketable import Body, Fragility, InputError, ShearBuilding, floor_motions, fragility, suite
from shaketable.fragility.lognormal import Fits
from shaketable.hazard import Hazard, annual_rate, annual_rates
from shaketable.signal import measure_named

PGV = measure_named("PGV")
THETA, BETA = 0.4, 0.45


@pytest.fixture(scope="module")
def found() -> Fragility:
    return fragility(Body.rectangle(0.32, 1.8, name="bookcase"), suite("far-field"), draws=100)


def with_fits(found: Fragility, theta: float, beta: float) -> Fragility:
    """The same function with given parameters, without an interval."""
    curve = replace(found.curve, fits=Fits(np.array([theta]), np.array([beta])))
    return replace(found, curves=(curve,))


def power_law(low: float, high: float, count: int, k0: float = 1e-4, k: float = 2.3) -> Hazard:
    levels = np.geomspace(low, high, count)
    return Hazard(measure=PGV, levels=levels, rates=k0 * levels**-k)


@pytest.mark.parametrize("count", [2, 7, 60])
@pytest.mark.parametrize("beta", [1e-3, BETA, 1.2])
def test_power_law(found: Fragility, count: int, beta: float) -> None:
    """λ = k0 θ^-k exp(k²β²/2), Cornell (1996); the sum is exact but for round-off."""
    for low, high in ((0.01, 5.0), (0.3, 0.5)):
        got = annual_rate(with_fits(found, THETA, beta), power_law(low, high, count))
        assert got.rate == pytest.approx(1e-4 * THETA**-2.3 * np.exp(2.3**2 * beta**2 / 2), 1e-10)
        assert got.by_level.sum() == pytest.approx(got.rate)
        assert (got.by_level >= 0.0).all()


def test_an_uneven_curve_against_quadrature(found: Fragility) -> None:
    levels = np.array([0.02, 0.05, 0.11, 0.3, 0.5, 1.4])
    rates = np.array([0.3, 0.09, 0.02, 2e-3, 9e-4, 1e-5])
    hazard = Hazard(measure=PGV, levels=levels, rates=rates)
    got = annual_rate(with_fits(found, THETA, BETA), hazard)

    def density(y: float) -> float:  # λ dF over y = ln x
        z = (y - np.log(THETA)) / BETA
        return float(hazard.rate(np.exp(y)) * norm.pdf(z) / BETA)

    total = quad(density, np.log(1e-4), np.log(1e3), points=np.log(levels), limit=400)[0]
    assert got.rate == pytest.approx(total, rel=1e-8)
    for k in range(5):  # ∫ F |dλ| of each interval

        def part(y: float) -> float:
            slope = hazard.slopes[k]  # noqa: B023  used at once
            share = norm.cdf((y - np.log(THETA)) / BETA)
            return float(slope * hazard.rate(np.exp(y)) * share)

        between = quad(part, np.log(levels[k]), np.log(levels[k + 1]))[0]
        assert got.by_level[k + 1] == pytest.approx(between, rel=1e-7)


def test_a_curve_that_ends_at_zero_adds_nothing_beyond(found: Fragility) -> None:
    given = with_fits(found, THETA, BETA)
    open_end = Hazard(measure=PGV, levels=[0.1, 0.3, 0.5], rates=[0.1, 0.01, 0.004])
    closed = Hazard(measure=PGV, levels=[0.1, 0.3, 0.5, 1.0], rates=[0.1, 0.01, 0.004, 0.0])
    assert annual_rate(given, closed).rate < annual_rate(given, open_end).rate
    # every shaking above 0.5 m/s is one of 0.5 m/s then: F(0.5) of them
    above = norm.cdf(np.log(0.5 / THETA) / BETA) * 0.004
    assert annual_rate(given, closed).by_level[-1] == pytest.approx(above)
    assert closed.rate([0.4, 0.6]).tolist() == [pytest.approx(open_end.rate(0.4)), 0.0]


def test_intervals_and_probabilities(found: Fragility) -> None:
    hazard = power_law(0.02, 3.0, 25)
    got = annual_rate(found, hazard)
    low, high = got.interval
    assert low < got.rate < high
    assert got.probability(50.0) == pytest.approx(1.0 - np.exp(-50.0 * got.rate))
    assert got.probability_interval(50.0)[0] < got.probability(50.0)
    # the interval is about as wide as that of θ to the power k
    ends = np.array(found.median_interval)
    assert high / low == pytest.approx((ends[1] / ends[0]) ** 2.3, rel=0.5)
    table = annual_rates(found, hazard, years=(1, 50))
    assert table["annual_rate"].tolist() == [got.rate]
    assert table["probability_in_50_years"].tolist() == [got.probability(50.0)]
    assert table["years_between"].tolist() == [1.0 / got.rate]


def test_tails_are_told(found: Fragility, caplog: pytest.LogCaptureFixture) -> None:
    got = annual_rate(found, power_law(1.0, 3.0, 8))
    assert got.below > 0.5
    assert "1 of 1 rates are to more than 10 %" in caplog.text
    assert "below the first level of the hazard curve, where it is taken to go str" in caplog.text
    caplog.clear()
    annual_rate(found, Hazard(measure=PGV, levels=[0.1, 0.2, 0.3], rates=[0.1, 0.05, 0.0]))
    assert (
        "above the last level of the hazard curve that has a rate, where nothing is taken to "
        "exceed it" in caplog.text
    )


def test_more_beta_is_in_the_rate_and_in_its_interval(found: Fragility) -> None:
    """β with what is not known of the object: e^{k²(β²+x²)/2} of a power law."""
    hazard, more = power_law(0.02, 3.0, 25), 0.3
    bare, wide = annual_rate(found, hazard), annual_rate(found.with_more_beta(more), hazard)
    assert wide.rate / bare.rate == pytest.approx(np.exp(2.3**2 * more**2 / 2.0), rel=1e-9)
    assert wide.interval[0] / bare.interval[0] > 1.1


def test_a_function_that_is_not_known_has_no_rate(found: Fragility) -> None:
    never = fragility(Body.rectangle(2.0, 1.0), suite("far-field")[:6], scales=[1.0], draws=0)
    got = annual_rate(never, power_law(0.02, 3.0, 25))
    assert np.isnan(got.rate)
    assert np.isnan(got.interval).all()


def test_a_floor_needs_the_ground(found: Fragility) -> None:
    """On a floor that shakes more strongly than the ground, less of the ground's PGV is enough."""
    body, ground = Body.rectangle(0.32, 1.8), suite("far-field")[:20]
    building = ShearBuilding(storeys=4, first_period=0.5)
    roofs = [floor_motions(building, motion)[-1] for motion in ground]
    on_floor = fragility(body, roofs, draws=0)
    assert on_floor.curve.place == "floor 4"
    with pytest.raises(InputError, match=r"of PGV on floor 4, the hazard of that of the ground"):
        annual_rate(on_floor, power_law(0.02, 3.0, 25))
    of_ground = fragility(body, roofs, ground=ground, draws=0)
    assert of_ground.curve.place == "the ground"
    assert of_ground.median < on_floor.median
    assert annual_rate(of_ground, power_law(0.02, 3.0, 25)).rate > 0.0
    # where a station stands does not make its ground a floor
    at_ground = [
        replace(motion, origin=replace(motion.origin, location="6-storey building, ground floor"))
        for motion in ground
    ]
    assert fragility(body, at_ground, draws=0).curve.place == "the ground"
    with pytest.raises(InputError, match="one motion for each of the 20 motions"):
        fragility(body, roofs, ground=ground[:3])


@pytest.mark.parametrize(
    ("levels", "rates", "message"),
    [
        ([0.1, 0.2], [0.01, 0.02], "the rate rises with the level, from 0.01 a year at 0.1 m/s"),
        ([0.2, 0.1], [0.02, 0.01], "levels must be above 0 and rise"),
        ([0.1, 0.2], [62.0, 10.0], "a rate of 62 a year: nowhere is shaken so often"),
        ([0.1, 0.2], [0.01, 0.0], "needs two levels with a rate above 0"),
        ([0.1, 0.2], [0.01, -1.0], "a rate is negative"),
        ([0.1, 0.2], [0.01, np.nan], "must be finite"),
        ([0.1], [0.01, 0.02], "as many levels as rates"),
    ],
)
def test_curves_that_cannot_be(levels: list[float], rates: list[float], message: str) -> None:
    with pytest.raises(InputError, match=message):
        Hazard(measure=PGV, levels=levels, rates=rates)


def test_another_measure(found: Fragility) -> None:
    other = Hazard(measure=measure_named("PGA"), levels=[1.0, 2.0], rates=[0.1, 0.01])
    with pytest.raises(InputError, match=r"is of PGA, the fragility function of PGV: find .*'PGA'"):
        annual_rate(found, other)


def test_level_of_a_rate() -> None:
    hazard = power_law(0.02, 3.0, 25)
    at = 1.0 / 475.0
    assert hazard.rate(hazard.level(at)) == pytest.approx(at)
    with pytest.raises(InputError, match="not 1e-09"):
        hazard.level(1e-9)
