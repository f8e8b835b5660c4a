"""How long direct integration takes: `python -m benchmarks.risk`.

1,000 pairs of furniture and floor: 100 bodies on 10 floors of linear shear buildings, 100 motions
for each floor, made and simulated.
"""

from __future__ import annotations

import time

import numpy as np

from benchmarks.cases import motions
from shaketable import Body, ShearBuilding, floor_motions, overturning_risk
from shaketable.engine.pool import available_cores


def main() -> None:
    building = ShearBuilding(storeys=5, first_period=0.6)
    floors = [floor for ground in motions()[:2] for floor in floor_motions(building, ground)]
    rng = np.random.default_rng(1)
    heights, ratios = rng.uniform(0.5, 2.5, 100), rng.uniform(0.1, 0.5, 100)
    bodies = [Body.rectangle(b, h) for b, h in zip(heights * ratios, heights, strict=True)]
    overturning_risk(bodies[0], floors[0], n=2)  # what it compiles or loads is not counted
    start = time.perf_counter()
    risk = overturning_risk(bodies, floors)
    seconds = time.perf_counter() - start
    print(
        f"{risk.falls.size:,} pairs of furniture and floor, {risk.falls.size * risk.simulations:,} "
        f"simulations of {len(floors) * risk.simulations:,} motions: {seconds:.0f} s on "
        f"{available_cores()} cores"
    )


if __name__ == "__main__":
    main()
