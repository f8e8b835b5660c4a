"""The slide coefficient of Kaneko and Hayashi's eq. 5, from the general model.

The coefficient is the share of the falls of a body that cannot slide that is left where it can. The
paper says that it is a function of B/H and the friction, and does not print it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd

from shaketable.body import Body
from shaketable.models import General, Model
from shaketable.motion import Motion
from shaketable.simulate import fell, simulate_many

RATIOS = (0.15, 0.2, 0.3, 0.4)  # B/H
MARGINS = (0.7, 0.9, 0.95, 1.0, 1.05, 1.1, 1.25, 1.5, 2.0, 3.0)  # friction over B/H
HEIGHTS = (1.0, 1.8)  # m
SCALES = (1.0, 1.5)
EVERY = 4  # of the motions


def simulations(motions: int) -> int:
    """How many simulations `slide_coefficients` runs."""
    some = len(range(0, motions, EVERY))
    return (1 + len(MARGINS)) * len(RATIOS) * len(HEIGHTS) * len(SCALES) * 2 * some


def slide_coefficients(motions: Sequence[Motion], done: Callable[[int], None]) -> pd.DataFrame:
    """Falls with every friction, and without sliding, for every B/H; both heights together."""
    some = motions[::EVERY]

    def falls(ratio: float, model: Model) -> int:
        bodies = [Body.rectangle(height * ratio, height) for height in HEIGHTS]
        runs = simulate_many(bodies, some, scales=SCALES, model=model, progress=done)
        return int(fell(runs).sum())

    rows = []
    for ratio in RATIOS:
        without = falls(ratio, General())
        for margin in MARGINS:
            slides = falls(ratio, General(static_friction=margin * ratio))
            rows.append(
                {
                    "b_over_h": ratio,
                    "friction": margin * ratio,
                    "friction_over_b_over_h": margin,
                    "falls": slides,
                    "falls_without_sliding": without,
                    "coefficient": slides / without if without else math.nan,
                }
            )
    return pd.DataFrame(rows)


def step(table: pd.DataFrame) -> tuple[float, float]:
    """The friction over B/H up to which nothing falls, and from which on nearly all fall.

    Nearly all: 95 % of what falls without sliding, for every B/H.
    """
    known = table[table["falls_without_sliding"] > 0]
    least = known.groupby("friction_over_b_over_h")["coefficient"].min()
    most = known.groupby("friction_over_b_over_h")["coefficient"].max()
    none = most.index[np.cumprod(most.to_numpy() == 0.0) == 1]
    nearly = least.index[np.cumprod(least.to_numpy()[::-1] >= 0.95)[::-1] == 1]
    return (
        float(none.max()) if none.size else math.nan,
        float(nearly.min()) if nearly.size else math.nan,
    )
