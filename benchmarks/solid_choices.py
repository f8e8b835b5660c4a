"""`python -m benchmarks.solid_choices`: what the engine's choices do to shares over ensembles.

Every choice of the engine for solids is changed by itself, each of its thresholds to a tenth and to
ten times, and W3 run again under some of its pairs: which outcomes change, and how the share that
overturns does. A change that makes as many fall as it makes stand is chance: single runs are
chaotic. Printed is the difference of the shares in standard deviations of that chance. Beside W3's
boxes and cylinders stand prisms on regular polygons around the same circles, which roll from corner
to corner, the cylinders on high points of their rims, and the boxes on four feet, two of which are
castors.
"""

from __future__ import annotations

import argparse
import importlib
import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from benchmarks.solids import TABLE_1, boxes, cylinders, pairs, shaken
from shaketable import Motion, Outcome, Solid, uneven_rims

CHOICES = importlib.import_module("shaketable.models.solid_input")
#: Those that are changed to a tenth and to ten times.
THRESHOLDS = (
    "BOUNCE", "SETTLE", "LEAVING", "TURNING", "SLOW", "SLIPPING", "LANDING", "HOVERING", "STARTING",
)  # fmt: skip
CHANGES = (
    ("TOLERANCE", 1e-7), ("TOLERANCE", 1e-11),
    *((name, factor * getattr(CHOICES, name)) for name in THRESHOLDS for factor in (0.1, 10.0)),
    ("RING", 8), ("RING", 32), ("RING", 64),
)  # fmt: skip
SIDES = (12, 24)


def polygons() -> list[Solid]:
    """Prisms whose corners lie on the circles of W3's cylinders."""
    found = []
    for k, (width, height) in enumerate(TABLE_1):
        angles = 2 * math.pi * np.arange(SIDES[k % 2]) / SIDES[k % 2]
        corners = width / 2 * np.column_stack([np.cos(angles), np.sin(angles)])
        found.append(Solid.polygon(corners, height))
    return found


def carts() -> list[Solid]:
    """W3's boxes on feet in their corners: castors in front, locked ones behind."""
    castors = (True, False, False, True)
    return [Solid.on_feet(box.corners, 2 * box.cg_height, castors=castors) for box in boxes()]


def rims() -> list[Solid]:
    """W3's cylinders on 3 to 5 high points of 0.1 to 1 mm."""
    return [
        drum for seed, each in enumerate(cylinders()) for drum in uneven_rims(each, 1, seed=seed)
    ]


ENSEMBLES = {
    "square": boxes, "circle": cylinders, "polygon": polygons, "rim": rims, "feet": carts,
}  # fmt: skip


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


@contextmanager
def changed(name: str, value: float) -> Iterator[None]:
    """The engine with another choice."""
    kept = getattr(CHOICES, name)
    setattr(CHOICES, name, value)
    try:
        yield
    finally:
        setattr(CHOICES, name, kept)


def compared(
    solids: Sequence[Solid], motions: Sequence[Motion], changes: Sequence[tuple[str, float]]
) -> Iterator[tuple[str, float, Compared]]:
    """Each change and what it does."""
    before = (shaken(solids, motions).outcome != Outcome.STANDING).values
    for name, value in changes:
        with changed(name, value):
            after = (shaken(solids, motions).outcome != Outcome.STANDING).values
        counts = (before, before & ~after, ~before & after)
        yield name, value, Compared(before.size, *(int(np.sum(each)) for each in counts))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=2, help="every so many of the pairs alone")
    parser.add_argument("--bases", nargs="+", choices=ENSEMBLES, default=list(ENSEMBLES),
                        help="feet take twenty minutes a change")  # fmt: skip
    given = parser.parse_args()
    motions = pairs()[:: given.every]
    print("| base | choice | instead | overturn | now stand | now fall | deviations |")
    print("|---|---|---:|---:|---:|---:|---:|")
    for word in given.bases:
        solids = ENSEMBLES[word]
        changes = [change for change in CHANGES if word == "circle" or change[0] != "RING"]
        for name, value, found in compared(solids(), motions, changes):
            share = 100 * found.fell / found.runs
            print(
                f"| {word} | {name} {getattr(CHOICES, name):g} | {value:g} | {share:.1f} % | "
                f"{found.now_stand} | {found.now_fall} | {found.deviations:+.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
