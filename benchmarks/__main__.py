"""`make bench`: this package and its peers on the same workload, simulations a second on one core.

The package runs all of W1, its peers a random sample of it. Outcomes and peak rotations are
compared with the tests' reference integrator (SciPy's DOP853 at a relative tolerance of 1e-13).
Times on shared machines vary by tens of percent; the ratios of one run are what counts.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Sequence

from benchmarks.cases import BODIES, TILTS, motions, sample
from benchmarks.peers import PEERS, Case
from shaketable import Body, Motion, Support, simulate, simulate_many
from shaketable.engine.pool import available_cores
from tests.reference import integrate

ROUNDS = 6


def w1(threads: int | None) -> float:
    """Simulations a second on W1, the best of some rounds."""
    shaking = motions()
    best = math.inf
    for _ in range(ROUNDS):
        start = time.perf_counter()
        runs = simulate_many(BODIES, shaking, tilts=TILTS, progress=False, threads=threads)
        best = min(best, time.perf_counter() - start)
    return float(runs.outcome.size / best)


def single(body: Body, motion: Motion, tilt: float) -> Case:
    run = simulate(body, motion, Support(tilt=tilt))
    return int(run.outcome), run.peak_rotation


def accuracy(found: Sequence[Case], truth: Sequence[Case]) -> tuple[str, str]:
    """Outcomes that agree, and the median error of the peak where a body rocks and stands."""
    same = sum(f[0] == t[0] for f, t in zip(found, truth, strict=True))
    off = sorted(
        abs(f[1] - t[1])
        for f, t in zip(found, truth, strict=True)
        if f[0] == t[0] == 0 and t[1] > 0
    )
    return f"{same}/{len(truth)}", f"{off[len(off) // 2]:.0e}" if off else "-"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=60, help="members of W1 that the peers run")
    cases = sample(parser.parse_args().cases)

    references = [integrate(body, motion, tilt) for body, motion, tilt in cases]
    truth = [(reference.outcome, reference.peak) for reference in references]
    alone, together = w1(1), w1(None)
    print(f"W1, 36,000 simulations: {together:,.0f} /s on {available_cores()} cores\n")
    print("| software | simulations/s, one core | times slower | outcomes | peak off [rad] |")
    print("|---|---:|---:|---:|---:|")
    ours = accuracy([single(*case) for case in cases], truth)
    print(f"| shaketable, `simulate_many` | {alone:,.0f} | 1 | {ours[0]} | {ours[1]} |")
    for name, peer in {"shaketable, `simulate` with history": single, **PEERS}.items():
        peer(*cases[0])  # what it compiles or loads is not counted
        start = time.perf_counter()
        found = [peer(*case) for case in cases]
        rate = len(cases) / (time.perf_counter() - start)
        same, off = accuracy(found, truth)
        print(f"| {name} | {rate:,.2f} | {alone / rate:,.0f} | {same} | {off} |", flush=True)


if __name__ == "__main__":
    main()
