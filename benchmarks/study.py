"""How long the study of Boroschek and Iruretagoyena (2006) takes on W1.

Everything but the figures: simulations of both models, bootstrap, fits, tables. The first run also
loads the compiled kernels and SciPy.
"""

from __future__ import annotations

import time

from benchmarks.cases import motions
from shaketable import Motion
from shaketable.engine.pool import available_cores
from shaketable.studies.boroschek_iruretagoyena_2006 import run
from shaketable.studies.boroschek_iruretagoyena_2006.printed import TABLE_1
from shaketable.tilting import design_tilt


def main() -> None:
    shaking = motions()
    print(f"{available_cores()} cores\n\n| work | first [s] | again [s] |\n|---|---:|---:|")
    for name, models in {
        "the study, rocking model": ("rocking",),
        "the study, both models": ("rocking", "general"),
    }.items():
        print(f"| {name} | {' | '.join(f'{timed(shaking, models):.1f}' for _ in range(2))} |")
    start = time.perf_counter()
    for size in TABLE_1:
        design_tilt(size.body, shaking[:44], progress=False)
    each = (time.perf_counter() - start) / len(TABLE_1)
    print(f"\na designed tilt, 44 motions, 41 tilts, 500 draws: {each:.2f} s in the mean of 12")


def timed(shaking: list[Motion], models: tuple[str, ...]) -> float:
    start = time.perf_counter()
    run(shaking, models=models, progress=False)
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
