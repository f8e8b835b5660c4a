"""Both models as a GPU runs them: the same numbers, a body at a time."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from shaketable import (
    Body,
    General,
    InputError,
    Motion,
    Rocking,
    Solid,
    Surroundings,
    Wall,
    simulate_many,
)
from shaketable.engine import cuda
from shaketable.engine.batch import demands_of
from shaketable.engine.general_lane import move_each
from shaketable.engine.general_many import move_many
from shaketable.engine.rocking_lane import rock_each
from shaketable.engine.rocking_many import rock_many
from shaketable.models import Model
from shaketable.models.batch import batch_of
from shaketable.models.engine_input import refined, substeps
from shaketable.simulate import plane_on_gpu
from shaketable.simulate.plane import Group, Rows
from tests.support.builders import TABLE_1
from tests.support.recorded import random_case

WAYS = {Rocking: (rock_many, rock_each), General: (move_many, move_each)}
ROCKING = (Rocking(), Rocking(restitution=0.8))
GENERAL = (
    General(static_friction=2.0),
    General(static_friction=0.5, kinetic_friction=0.4, restitution_factor=0.95),
    General(static_friction=0.5, normal_restitution=0.3),
    General(static_friction=0.02),  # it only slides
)


def same(model: Model, bodies: list[Body], tilts: np.ndarray, way: float, motion: Motion) -> None:
    """In lanes and by itself a body comes to the same, to the bit."""
    table, polarity = model.tabulate(bodies, tilts), np.full(len(bodies), way)
    parts = int(substeps(table.blocks, motion).max())
    shaking = refined(motion, parts)
    demands = demands_of(shaking)
    results = []
    for run in WAYS[type(model)]:
        batch, _ = batch_of(table, polarity)
        run(shaking, demands, batch)
        results.append(batch.results)
    assert np.array_equal(*results, equal_nan=True)


# One test for all of it: each process that runs any of it compiles both ways.
# The general model's one by one takes minutes to compile, for nothing else that is tested.
@pytest.mark.parametrize(
    "models",
    [
        pytest.param(ROCKING, id="rocking"),
        pytest.param(GENERAL, id="general", marks=pytest.mark.slow),
    ],
)
def test_a_body_by_itself_goes_as_in_lanes(models: tuple[Model, ...], p695: list[Motion]) -> None:
    """Table I's bodies on tilts; verticals and eccentric bodies; motions that end at once."""
    tilts = np.radians([0.0, 1.0, 3.5, 7.0])
    bodies = [Body.rectangle(*size) for size in TABLE_1 for _ in tilts]
    rng = np.random.default_rng(5)
    cases = [random_case(rng, p695) for _ in range(30)]
    for model in models:
        for k, motion in enumerate(p695[::5]):
            same(model, bodies, np.tile(tilts, len(TABLE_1)), 1.0 if k % 2 else -1.0, motion)
        for body, motion, support in cases:
            same(model, [body], np.array([support.tilt]), 1.0, motion)
        for push in ([0.0, 0.0], [0.0, 9.0], [9.0, 0.0], [9.0, 9.0, 9.0]):
            same(model, [Body.rectangle(0.3, 1.0)], np.zeros(1), 1.0, Motion(push, 0.01))


def test_surroundings_are_refused() -> None:
    """They were never tried there; it is told with and without a GPU."""
    around = Surroundings(walls=(Wall(restitution=0.5),))
    with pytest.raises(InputError, match=r"surroundings= is not for a GPU"):
        simulate_many([Body.rectangle(0.3, 1.0)], [Motion([0.0, 1.0], 0.01)], surroundings=around,
                      device="cuda", progress=False)  # fmt: skip


def test_solids_are_of_the_processor_alone() -> None:
    with pytest.raises(InputError, match=r"device='cuda': solids are simulated on the CPU"):
        simulate_many([Solid.box(1, 1, 1)], [Motion([0.0, 1.0], 0.01)], device="cuda",
                      progress=False)  # fmt: skip


def test_without_a_gpu_it_is_told() -> None:
    try:
        cuda.require_gpu()
    except InputError:
        pass
    else:
        pytest.skip("a GPU is here")
    body, motion = Body.rectangle(0.3, 1.0), Motion([0.0, 1.0], 0.01)
    with pytest.raises(InputError, match=r"device='cuda'.*(shaketable.gpu.|nvidia-smi)"):
        simulate_many([body], [motion], device="cuda", progress=False)
    for bodies in ([body], [Solid.box(1, 1, 1)]):
        with pytest.raises(InputError, match="unknown device 'gpu'; accepted: cpu, cuda"):
            simulate_many(bodies, [motion], device="gpu", progress=False)


SIMULATED = """
import importlib
import numpy as np
from shaketable import Body, General, Motion, simulate_each, simulate_many
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
given["model"] = General(static_friction=0.45)
there = simulate_many(**given, device="cuda")
here = simulate_many(**given, threads=1)
assert there.identical(here), (there, here)
assert here["outcome"].any() and here["impacts"].any() and here["displacement_x"].any()
"""


def test_under_the_simulator_of_cuda() -> None:
    """Kernel, grid and members as on a device, in plain Python; its mathematics is the CPU's."""
    environment = {**os.environ, "NUMBA_ENABLE_CUDASIM": "1", "NUMBA_DISABLE_JIT": "1"}
    root = Path(__file__).parents[2]
    run = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", SIMULATED],
        env=environment, cwd=root, capture_output=True, text=True,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr


def test_members_of_a_warp_are_alike(p695: list[Motion]) -> None:
    """Each member is launched once, with those of its motion, the liveliest first."""
    rng = np.random.default_rng(3)
    bodies = [Body.rectangle(w, 1.0) for w in rng.uniform(0.1, 0.6, 40)]
    table, none = Rocking().tabulate(bodies, np.zeros(40)), np.ones(40)
    rows = Rows(table, none, np.ones(40, np.int8), np.arange(40))
    groups = [
        Group(motion, 1.0, np.arange(40)[part], 40 * k)
        for k, motion in enumerate(p695[:4])
        for part in (slice(0, 25), slice(25, 40))
    ]
    launches = list(plane_on_gpu._launches(rows, groups))
    pieces = [piece for launch in launches for piece in launch]
    members = np.concatenate([piece.group.first + piece.group.rows[piece.rows] for piece in pieces])
    assert sorted(members) == list(range(160))
    widths = np.array([body.base for body in bodies])
    for piece in pieces:  # a slender body of this height is lively
        assert (np.diff(widths[piece.group.rows[piece.rows]]) >= 0.0).all()


def test_a_launch_is_of_a_bounded_size(p695: list[Motion], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(plane_on_gpu, "AT_ONCE", 16)
    table = Rocking().tabulate([Body.rectangle(0.3, 1.0)] * 40, np.zeros(40))
    rows = Rows(table, np.ones(40), np.ones(40, np.int8), np.arange(40))

    def sizes(*groups: Group) -> list[int]:
        launches = plane_on_gpu._launches(rows, groups)
        return [sum(piece.rows.size for piece in launch) for launch in launches]

    assert sizes(Group(p695[0], 1.0, np.arange(40), 0)) == [16, 16, 8]
    some = [Group(motion, 1.0, np.arange(7), 7 * k) for k, motion in enumerate(p695[:5])]
    assert sizes(*some) == [14, 14, 7]
    monkeypatch.setattr(plane_on_gpu, "SAMPLES", p695[0].horizontal.size)
    assert sizes(*some) == 5 * [7]
