"""Which measure tells best: dispersions and covariates."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, fragility, suite
from shaketable.fragility import efficiency
from shaketable.fragility.covariates import known_covariates
from shaketable.fragility.intensities import intensities
from shaketable.fragility.lognormal import Points
from shaketable.fragility.wild_score import score_p
from shaketable.resampling import events_of, recordings_of
from shaketable.signal import intensity_measures, measure_named

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
    assert row["PGV/PGA_p"] < 0.01
    assert row["PGV/PGA_effect"] < 0.0  # the slower a motion, the less PGA is needed
    assert row["noise_p"] > 0.01
    assert 0.0 <= row["D5-95_p"] <= 1.0


def test_bad_input(far_field: list[Motion]) -> None:
    with pytest.raises(InputError, match="'Tm': does not grow with the motion"):
        efficiency(BOOKCASE, far_field, ("PGA", "Tm"))
    for values in ([1.0], [0.0] * 44, [np.inf] * 44, [np.nan] * 44):
        with pytest.raises(InputError, match="covariate 'distance': one finite value"):
            efficiency(BOOKCASE, far_field, ("PGA",), covariates={"distance": values})


def test_few_earthquakes_tell_no_chance(far_field: list[Motion]) -> None:
    """With one earthquake there is no p-value; two bodies of one name are told apart."""
    ours = [motion for motion in far_field if motion.origin.event == "NORTHR"]
    twins = [BOOKCASE, Body.rectangle(0.4, 1.2, name="bookcase")]
    table = efficiency(twins, ours, ("PGA", "PGV"), draws=20)
    assert table["D5-95_p"].isna().all()
    assert table["body"].unique().tolist() == ["bookcase #0", "bookcase #1"]


@pytest.mark.parametrize("parts", [(0.25, 0.25, 0.5), (0.0, 0.0, 1.0)])
def test_chance_is_told_as_often_as_it_happens(
    far_field: list[Motion], parts: tuple[float, float, float]
) -> None:
    """Where nothing but PGV matters p is below 0.1 in 10 % of cases; 3 standard errors of 120."""
    scales = 2.0 ** np.arange(-2.0, 3.1, 0.5)
    recording, event = recordings_of(far_field), events_of(far_field)
    level = intensities(far_field, measure_named("PGV"), scales)
    magnitude = known_covariates(far_field)["magnitude"].standard
    rng = np.random.default_rng(5)
    found = []
    for _ in range(120):
        shared = [np.sqrt(part) * rng.standard_normal(44) for part in parts]
        capacity = 0.4 * (shared[0][event[recording]] + shared[1][recording] + shared[2])
        reached = 2 * (np.log(level / 0.43) > capacity[:, None])
        of_point = np.repeat(recording, scales.size)
        points = Points(level.ravel(), reached.ravel(), np.full(level.size, 2), of_point)
        at = np.repeat(magnitude, scales.size)
        found.append(score_p(points, at, event[points.recording]))
    assert (np.array(found) < 0.1).mean() == pytest.approx(0.1, abs=0.082)
