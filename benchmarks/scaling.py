"""How time and memory grow with an ensemble: `python -m benchmarks.scaling`.

Members of the rocking model from ten thousand to ten million, and solids on three to eight feet,
each on one thread and on two, each case in a process of its own. What one object more costs
`assess` is told by `python -m benchmarks.inventory`.
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np
import xarray as xr
from tests.support.builders import TABLE_1

from benchmarks.cases import motions
from benchmarks.solids import MODEL, ORIENTATIONS, pairs
from shaketable import Body, Solid, simulate_many

MEMBERS = (10_000, 100_000, 1_000_000, 10_000_000)
FEET = (3, 4, 5, 6, 8)
THREADS = (1, 2)
EVERY = 8  # of the pairs


def rocked(members: int, threads: int) -> xr.Dataset:
    """Bodies of many sizes, each by 100 motions in both directions."""
    rng = np.random.default_rng(1)
    sizes = zip(
        rng.uniform(0.15, 0.6, members // 200), rng.uniform(0.8, 2.2, members // 200), strict=True
    )
    bodies = [Body.rectangle(width, height) for width, height in sizes]
    return simulate_many(bodies, motions(), threads=threads, progress=False)


def on_feet(count: int, threads: int) -> xr.Dataset:
    """The twelve bodies of table I on feet around a circle, by an eighth of the pairs."""
    turns = 2.0 * np.pi * np.arange(count) / count
    ring = np.column_stack([np.cos(turns), np.sin(turns)])
    solids = [Solid.on_feet(0.5 * width * ring, height) for width, height in TABLE_1]
    return simulate_many(
        solids,
        pairs()[::EVERY],
        orientations=ORIENTATIONS,
        polarities=(1,),
        model=MODEL,
        threads=threads,
        progress=False,
    )


CASES: dict[str, Callable[[int, int], xr.Dataset]] = {"members": rocked, "feet": on_feet}


def measure(case: str, size: int, threads: int) -> None:
    """Simulate once and print runs, seconds and the largest memory in MiB."""
    CASES[case](200 if case == "members" else 3, threads)  # loads or compiles
    start = time.perf_counter()
    runs = CASES[case](size, threads)
    seconds = time.perf_counter() - start
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(runs.outcome.size, seconds, peak)


def print_table(case: str, sizes: tuple[int, ...]) -> None:
    print(f"\n| {case} | threads | runs | s | runs a second | peak memory [MiB] |")
    print("|---:|---:|---:|---:|---:|---:|")
    for size in sizes:
        for threads in THREADS:
            command = [sys.executable, "-m", "benchmarks.scaling", "--case", case]
            command += ["--size", str(size), "--threads", str(threads)]
            run = subprocess.run(command, capture_output=True, text=True, check=True)
            runs, seconds, memory = map(float, run.stdout.split())
            rate = runs / seconds
            print(
                f"| {size:,} | {threads} | {runs:,.0f} | {seconds:.2f} | {rate:,.0f} "
                f"| {memory:,.0f} |",
                flush=True,
            )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--case", choices=CASES, help="one case only, in this process")
    parser.add_argument("--size", type=int, default=10_000, help="of that case")
    parser.add_argument("--threads", type=int, default=1, help="of that case")
    asked = parser.parse_args()
    if asked.case:
        measure(asked.case, asked.size, asked.threads)
        return
    print_table("members", MEMBERS)
    print_table("feet", FEET)


if __name__ == "__main__":
    main()
