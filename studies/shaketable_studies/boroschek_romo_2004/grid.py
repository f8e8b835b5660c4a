"""The bodies of the study.

The paper has 48 symmetric ones, "their center of gravity height varies from 0.25 m to 4.0 m and
widths from 0.08 to 3.5 depending on body height", drawn in four panels by height, and does not list
them. Taken here: heights of 0.25, 1, 2 and 4 m, and for each twelve bases from 0.16 to 0.4375 of
the full height in equal steps: 0.08 m for the smallest, 3.5 m for the largest. Then the same with
the centre of gravity off centre, their inertia unchanged.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from shaketable.body import Body

CG_HEIGHTS = (0.25, 1.0, 2.0, 4.0)  # m
RATIOS = np.linspace(0.16, 0.4375, 12)  # base over full height
ECCENTRICITIES = (0.5, 0.4, 0.3, 0.2)  # ν


def grid() -> pd.DataFrame:
    """One row per body; eccentricity changes slowest, then height, then base."""
    return pd.DataFrame(
        {
            "eccentricity": eccentricity,
            "cg_height_m": height,
            "base_m": 2 * height * ratio,
        }
        for eccentricity in ECCENTRICITIES
        for height in CG_HEIGHTS
        for ratio in RATIOS
    )


def bodies_of(rows: pd.DataFrame) -> list[Body]:
    """The bodies of some rows of the grid."""
    columns = zip(rows["base_m"], rows["cg_height_m"], rows["eccentricity"], strict=True)
    return [
        Body.rectangle(base, 2 * height, eccentricity=eccentricity)
        for base, height, eccentricity in columns
    ]
