"""The table of an assessment: how often each item falls, which way, and what would help."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.sliding import Kept
from shaketable.inventory import Item
from shaketable.recordings import CONFIDENCE
from shaketable.tilting import TiltCounts, TiltCurves

if TYPE_CHECKING:
    import pandas as pd

#: Classes of overturning ratio by their upper limits (Kaneko & Hayashi 2004; physics.md 4).
RISK_CLASSES = {"low": 0.03, "medium": 0.3, "high": 0.7, "very high": np.inf}


def risk_class(share: float) -> str:
    """Low, medium, high or very high, by the share of motions that overturn."""
    return next(name for name, limit in RISK_CLASSES.items() if share < limit)


def overturning_table(
    items: Sequence[Item],
    now: TiltCounts,
    present: Sequence[TiltCurves],
    kept: Kept,
    bases: NDArray[np.float64],
    curves: Sequence[TiltCurves],
) -> pd.DataFrame:
    """One row an item.

    Args:
        now, present: at the items' own tilt: counts, and shares with their intervals.
        kept: single simulations there.
        bases: safe widths [m].
        curves: over the tilts tried.
    """
    import pandas as pd
    from statsmodels.stats.proportion import proportion_confint

    # The two directions of a motion are one experiment for a symmetric body on a level support,
    # and related ones otherwise: the interval counts motions, not simulations.
    simulations = int(now.simulations[0].sum())
    motions = simulations // 2
    falls, downhill = now.falls[:, 0].sum(axis=1), now.downhill[:, 0].sum(axis=1)
    low, high = proportion_confint(
        falls / simulations * motions, motions, 1 - CONFIDENCE, method="wilson"
    )
    # observed values: half way between a rotation that stood and 90° nothing ever was
    quartiles = np.degrees(
        np.quantile(kept.peak_rotation[:, 0], [0.25, 0.5, 0.75], axis=1, method="inverted_cdf")
    )
    share = falls / simulations
    with np.errstate(invalid="ignore"):
        toward = downhill / falls
    found = [each if math.isfinite(each.tilt) else None for each in curves]
    tilts = np.degrees([(c.tilt, *c.tilt_interval) if c else (np.nan,) * 3 for c in found])
    then = [(c.falls_at_tilt, *c.falls_at_tilt_interval) if c else (np.nan,) * 3 for c in found]
    return pd.DataFrame(
        {
            "name": [item.name for item in items],
            "location": [item.location for item in items],
            "quantity": [item.quantity for item in items],
            "width_m": [item.body.width for item in items],
            "height_m": [item.height for item in items],
            "cg_height_m": [item.body.cg_height for item in items],
            "eccentricity": [item.body.left / item.body.width for item in items],
            "gyration_radius_m": [item.body.gyration_radius for item in items],
            "simulations": simulations,
            "falls": falls,
            "fall_share": share,
            "fall_share_low": low,
            "fall_share_high": high,
            "risk": [risk_class(s) for s in share],
            "falls_downhill": downhill,
            "downhill_share": toward,
            "downhill_share_low": [each.control_band[0][0] for each in present],
            "downhill_share_high": [each.control_band[1][0] for each in present],
            "peak_rotation_lower_quartile_deg": quartiles[0],
            "peak_rotation_median_deg": quartiles[1],
            "peak_rotation_upper_quartile_deg": quartiles[2],
            "control_tilt_deg": tilts[:, 0],
            "control_tilt_low_deg": tilts[:, 1],
            "control_tilt_high_deg": tilts[:, 2],
            "fall_share_at_control_tilt": [each[0] for each in then],
            "fall_share_at_control_tilt_low": [each[1] for each in then],
            "fall_share_at_control_tilt_high": [each[2] for each in then],
            "safe_width_m": bases,
            "note": [item.note for item in items],
        }
    )
