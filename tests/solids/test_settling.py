"""Where events accumulate a solid comes to rest, and does not chatter for ever."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import General, Motion, Solid, simulate


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
