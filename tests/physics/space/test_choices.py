"""Shares over ensembles do not depend on the engine's choices: tolerances, thresholds, points."""

from __future__ import annotations

import math

import numpy as np
import pytest
from benchmarks.solid_choices import CHANGES, CHOICES, ENSEMBLES, changed, compared
from benchmarks.solids import pairs

from shaketable import General, Solid, simulate

EVERY = 12  # of the pairs
DEVIATIONS = 4.0  # of chance, of which one in 16,000 is beyond
CHANGED = 0.1  # of the outcomes: orientations of a polygon are alike, and change together


@pytest.mark.parametrize(
    "base",
    ["square", "circle", "polygon", "rim", pytest.param("feet", marks=pytest.mark.slow)],
)
def test_outcomes_change_by_chance_alone(base: str) -> None:
    """Of every third change, and of all of a circle's ring; the benchmark makes all of them."""
    circular = base == "circle"
    changes = [change for change in CHANGES if circular or change[0] != "RING"]
    some = [change for k, change in enumerate(changes) if k % 3 == 0 or change[0] == "RING"]
    for name, value, found in compared(ENSEMBLES[base]()[2::4], pairs()[::EVERY], some):
        assert 0 < found.fell < found.runs
        assert abs(found.deviations) < DEVIATIONS, (name, value, found)
        assert found.now_fall + found.now_stand < CHANGED * found.runs, (name, value, found)


@pytest.mark.parametrize("sides", [16, 64])
def test_slow_polygons_are_not_held_on_a_side(sides: int) -> None:
    """What rolls slowly leaves each corner by ω s, which a fixed speed of 0.1 mm/s did not let go.

    Where nothing slips, a threshold a thousandth changes nothing, and one a hundred times does.
    """
    angles = 2 * math.pi * np.arange(sides) / sides
    corners = 0.15 * np.column_stack([np.cos(angles), np.sin(angles)])
    solid, motion = Solid.polygon(corners, 1.2), pairs()[3]
    times = []
    for factor in (1.0, 1e-3, 100.0):
        with changed("LEAVING", factor * CHOICES.LEAVING):
            run = simulate(solid, motion, model=General(static_friction=5.0))
        times.append(run.overturning_time)
    assert math.isfinite(times[0])
    assert times[0] == pytest.approx(times[1], abs=1e-4)
    assert times[2] != pytest.approx(times[0], abs=0.1)
