"""The general model beside other software on pulses with sliding, jumping and falling.

The truth is the tests' time-stepping at a step so small that its error, of first order, is below
what is compared.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from tests.support.pulses import Case

from benchmarks.cases import pulses
from benchmarks.peers import mujoco_contact
from benchmarks.time_stepping import time_stepping

Found = tuple[int, float, float]  # outcome, peak rotation [rad], slip at the end [m]
TRUE_STEP = 1e-6  # s
AFTER = 3.0  # s of rest that is left after a pulse


def end_of(case: Case) -> float:
    return case.motion.duration + AFTER


def general(case: Case) -> Found:
    run = case.run()
    return int(run.outcome), run.peak_rotation, float(run.slip[-1])


def stepped(step: float) -> Callable[[Case], Found]:
    def run(case: Case) -> Found:
        found = time_stepping(case, end_of(case), step)
        return found.outcome, found.peak, found.slip

    return run


def by_mujoco(step: float) -> Callable[[Case], Found]:
    def run(case: Case) -> Found:
        tilt, friction = case.support.tilt, case.model.static_friction
        return mujoco_contact(case.body, case.motion, tilt, friction, step, end_of(case))

    return run


SOLVERS: dict[str, Callable[[Case], Found]] = {
    "shaketable, `simulate(model=General(…))`": general,
    "Moreau-Jean, compiled, steps of 10 μs": stepped(1e-5),
    "MuJoCo, steps of 0.5 ms": by_mujoco(5e-4),
    "MuJoCo, steps of 0.1 ms": by_mujoco(1e-4),
}


def worst_and_median(errors: list[float]) -> str:
    ordered = sorted(errors)
    return f"{ordered[len(ordered) // 2]:.1e} ({ordered[-1]:.1e})" if ordered else "-"


def report(count: int) -> None:
    """Print the table."""
    cases = pulses(count)
    truth = [stepped(TRUE_STEP)(case) for case in cases]
    print(f"\n{count} pulses; error: median (largest) of the bodies that stand\n")
    print("| software | simulations/s | times slower | outcomes | peak off [rad] | slip off [m] |")
    print("|---|---:|---:|---:|---:|---:|")
    fastest = math.nan
    for name, solver in SOLVERS.items():
        solver(cases[0])  # what it compiles or loads is not counted
        start = time.perf_counter()
        found = [solver(case) for case in cases]
        rate = count / (time.perf_counter() - start)
        fastest = rate if math.isnan(fastest) else fastest
        same = sum(f[0] == t[0] for f, t in zip(found, truth, strict=True))
        standing = [(f, t) for f, t in zip(found, truth, strict=True) if f[0] == t[0] == 0]
        peaks = worst_and_median([abs(f[1] - t[1]) for f, t in standing])
        slips = worst_and_median([abs(f[2] - t[2]) for f, t in standing])
        error = f"{peaks} | {slips}"
        print(f"| {name} | {rate:,.1f} | {fastest / rate:,.0f} | {same}/{count} | {error} |")
