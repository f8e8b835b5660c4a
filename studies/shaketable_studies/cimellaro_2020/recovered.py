"""What table 2 tells without saying it: the floors' accelerations, B/H and ζ_A.

The column "proposed" is eq. 9 of B/H and the peak floor acceleration. For a B/H, it gives each
channel's acceleration, to the rounding of a per cent. The column "simplified" is then Kaneko and
Hayashi's ratio of that acceleration where the acceleration's branch decides, and less where the
velocity's does. B/H and ζ_A are those for which the most entries come out and none is above its
acceleration's branch.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria import cimellaro_2020
from shaketable.criteria.kaneko_hayashi_2004 import RECOVERED_RATIO, RECOVERED_ZETA_A
from shaketable.units import CM
from shaketable_studies.cimellaro_2020.printed import TABLE_2

RATIOS = np.round(np.arange(0.10, 0.4201, 0.002), 4)  # B/H
ZETAS = np.round(np.arange(0.100, 0.3501, 0.005), 4)
ROUNDING = 0.005  # half of a per cent
FAR = 0.1  # below the acceleration's ratio by so much, the velocity's branch decides for sure
G = 981.0 * CM  # m/s², with which the paper's tables come out
#: What was assumed before, for comparison: a bookcase's B/H, and this project's ζ_A.
ASSUMED = (0.178, 0.25)

_PROPOSED = np.array([row.proposed for row in TABLE_2])  # %
_SIMPLIFIED = np.array([row.simplified for row in TABLE_2])  # %


class Fit(NamedTuple):
    """How the printed entries fit a B/H and a ζ_A.

    Attributes:
        low, high: each channel's PFA [m/s²] between the ends of its rounding.
        least, most: the acceleration branch's ratio at these.
        met: whether the printed ratio lies between them, to its rounding.
        below: whether it lies below them: the branch of the velocity.
        above: whether it lies above them, which no branch can explain.
    """

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    least: NDArray[np.float64]
    most: NDArray[np.float64]
    met: NDArray[np.bool_]
    below: NDArray[np.bool_]
    above: NDArray[np.bool_]


def fit(ratio: float, zeta_a: float) -> Fit:
    """The printed entries against a B/H and a ζ_A."""
    from scipy.special import ndtr

    proposed, simplified = _PROPOSED / 100.0, _SIMPLIFIED / 100.0
    low = cimellaro_2020.acceleration_of(ratio, proposed - ROUNDING)
    high = cimellaro_2020.acceleration_of(ratio, proposed + ROUNDING)
    turns = float(cimellaro_2020.turning_acceleration(ratio))
    high = np.where(np.isnan(high), turns, high)  # the surface's top lies within the rounding
    median = ratio * G * (1.0 + ratio)
    with np.errstate(invalid="ignore", divide="ignore"):  # a PFA that eq. 9 puts below zero
        least, most = (ndtr(np.log(pfa / median) / zeta_a) for pfa in (low, high))
    met = (least <= simplified + ROUNDING) & (most >= simplified - ROUNDING)
    above = most < simplified - ROUNDING
    return Fit(low, high, least, most, met, ~met & ~above, above)


def constants() -> pd.DataFrame:
    """The range of B/H and ζ_A that fits best, and how well the assumed and chosen ones fit.

    Only entries strictly between 1 and 100 % tell: at the ends every steep curve fits.
    """
    telling = _telling()
    best, most = _best()
    rows = [
        {
            "which": "recovered",
            "b_over_h_low": best[:, 0].min(),
            "b_over_h_high": best[:, 0].max(),
            "zeta_a_low": best[:, 1].min(),
            "zeta_a_high": best[:, 1].max(),
            "entries_met": most,
            "contradicted": 0,
            "of": int(telling.sum()),
        }
    ]
    for which, (ratio, zeta) in (
        ("used", (RECOVERED_RATIO, RECOVERED_ZETA_A)),
        ("assumed before", ASSUMED),
    ):
        one = fit(ratio, zeta)
        rows.append(
            {
                "which": which,
                "b_over_h_low": ratio,
                "b_over_h_high": ratio,
                "zeta_a_low": zeta,
                "zeta_a_high": zeta,
                "entries_met": int(one.met[telling].sum()),
                "contradicted": int(one.above[telling].sum()),
                "of": int(telling.sum()),
            }
        )
    return pd.DataFrame(rows)


@cache
def _best() -> tuple[NDArray[np.float64], int]:
    """Every B/H and ζ_A, a row each, that meets most entries, and how many these are."""
    telling = _telling()
    met = {}
    for ratio in RATIOS.tolist():
        for zeta in ZETAS.tolist():
            one = fit(ratio, zeta)
            if not one.above.any() and (one.low > 0.0).all():
                met[ratio, zeta] = int(one.met[telling].sum())
    most = max(met.values())
    return np.array([key for key, count in met.items() if count == most]), most


def _telling() -> NDArray[np.bool_]:
    return (_SIMPLIFIED > 1) & (_SIMPLIFIED < 100)


def channels() -> pd.DataFrame:
    """Table 2 with what was recovered: each channel's PFA [g], the branch, and the class.

    The ends of the PFA are those over all of the range of B/H that fits, and of the rounding.
    """
    table = pd.DataFrame(TABLE_2)
    used = fit(RECOVERED_RATIO, RECOVERED_ZETA_A)
    ranges = constants().iloc[0]
    ends = [fit(float(ranges[f"b_over_h_{end}"]), RECOVERED_ZETA_A) for end in ("low", "high")]
    table["pfa_g"] = 0.5 * (used.low + used.high) / G
    table["pfa_low_g"] = np.minimum(ends[0].low, ends[1].low) / G
    table["pfa_high_g"] = np.maximum(ends[0].high, ends[1].high) / G
    table["by_acceleration_low"] = used.least
    table["by_acceleration_high"] = used.most
    table["branch"] = np.where(used.below, "PFV", "PFA")
    return table


def mixed_floors() -> pd.DataFrame:
    """The spread of the simplified risks on every floor of several channels, and its branches."""
    table = channels()
    far = table["by_acceleration_low"] - table["simplified"] / 100.0 > FAR
    table["decided_by_velocity"] = (table["branch"] == "PFV") & far
    grouped = table.groupby(["building", "storey"])
    found = pd.DataFrame(
        {
            "channels": grouped.size(),
            "decided_by_velocity": grouped["decided_by_velocity"].sum(),
            "spread": (grouped["simplified"].max() - grouped["simplified"].min()) / 100.0,
        }
    ).reset_index()
    found = found[found["channels"] > 1].reset_index(drop=True)
    found["mixes"] = (found["decided_by_velocity"] > 0) & (
        found["decided_by_velocity"] < found["channels"]
    )
    return found
