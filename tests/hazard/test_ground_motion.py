"""Earthquakes of a magnitude at a distance, by ground-motion models."""

from __future__ import annotations

from importlib import import_module

import numpy as np
import pytest

from shaketable import Body, InputError, fragility, suite
from shaketable.hazard import Hazard, annual_rate, fall_probability
from shaketable.signal import measure_named
from shaketable.units import STANDARD_GRAVITY as G

pytest.importorskip("pygmm")

from shaketable.hazard import scenario
from shaketable.hazard.ground_motion import MODELS

BSSA = {"BSSA14": 1.0}


def test_bssa14() -> None:
    """Boore, Stewart, Seyhan and Atkinson (2014), M 7, 20 km, strike-slip, 760 m/s.

    To the digits of an independent evaluation of their equations; ordinates between the models'
    own periods are interpolated on ours, which costs 1e-4.
    """
    found = scenario(7.0, 20.0, 760.0, models=BSSA)
    for name, unit, value in (
        ("PGA", G, 0.14971), ("PGV", 0.01, 12.84), ("SA(0.5)", G, 0.1997), ("SA(1.0)", G, 0.1000),
    ):  # fmt: skip
        assert np.exp(found.of(name)[0]) / unit == pytest.approx(value, rel=5e-4)
    assert found.name == "magnitude 7 at 20 km (strike-slip, Vs30 760 m/s)"


@pytest.mark.parametrize("name", ["BSSA14", "ASK14", "CB14", "CY14"])
def test_the_models_own_periods_are_not_interpolated(name: str) -> None:
    """Between two of ours an ordinate was off by up to 1.2 %."""
    found = scenario(6.5, 15.0, 400.0, models={name: 1.0})
    top = (2.673 - 1.136 * (6.5 - 4.970)) ** 2
    alone = import_module("pygmm").Scenario(
        mag=6.5, dist_jb=15.0, dist_rup=np.hypot(15.0, top), dist_x=-15.0, v_s30=400.0,
        mechanism="SS", region="california", dip=90.0, depth_tor=top,
    )  # fmt: skip
    model = getattr(import_module("pygmm"), MODELS[name])(alone)
    for period in (0.02, 0.075, 0.75, 1.5, 3.0, 7.5):
        told = model.interp_ln_spec_accels([period])[0] + np.log(G)
        assert found.of(f"SA({period:g})")[0] == pytest.approx(told, abs=1e-9)


def test_cb14_takes_a_hypocentral_depth() -> None:
    """Its median rises from 7 km on (Campbell and Bozorgnia 2014, eqs. 21 to 23)."""
    cb = {"CB14": 1.0}
    usual = scenario(6.5, 15.0, 400.0, models=cb)
    assert 7.0 < usual.hypocentral_depth < 12.0
    same = scenario(6.5, 15.0, 400.0, models=cb, hypocentral_depth=usual.hypocentral_depth)
    assert same.of("PGA") == pytest.approx(usual.of("PGA"))
    shallow, seven, deep = (
        scenario(6.5, 15.0, 400.0, models=cb, hypocentral_depth=each).of("PGA")[0]
        for each in (2.0, 7.0, 15.0)
    )
    assert shallow == seven < usual.of("PGA")[0] < deep
    other = scenario(6.5, 15.0, 400.0, models=BSSA, hypocentral_depth=15.0)
    assert other.of("PGA") == scenario(6.5, 15.0, 400.0, models=BSSA).of("PGA")
    assert np.isnan(other.hypocentral_depth)
    with pytest.raises(InputError, match="hypocentral depth 30: CB14 is given from 0 to 20"):
        scenario(6.5, 15.0, 400.0, models=cb, hypocentral_depth=30.0)


