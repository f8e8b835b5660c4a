"""The slide coefficient of Kaneko and Hayashi's eq. 5, from the general model.

The coefficient is the share of the falls of a body that cannot slide that is left where it can. The
paper says that it is a function of B/H and the friction, and does not print it.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.models import General, Model
from shaketable.motion import Motion
from shaketable.resampling import CONFIDENCE, interval, recordings_of, resamples
from shaketable.resampling import ratio as rate
from shaketable.simulate import fell, simulate_many

RATIOS = (0.15, 0.2, 0.3, 0.4)  # B/H
MARGINS = (0.7, 0.9, 0.95, 1.0, 1.05, 1.1, 1.25, 1.5, 2.0, 3.0)  # friction over B/H
HEIGHTS = (1.0, 1.8)  # m
SCALES = (1.0, 1.5)
MANY_DRAWS = 4000  # the ends of intervals at a high level are far out


def simulations(motions: int) -> int:
    """How many simulations `slide_coefficients` runs."""
    return (1 + len(MARGINS)) * len(RATIOS) * len(HEIGHTS) * len(SCALES) * 2 * motions


class Slides(NamedTuple):
    """What was found.

    Attributes:
        coefficient: falls with every friction, and without sliding, for every B/H; heights and
            scales together.
        apart: by how much the coefficients of both heights, and of both scales, differ at one
            B/H and friction; of a friction up to B/H nothing falls, and it is left out.
    """

    coefficient: pd.DataFrame
    apart: pd.DataFrame


def slide_coefficients(
    motions: Sequence[Motion], done: Callable[[int], None], seed: int = 0
) -> Slides:
    """Falls with every friction over those without sliding.

    Args:
        motions: of the ground.
        done: is told how many more simulations were made.
        seed: of the bootstrap over recordings.
    """
    recording = recordings_of(motions)
    groups = recording[:, None] == np.arange(recording.max() + 1)

    def falls(ratio: float, model: Model) -> NDArray[np.int64]:
        """Of every height, scale and recording."""
        bodies = [Body.rectangle(height * ratio, height) for height in HEIGHTS]
        runs = simulate_many(bodies, motions, scales=SCALES, model=model, progress=done)
        often = fell(runs).sum(["polarity", "tilt"]).transpose("body", "scale", "motion").values
        return np.asarray(often @ groups)

    without = np.array([falls(ratio, General()) for ratio in RATIOS])
    slides = np.array(
        [
            [falls(ratio, General(static_friction=margin * ratio)) for margin in MARGINS]
            for ratio in RATIOS
        ]
    )
    rows = [
        {
            "b_over_h": ratio,
            "friction": margin * ratio,
            "friction_over_b_over_h": margin,
            "falls": int(slides[i, k].sum()),
            "falls_without_sliding": int(without[i].sum()),
            "coefficient": slides[i, k].sum() / without[i].sum() if without[i].any() else math.nan,
        }
        for i, ratio in enumerate(RATIOS)
        for k, margin in enumerate(MARGINS)
    ]
    return Slides(pd.DataFrame(rows), _apart(slides, without, seed))


def certain(comparisons: int) -> float:
    """The level of each interval at which all hold together with CONFIDENCE (Bonferroni)."""
    return 1.0 - (1.0 - CONFIDENCE) / comparisons


def _apart(slides: NDArray[np.int64], without: NDArray[np.int64], seed: int) -> pd.DataFrame:
    """The difference of the coefficients of both heights, and of both scales, for every B/H.

    Args:
        slides, without: falls, (B/H, margin, height, scale, recording) and without the margin.
        seed: of the bootstrap over recordings.
    """
    weights = resamples(without.shape[-1], MANY_DRAWS, seed)
    slip = [k for k, margin in enumerate(MARGINS) if margin > 1.0]  # below, nothing can rock
    level = certain(2 * len(RATIOS) * len(slip))
    rows = []
    for name, axis in (("height", 0), ("scale", 1)):
        # both of the other together: (B/H, margin, level, recording)
        count, total = slides.sum(axis=3 - axis), without.sum(axis=2 - axis)[:, None]
        share = rate(count, total, weights)
        for i, k in itertools.product(range(len(RATIOS)), slip):
            off = share[:, i, k, 1] - share[:, i, k, 0]
            low, high = interval(off[1:], level)
            rows.append(
                {
                    "what": name,
                    "b_over_h": RATIOS[i],
                    "friction_over_b_over_h": MARGINS[k],
                    "of_the_lower": float(share[0, i, k, 0]),
                    "of_the_higher": float(share[0, i, k, 1]),
                    "difference": float(off[0]),
                    "low": float(low),
                    "high": float(high),
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
