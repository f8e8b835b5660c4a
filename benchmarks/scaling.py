"""How time and memory grow with a job: `python -m benchmarks.scaling`.

Members of the rocking model from ten thousand to ten million, solids on three to eight feet, and
three sizes each of: motions, solids, rows of a list, rooms in a row, storeys. Each case is a
process of its own, on one thread and on two; lists, rooms and buildings take all cores. The slope
is the exponent of the time from one size to the next: 1 where twice as much takes twice as long.
`--case NAME` prints one of them.
"""

from __future__ import annotations

import argparse
import math
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import xarray as xr
from tests.support.builders import TABLE_1

from benchmarks.cases import motions
from benchmarks.inventory import inventory
from benchmarks.rooms import EXAMPLE, in_a_row
from benchmarks.solids import MODEL, ORIENTATIONS, pairs
from shaketable import Body, Solid, simulate_many
from shaketable.assess import assess
from shaketable.building import Building
from shaketable.rooms import assess_room, read_room
from shaketable.synthesis import ShearBuilding, floor_motions

THREADS = (1, 2)
ON_ALL_CORES = {"rows", "rooms", "storeys"}
EVERY = 8  # of the pairs
SIDEWAYS = Body.rectangle(0.9, 1.8)


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


def under(count: int, threads: int) -> xr.Dataset:
    """The twelve bodies of table I, as planar ones, by so many motions."""
    some = motions()
    each = [some[k % len(some)].scaled(1.0 + 0.001 * k) for k in range(count)]
    bodies = [Body.rectangle(width, height) for width, height in TABLE_1]
    return simulate_many(bodies, each, threads=threads, progress=False)


def boxes(count: int, threads: int) -> xr.Dataset:
    """So many boxes of their own sizes, by an eighth of the pairs."""
    rng = np.random.default_rng(2)
    sizes = zip(rng.uniform(0.2, 0.5, count), rng.uniform(0.8, 2.0, count), strict=True)
    solids = [Solid.box(width, 2.0 * width, height) for width, height in sizes]
    return simulate_many(
        solids, pairs()[::EVERY], orientations=ORIENTATIONS, polarities=(1,), model=MODEL,
        threads=threads, progress=False,
    )  # fmt: skip


def rows(count: int, _: int) -> int:
    """A list of so many bookcases, no two alike, in three dimensions, the first of them tried."""
    items = [replace(each, sideways=SIDEWAYS) for each in inventory(count)]
    found = assess(items, pairs()[::EVERY], leading=3, progress=False)
    return sum(each.solid.simulations for each in found.results if each.solid)


def rooms(count: int, _: int) -> int:
    """The example's room, so many times in a row."""
    room = in_a_row(read_room(EXAMPLE), count)
    found = assess_room(room, pairs()[::EVERY], progress=False)
    return found.runs * len(found.things)


def storeys(count: int, _: int) -> int:
    """A bookcase on each floor of a building of so many storeys, computed from the ground."""
    ground = pairs()[::EVERY]
    frame = ShearBuilding(storeys=count, first_period=0.1 * count)
    risen = [floor_motions(frame, motion) for motion in ground]
    floors = {"0": ground} | {str(k + 1): [each[k] for each in risen] for k in range(count)}
    building = Building(name="frame", floors=floors, told="as computed", computed=True)
    (item,) = inventory(1)
    items = [replace(item, sideways=SIDEWAYS, floor=label) for label in floors]
    found = assess(items, building, leading=0, progress=False)
    return sum(each.solid.simulations for each in found.results if each.solid)


CASES: dict[str, Callable[[int, int], xr.Dataset | int]] = {
    "members": rocked,
    "feet": on_feet,
    "motions": under,
    "solids": boxes,
    "rows": rows,
    "rooms": rooms,
    "storeys": storeys,
}
SIZES = {
    "members": (10_000, 100_000, 1_000_000, 10_000_000),
    "feet": (3, 4, 5, 6, 8),
    "motions": (100, 1_000, 10_000),
    "solids": (30, 100, 300),
    "rows": (10, 30, 100),
    "rooms": (1, 3, 9),
    "storeys": (1, 3, 9),
}


def measure(case: str, size: int, threads: int) -> None:
    """Simulate once and print runs, seconds and the largest memory in MiB."""
    CASES[case](200 if case == "members" else SIZES[case][0], threads)  # loads or compiles
    start = time.perf_counter()
    runs = CASES[case](size, threads)
    seconds = time.perf_counter() - start
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(runs if isinstance(runs, int) else runs.outcome.size, seconds, peak)


def print_table(case: str) -> None:
    print(f"\n| {case} | threads | runs | s | slope | runs a second | peak memory [MiB] |")
    print("|---:|---:|---:|---:|---:|---:|---:|")
    before: dict[int, tuple[int, float]] = {}
    for size in SIZES[case]:
        for threads in THREADS[-1:] if case in ON_ALL_CORES else THREADS:
            command = [sys.executable, "-m", "benchmarks.scaling", "--case", case]
            command += ["--size", str(size), "--threads", str(threads)]
            run = subprocess.run(command, capture_output=True, text=True, check=True)
            runs, seconds, memory = map(float, run.stdout.split())
            slope = ""
            if threads in before:
                smaller, took = before[threads]
                slope = f"{math.log(seconds / took) / math.log(size / smaller):.2f}"
            before[threads] = size, seconds
            print(
                f"| {size:,} | {threads} | {runs:,.0f} | {seconds:.2f} | {slope} "
                f"| {runs / seconds:,.0f} | {memory:,.0f} |",
                flush=True,
            )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--case", choices=CASES, help="one case only")
    parser.add_argument("--size", type=int, help="of that case, once, in this process")
    parser.add_argument("--threads", type=int, default=1, help="of that case")
    asked = parser.parse_args()
    if asked.case and asked.size:
        measure(asked.case, asked.size, asked.threads)
        return
    for case in [asked.case] if asked.case else CASES:
        print_table(case)


if __name__ == "__main__":
    main()
