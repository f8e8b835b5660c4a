"""`make bench`: this package and its peers on the same cases, on one core, as ratios.

Times on shared machines vary by tens of percent; the ratios of one run are what counts.
"""

from __future__ import annotations

import argparse
import math
import time

from rich.console import Console
from rich.table import Table

from benchmarks.cases import BODIES, TILTS, motions, sample
from benchmarks.peers import PEERS
from shaketable import Support, simulate, simulate_many
from shaketable.engine.pool import available_cores

ROUNDS = 5


def w1(threads: int | None) -> float:
    """Simulations a second on W1, the best of some rounds."""
    shaking = motions()
    best = math.inf
    for _ in range(ROUNDS + 1):
        start = time.perf_counter()
        runs = simulate_many(BODIES, shaking, tilts=TILTS, progress=False, threads=threads)
        best = min(best, time.perf_counter() - start)
    return float(runs.outcome.size / best)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=24, help="cases that the peers run")
    options = parser.parse_args()
    console = Console()
    cases = sample(options.cases)
    ours = [simulate(body, motion, Support(tilt=tilt)) for body, motion, tilt in cases]

    alone, together = w1(1), w1(None)
    console.print(
        f"W1, 36,000 simulations: {together:,.0f}/s on {available_cores()} cores, "
        f"{alone:,.0f}/s on one"
    )
    table = Table("software", "simulations/s, one core", "times slower", "same outcome", "peak off")
    table.add_row("shaketable, W1", f"{alone:,.0f}", "1", "", "")
    start = time.perf_counter()
    for body, motion, tilt in cases:
        simulate(body, motion, Support(tilt=tilt))
    single = len(cases) / (time.perf_counter() - start)
    table.add_row("shaketable, one by one, histories", f"{single:,.0f}", f"{alone / single:,.0f}")
    for name, peer in PEERS.items():
        peer(*cases[0])  # what it compiles or loads is not counted
        start = time.perf_counter()
        found = [peer(*case) for case in cases]
        rate = len(cases) / (time.perf_counter() - start)
        same = [f[0] == run.outcome for f, run in zip(found, ours, strict=True)]
        off = [
            abs(f[1] - run.peak_rotation)
            for f, run in zip(found, ours, strict=True)
            if f[0] == run.outcome == 0
        ]
        table.add_row(
            name,
            f"{rate:,.2f}",
            f"{alone / rate:,.0f}",
            f"{sum(same)}/{len(same)}",
            f"{sorted(off)[len(off) // 2]:.1e} rad (median)" if off else "-",
        )
    console.print(table)


if __name__ == "__main__":
    main()
