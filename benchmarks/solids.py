"""`python -m benchmarks.solids`: solids under pairs of recorded components (W3).

The twelve bodies of Boroschek & Iruretagoyena (2006) as boxes on square bases and as cylinders,
under FEMA P-695's pairs, in four orientations and on three tilts, at μ = 0.5 and e_n = 0.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Sequence

import numpy as np
import xarray as xr
from tests.support.builders import TABLE_1

from shaketable import General, Motion, Outcome, Solid, simulate_many, suite
from shaketable.engine.endings import not_settled
from shaketable.engine.pool import available_cores

TILTS = np.radians([0.0, 2.0, 4.0])
ORIENTATIONS = np.radians([0.0, 22.5, 45.0, 67.5])
MODEL = General(static_friction=0.5)


def pairs() -> list[Motion]:
    """Those of FEMA P-695's recordings whose components' azimuths are known."""
    return [motion for motion in suite("fema-p695", pairs=True) if motion.transverse is not None]


def boxes() -> list[Solid]:
    return [Solid.box(width, width, height) for width, height in TABLE_1]


def cylinders() -> list[Solid]:
    return [Solid.cylinder(width, height) for width, height in TABLE_1]


def shaken(solids: Sequence[Solid], motions: Sequence[Motion]) -> xr.Dataset:
    """W3's runs of some solids under some pairs."""
    return simulate_many(
        solids,
        motions,
        tilts=TILTS,
        orientations=ORIENTATIONS,
        polarities=(1,),
        model=MODEL,
        progress=False,
    )


def w3(solids: list[Solid], motions: list[Motion]) -> tuple[xr.Dataset, float]:
    """The runs, and how long they took [s]."""
    simulate_many(solids[:1], motions[:1], model=MODEL, polarities=(1,), progress=False)
    start = time.perf_counter()
    runs = shaken(solids, motions)
    return runs, time.perf_counter() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=1, help="every so many of the pairs alone")
    every = parser.parse_args().every
    motions = pairs()[::every]
    count, seconds = 0, 0.0
    for name, solids in (("boxes", boxes()), ("cylinders", cylinders())):
        runs, took = w3(solids, motions)
        fell = float((runs.outcome != Outcome.STANDING).mean())
        given_up = int(not_settled(runs.ending.values).sum())
        print(
            f"{name}: {runs.outcome.size:,} runs under {len(motions)} pairs, "
            f"{runs.outcome.size / took:,.0f} a second; {100 * fell:.1f} % overturn, "
            f"{given_up} given up while they moved"
        )
        count, seconds = count + runs.outcome.size, seconds + took
    cores = available_cores()
    print(f"W3: {count / seconds:,.0f} a second on {cores} cores, {math.ceil(seconds)} s")


if __name__ == "__main__":
    main()
