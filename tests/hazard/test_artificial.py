"""Artificial motions of an earthquake of a magnitude at a distance."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import InputError, Motion
from shaketable.signal import displacement, measure_named, velocity
from shaketable.signal.intensity import Record

pytest.importorskip("pygmm")

from shaketable.hazard import Scenario, artificial_motions, ln_spectra_of, scenario, target_of

N = 32


@pytest.fixture(scope="module")
def quake() -> Scenario:
    return scenario(6.5, 15.0, 400.0)


@pytest.fixture(scope="module")
def motions(quake: Scenario) -> list[Motion]:
    return artificial_motions(quake, N, seed=1)


def test_spectra_spread_as_the_models_say(quake: Scenario, motions: list[Motion]) -> None:
    """Medians within 8 %, standard deviations within 0.1 of 0.6, from 0.1 to 5 s.

    Spectra are drawn evenly, so that little is left to chance; what motions depart from their own
    spectra by is 5 % (docs/how_to/hazard.md). Independent draws would be off by 8 % one time in
    three.
    """
    periods = np.array([0.1, 0.2, 0.5, 1.0, 2.0, 5.0])
    target = target_of(quake, periods)
    found = ln_spectra_of(motions, periods)
    assert found.mean(axis=0) == pytest.approx(target.mean, abs=0.08)
    assert found.std(axis=0, ddof=1) == pytest.approx(target.sigma, abs=0.1)
    wanted = target.covariance / np.outer(target.sigma, target.sigma)
    # 4 standard errors of independent draws, at the least correlated pair
    assert np.corrcoef(found.T) == pytest.approx(wanted, abs=4.0 / np.sqrt(N))


def test_velocity_and_duration(quake: Scenario, motions: list[Motion]) -> None:
    """Neither is matched: PGV follows from the spectra, the duration from the envelope."""
    records = [Record(motion.horizontal, motion.time_step) for motion in motions]
    pgv = np.log([measure_named("PGV").of(record) for record in records])
    mean, sigma = quake.of("PGV")
    assert pgv.mean() == pytest.approx(mean, abs=0.1)
    assert pgv.std(ddof=1) == pytest.approx(sigma, abs=0.15)
    duration = np.log([measure_named("D5-95").of(record) for record in records])
    assert duration.mean() == pytest.approx(np.log(quake.duration[0]), abs=0.1)
    assert duration.std(ddof=1) == pytest.approx(quake.duration[1], abs=0.08)


def test_they_begin_and_end_at_rest(motions: list[Motion]) -> None:
    for motion in motions[:8]:
        v = velocity(motion.horizontal, motion.time_step)
        d = displacement(motion.horizontal, motion.time_step)
        assert abs(v[-1]) < 1e-9 * np.abs(v).max()
        assert abs(d[-1]) < 1e-9 * np.abs(d).max()


def test_each_is_the_same_for_any_number(quake: Scenario, motions: list[Motion]) -> None:
    few = artificial_motions(quake, 3, seed=1, threads=1)
    for one, other in zip(few, motions, strict=False):
        assert (one.horizontal == other.horizontal).all()
    assert "seed 1, no. 3" in str(few[2].origin)
    other = artificial_motions(quake, 1, seed=2)[0]
    assert other.horizontal.size != few[0].horizontal.size


def test_refused(quake: Scenario) -> None:
    for n in (0, -1, 2.5):
        with pytest.raises(InputError):
            artificial_motions(quake, n)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="seed"):
        artificial_motions(quake, 1, seed=-1)
