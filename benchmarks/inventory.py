"""How an assessment grows with its inventory: `python -m benchmarks.inventory`.

Time and memory of `assess` for inventories of different lengths, each in a process of its own.
`--stub` puts falls by a plain formula in place of the simulations: what remains is the memory and
the time of everything around them, up to 100,000 objects.
"""

from __future__ import annotations

import argparse
import math
import resource
import subprocess
import sys
import time

import numpy as np
from tests.support.stub import Stub

from benchmarks.cases import motions
from shaketable import Body
from shaketable.assess import assess
from shaketable.engine.pool import available_cores
from shaketable.inventory import Item

LENGTHS = {False: (1, 100, 316, 1_000), True: (1, 1_000, 10_000, 100_000)}
MOTIONS = {False: 88, True: 10}


def inventory(length: int) -> list[Item]:
    """Bookcases, no two alike."""
    heights = np.linspace(0.8, 2.2, length)
    widths = 0.15 + 0.25 * (np.arange(length) * 0.618 % 1.0)
    return [
        Item(body=Body.rectangle(width, height, name=f"object {k}"), height=height)
        for k, (width, height) in enumerate(zip(widths.tolist(), heights.tolist(), strict=True))
    ]


def measure(length: int, stub: bool) -> None:
    """Assess once and print seconds and the largest memory in MiB."""
    shaking = motions()[: MOTIONS[stub]]
    items = inventory(length)
    start = time.perf_counter()
    assess(items, shaking, model=Stub() if stub else None, progress=False)
    seconds = time.perf_counter() - start
    print(seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stub", action="store_true", help="no simulations, up to 100,000 objects")
    parser.add_argument("--length", type=int, help="one length only, in this process")
    asked = parser.parse_args()
    if asked.length:
        measure(asked.length, asked.stub)
        return
    print(f"{MOTIONS[asked.stub]} motions, both directions, {available_cores()} cores\n")
    print("| objects | s | peak memory [MiB] |\n|---:|---:|---:|")
    found: list[tuple[int, float]] = []
    for length in LENGTHS[asked.stub]:
        command = [sys.executable, "-m", "benchmarks.inventory", "--length", str(length)]
        command += ["--stub"] if asked.stub else []
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        seconds, memory = map(float, run.stdout.split())
        print(f"| {length:,} | {seconds:.1f} | {memory:,.0f} |", flush=True)
        found.append((length, seconds))
    begin = found[0][1]  # what one object takes is what every run takes: imports, motions
    (few, short), (many, long) = found[-2:]
    slope = math.log((long - begin) / (short - begin)) / math.log(many / few)
    print(f"\nslope of the last two, less the first: time ~ objects^{slope:.2f}")


if __name__ == "__main__":
    main()
