"""What ensembles of artificial motions have, beside the models that they are made from.

    python -m benchmarks.scenario

For each of several earthquakes: the ratio of medians and the difference of standard deviations of
ln between motions and models, of spectral ordinates, PGA, PGV and the duration; and the time taken.
Then how alike what different kinds of objects withstand is from motion to motion.
"""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

from shaketable import ida, read_inventory, suite
from shaketable.hazard import artificial_motions, scenario
from shaketable.signal import measure_named
from shaketable.signal.intensity import Record

EARTHQUAKES = ((5.0, 10.0, 300.0), (6.0, 20.0, 400.0), (7.0, 20.0, 400.0), (7.8, 40.0, 250.0))
NAMES = ("SA(0.1)", "SA(0.3)", "SA(1.0)", "SA(3.0)", "SA(5.0)", "PGA", "PGV", "D5-95")
NUMBER = 128


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
    items = read_inventory(Path(__file__).parents[1] / "examples" / "hospital.csv")
    found = ida([item.body for item in items], suite("fema-p695-far-field"))
    lowest = np.log(found["capacity"].transpose("body", ...).values.reshape(len(items), -1))
    known = np.isfinite(lowest).mean(axis=1) > 0.8
    table = np.ma.corrcoef(np.ma.masked_invalid(lowest[known]))
    pairs = table[np.triu_indices(int(known.sum()), 1)]
    print(
        f"correlation of what {known.sum()} kinds withstand: median {np.ma.median(pairs):.2f}, "
        f"from {pairs.min():.2f} to {pairs.max():.2f}"
    )


if __name__ == "__main__":
    main()
    print_alike()
