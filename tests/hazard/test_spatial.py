"""How many pieces fall in all, where places are shaken alike."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable.fragility.lognormal import ndtr
from shaketable.hazard.spatial import Fall, correlation_length, residuals, total_falls


def test_correlation_falls_with_the_distance() -> None:
    """Jayaram and Baker (2009), eqs. 20 and 21, on similar ground; within 5 standard errors."""
    assert correlation_length("PGA") == 40.7
    assert correlation_length("SA(0.5)") == pytest.approx(33.2)
    assert correlation_length("SA(2.0)") == pytest.approx(29.4)
    assert correlation_length("PGV") == pytest.approx(25.7)
    # 0, 0.1° and 0.5° of latitude apart: 0, 11.12 and 55.6 km
    sites = np.array([[8.0, 47.0], [8.0, 47.0], [8.0, 47.1], [8.0, 47.5]])
    n = 40_000
    z = residuals(sites, "PGV", n, np.random.default_rng(0), event_share=0.3)
    assert z.std(axis=0) == pytest.approx(np.ones(4), abs=0.02)
    expected = 0.3 + 0.7 * np.exp(-3.0 * np.array([0.0, 11.12, 55.6]) / 25.7)
    assert np.corrcoef(z.T)[0, 1:] == pytest.approx(expected, abs=5.0 / np.sqrt(n))


def test_alike_pieces_at_one_place_fall_together() -> None:
    """One motion shakes all of them: all fall or none does, and seldom ones do not fall at all."""
    place = [(8.0, 47.0)]
    assert total_falls([Fall(0, 100, 1.0, 0.4)], [(-0.3, 0.5)], place, "PGV") == (0.0, 100.0)
    # Φ((ln 0.3 - 0)/0.5) = 0.8 %: less than the 2.5 % that are beyond either end
    seldom = total_falls([Fall(0, 100, 1.0, 0.3)], [(np.log(0.3), 0.4)], place, "PGV")
    assert seldom == (0.0, 0.0)
    # of two kinds the stronger one falls in 0.8 % of the earthquakes, the weaker in a half
    both = [Fall(0, 100, 1.0, 0.3), Fall(0, 7, 0.3, 0.3)]
    assert total_falls(both, [(np.log(0.3), 0.4)], place, "PGV") == (0.0, 7.0)


def test_places_that_are_far_apart_share_the_event_alone() -> None:
    """200 places 300 km and more apart: their common part alone is left.

    With the share 0.3 of the variance in common, the rest is averaged out: each place falls with
    Φ((μ + √0.3 σ z - ln θ)/√(β² + 0.7 σ²)) given the event. Beside that chance is left: 50 pieces
    √(200 p (1 - p)) are 350 at most, 250 of the quantiles of 2,000 draws.
    """
    sites = [(4.0 * k, 3.0 * j) for k in range(40) for j in range(-2, 3)]
    falls = [Fall(k, 50, 1.0, 0.4) for k in range(200)]
    found = total_falls(falls, [(-0.3, 0.5)] * 200, sites, "PGV", draws=2000)
    spread = np.hypot(0.4, 0.5 * np.sqrt(0.7))
    for end, z in zip(found, (-1.96, 1.96), strict=True):
        expected = 1e4 * float(ndtr(np.array((-0.3 + z * np.sqrt(0.3) * 0.5) / spread)))
        assert end == pytest.approx(expected, abs=600.0)


def test_the_date_line_is_no_distance() -> None:
    z = residuals(
        np.array([[179.99, 10.0], [-179.99, 10.0]]), "PGV", 4000, np.random.default_rng(0)
    )
    assert np.corrcoef(z.T)[0, 1] > 0.7  # 2.2 km apart: 0.3 + 0.7 exp(-3·2.2/25.7) = 0.84


def test_without_sites_all_is_one_site() -> None:
    falls = [Fall(0, 500, 1.0, 0.4), Fall(1, 500, 1.0, 0.4)]
    assert total_falls(falls, [(-0.3, 0.5)] * 2, [None, None], "PGA") == (0.0, 1000.0)


def test_many_places_are_put_together() -> None:
    random = np.random.default_rng(0)
    sites = random.uniform((7.6, 46.6), (8.4, 47.4), (20_000, 2))
    z = residuals(sites, "PGA", 3, random)
    assert z.shape == (3, 20_000)
    assert np.isfinite(z).all()
