"""`python -m benchmarks.gpu_counts`: what a GPU has to do for W1, counted on the CPU.

Nothing here was measured on a device. It counts, for the rocking model, the intervals and events of
each simulation and the operations of an interval, and what general solvers for GPUs (DiffEqGPU,
MPGOS) would need for the same if one step of a Runge-Kutta method took them through an interval,
which is not to round-off. Divided into the FP64 rate of a data sheet, without fused operations,
they are rates on paper. It also tells how much of a warp's threads is at work if members are
launched in the order given, and in the order of `simulate.plane_on_gpu`.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from benchmarks.cases import BODIES, TILTS, motions
from shaketable import Body, Motion, Rocking
from shaketable.engine.batch import block_of, demands_of
from shaketable.engine.body_tables import tabulate_demands
from shaketable.engine.rocking_many import begin, finish, resolve
from shaketable.engine.rocking_one import short_ways
from shaketable.engine.single_lane import run_lane
from shaketable.models.batch import batch_of
from shaketable.models.engine_input import refined, substeps

FP64 = 17e12  # operations a second of an H200: 34e12 by its data sheet, which counts a fused
# multiplication and addition as two
WARP = 32
EVENT = 5.0  # an interval with events takes as long as so many without, about, on a CPU
EVERY = 4  # one motion in so many is counted
STAGES = 6  # right-hand sides of a step of a Runge-Kutta pair of order 5 (Dormand and Prince)
RIGHT_HAND_SIDE = 2 * 40 + 12  # operations: sine and cosine in FP64, about, and the rest
SUMS = 2 * 2 * 27  # of both unknowns, with the estimate of the error

#: Runs `step` as plain Python on numbers that count what is done to them.
COUNTING = """
import math
from shaketable.physics.plane import rocking, taylor
from shaketable.physics.plane.forcing import Forcing
class Number(float):
    done = 0
def counted(name):
    plain = getattr(float, name)
    def operation(self, *others):
        Number.done += 1
        value = plain(self, *others)
        return Number(value) if isinstance(value, float) else value
    return operation
for name in ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv", "lt", "le", "gt",
             "ge", "abs", "neg"):
    setattr(Number, f"__{name}__", counted(f"__{name}__"))
n = Number
state = rocking.State(n(1), n(0.1), n(0.2), n(0.2), n(0.98))
rocking.step(state, n(0.7), n(0.3), n(0.01), Forcing(n(9.8), n(0.1), n(1.0), n(0.2)))
print(Number.done)
"""


@numba.njit(error_model="numpy", forceinline=True)  # type: ignore[untyped-decorator]
def counting(passage: Any, body: Any, shaking: Any, interval: Any, counts: Any) -> Any:
    """`short_ways`, which counts intervals and those that it cannot cross."""
    moved, done = short_ways(passage, body, shaking, interval, counts[:0])
    counts[0] += 1.0
    if not done:
        counts[1] += 1.0
    return moved, done


@numba.njit(error_model="numpy")  # type: ignore[untyped-decorator]
def count_each(shaking: Any, demands: Any, batch: Any, counts: NDArray[np.float64]) -> None:
    """Write the intervals of each body of a batch, and those with events."""
    no_times = np.empty(0)
    for row in range(counts.shape[0]):
        body = block_of(batch, row)
        run_lane(
            batch, row, shaking, demands, no_times, body, counts[row], counting, begin, resolve,
            finish,
        )  # fmt: skip


class Work(NamedTuple):
    """Of the bodies of a set under one motion."""

    intervals: NDArray[np.float64]
    events: NDArray[np.float64]  # intervals that no short way crosses
    demands: NDArray[np.float64]  # at which each can tip

    @property
    def cost(self) -> NDArray[np.float64]:
        """In intervals."""
        return self.intervals + EVENT * self.events


def work_of(bodies: list[Body], tilts: NDArray[np.float64], motion: Motion) -> Work:
    table = Rocking().tabulate(bodies, tilts)
    shaking = refined(motion, int(substeps(table.blocks, motion).max()))
    batch, _ = batch_of(table, np.ones(len(bodies)))
    counts = np.zeros((len(bodies), 2))
    count_each(shaking, demands_of(shaking), batch, counts)
    return Work(*counts.T, tabulate_demands(table.blocks))


def at_work(cost: NDArray[np.float64], order: NDArray[np.intp]) -> tuple[float, float]:
    """What the members cost, and what their warps do: each as long as its longest member."""
    padded = np.append(cost[order], np.zeros(-cost.size % WARP)).reshape(-1, WARP)
    return float(padded.sum()), float(WARP * padded.max(axis=1).sum())


def share_at_work(works: list[Work], sorted_too: bool) -> float:
    """The share of the threads' time in which they have something to do."""
    both = [
        at_work(
            work.cost,
            np.argsort(work.demands, kind="stable") if sorted_too else np.arange(work.cost.size),
        )
        for work in works
    ]
    done, taken = np.sum(both, axis=0)
    return float(done / taken)


def operations_of_a_step() -> int:
    run = subprocess.run(
        [sys.executable, "-c", COUNTING],
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return int(run.stdout)


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    shaken = motions()[::EVERY]
    w1 = [body for body in BODIES for _ in TILTS], np.tile(TILTS, len(BODIES))
    rng = np.random.default_rng(1)
    spread = [
        Body.rectangle(width, height)
        for width, height in zip(
            rng.uniform(0.1, 0.8, 6000), rng.uniform(0.5, 2.5, 6000), strict=True
        )
    ]
    sets = {"W1": w1, "6,000 bodies of all sizes": (spread, np.zeros(len(spread)))}
    found = {name: [work_of(*each, motion) for motion in shaken] for name, each in sets.items()}
    for name, works in found.items():
        print(f"{name}: threads of a warp at work {100 * share_at_work(works, False):.0f} % in the "
              f"order given, {100 * share_at_work(works, True):.0f} % in the order of their "
              "demands")  # fmt: skip
    cost = np.concatenate([work.cost for work in found["W1"]])
    events = np.concatenate([work.events for work in found["W1"]])
    print(
        f"W1: {cost.mean():,.0f} intervals a simulation; {events.mean():.0f} of them with events, "
        f"which count {EVENT:g}-fold"
    )
    ways = {
        "this package": operations_of_a_step(),
        "an integrator of order 5, one step an interval": STAGES * RIGHT_HAND_SIDE + SUMS,
    }
    for name, each in ways.items():
        rate = FP64 / (each * float(cost.mean()))
        print(f"{name}: {each} operations an interval; some {rate:.1g} simulations/s")


if __name__ == "__main__":
    main()
