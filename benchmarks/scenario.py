"""What ensembles of artificial motions have, beside the models that they are made from.

    python -m benchmarks.scenario
    python -m benchmarks.scenario city     # the time that a city takes

For each of several earthquakes: the ratio of medians and the difference of standard deviations of
ln between motions and models, of spectral ordinates, PGA, PGV and the duration; and the time taken.
Then how alike what different kinds of objects withstand is from motion to motion, and how many
pieces of a hospital fall in single simulations, beside the range that is told without simulating.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pandas as pd

from shaketable import ida, read_inventory, simulate_many, suite
from shaketable.assess.earthquake import compared
from shaketable.hazard import artificial_motions, scenario
from shaketable.hazard.earthquake import object_chances, shaken_places
from shaketable.signal import measure_named
from shaketable.signal.intensity import Record

EARTHQUAKES = ((5.0, 10.0, 300.0), (6.0, 20.0, 400.0), (7.0, 20.0, 400.0), (7.8, 40.0, 250.0))
NAMES = ("SA(0.1)", "SA(0.3)", "SA(1.0)", "SA(3.0)", "SA(5.0)", "PGA", "PGV", "D5-95")
NUMBER = 128
EXAMPLES = Path(__file__).parents[1] / "examples"
KEPT = ["name", "depth_m", "width_m", "height_m", "cg_height_m"]


def main() -> None:
    known = [measure_named(name) for name in NAMES]
    print("motions over models, median and difference in the standard deviation of ln")
    print(f"{'earthquake':34}" + "".join(f"{name:>14}" for name in NAMES) + "   s/motion")
    for magnitude, distance, vs30 in EARTHQUAKES:
        quake = scenario(magnitude, distance, vs30)
        begun = time.perf_counter()
        motions = artificial_motions(quake, NUMBER)
        taken = (time.perf_counter() - begun) / NUMBER
        records = [Record(motion.horizontal, motion.time_step) for motion in motions]
        found = np.log([[measure.of(record) for measure in known] for record in records])
        cells = []
        for k, name in enumerate(NAMES):
            if name == "D5-95":
                mean, spread = np.log(quake.duration[0]), quake.duration[1]
            else:
                mean, spread = quake.of(name)
            ratio = np.exp(found[:, k].mean() - mean)
            cells.append(f"{ratio:6.2f} ({found[:, k].std(ddof=1) - spread:+.2f})")
        print(
            f"{quake.name[:33]:34}" + "".join(f"{cell:>14}" for cell in cells) + f"   {taken:.2f}"
        )


def print_alike() -> None:
    """The correlation between kinds of ln of the lowest PGV that overturns them, over motions."""
    items = read_inventory(EXAMPLES / "hospital.csv")
    found = ida([item.body for item in items], suite("fema-p695-far-field"))
    lowest = np.log(found["capacity"].transpose("body", ...).values.reshape(len(items), -1))
    known = np.isfinite(lowest).mean(axis=1) > 0.8
    table = np.ma.corrcoef(np.ma.masked_invalid(lowest[known]))
    pairs = table[np.triu_indices(int(known.sum()), 1)]
    print(
        f"correlation of what {known.sum()} kinds withstand: median {np.ma.median(pairs):.2f}, "
        f"from {pairs.min():.2f} to {pairs.max():.2f}"
    )


def print_totals() -> None:
    """How many pieces of the example hospital fall in single simulations, beside the range told."""
    items = read_inventory(EXAMPLES / "hospital.csv")
    quake = scenario(7.0, 20.0, 400.0)
    places = shaken_places(items, quake, "PGV")
    chances = object_chances(items, places, suite("fema-p695-far-field"), "PGV")
    found = compared(quake.name, measure_named("PGV"), chances, places)
    bodies, quantities = [], []
    for one in found.leading:
        front = one.chance.direction == "front to back"
        bodies.append(one.chance.item.body if front else one.chance.item.sideways)
        quantities.append(one.chance.item.quantity)
    runs = simulate_many(bodies, artificial_motions(quake, 256, seed=5))
    fell = (runs["outcome"] != 0).transpose("body", ...).values.reshape(len(bodies), -1)
    low, high = np.percentile(np.array(quantities) @ fell, [2.5, 97.5])
    told = " to ".join(f"{end:.0f}" for end in found.interval)
    print(f"pieces that fall, 95 % of {fell.shape[1]} simulations: {low:.0f} to {high:.0f}; "
          f"told by functions: {told}")  # fmt: skip


def print_city() -> None:
    """The time of `shaketable scenario` for 100,000 rows of the hospital's kinds on a map."""
    random = np.random.default_rng(1)
    kinds = pd.read_csv(EXAMPLES / "hospital.csv")[KEPT]
    rows = [kinds.iloc[random.choice(len(kinds), 10, replace=False)] for _ in range(10_000)]
    city = pd.concat(rows, ignore_index=True).assign(quantity=1)
    lon, lat = np.round(random.normal((-70.66, -33.45), 0.08, (10_000, 2)), 4).repeat(10, 0).T
    city = city.assign(building=np.arange(10_000).repeat(10), longitude=lon, latitude=lat)
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "city.csv"
        city.to_csv(table, index=False)
        command = ["shaketable", "scenario", str(table), "--out", f"{folder}/quake", "--shakemap",
                   str(EXAMPLES / "shakemap" / "grid.xml")]  # fmt: skip
        begun = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        print(f"a city of {len(city):,} things: {time.perf_counter() - begun:.0f} s")


if __name__ == "__main__":
    if sys.argv[1:] == ["city"]:
        print_city()
    else:
        main()
        print_alike()
        print_totals()
