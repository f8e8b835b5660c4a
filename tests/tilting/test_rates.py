"""Counts by recording, shares, tilts and their intervals."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, Origin, Outcome, simulate_many
from shaketable.resampling import interval, recordings_of, resamples
from shaketable.simulate import ShakingSet, count_by_recording
from shaketable.tilting import (
    TiltCounts,
    control_tilt,
    count_outcomes,
    downhill_share,
    fall_share,
)

TILTS = np.arange(0.0, 10.01, 0.5)


@pytest.mark.parametrize(
    ("shares", "tilt"),
    [
        ([0.5, 0.7, 0.9, 1.0], 1.25),  # between 0.9 at 1° and 1.0 at 1.5°
        ([0.5, 0.96, 0.9, 1.0], 1.25),  # the first crossing does not hold
        ([0.96, 0.97, 1.0, 1.0], 0.0),
        ([0.5, 0.6, 0.7, 0.8], math.inf),
        ([0.5, 0.6, 0.7, math.nan], math.nan),  # too few falls after it to tell
        ([0.5, 0.9, math.nan, 0.99], math.nan),
        ([math.nan, math.nan, 0.99, 1.0], math.nan),  # too few falls before it to tell
        ([math.nan] * 4, math.nan),
    ],
)
def test_control_tilt(shares: list[float], tilt: float) -> None:
    padded = np.full(TILTS.size, shares[-1])
    padded[:4] = shares
    np.testing.assert_allclose(control_tilt(TILTS, padded, 0.95), tilt, rtol=0, atol=1e-12)
    many = control_tilt(TILTS, np.array([padded, np.ones(TILTS.size)]), 0.95)
    np.testing.assert_allclose(many, [tilt, 0.0], rtol=0, atol=1e-12)


def test_recordings_are_events_at_stations(p695: list[Motion]) -> None:
    assert recordings_of(p695)[:4].tolist() == [0, 0, 1, 1]
    assert recordings_of(p695).max() == 49  # FEMA P-695: 50 records of two components
    plain = Motion(np.ones(3), 0.01)
    unnamed = [Motion(np.ones(3), 0.01, origin=Origin(file=f)) for f in ("a", "b", "a")]
    assert recordings_of([plain, *unnamed, plain]).tolist() == [0, 1, 2, 1, 3]
    # two earthquakes at a station whose files do not name them
    quakes = [Motion(np.ones(3), 0.01, origin=Origin(station="S", file=f)) for f in ("a", "b")]
    assert recordings_of(quakes).tolist() == [0, 1]


@pytest.fixture(scope="module")
def counted(p695: list[Motion]) -> TiltCounts:
    bodies = [Body.rectangle(0.1, 0.5), Body.rectangle(0.05, 1.0)]
    trial = ShakingSet(p695[:12])
    return count_outcomes(bodies, trial, np.radians([0.0, 2.0, 4.0]), progress=False)


def test_counts_are_those_of_the_simulations(counted: TiltCounts, p695: list[Motion]) -> None:
    runs = simulate_many(
        [Body.rectangle(0.1, 0.5)], p695[:12], tilts=counted.tilts, progress=False
    ).outcome.isel(body=0, scale=0)
    falls = (runs != Outcome.STANDING).sum(["motion", "polarity"])
    downhill = (runs == Outcome.DOWNHILL).sum(["motion", "polarity"])
    assert counted.falls[0].sum(axis=1).tolist() == falls.values.tolist()
    assert counted.downhill[0].sum(axis=1).tolist() == downhill.values.tolist()
    assert counted.simulations.tolist() == [[4] * 6] * 2
    # atan(0.05) = 2.9°: nothing is simulated at 4°
    assert counted.stands.tolist() == [[True] * 3, [True, True, False]]
    observed = resamples(6, 0)
    assert np.isnan(fall_share(counted, observed)[0, 1, 2])
    assert downhill_share(counted, observed)[0, 0, 0] == 0.5


def test_motions_that_do_not_count(p695: list[Motion]) -> None:
    body = [Body.rectangle(0.1, 0.5)]
    runs = simulate_many(body, p695[:4], progress=False)
    some = np.array([[True, False, True, True]])
    part = count_by_recording(runs, recordings_of(p695[:4]), some)
    trial = ShakingSet([p695[0], *p695[2:4]])
    alone = count_outcomes(body, trial, np.array([0.0]), progress=False)
    assert part.simulations.tolist() == [[2, 4]]
    assert np.array_equal(part.falls, alone.falls)


def test_counted_as_they_end_or_afterwards(p695: list[Motion]) -> None:
    bodies = [Body.rectangle(0.1, 0.5, eccentricity=0.1), Body.rectangle(0.2, 1.0)]
    trial, tilts = ShakingSet(p695[:7], 1.3), np.radians([-2.0, 0.0, 2.0])
    afterwards = count_by_recording(trial.run(bodies, tilts, progress=False), trial.recording)
    as_they_end = trial.count(bodies, tilts, progress=False)
    assert afterwards.falls.sum() > afterwards.downhill.sum() > 0
    for name in ("simulations", "falls", "downhill"):
        assert np.array_equal(getattr(as_they_end, name), getattr(afterwards, name))


def test_what_slides_by_itself_is_not_simulated(p695: list[Motion]) -> None:
    counts = count_outcomes(
        [Body.rectangle(0.1, 0.5)],
        ShakingSet(p695[:2], model=General(static_friction=0.1)),
        np.radians([0.0, 2.0, 8.0]),
        progress=False,
    )
    assert counts.stands.tolist() == [[True, True, False]]  # atan(0.1) = 5.7°


def test_bootstrap_of_independent_experiments_is_binomial() -> None:
    # 400 recordings with one fall each, 300 downhill: the standard error is √(p (1 - p)/n)
    downhill = (np.arange(400) < 300).astype(np.int64).reshape(1, 1, 400)
    counts = TiltCounts(
        tilts=np.zeros(1),
        simulations=np.full((1, 400), 2),
        falls=np.ones((1, 1, 400), np.int64),
        downhill=downhill,
        stands=np.ones((1, 1), np.bool_),
    )
    drawn = downhill_share(counts, resamples(400, 4000, seed=1))[1:, 0, 0]
    error = math.sqrt(0.75 * 0.25 / 400)
    assert drawn.std() == pytest.approx(error, rel=4 / math.sqrt(2 * 4000))  # 4 standard errors
    low, high = interval(drawn)
    # a quantile of 4,000 draws has a standard error of 2.7 error/√4000 (normal density at 1.96);
    # three of them, and half a step of 1/400
    off = 3 * 2.7 * error / math.sqrt(4000) + 0.5 / 400
    assert (low, high) == pytest.approx((0.75 - 1.96 * error, 0.75 + 1.96 * error), abs=off)
    # two equal falls a recording say no more than one
    twice = replace(counts, falls=2 * counts.falls, downhill=2 * downhill)
    assert np.array_equal(downhill_share(twice, resamples(400, 4000, seed=1))[1:, 0, 0], drawn)


def test_interval_of_few_values() -> None:
    values = np.array([[3.0, np.nan], [1.0, np.nan], [np.inf, np.nan], [2.0, np.nan]])
    low, high = interval(values)
    assert low[0] == 1.0
    assert high[0] == np.inf
    assert np.isnan([low[1], high[1]]).all()


def test_tilts_must_rise_and_may_all_be_too_steep(p695: list[Motion]) -> None:
    body = [Body.rectangle(0.1, 0.5)]
    with pytest.raises(InputError, match="tilts that rise"):
        count_outcomes(body, ShakingSet(p695[:1]), np.radians([4.0, 2.0]), progress=False)
    steep = count_outcomes(body, ShakingSet(p695[:2]), np.radians([20.0]), progress=False)
    assert not steep.stands.any()
    assert steep.falls.sum() == 0


@pytest.mark.parametrize("scale", [0.0, -1.0, 1e308])
def test_scales_that_are_none(p695: list[Motion], scale: float) -> None:
    with pytest.raises(InputError, match="scale must be"):
        ShakingSet(p695[:1], scale)
