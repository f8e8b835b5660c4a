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


def test_one_place_by_its_quantiles() -> None:
    """At one place the number that falls rises with the shaking: its quantiles are closed.

    10,000 alike pieces: n Φ((μ ± 1.96 σ - ln θ)/β), to 5 % of the pieces for 4,000 draws.
    """
    low, high = total_falls(
        [Fall(0, 10_000, 1.0, 0.4)], [(-0.3, 0.5)], [(8.0, 47.0)], "PGV", draws=4000
    )
    for found, z in ((low, -1.96), (high, 1.96)):
        expected = 1e4 * float(ndtr(np.array((-0.3 + z * 0.5) / 0.4)))
        assert found == pytest.approx(expected, abs=500.0)


def test_places_that_are_far_apart_share_the_event_alone() -> None:
    """200 places 300 km and more apart: their common part alone is left.

    With the share 0.3 of the variance in common, the rest is averaged out: each place falls with
    Φ((μ + √0.3 σ z - ln θ)/√(β² + 0.7 σ²)) given the event.
    """
    sites = [(4.0 * k, 3.0 * j) for k in range(40) for j in range(-2, 3)]
    falls = [Fall(k, 50, 1.0, 0.4) for k in range(200)]
    found = total_falls(falls, [(-0.3, 0.5)] * 200, sites, "PGV", draws=2000)
    spread = np.hypot(0.4, 0.5 * np.sqrt(0.7))
    for end, z in zip(found, (-1.96, 1.96), strict=True):
        expected = 1e4 * float(ndtr(np.array((-0.3 + z * np.sqrt(0.3) * 0.5) / spread)))
        assert end == pytest.approx(expected, abs=500.0)


def test_without_sites_all_is_one_site() -> None:
    falls = [Fall(0, 500, 1.0, 0.4), Fall(1, 500, 1.0, 0.4)]
    one = total_falls(falls, [(-0.3, 0.5)] * 2, [None, None], "PGA")
    low, high = total_falls([Fall(0, 1000, 1.0, 0.4)], [(-0.3, 0.5)], [(0.0, 0.0)], "PGA")
    assert one == pytest.approx((low, high), abs=40.0)  # each piece still falls by itself


def test_many_places_are_put_together() -> None:
    random = np.random.default_rng(0)
    sites = random.uniform((7.6, 46.6), (8.4, 47.4), (20_000, 2))
    z = residuals(sites, "PGA", 3, random)
    assert z.shape == (3, 20_000)
    assert np.isfinite(z).all()
