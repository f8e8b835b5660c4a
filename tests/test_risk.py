"""The risk on a floor by direct integration."""

from __future__ import annotations

import numpy as np
import pytest
from statsmodels.stats.proportion import proportion_confint

from shaketable import Body, InputError, Motion, overturning_risk, response_spectrum
from shaketable.risk import STRONG, TOLERANCE, compatible_motions
from shaketable.signal import intensity_measures
from shaketable.synthesis.compatible import trapezoid

SHELVES = [Body.rectangle(width, 1.8) for width in (0.25, 0.4, 0.9)]


@pytest.fixture(scope="module")
def floor(p695: list[Motion]) -> Motion:
    return p695[1].scaled(0.7)


def test_motions_have_the_floor_s_spectrum_and_duration(floor: Motion) -> None:
    motions = compatible_motions(floor, 6, 3, TOLERANCE, lambda more: None)
    periods = np.geomspace(0.05, 3.0, 100)
    wanted = response_spectrum(floor, periods).acceleration
    for motion in motions:
        found = response_spectrum(motion, periods).acceleration
        assert np.abs(found / wanted - 1.0).max() < TOLERANCE
    lasts = [intensity_measures(motion)["D5-95"] for motion in motions]
    # wavelets lengthen it where a period is short of response: by a fifth at most
    assert np.mean(lasts) == pytest.approx(1.1 * intensity_measures(floor)["D5-95"], rel=0.15)


def test_the_envelope_s_strong_part() -> None:
    at = np.linspace(0.0, 1.0, 100_001)
    energy = np.cumsum(trapezoid(at) ** 2)
    ends = np.interp([0.05, 0.95], energy / energy[-1], at)
    assert ends[1] - ends[0] == pytest.approx(STRONG, abs=1e-4)


def test_shares_and_intervals(floor: Motion) -> None:
    risk = overturning_risk(SHELVES, floor, n=40, seed=1)
    assert risk.falls.shape == (3, 1)
    assert risk.simulations == 40
    assert risk.share[:, 0] == pytest.approx(risk.falls[:, 0] / 40)
    low, high = proportion_confint(risk.falls[:, 0], 40, method="wilson")
    assert risk.low[:, 0] == pytest.approx(low)
    assert risk.high[:, 0] == pytest.approx(high)
    # a narrower one of the same height falls more often, and B/H g lifts no corner of 0.9 m
    assert risk.share[0, 0] > risk.share[1, 0] > risk.share[2, 0] == 0.0


def test_floors_do_not_disturb_each_other(floor: Motion, p695: list[Motion]) -> None:
    both = overturning_risk(SHELVES[:2], [floor, p695[3]], n=7, seed=5)
    first = overturning_risk(SHELVES[0], floor, n=7, seed=5)
    assert both.falls[0, 0] == first.falls[0, 0]
    again = overturning_risk(SHELVES[:2], [floor, p695[3]], n=7, seed=5)
    assert np.array_equal(both.falls, again.falls)


def test_bad_input(floor: Motion) -> None:
    with pytest.raises(InputError, match="at least one body"):
        overturning_risk([], floor)
    with pytest.raises(InputError, match="does not move"):
        overturning_risk(SHELVES[0], Motion(np.zeros(900), 0.01, name="roof"))
    with pytest.raises(InputError, match="n "):
        overturning_risk(SHELVES[0], floor, n=0)
    with pytest.raises(InputError, match="unknown model"):
        overturning_risk(SHELVES[0], floor, model="x")
