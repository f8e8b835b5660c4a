"""The engine gives the same whether Numba compiles it or Python runs it as it stands."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

CASES = """
import numpy as np
from shaketable import Body, General, Motion, Rocking, Support, simulate, simulate_many
rng = np.random.default_rng(12)
results = []
for _ in range(8):
    body = Body.rectangle(rng.uniform(0.15, 0.3), rng.uniform(0.5, 0.9))
    samples = np.convolve(rng.normal(0, 2.2, 160), np.ones(6) / 3, "same")
    run = simulate(body, Motion(samples, 0.02), Support(tilt=0.02))
    results.append([int(run.outcome), run.peak_rotation, run.impacts])
"""
GENERAL = """
model = General(static_friction=0.3, kinetic_friction=0.25, restitution_factor=0.95)
for _ in range(3):
    body = Body.rectangle(rng.uniform(0.15, 0.3), rng.uniform(0.5, 0.9))
    across, up = (np.convolve(rng.normal(0, 3.0, 80), np.ones(6) / 3, "same") for _ in range(2))
    run = simulate(body, Motion(across, 0.02, vertical=up), Support(tilt=0.02), model=model)
    results.append([int(run.outcome), run.peak_rotation, run.peak_slip, run.max_lift])
for model in (Rocking(), model, General(static_friction=3.0)):
    bodies = [Body.rectangle(width, 0.8) for width in (0.12, 0.2, 0.3)]
    runs = simulate_many(
        bodies, [Motion(across, 0.02)], tilts=[0.02], model=model, progress=False, threads=1
    )
    results.append([*runs.outcome.values.ravel().tolist(), *runs.peak_rotation.values.ravel()])
"""
TO_THE_END = """
from shaketable.physics.plane import events, rocking
events.SETTLE_ROTATION = rocking.SETTLE_ROTATION = 0.0
"""


def run_uncompiled(cases: str) -> list[list[float]]:
    result = subprocess.run(
        [sys.executable, "-c", cases + "import json\nprint(json.dumps(results))"],
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(result.stdout)


def test_compiled_and_interpreted_engines_agree() -> None:
    interpreted = run_uncompiled(CASES + GENERAL)
    assert 2 <= sum(row[0] == 0 for row in interpreted[:8]) <= 6  # some stand and some fall
    compiled: dict[str, object] = {}
    exec(CASES + GENERAL, compiled)
    results = compiled["results"]
    assert isinstance(results, list)
    slips = [row[2] for row in results[8:11]]
    assert min(slips) > 1e-3  # they slide
    # the same operations but for libm's sine, good to the last bit or two; in the general model
    # bounces make more of it
    for ours, theirs in zip(results[:8], interpreted[:8], strict=True):
        assert theirs == pytest.approx(ours, abs=1e-12)
    for ours, theirs in zip(results[8:], interpreted[8:], strict=True):
        assert theirs == pytest.approx(ours, abs=1e-9)


def test_verdicts_do_not_depend_on_where_bouncing_ends() -> None:
    # SETTLE_ROTATION = 0 follows every bounce down to RESTING_SPEED, 1e-10 rad/s
    usual, to_the_end = run_uncompiled(CASES), run_uncompiled(TO_THE_END + CASES)
    assert sum(row[2] for row in to_the_end) > 1.5 * sum(row[2] for row in usual)
    for short, long in zip(usual, to_the_end, strict=True):
        assert short[0] == long[0]
        assert short[1] == pytest.approx(long[1], abs=1e-10)
