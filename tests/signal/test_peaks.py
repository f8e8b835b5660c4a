"""PGA and PGV of motions whose velocity comes to rest, and of others."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from shaketable import Motion
from shaketable.signal import peaks


def test_a_motion_at_rest_is_taken_as_it_is() -> None:
    time = 0.01 * np.arange(401)
    found = peaks(Motion(2.0 * np.sin(2 * np.pi * time), 0.01))
    assert found.acceleration == pytest.approx(2.0)
    # ∫ of a half sine of 1 Hz: 2·2/2π; linear between samples of a hundredth of the period
    assert found.velocity == pytest.approx(2.0 / np.pi, rel=1e-3)
    assert not found.corrected


def test_a_drifting_velocity_is_corrected(p695: list[Motion]) -> None:
    record = p695[1]
    known = peaks(record)
    assert not known.corrected
    time = record.time
    shifted = Motion(record.horizontal + 0.05 * (time > 12.0), record.time_step)
    found = peaks(shifted)
    assert found.corrected
    # 0.05 m/s² over 18 s drifts by 0.9 m/s, more than the record's peak
    assert found.velocity == pytest.approx(known.velocity, rel=0.15)


def test_what_cannot_be_corrected_is_said(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        found = peaks(Motion(np.full(50, 1.0), 0.01, name="a step"))
    assert not found.corrected
    assert found.velocity == pytest.approx(0.49)
    assert "a step: its velocity does not come to rest" in caplog.text
