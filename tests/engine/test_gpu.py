"""The rocking model as a GPU runs it: the same numbers, a body at a time."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, Rocking, simulate_many
from shaketable.engine import cuda
from shaketable.engine.lane_loop import demands_of
from shaketable.engine.rocking_lane import rock_each
from shaketable.engine.rocking_many import rock_many
from shaketable.models.batch import batch_of
from shaketable.models.engine_input import refined, substeps
from tests.support.builders import TABLE_1
from tests.support.recorded import random_case


def same(table: object, polarity: np.ndarray, motion: Motion) -> None:
    """Both ways give one result, to the bit."""
    parts = int(substeps(table.blocks, motion).max())
    shaking = refined(motion, parts)
    demands = demands_of(shaking)
    results = []
    for way in (rock_many, rock_each):
        batch, _ = batch_of(table, polarity)
        way(shaking, demands, batch)
        results.append(batch.results)
    assert np.array_equal(*results, equal_nan=True)


def test_a_body_by_itself_goes_as_in_lanes(p695: list[Motion]) -> None:
    """Every body of table I on every second tilt, under every fifth motion, in both directions."""
    tilts = np.radians(np.arange(0.0, 7.01, 1.0))
    bodies = [Body.rectangle(*size) for size in TABLE_1 for _ in tilts]
    table = Rocking().tabulate(bodies, np.tile(tilts, len(TABLE_1)))
    for k, motion in enumerate(p695[::5]):
        same(table, np.full(len(bodies), 1.0 if k % 2 else -1.0), motion)


def test_with_verticals_eccentric_bodies_and_tilts(p695: list[Motion]) -> None:
    rng = np.random.default_rng(5)
    for _ in range(30):
        body, motion, support = random_case(rng, p695)
        same(Rocking().tabulate([body], np.array([support.tilt])), np.ones(1), motion)


def test_a_body_that_never_rocks_and_a_motion_that_ends_at_once() -> None:
    table = Rocking().tabulate([Body.rectangle(0.3, 1.0)], np.zeros(1))
    for push in ([0.0, 0.0], [0.0, 9.0], [9.0, 0.0], [9.0, 9.0, 9.0]):
        same(table, np.ones(1), Motion(push, 0.01))


def test_without_a_gpu_it_is_told() -> None:
    try:
        cuda.require_gpu()
    except InputError:
        pass
    else:
        pytest.skip("a GPU is here")
    body, motion = Body.rectangle(0.3, 1.0), Motion([0.0, 1.0], 0.01)
    with pytest.raises(InputError, match=r"device='cuda'.*(extra gpu|nvidia-smi)"):
        simulate_many([body], [motion], device="cuda", progress=False)
    with pytest.raises(InputError, match="unknown device 'gpu'; accepted: cpu, cuda"):
        simulate_many([body], [motion], device="gpu", progress=False)
    with pytest.raises(InputError, match=r"General\(.*runs on the CPU only"):
        simulate_many([body], [motion], model="general", device="cuda", progress=False)


SIMULATED = """
import importlib
import numpy as np
from shaketable import Body, Motion, simulate_each, simulate_many
from shaketable.engine import cuda
cuda.require_gpu = lambda: importlib.import_module("numba.cuda")
time = np.arange(0.0, 1.5, 0.01)
motions = [Motion(a * np.sin(f * time), 0.01) for a, f in ((4.0, 6.0), (7.0, 4.0))]
given = {"bodies": [Body.rectangle(0.2, 1.0), Body.rectangle(0.1, 0.8)], "motions": motions,
         "tilts": [0.0, 0.02], "progress": False}
there = simulate_many(**given, device="cuda")
here = simulate_many(**given, threads=1)
assert there.identical(here), (there, here)
each = {"bodies": given["bodies"][0], "motions": motions, "scales": (1.0, 1.2), "progress": False}
assert simulate_each(**each, device="cuda").identical(simulate_each(**each, threads=1))
assert here["outcome"].any() and here["impacts"].any()
"""


def test_under_the_simulator_of_cuda() -> None:
    """Kernel, grid and members as on a device, in plain Python; its mathematics is the CPU's."""
    pytest.importorskip("numba_cuda", reason="the extra gpu is not installed")
    environment = {**os.environ, "NUMBA_ENABLE_CUDASIM": "1", "NUMBA_DISABLE_JIT": "1"}
    root = Path(__file__).parents[2]
    run = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", SIMULATED],
        env=environment, cwd=root, capture_output=True, text=True,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
