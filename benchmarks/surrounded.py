"""Bodies among surroundings: what a run takes, and whether any of many random planar ones is lost.

python -m benchmarks.surrounded                       milliseconds of one core a planar run
python -m benchmarks.surrounded --solids              of a solid, and its ratio to that alone
python -m benchmarks.surrounded --stepped             solids that need time steps, doubled motions
python -m benchmarks.surrounded --random 100000       random bodies, walls, straps and edges
"""

from __future__ import annotations

import argparse
import logging
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from tests.models.surrounded.test_random import STEP, deepest, random_case, wave_of
from tests.support.surrounded import move

from shaketable import (
    Body,
    Edge,
    General,
    Motion,
    Solid,
    Strap,
    Surroundings,
    Wall,
    simulate,
    simulate_many,
    suite,
)

SOLID = Solid.box(0.32, 0.90, 1.80, mass=100.0)
BOOKCASE = Body.rectangle(0.32, 1.80, mass=100.0)
MODEL = General(static_friction=0.5)
WALL = Wall(gap=0.01, restitution=0.3)
STRAP = Strap(point=(0.16, 1.8), anchor=(0.21, 1.8), stiffness=5e4, damping=100.0, slack=0.005)
CASES: dict[str, Surroundings | None] = {
    "alone": None,
    "wall at 10 mm": Surroundings(walls=(WALL,)),
    "strap": Surroundings(straps=(STRAP,)),
    "both": Surroundings(walls=(WALL,), straps=(STRAP,)),
    "edge with a lip": Surroundings(edge=Edge(at=0.21, lip=0.005)),
}


def speed() -> None:
    """The bookcase under the far-field motions, as recorded and doubled, both polarities."""
    motions = suite("far-field")
    for name, around in CASES.items():
        simulate_many([BOOKCASE], motions[:1], model=MODEL, surroundings=around, progress=False)
        begun = time.process_time()
        found = simulate_many(
            [BOOKCASE], motions, model=MODEL, surroundings=around, scales=(1.0, 2.0),
            progress=False, threads=1,
        )  # fmt: skip
        each = 1e3 * (time.process_time() - begun) / found.outcome.size
        print(f"{name:16} {each:6.2f} ms/run, {int((found.outcome != 0).sum())} of "
              f"{found.outcome.size} fall")  # fmt: skip


def solids() -> None:
    """The bookcase as a solid, both components as recorded; what falls ends early.

    It slides, or with the usual model's friction it does not.
    """
    pairs = [motion for motion in suite("far-field", pairs=True) if motion.transverse is not None]
    wall, strap = (WALL,), (replace(STRAP, point=(0.16, 0, 1.8), anchor=(0.17, 0, 1.8)),)
    cases = {
        "alone": None,
        "wall at 10 mm": Surroundings(walls=wall),
        "strap": Surroundings(straps=strap),
        "both": Surroundings(walls=wall, straps=strap),
    }
    for model in (General(), MODEL):
        alone = 0.0
        for name, around in cases.items():
            each = seconds_of_solids(pairs[:1], model, around)  # compiles
            each = seconds_of_solids(pairs, model, around)
            alone = alone or each
            print(f"friction {model.static_friction:g}, {name:13} {1e3 * each:6.2f} ms/run, "
                  f"{each / alone:.1f} times alone")  # fmt: skip


def seconds_of_solids(
    pairs: Sequence[Motion], model: General, around: Surroundings | None
) -> float:
    """Seconds of a processor for a run of the bookcase."""
    begun = time.process_time()
    found = simulate_many(
        [SOLID], pairs, model=model, surroundings=around, progress=False, threads=1
    )
    return (time.process_time() - begun) / found.outcome.size


def stepped() -> None:
    """The bookcase as a solid, both components doubled: how often a run needs time steps."""
    pairs = [motion for motion in suite("far-field", pairs=True) if motion.transverse is not None]
    strap = replace(STRAP, point=(0.16, 0, 1.8), anchor=(0.21, 0, 1.8))
    cases = {
        "wall at 10 mm": Surroundings(walls=(WALL,)),
        "strap": Surroundings(straps=(strap,)),
        "both": Surroundings(walls=(WALL,), straps=(strap,)),
    }
    for name, around in cases.items():
        runs = [
            simulate(SOLID, pair.scaled(2.0), model=MODEL, surroundings=around) for pair in pairs
        ]
        times = [run.fallbacks for run in runs]
        print(f"{name:13} {sum(time > 0 for time in times)} of {len(times)} runs, "
              f"{sum(times)} times, {sum(run.outcome != 0 for run in runs)} fall")  # fmt: skip


def random(count: int, first: int) -> None:
    """Random bodies: how many are lost or enter something, and the longest run.

    By 2e-9 m; by 1 mm where events were stepped over in steps of 0.1 ms.
    """
    lost, longest, endings = [], 0.0, dict.fromkeys(range(5), 0)
    for seed in range(first, first + count):
        rng = np.random.default_rng(seed)
        body, model, around, tilt = random_case(rng)
        wave = wave_of(rng, 500)
        begun = time.perf_counter()
        found = move(body, wave, STEP, model, around, tilt=tilt, samples=2000)
        if seed > first:  # the first one compiles
            longest = max(longest, time.perf_counter() - begun)
        shown = found._replace(state=found.state[:2000])
        endings[int(found.end.ending)] += 1
        fine = np.isfinite(shown.state).all() and found.end.ending < 4
        most = 1e-3 if found.end.fallbacks else 2e-9
        if not fine or deepest(body, around, tilt, shown) > most:
            lost.append(seed)
    print(f"{count} runs, lost {len(lost)} {lost[:10]}, the longest {longest:.2f} s")
    print(f"stood, fell, still rocked, still slid, not resolved: {list(endings.values())}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--random", type=int, default=0, help="how many random bodies")
    parser.add_argument("--first", type=int, default=100_000, help="seed of the first")
    parser.add_argument("--solids", action="store_true", help="solids in place of planar bodies")
    parser.add_argument("--stepped", action="store_true", help="how many need time steps")
    given = parser.parse_args()
    logging.disable(logging.WARNING)
    if given.random:
        random(given.random, given.first)
    elif given.stepped:
        stepped()
    elif given.solids:
        solids()
    else:
        speed()


if __name__ == "__main__":
    main()
