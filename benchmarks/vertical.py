"""`python -m benchmarks.vertical FOLDER`: what the vertical component does to falls in space.

The twelve bodies of Boroschek & Iruretagoyena (2006) as boxes on square bases, under recordings of
three components that the user gives: each in four orientations and both polarities, with and
without its vertical, at a friction that keeps everything from sliding and at μ = 0.3. Printed are
falls without and with it, and their ratio with its 95 % interval over the recordings (bootstrap,
2,000 draws of whole recordings).
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.solids import ORIENTATIONS, boxes
from shaketable import General, Motion, simulate_many, suite
from shaketable.simulate import fell

DRAWS, SEED = 2_000, 0
FRICTIONS = (math.inf, 0.3)


def triaxial(components: Sequence[Motion]) -> list[Motion]:
    """Both horizontal components of each recording as one motion, with the vertical of the first.

    Files belong together by their station and event or, where they name none, by their names up to
    the last underscore. Which way the second component counts is not told by every file: it changes
    no share of square boxes in four orientations.
    """
    groups: dict[object, list[Motion]] = {}
    for each in components:
        origin = each.origin
        named = origin is not None and (origin.event or origin.station)
        key = (origin.event, origin.station) if named else each.name.rpartition("_")[0]
        groups.setdefault(key, []).append(each)
    found = []
    for own in groups.values():
        if len(own) == 2 and own[0].vertical is not None and own[0].time_step == own[1].time_step:
            count = min(own[0].horizontal.size, own[1].horizontal.size, own[0].vertical.size)
            first, second, up = (
                each[:count] for each in (own[0].horizontal, own[1].horizontal, own[0].vertical)
            )
            found.append(replace(own[0], horizontal=first, transverse=second, vertical=up))
    return found


def falls(motions: list[Motion], friction: float) -> np.ndarray:
    """How many of the simulations of each recording fall, (recording,)."""
    runs = simulate_many(
        boxes(), motions, orientations=ORIENTATIONS, model=General(static_friction=friction),
        progress=False,
    )  # fmt: skip
    fallen = fell(runs)
    return np.asarray(fallen.sum([each for each in fallen.dims if each != "motion"]).values)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="records of three components each")
    parser.add_argument("--units", help="of files that do not say theirs")
    parser.add_argument("--time-step-s", type=float, help="of files that do not say theirs")
    asked = parser.parse_args()
    motions = triaxial(
        suite(asked.folder, vertical=True, units=asked.units, time_step=asked.time_step_s)
    )
    if len(motions) < 2:
        parser.error(f"{asked.folder}: holds fewer than two recordings of three components")
    flat = [replace(each, vertical=None) for each in motions]
    each = len(boxes()) * len(ORIENTATIONS) * 2
    draws = np.random.default_rng(SEED).integers(len(motions), size=(DRAWS, len(motions)))
    print(
        f"{len(motions)} recordings of {asked.folder}, {each * len(motions):,} simulations each\n"
    )
    print("| friction | falls without | with the vertical | ratio (95 %) |\n|---|---:|---:|---|")
    for friction in FRICTIONS:
        without, with_it = falls(flat, friction), falls(motions, friction)
        ratios = with_it[draws].sum(axis=1) / without[draws].sum(axis=1)
        low, high = np.quantile(ratios, [0.025, 0.975])
        print(f"| {friction:g} | {without.sum()} | {with_it.sum()} | "
              f"{with_it.sum() / without.sum():.2f} ({low:.2f}–{high:.2f}) |")  # fmt: skip


if __name__ == "__main__":
    main()
