"""The third condition: which friction makes "rocks without sliding" true."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from shaketable.body import Body
from shaketable.demand import largest_demand
from shaketable.motion import Motion
from shaketable.simulate import simulate
from shaketable_studies.boroschek_romo_2004.grid import CG_HEIGHTS, RATIOS

SHAPES = RATIOS[::3]  # base over full height
ECCENTRICITIES = (0.5, 0.3)
EVERY = 4  # of the motions


def demands(motions: Sequence[Motion]) -> pd.DataFrame:
    """The largest |R_x|/R_y while rocking of every body under some motions that rock it."""
    rows = []
    for height in CG_HEIGHTS:
        for shape in SHAPES:
            for nu in ECCENTRICITIES:
                body = Body.rectangle(2 * height * shape, 2 * height, eccentricity=nu)
                for motion in motions[::EVERY]:
                    run = simulate(body, motion)
                    if run.peak_rotation == 0.0:
                        continue
                    rows.append(
                        {
                            "b_over_h": shape,
                            "cg_height_m": height,
                            "eccentricity": nu,
                            "record": motion.name,
                            "pga_m_s2": motion.peak_ground_acceleration,
                            "overturns": run.outcome != 0,
                            "at_rest": max(body.left, body.right) / height,
                            "demand": largest_demand(run),
                        }
                    )
    columns = ["b_over_h", "cg_height_m", "eccentricity", "record", "pga_m_s2", "overturns",
               "at_rest", "demand"]  # fmt: skip
    return pd.DataFrame(rows, columns=columns)


def shares_without_sliding(table: pd.DataFrame) -> pd.DataFrame:
    """Of what rocks, the share that a friction keeps from sliding, by base over height."""
    frictions = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
    rows = []
    for (shape, nu), here in table.groupby(["b_over_h", "eccentricity"]):
        at_rest = float(here["at_rest"].iloc[0])
        rows += [
            {
                "b_over_h": shape,
                "eccentricity": nu,
                "friction": friction,
                "enough_at_rest": friction >= at_rest,
                "rocks": len(here),
                "without_sliding": float((here["demand"] <= friction).mean()),
            }
            for friction in frictions
        ]
    return pd.DataFrame(rows)


def needed(table: pd.DataFrame) -> pd.DataFrame:
    """The friction with which half and nineteen of twenty of what rocks does so without sliding."""
    grouped = table.groupby(["b_over_h", "eccentricity"])
    finite = table.assign(demand=table["demand"].replace(np.inf, np.nan))
    return pd.DataFrame(
        {
            "at_rest": grouped["at_rest"].first(),
            "rocks": grouped.size(),
            "half": grouped["demand"].quantile(0.5, interpolation="higher"),
            "nineteen_of_twenty": grouped["demand"].quantile(0.95, interpolation="higher"),
            "largest": finite.groupby(["b_over_h", "eccentricity"])["demand"].max(),
        }
    ).reset_index()
