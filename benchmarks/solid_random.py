"""`python -m benchmarks.solid_random`: random solids under random pulses; what hangs or is lost.

Boxes, cylinders, half of them on high points of their rims, prisms and bodies on feet, stocky to
needle-like, with frictions from none to infinite and restitutions up to 0.9, under pulses of up to
3 g of half a second to six seconds. It prints how long runs took, and the numbers of those that
took more than a second.
"""

from __future__ import annotations

import argparse
import itertools
import time

import numpy as np
from tests.support.random_solids import case, is_lost, run

SLOW = 1.0  # s


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=2.0)
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--castors", action="store_true", help="some feet are castors")
    parser.add_argument("--straps", action="store_true", help="each has one to four straps")
    parser.add_argument("--walls", action="store_true", help="each stands at one to three walls")
    given = parser.parse_args()
    until = time.monotonic() + 60.0 * given.minutes
    took, lost = [], 0
    for seed in itertools.count(given.first):
        if time.monotonic() > until:
            break
        shaken = case(seed, given.castors, given.straps, given.walls)
        if shaken is None:
            continue
        found, seconds = run(shaken)
        if not took:
            found, seconds = run(shaken)  # the first one compiled
        took.append(seconds)
        if is_lost(found):
            lost += 1
            print(f"case {seed} is lost: {found}", flush=True)
        if seconds > SLOW:
            work = f"{found.events:.0f} events, {found.steps:.0f} steps"
            print(f"case {seed}: {seconds:.1f} s, {work}, {shaken.solid!r}", flush=True)
    times = np.array(took)
    print(
        f"{times.size:,} runs, {lost} lost; median {1e3 * np.median(times):.2f} ms, 99.9 % within "
        f"{np.quantile(times, 0.999):.2f} s, longest {times.max():.1f} s, "
        f"{np.sum(times > 5.0)} of them above 5 s"
    )


if __name__ == "__main__":
    main()
