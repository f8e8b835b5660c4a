"""Whether two versions decide alike, over some 37,000 runs in space, and how long each takes.

python -m benchmarks.outcomes before.npz                       in the one checkout
python -m benchmarks.outcomes after.npz --against before.npz   in the other

Single runs are chaotic, so that some end otherwise whenever a last digit changes: as many have to
fall now that stood as stand now that fell. What is compared is the same in both: W3, what cannot
slide, and what stands beside a wall, in a corner, in a strap, and in a strap at a wall.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import xarray as xr
from tests.support.builders import TABLE_1

from benchmarks.solids import ORIENTATIONS, boxes, cylinders, pairs, shaken
from shaketable import General, Solid, simulate_many
from shaketable.outcome import Outcome
from shaketable.surroundings import Strap, Surroundings, Wall

NO_SLIP, SLIPS = General(static_friction=math.inf), General(static_friction=0.5)
HEIGHTS = (0.74, 1.04, 1.42, 1.8, 2.06)  # m, of bookcases


def cannot_slide() -> xr.Dataset:
    """Oblong boxes, bookcases and cylinders, level and tilted, with friction without limit."""
    solids = [Solid.box(0.6 * width, width, height) for width, height in TABLE_1]
    solids += [Solid.box(0.32, 0.9, height) for height in HEIGHTS]
    solids += cylinders()[:4]
    return simulate_many(
        solids, pairs(), tilts=(0.0, math.radians(2.0)), orientations=ORIENTATIONS,
        polarities=(1, -1), model=NO_SLIP, progress=False,
    )  # fmt: skip


def furniture(model: General, around: Surroundings) -> xr.Dataset:
    """Bookcases and a filing cabinet among surroundings, under half of the pairs."""
    solids = [Solid.box(0.32, 0.9, height, mass=60.0 * height) for height in HEIGHTS[1:]]
    solids.append(Solid.box(0.46, 0.62, 1.32, mass=110.0))
    return simulate_many(
        solids, pairs()[::2], scales=(1.0, 1.5), orientations=(0.0, 0.7), polarities=(1, -1),
        model=model, surroundings=around, progress=False,
    )  # fmt: skip


def surroundings() -> dict[str, Surroundings]:
    """What furniture stands among."""
    back = Wall(azimuth=0.0, gap=0.02)
    strap = Strap(
        point=(0.16, 0.0, 0.9), anchor=(0.21, 0.0, 0.9), stiffness=2e5, slack=0.02, strength=2000.0
    )
    corner = (Wall(azimuth=0.0, gap=0.52), Wall(azimuth=math.pi / 2, gap=0.05))
    return {
        "at a wall": Surroundings(walls=(back,)),
        "in a corner": Surroundings(walls=corner),
        "in a strap": Surroundings(straps=(strap,)),
        "in a strap at a wall": Surroundings(walls=(back,), straps=(strap,)),
    }


def cases() -> Iterator[tuple[str, xr.Dataset]]:
    yield "W3's boxes", shaken(boxes(), pairs())
    yield "W3's cylinders", shaken(cylinders(), pairs())
    yield "cannot slide", cannot_slide()
    for name, around in surroundings().items():
        yield f"cannot slide, {name}", furniture(NO_SLIP, around)
        yield f"μ = 0.5, {name}", furniture(SLIPS, around)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path, help="where its outcomes are kept, .npz")
    parser.add_argument("--against", type=Path, help="outcomes of another version")
    given = parser.parse_args()
    before = dict(np.load(given.against)) if given.against else {}
    furniture(NO_SLIP, Surroundings())  # compiled, or read from the cache
    kept: dict[str, np.ndarray] = {}
    head = "| runs of | number | CPU s | fall |"
    print(f"{head} CPU s before | now fall | now stand | deviations |" if before else head)
    print("|---|" + "---:|" * (7 if before else 3))
    begin = time.process_time()
    for name, runs in cases():
        seconds, fell = time.process_time() - begin, runs.outcome.values != Outcome.STANDING
        kept[name], kept[f"{name}, s"] = fell, np.array(seconds)
        line = f"| {name} | {fell.size:,} | {seconds:.1f} | {100 * fell.mean():.1f} % |"
        if before:
            was = before[name]
            more, fewer = int((fell & ~was).sum()), int((was & ~fell).sum())
            apart = (more - fewer) / math.sqrt(max(more + fewer, 1))
            line += f" {float(before[f'{name}, s']):.1f} | {more} | {fewer} | {apart:+.1f} |"
        print(line, flush=True)
        begin = time.process_time()
    np.savez_compressed(given.out, **kept)  # type: ignore[arg-type]


if __name__ == "__main__":
    main()
