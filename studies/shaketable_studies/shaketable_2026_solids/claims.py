"""What the plane says, and whether it holds in three dimensions; every verdict may come out
either way.
"""

from __future__ import annotations

import math

import pandas as pd

from shaketable.study import NO, OPEN, YES, Claim, verdict_within
from shaketable_studies.shaketable_2026_solids.direction import PLANE

PUBLISHED = (4.0, 5.5)  # degrees: Boroschek & Iruretagoyena (2006), for 95 % of the falls
LARGEST = 7.0  # degrees: tilts that were tried


def claims(controlled: pd.DataFrame, ratios: pd.DataFrame, measured: pd.DataFrame) -> list[Claim]:
    """The claims, one by one."""
    return [
        *(_control(row) for row in controlled.to_dict("records")),
        *(_more(row) for row in ratios.to_dict("records")),
        *(_best(measured, ground) for ground in dict.fromkeys(measured["of_the_ground"])),
    ]


def _degrees(value: float) -> str:
    if math.isnan(value):
        return "not known, of too few falls"
    return f"{value:.1f}°" if value <= LARGEST else f"above {LARGEST:g}°"


def _control(row: dict) -> Claim:  # type: ignore[type-arg]
    low, high = row["tilt_low_deg"], row["tilt_high_deg"]
    if row["base"] == PLANE:
        where, straight = "in a plane, under one component", ""
    else:
        where = f"{row['base']} base, tilted {row['direction_deg']:g}° from the short side, both"
        where += " components"
        share = 100 * row["straight_at_5_deg"]
        straight = f"; at 5° {share:.0f} % of the falls are within 45° of downhill"
    return Claim(
        f"a tilt of 4 to 5.5° sends 95 % of the falls downhill: {where}",
        "4 to 5.5° (Boroschek & Iruretagoyena 2006, in a plane)",
        f"{_degrees(row['tilt_deg'])} ({_degrees(low)} to {_degrees(high)}){straight}",
        # less tilt than published does as well
        verdict_within(low, high, 0.0, PUBLISHED[1]),
    )


def _more(row: dict) -> Claim:  # type: ignore[type-arg]
    low, high = row["low"], row["high"]
    of = {
        "one component": "one component in a plane",
        "the stronger component": "the stronger component in a plane",
        "either component": "one or the other component in a plane",
        "square": "a square base as wide under the same pairs",
    }[row["over"]]
    what = (
        "both components overturn a square box" if row["case"] == "square" else "a cylinder falls"
    )
    return Claim(
        f"{what} more often than {of} (motions × {row['scale']:g})",
        "–",
        f"{row['ratio']:.2f} times as often ({low:.2f} to {high:.2f})",
        YES if low > 1.0 else NO if high < 1.0 else OPEN,
    )


def _best(measured: pd.DataFrame, ground: str) -> Claim:
    here = measured[measured["of_the_ground"] == ground]
    others = here[here["of_the_pair"] != "RotD100"]
    said = ", ".join(f"{row.of_the_pair} {row.area:.3f}" for row in here.itertuples())
    if (others["more_high"] < 0.0).all():
        holds = YES
    elif (others["more_low"] > 0.0).any():
        holds = NO
    else:
        holds = OPEN
    return Claim(
        f"of {ground}, RotD100 tells best what falls in three dimensions",
        "–",
        f"areas under the ROC curve: {said}",
        holds,
    )
