"""How much figure 8 depends on the widths of the bodies, which the paper does not list."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.motion import Motion
from shaketable.resampling import interval, ratio, recordings_of
from shaketable.simulate import count_by_recording, simulate_many
from shaketable_studies.boroschek_romo_2004.grid import CG_HEIGHTS, RATIOS

NU = 0.3  # of figure 8's sentence
#: Width over full height: the study's, and others that "0.08 to 3.5 m" allows.
RANGES = {
    "study": (float(RATIOS[0]), float(RATIOS[-1])),
    "narrow": (0.10, 0.25),
    "middle": (0.16, 0.30),
    "wide": (0.25, 0.4375),
}
WIDTHS = 6  # in each range


def simulations(motions: int) -> int:
    """How many simulations `ratios` runs."""
    return 2 * len(RANGES) * WIDTHS * len(CG_HEIGHTS) * 2 * motions


def ratios(
    motions: Sequence[Motion], weights: NDArray[np.float64], done: Callable[[int], None]
) -> pd.DataFrame:
    """Falls at ν = 0.3 over those of symmetric bodies, for each range of widths, by height.

    A height of 0 is all of them.
    """
    recording = recordings_of(motions)
    rows = []
    for name, (least, most) in RANGES.items():
        shapes = np.linspace(least, most, WIDTHS)
        falls = []
        for nu in (NU, 0.5):
            bodies = [
                Body.rectangle(2 * h * b, 2 * h, eccentricity=nu)
                for h in CG_HEIGHTS
                for b in shapes
            ]
            counts = count_by_recording(simulate_many(bodies, motions, progress=done), recording)
            falls.append(counts.falls[:, 0].reshape(len(CG_HEIGHTS), WIDTHS, -1).sum(axis=1))
        for k, height in enumerate((0.0, *CG_HEIGHTS)):
            off, even = (f.sum(axis=0) if k == 0 else f[k - 1] for f in falls)
            draws = ratio(off, even, weights)
            low, high = interval(draws[1:])
            rows.append(
                {
                    "widths": name,
                    "b_over_h_least": least,
                    "b_over_h_most": most,
                    "cg_height_m": height,
                    "falls": int(off.sum()),
                    "falls_symmetric": int(even.sum()),
                    "ratio": float(draws[0]),
                    "ratio_low": float(low),
                    "ratio_high": float(high),
                }
            )
    return pd.DataFrame(rows)
