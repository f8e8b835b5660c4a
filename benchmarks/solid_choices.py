"""`python -m benchmarks.solid_choices`: what the engine's choices do to shares over ensembles.

Every choice of the engine for solids is changed by itself, and W3 run again under some of its
pairs: which outcomes change, and how the share that overturns does. A change that makes as many
fall as it makes stand is chance: single runs are chaotic. Printed is the difference of the shares
in standard deviations of that chance.
"""

from __future__ import annotations

import argparse
import importlib
import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from benchmarks.solids import boxes, cylinders, pairs, shaken
from shaketable import Motion, Outcome, Solid

CHOICES = importlib.import_module("shaketable.simulate.solid_input")
CHANGES = (
    ("TOLERANCE", 1e-7), ("TOLERANCE", 1e-11),
    ("BOUNCE_SPEED", 1e-5), ("BOUNCE_SPEED", 1e-3),
    ("SETTLE_SPEED", 1e-5), ("SETTLE_SPEED", 1e-3),
    ("LEAVING_SPEED", 1e-5), ("LEAVING_SPEED", 1e-3),
    ("RING", 8), ("RING", 32), ("RING", 64),
)  # fmt: skip


class Compared(NamedTuple):
    """Runs before and after a change."""

    runs: int
    fell: int  # before
    now_stand: int
    now_fall: int

    @property
    def deviations(self) -> float:
        """The difference of the shares in standard deviations, if it were chance."""
        changed = self.now_fall + self.now_stand
        return (self.now_fall - self.now_stand) / math.sqrt(changed) if changed else 0.0


def compared(
    solids: Sequence[Solid], motions: Sequence[Motion], changes: Sequence[tuple[str, float]]
) -> Iterator[tuple[str, float, Compared]]:
    """Each change and what it does."""
    before = (shaken(solids, motions).outcome != Outcome.STANDING).values
    for name, value in changes:
        kept = getattr(CHOICES, name)
        setattr(CHOICES, name, value)
        try:
            after = (shaken(solids, motions).outcome != Outcome.STANDING).values
        finally:
            setattr(CHOICES, name, kept)
        counts = (before, before & ~after, ~before & after)
        yield name, value, Compared(before.size, *(int(np.sum(each)) for each in counts))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=2, help="every so many of the pairs alone")
    motions = pairs()[:: parser.parse_args().every]
    print("| base | choice | instead | overturn | now stand | now fall | deviations |")
    print("|---|---|---:|---:|---:|---:|---:|")
    for word, solids in (("square", boxes()), ("circle", cylinders())):
        for name, value, found in compared(solids, motions, CHANGES):
            if name == "RING" and word == "square":
                continue
            share = 100 * found.fell / found.runs
            print(
                f"| {word} | {name} {getattr(CHOICES, name):g} | {value:g} | {share:.1f} % | "
                f"{found.now_stand} | {found.now_fall} | {found.deviations:+.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
