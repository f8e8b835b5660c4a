"""Spectra of a horizontal pair in all directions."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import InputError, Motion
from shaketable.signal import rotated_spectra, rotd
from shaketable.signal.spectra import peak_responses

PERIODS = np.array([0.2, 1.0])


def test_a_motion_on_a_line() -> None:
    """Of a motion on one line RotD100 is its own, RotD50 that at 45° to it: cos 45° of it."""
    x = np.random.default_rng(1).normal(size=800)
    own = np.abs(peak_responses(x, 0.01, PERIODS, damping=0.05)[0])
    line = Motion(x, 0.01).rotated(0.5)
    assert rotd(line, PERIODS, 100.0) == pytest.approx(own, rel=2e-4)  # angles are 1° apart
    # the median of |cos| over 180 angles 1° apart lies between two of them
    assert rotd(line, PERIODS) == pytest.approx(own / np.sqrt(2.0), rel=0.01)
    assert rotd(line, PERIODS, 0.0) == pytest.approx(np.zeros(2), abs=0.01 * own.max())


def test_it_does_not_depend_on_the_axes(p695: list[Motion]) -> None:
    """Turned by whole degrees the same directions are looked at: to round-off."""
    first, second = p695[0], p695[1]
    n = min(first.horizontal.size, second.horizontal.size)
    pair = Motion(first.horizontal[:n], first.time_step, transverse=second.horizontal[:n])
    turned = pair.rotated(np.radians(37.0))
    for percentile in (50.0, 100.0):
        assert rotd(turned, PERIODS, percentile) == pytest.approx(
            rotd(pair, PERIODS, percentile), rel=1e-9
        )
    spectra = rotated_spectra(pair, PERIODS)
    own = np.abs(peak_responses(pair.horizontal, pair.time_step, PERIODS, damping=0.05)[0])
    assert np.array_equal(spectra[0], own)
    across = np.abs(peak_responses(second.horizontal[:n], pair.time_step, PERIODS, damping=0.05)[0])
    assert spectra[90] == pytest.approx(across, rel=1e-9)


def test_refused() -> None:
    x = np.ones(10)
    with pytest.raises(InputError, match="has no transverse component"):
        rotd(Motion(x, 0.01, name="one"), PERIODS)
    pair = Motion(x, 0.01, transverse=x)
    with pytest.raises(InputError, match="percentile must lie between 0 and 100"):
        rotd(pair, PERIODS, 101.0)
    with pytest.raises(InputError, match="periods"):
        rotd(pair, [0.0])
