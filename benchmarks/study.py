"""How long the studies take on the 100 motions of FEMA P-695.

Everything but the figures: simulations of both models, bootstrap, fits, tables. The first run also
loads the compiled kernels and SciPy.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from benchmarks.cases import motions
from shaketable.engine.pool import available_cores
from shaketable.study import Study, StudyInput, installed_studies
from shaketable.tilting import design_tilt
from shaketable_studies.boroschek_iruretagoyena_2006.printed import TABLE_1


def main() -> None:
    shaking = motions()
    studies = {
        "Boroschek & Iruretagoyena 2006, rocking model": ("boroschek-iruretagoyena-2006", {}),
        "the same, both models": ("boroschek-iruretagoyena-2006", {"model": "both"}),
        "Boroschek & Romo 2004": ("boroschek-romo-2004", {}),
    }
    print(f"{available_cores()} cores\n\n| study | first [s] | again [s] |\n|---|---:|---:|")
    for name, (study, options) in studies.items():
        given = StudyInput(motions=shaking, progress=False, options=options)
        times = " | ".join(f"{timed(installed_studies()[study].do, given):.1f}" for _ in range(2))
        print(f"| {name} | {times} |")
    start = time.perf_counter()
    for size in TABLE_1:
        design_tilt(size.body, shaking[:44], progress=False)
    each = (time.perf_counter() - start) / len(TABLE_1)
    print(f"\na designed tilt, 44 motions, 41 tilts, 500 draws: {each:.2f} s in the mean of 12")


def timed(run: Callable[[StudyInput], Study], given: StudyInput) -> float:
    start = time.perf_counter()
    run(given)
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
