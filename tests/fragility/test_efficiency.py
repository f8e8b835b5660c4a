"""Which measure tells best: dispersions and covariates."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, fragility, suite
from shaketable.fragility import efficiency
from shaketable.signal import intensity_measures

BOOKCASE = Body.rectangle(0.32, 1.8, name="bookcase")


@pytest.fixture(scope="module")
def far_field() -> list[Motion]:
    return suite("fema-p695-far-field")


def test_dispersions_are_those_of_the_functions(far_field: list[Motion]) -> None:
    table = efficiency(BOOKCASE, far_field, ("PGA", "PGV", "Arias"), draws=60)
    table = table.set_index("measure")
    for measure, power in (("PGA", 1), ("PGV", 1), ("Arias", 2)):
        beta = fragility(BOOKCASE, far_field, measure=measure, draws=0).beta
        assert table.loc[measure, "beta"] == pytest.approx(beta, rel=1e-9)
        assert table.loc[measure, "dispersion"] == pytest.approx(beta / power, rel=1e-9)
    assert table["dispersion"].is_monotonic_increasing
    best = table.iloc[0]
    assert best["more_than_best"] == best["more_low"] == best["more_high"] == 0.0
    assert (table["more_low"] <= table["more_than_best"]).all()


def test_measures_of_slow_shaking_are_efficient_for_bookcases(far_field: list[Motion]) -> None:
    """PGV is better than PGA (Ishiyama 1982), and an average of slow spectral ordinates than PGV.

    Seen in 95 % intervals over 14 earthquakes.
    """
    table = efficiency(BOOKCASE, far_field).set_index("measure")
    assert table.loc["PGV", "dispersion"] < table.loc["PGA", "dispersion"]
    assert table.loc["PGV", "more_low"] > 0.0
    assert table.loc["AvgSA(1.0)", "dispersion"] < table.loc["SA(0.3)", "dispersion"]


def test_a_covariate_that_matters_is_seen(far_field: list[Motion]) -> None:
    """PGV/PGA beside PGA matters; what is drawn at random does not, in 99 of 100 cases."""
    ratio = [intensity_measures(motion)["PGV/PGA"] for motion in far_field]
    noise = np.random.default_rng(1).uniform(1.0, 2.0, len(far_field))
    table = efficiency(
        BOOKCASE, far_field, ("PGA",), covariates={"PGV/PGA": ratio, "noise": noise}, draws=0
    )
    row = table.iloc[0]
    assert row["PGV/PGA_p"] < 1e-3
    assert row["PGV/PGA_effect"] < 0.0  # the slower a motion, the less PGA is needed
    assert row["noise_p"] > 0.01
    assert 0.0 <= row["D5-95_p"] <= 1.0


def test_bad_input(far_field: list[Motion]) -> None:
    with pytest.raises(InputError, match="'Tm': does not grow with the motion"):
        efficiency(BOOKCASE, far_field, ("PGA", "Tm"))
    for values in ([1.0], [0.0] * 44):
        with pytest.raises(InputError, match="covariate 'distance': one value above 0 for each"):
            efficiency(BOOKCASE, far_field, ("PGA",), covariates={"distance": values})