def test_several_models_are_averaged() -> None:
    """Of equal weights: the mean of their logarithms, and what they differ by in the sigma."""
    each = [scenario(7.0, 20.0, models={name: 1.0}) for name in ("BSSA14", "CB14")]
    both = scenario(7.0, 20.0, models={"BSSA14": 2.0, "CB14": 2.0})
    means, sigmas = np.array([one.of("PGV") for one in each]).T
    mean, sigma = both.of("PGV")
    assert mean == pytest.approx(means.mean())
    assert sigma**2 == pytest.approx((sigmas**2).mean() + means.var())
    assert dict(both.weights) == {"BSSA14": 0.5, "CB14": 0.5}
    assert set(scenario(7.0, 20.0).weights) == {"BSSA14", "ASK14", "CB14", "CY14"}


def test_drawn_spectra_have_the_spread_and_the_correlation() -> None:
    """Within 4 standard errors of 1,000 draws, at each of the periods and pair of them."""
    found = scenario(7.0, 20.0, 760.0, models=BSSA)
    drawn = np.log(found.spectra(1000, seed=1))
    n = len(drawn)
    assert drawn.mean(axis=0) == pytest.approx(
        found.ln_spectrum, abs=4.0 * float(found.sigma.max()) / np.sqrt(n)
    )
    assert drawn.std(axis=0, ddof=1) / found.sigma == pytest.approx(
        np.ones(found.sigma.size), abs=4.0 / np.sqrt(2.0 * n)
    )
    seen, wanted = np.corrcoef(drawn.T), found.correlation
    assert (np.abs(seen - wanted) <= 4.0 * (1.0 - wanted**2) / np.sqrt(n) + 1e-6).all()
    assert (found.spectra(5, seed=1) == found.spectra(5, seed=1)).all()


def test_falls_in_an_earthquake() -> None:
    """Φ((μ - ln θ)/√(σ² + β²)) is what shakings that are drawn give; 4 standard errors."""
    curve = fragility(Body.rectangle(0.32, 1.8, name="bookcase"), suite("far-field"), draws=60)
    mean, sigma = scenario(7.0, 10.0, 400.0).of("PGV")
    found = fall_probability(curve, mean, sigma)
    assert found.low < found.value < found.high
    rng = np.random.default_rng(2)
    shaken = np.exp(mean + sigma * rng.standard_normal(40_000))
    assert found.value == pytest.approx(
        float(curve.probability(shaken).mean()), abs=4.0 * 0.5 / np.sqrt(40_000)
    )
    # a site that meets this earthquake once in 100 years, and no other
    levels = np.exp(mean + sigma * np.linspace(-5.0, 5.0, 400))
    from scipy.stats import norm

    curve_of_site = Hazard(
        measure=measure_named("PGV"), levels=levels,
        rates=0.01 * norm.sf((np.log(levels) - mean) / sigma),
    )  # fmt: skip
    assert annual_rate(curve, curve_of_site).rate == pytest.approx(0.01 * found.value, rel=1e-3)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"magnitude": 9.1, "distance_km": 20.0}, "magnitude 9.1: BSSA14 is given from 3 to 8.5"),
        ({"magnitude": 7.0, "distance_km": 500.0}, "distance 500: BSSA14 is given from 0 to 300"),
        ({"magnitude": 7.0, "distance_km": 20.0, "vs30": 90.0}, "Vs30 90: BSSA14 is given from"),
        ({"magnitude": 7.0, "distance_km": -1.0}, "distance \\[km\\] must be 0 or more"),
        ({"magnitude": 7.0, "distance_km": 20.0, "mechanism": "thrust"}, "accepted are strike-sl"),
        (
            {"magnitude": 7.0, "distance_km": 20.0, "models": {"XY20": 1.0}},
            "expected weights, not",
        ),
        (
            {"magnitude": 7.0, "distance_km": 20.0, "models": {"BSSA14": 0.0}},
            "expected weights, not",
        ),
    ],
)
def test_bad_input(given: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        scenario(**given)


def test_measures_that_models_do_not_give() -> None:
    found = scenario(7.0, 20.0)
    with pytest.raises(InputError, match="give PGA, PGV and SA"):
        found.of("CAV")
    with pytest.raises(InputError, match=r"SA\(12.0\): the models give periods from 0.01 to 10 s"):
        found.of("SA(12.0)")
