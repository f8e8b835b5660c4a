"""The table of an assessment: how often each item falls, which way, and what would help."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.sliding import Kept
from shaketable.criteria.kaneko_hayashi_2004 import risk_class
from shaketable.inventory import Item
from shaketable.recordings import binomial_interval
from shaketable.tilting import TiltCounts, TiltCurves

if TYPE_CHECKING:
    import pandas as pd


def overturning_table(
    items: Sequence[Item],
    now: TiltCounts,
    toward: tuple[NDArray[np.float64], NDArray[np.float64]],
    kept: Kept,
    bases: NDArray[np.float64],
    curves: Sequence[TiltCurves],
) -> pd.DataFrame:
    """One row an item.

    Args:
        now: counts at the items' own tilt.
        toward: ends of the interval of the share of those falls that goes downhill, (item,).
        kept: single simulations there.
        bases: safe widths [m].
        curves: over the tilts tried.
    """
    import pandas as pd

    # The two directions of a motion are one experiment for a symmetric body on a level support,
    # and related ones otherwise: the interval counts motions, not simulations.
    simulations = int(now.simulations[0].sum())
    motions = simulations // 2
    falls, downhill = now.falls[:, 0].sum(axis=1), now.downhill[:, 0].sum(axis=1)
    low, high = binomial_interval(falls / simulations * motions, motions)
    # observed values: half way between a rotation that stood and 90° nothing ever was
    quartiles = np.degrees(
        np.quantile(kept.peak_rotation[:, 0], [0.25, 0.5, 0.75], axis=1, method="inverted_cdf")
    )
    share = falls / simulations
    with np.errstate(invalid="ignore"):
        downhill_share = downhill / falls
    found = [each if math.isfinite(each.control_tilt) else None for each in curves]
    tilts = np.degrees(
        [(c.control_tilt, *c.control_tilt_interval) if c else (np.nan,) * 3 for c in found]
    )
    there = np.array([(c.fall_share_there, *c.fall_share_there_interval) for c in curves])
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
            "downhill_share": downhill_share,
            "downhill_share_low": toward[0],
            "downhill_share_high": toward[1],
            "peak_rotation_lower_quartile_deg": quartiles[0],
            "peak_rotation_median_deg": quartiles[1],
            "peak_rotation_upper_quartile_deg": quartiles[2],
            "control_tilt_deg": tilts[:, 0],
            "control_tilt_low_deg": tilts[:, 1],
            "control_tilt_high_deg": tilts[:, 2],
            "fall_share_at_control_tilt": there[:, 0],
            "fall_share_at_control_tilt_low": there[:, 1],
            "fall_share_at_control_tilt_high": there[:, 2],
            "safe_width_m": bases,
            "note": [item.note for item in items],
        }
    )
