"""The controlled rate against the direction of the tilt, seen from the body.

Boroschek & Iruretagoyena (2006) tilt a support in the plane in which the body rocks. Here a body
on a square, an oblong or a round base is tilted toward some direction of its base and shaken by
both components. A fall is downhill within 90° of the tilt's direction, and straight within 45°.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.outcome import Outcome
from shaketable.resampling import interval
from shaketable.simulate import count_by_recording, simulate_many
from shaketable.tilting import TiltCounts, control_tilt, downhill_share
from shaketable_studies.boroschek_iruretagoyena_2006.fits import body_mean
from shaketable_studies.shaketable_2026_solids.setting import (
    MODEL,
    SIZES,
    Pairs,
    components,
    cylinder,
    oblong,
    square,
)

TILTS = np.radians(np.arange(0.0, 7.01, 1.0))
CHOSEN = (1, 4, 8, 11)  # of the sizes: base over height 0.25, 0.2 to 1.5 m
PLANE, FACE = "plane", 0.0
#: Directions of the tilt from the body's x, over its short side [degrees], by base.
DIRECTIONS = {
    "square": (0.0, 22.5, 45.0),
    "oblong": (0.0, 22.5, 45.0, 67.5, 90.0),
    "round": (0.0,),
}
MAKERS = {"square": square, "oblong": oblong, "round": cylinder}
CONTROL = 0.95
STRAIGHT = math.radians(45.0)


def simulations(pairs: int) -> int:
    """How many simulations `by_direction` runs."""
    ways = 2 + sum(map(len, DIRECTIONS.values()))  # the plane has two components
    return int(ways * len(CHOSEN) * TILTS.size * 2 * pairs)


def by_direction(pairs: Pairs, done: Callable[[int], None]) -> pd.DataFrame:
    """The mean share of falls downhill by base, direction of the tilt and tilt."""
    sizes = [SIZES[k] for k in CHOSEN]
    parts = [_planar(pairs, done)]
    for base, directions in DIRECTIONS.items():
        solids = [MAKERS[base](size) for size in sizes]
        for direction in directions:
            turned = math.pi - math.radians(direction)  # downhill is toward -x
            runs = simulate_many(
                solids, pairs.motions, tilts=TILTS, orientations=turned, model=MODEL, progress=done
            ).isel(orientation=0)
            counts = TiltCounts.of(TILTS, count_by_recording(runs, pairs.recording))
            fell = runs["outcome"] != int(Outcome.STANDING)
            along = np.cos(runs["fall_azimuth"] - math.pi) >= math.cos(STRAIGHT)
            straight = (fell & along).sum(["body", "motion", "polarity", "scale"]).values
            parts.append(_rows(base, direction, counts, pairs.weights, straight))
    return pd.concat(parts, ignore_index=True)


def _planar(pairs: Pairs, done: Callable[[int], None]) -> pd.DataFrame:
    """The same in a plane, under each component by itself."""
    bodies = [SIZES[k].body for k in CHOSEN]
    motions = [motion for each in components(pairs) for motion in each]
    runs = simulate_many(bodies, motions, tilts=TILTS, model=MODEL, progress=done)
    counts = TiltCounts.of(TILTS, count_by_recording(runs, np.tile(pairs.recording, 2)))
    # in a plane a fall downhill is straight
    return _rows(PLANE, FACE, counts, pairs.weights, counts.downhill.sum(axis=(0, 2)))


def _rows(
    base: str,
    direction: float,
    counts: TiltCounts,
    weights: NDArray[np.float64],
    straight: NDArray[np.int64],
) -> pd.DataFrame:
    mean = body_mean(downhill_share(counts, weights))
    low, high = interval(mean[1:])
    falls = counts.falls.sum(axis=(0, 2))
    return pd.DataFrame(
        {
            "base": base,
            "direction_deg": direction,
            "tilt_deg": np.degrees(counts.tilts),
            "simulations": counts.simulations.sum(),
            "falls": falls,
            "downhill": mean[0],
            "low": low,
            "high": high,
            "straight": straight / np.maximum(falls, 1),
        }
    )


def tilts_for_control(table: pd.DataFrame) -> pd.DataFrame:
    """For every base and direction the tilt from which on CONTROL of the falls go downhill."""
    rows = []
    for (base, direction), here in table.groupby(["base", "direction_deg"], sort=False):
        tilts = here["tilt_deg"].to_numpy()
        # the interval's ends, read the other way round
        found = {
            name: float(control_tilt(tilts, here[end].to_numpy(), CONTROL))
            for name, end in (
                ("tilt_deg", "downhill"), ("tilt_low_deg", "high"), ("tilt_high_deg", "low"),
            )
        }  # fmt: skip
        level = here.iloc[0]
        rows.append(
            {
                "base": base,
                "direction_deg": direction,
                **found,
                "fall_share_when_level": level["falls"] / level["simulations"],
                "straight_at_5_deg": float(np.interp(5.0, tilts, here["straight"])),
            }
        )
    return pd.DataFrame(rows)
