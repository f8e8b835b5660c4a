"""Found by shaking solids at random: what chattered for ever, slid without friction, got lost."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import General, Motion, Solid, simulate
from tests.support.solids import moved


@pytest.mark.parametrize("seed", [27, 35, 51])
def test_what_time_stepping_brings_to_rest_lies_flat(
    seed: int, caplog: pytest.LogCaptureFixture
) -> None:
    """It hung some 0.1 µm above its support, and fell back on it 100 times in every sample."""
    rng = np.random.default_rng(seed)
    rng.uniform(0, 2 * math.pi, 7)
    angles = 2 * math.pi * (np.arange(7) + rng.uniform(-0.3, 0.3, 7)) / 7
    stool = Solid.on_feet(0.05 * np.column_stack([np.cos(angles), 1.3 * np.sin(angles)]), 0.3)
    x, y, z = rng.uniform(-1.0, 1.0, (3, 20)) * np.array([[6.0], [6.0], [4.0]])
    run = simulate(
        stool,
        Motion(x, 0.005, transverse=y, vertical=z),
        model=General(static_friction=0.4, normal_restitution=0.2),
    )
    assert run.fallbacks > 0
    assert run.time[-1] < 3.0  # it rests: nothing is given up
    assert run.impacts < 3000
    assert not caplog.records
    assert run.nutation[-1] == 0.0


FEET = np.array([
    [-0.01087, -0.00168], [0.00823, -0.0033], [0.00396, 0.00278], [-0.00339, 0.00362],
    [-0.00418, 0.00323], [-0.00879, -0.00016], [-0.00682, -0.0006], [0.00414, -0.00011],
])  # fmt: skip


@pytest.mark.parametrize("toward", np.arange(0.0, 2.0 * math.pi, 0.4))
def test_a_stool_whose_feet_are_nearly_in_line_tips(toward: float) -> None:
    """As a base of the same corners does; it slid, as if friction were none, for ever.

    Three feet in line cannot carry it, and were taken to carry it with no pressure at all.
    """
    push = np.r_[np.linspace(0.0, 2.0, 20), np.zeros(40)]  # its resultant passes the edge slowly
    motion = Motion(push * math.cos(toward), 0.005, transverse=push * math.sin(toward))
    stool = Solid.on_feet(FEET, 0.1038)
    base = Solid.polygon(stool.corners, 0.1038, inertia=stool.inertia)
    model = General(static_friction=0.7, kinetic_friction=0.36)
    runs = [simulate(solid, motion, model=model) for solid in (stool, base)]
    assert runs[0].peak_rotation > 1e-4
    # the same motion until points that only one of them has meet the support
    assert runs[0].peak_rotation == pytest.approx(runs[1].peak_rotation, rel=0.05)
    assert moved(runs[0]) == pytest.approx(moved(runs[1]), abs=2e-3)
