"""What friction and losses make of the shares: of floors, of impacts, and of rims as they roll.

One thing at a time is changed of the study's model and bodies. Rims lose by rolling friction, a
moment of so many millimetres times the pressure, by contour friction (Leine 2009), or as they
strike the high points that they stand on.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pandas as pd

from shaketable.models import General
from shaketable.rims import uneven_rims
from shaketable.solid import Solid
from shaketable_studies.shaketable_2026_solids.setting import (
    MODEL,
    SIZES,
    Pairs,
    cylinder,
    square,
)
from shaketable_studies.shaketable_2026_solids.shares import (
    ORIENTATIONS,
    PLANAR,
    SCALES,
    SOLID,
    FallsByCase,
    fallen,
    of_circles,
    of_planes,
    ratio_rows,
)

#: Two of the orientations: enough, where only what changes is asked.
TURNS = ORIENTATIONS[::2]
DRAWS = 2  # of a rim's high points, for each size
MM = 1e-3  # m
COMPARED = (("square", PLANAR[0]), ("square", PLANAR[1]), ("round", "square"))


class Change(NamedTuple):
    """What is changed, for some rows of the table.

    Attributes:
        name: what to call it.
        model: the contact model.
        of_corners: rolling friction of boxes [mm].
        of_rims: rolling friction of cylinders [mm].
        contour: contour friction of cylinders [mm].
        rise: of the high points of their rims [mm], least and largest; none at 0.
    """

    name: str
    model: General = MODEL
    of_corners: float = 0.0
    of_rims: float = 0.0
    contour: float = 0.0
    rise: tuple[float, float] = (0.0, 0.0)


CHANGES = (
    Change("friction 0.3", replace(MODEL, static_friction=0.3)),
    Change("friction 0.5 (as elsewhere)"),
    Change("friction 0.7", replace(MODEL, static_friction=0.7)),
    Change("normal restitution 0.1", replace(MODEL, normal_restitution=0.1)),
    # ElGawady, Ma, Butterworth and Ingham (2011): on concrete, and on rubber
    Change("impacts leave 0.95", replace(MODEL, restitution_factor=0.95)),
    Change("impacts leave 0.67", replace(MODEL, restitution_factor=0.67)),
    Change("rims roll with 3 mm", of_rims=3.0),
    Change("rims roll with 10 mm", of_rims=10.0),
    Change("rims and corners roll with 3 mm", of_corners=3.0, of_rims=3.0),
    Change("contour friction 0.1 mm", contour=0.1),
    Change("contour friction 1 mm", contour=1.0),
    Change("rims on high points of 0.01 mm", rise=(0.01, 0.01)),
    Change("rims on high points of 0.1 to 1 mm", rise=(0.1, 1.0)),
    Change("rims on such points, rolling with 3 mm", of_rims=3.0, rise=(0.1, 1.0)),
)


def simulations(pairs: int) -> int:
    """How many simulations `losses` runs."""
    each = len(SIZES) * pairs * len(SCALES)
    models = len({change.model for change in CHANGES})
    boxes = len({(change.model, change.of_corners) for change in CHANGES})
    rims = sum(DRAWS if change.rise[1] else 1 for change in CHANGES)
    return int(each * (2 * 2 * models + 2 * TURNS.size * boxes + rims))


def losses(pairs: Pairs, done: Callable[[int], None]) -> pd.DataFrame:
    """Ratios of the shares that overturn, for each change and scale, with intervals."""
    rows = []
    planes: dict[General, list[FallsByCase]] = {}
    boxes: dict[tuple[General, float], FallsByCase] = {}
    for change in CHANGES:
        model, key = change.model, (change.model, change.of_corners)
        if model not in planes:
            planes[model] = list(of_planes(pairs, done, model))
        if key not in boxes:
            solids = [replace(square(size), rolling_friction=MM * key[1]) for size in SIZES]
            found = fallen(solids, pairs.motions, pairs, done, model, TURNS)
            boxes[key] = FallsByCase.of(SOLID[0], found)
        drums = [
            replace(
                cylinder(size),
                rolling_friction=MM * change.of_rims,
                contour_friction=MM * change.contour,
            )
            for size in SIZES
        ]
        round_ones = (
            of_uneven(drums, change.rise, pairs, done, model)
            if change.rise[1]
            else of_circles(drums, pairs, done, model)
        )
        for row in ratio_rows([*planes[model], boxes[key], round_ones], pairs.weights, COMPARED):
            rows.append({"changed": change.name, **row})
    return pd.DataFrame(rows)


def of_uneven(
    drums: Sequence[Solid],
    rise: tuple[float, float],
    pairs: Pairs,
    done: Callable[[int], None],
    model: General,
) -> FallsByCase:
    """Cylinders of which each stands on DRAWS sets of high points [mm], turned at random."""
    least, most = MM * rise[0], MM * rise[1]
    drawn = [
        drum
        for seed, round_one in enumerate(drums)
        for drum in uneven_rims(round_one, DRAWS, seed=seed, rise=(least, most))
    ]
    found = fallen(drawn, pairs.motions, pairs, done, model, polarities=(1,))
    by_size = found[..., 0].reshape(len(drums), DRAWS, *found.shape[1:3])
    return FallsByCase.of(SOLID[1], np.moveaxis(by_size, 1, -1))
