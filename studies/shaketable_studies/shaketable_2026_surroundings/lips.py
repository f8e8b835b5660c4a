"""Things at the edge of a shelf: what a lip keeps on it, and what it trips."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pandas as pd

from shaketable.body import Body
from shaketable.models import General
from shaketable.simulate import simulate_many
from shaketable.surroundings import Edge, Surroundings
from shaketable_studies.shaketable_2026_solids.setting import Pairs
from shaketable_studies.shaketable_2026_surroundings.setting import SCALES, share_of

THINGS = {
    "squat": Body.rectangle(0.25, 0.30, name="squat"),
    "slender": Body.rectangle(0.12, 0.30, name="slender"),
}
FRICTIONS = (0.2, 0.4)
LIPS = (0.0, 0.002, 0.005, 0.01, 0.02, 0.05)  # m
TO_THE_EDGE, DROP = 0.05, 0.75  # m: from the side of a thing to the edge, and down to the floor


def lips(pairs: Pairs, done: Callable[[int], None]) -> pd.DataFrame:
    """How many fall off a shelf and how many on it, by the lip, in the plane of its depth."""
    rows = []
    motions = [motion.components()[0] for motion in pairs.motions]
    first = np.unique(pairs.recording, return_index=True)[1]
    bodies = [body for body in THINGS.values() for _ in LIPS]
    around = [
        Surroundings(edge=Edge(at=body.left + TO_THE_EDGE, azimuth=math.pi, lip=lip, drop=DROP))
        for body in THINGS.values()
        for lip in LIPS
    ]
    for friction in FRICTIONS:
        found = simulate_many(
            bodies, motions, model=General(static_friction=friction), scales=SCALES,
            surroundings=around, progress=done,
        ).isel(tilt=0).transpose("body", "motion", "scale", "polarity", ...)  # fmt: skip
        fell, off = found.outcome.values[:, first] != 0, found.off_edge.values[:, first]
        for k, body in enumerate(bodies):
            for n, scale in enumerate(SCALES):
                share, low, high = share_of(fell[k, :, n], pairs)
                gone, gone_low, gone_high = share_of(off[k, :, n], pairs)
                rows.append(
                    {
                        "thing": body.name,
                        "friction": friction,
                        "lip_mm": 1e3 * LIPS[k % len(LIPS)],
                        "scale": scale,
                        "runs": fell[k, :, n].size,
                        "falls": int(fell[k, :, n].sum()),
                        "off_edge": int(off[k, :, n].sum()),
                        "fall_share": share,
                        "low": low,
                        "high": high,
                        "off_share": gone,
                        "off_low": gone_low,
                        "off_high": gone_high,
                    }
                )
    return pd.DataFrame(rows)


def count_lips(pairs: int) -> int:
    """How many simulations that takes."""
    return 2 * pairs * len(SCALES) * len(THINGS) * len(LIPS) * len(FRICTIONS)
