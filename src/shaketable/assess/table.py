"""An assessment as a table: one row per item, units in the columns' names."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shaketable.assess.results import ItemResult

if TYPE_CHECKING:
    import pandas as pd


def table_of(floors: Iterable[tuple[str, Sequence[ItemResult]]]) -> pd.DataFrame:
    """All items of labelled floors; if a label is empty the column of floors is left out."""
    import pandas as pd

    rows = []
    for label, results in floors:
        place = {"floor": label} if label else {}
        rows += [{"name": each.item.name, **place, **_row(each)} for each in results]
    return pd.DataFrame(rows)


def _row(result: ItemResult) -> dict[str, Any]:
    item, body, curves = result.item, result.item.body, result.curves
    low, median, high = np.degrees(result.peak_rotation)
    known = math.isfinite(curves.control_tilt)
    tilts = (curves.control_tilt, *curves.control_tilt_interval) if known else (np.nan,) * 3
    tilt, tilt_low, tilt_high = np.degrees(tilts)
    there_low, there_high = curves.fall_share_there_interval
    return {
        "location": item.location,
        "quantity": item.quantity,
        "base_m": body.width,
        "direction": item.direction,
        "height_m": item.height,
        "cg_height_m": body.cg_height,
        "eccentricity": body.left / body.width,
        "gyration_radius_m": body.gyration_radius,
        "simulations": result.simulations,
        "recordings": result.recordings,
        "falls": result.falls,
        "fall_share": result.fall.value,
        "fall_share_low": result.fall.low,
        "fall_share_high": result.fall.high,
        "risk": result.risk,
        "falls_downhill": result.falls_downhill,
        "downhill_share": result.downhill.value,
        "downhill_share_low": result.downhill.low,
        "downhill_share_high": result.downhill.high,
        "peak_rotation_lower_quartile_deg": low,
        "peak_rotation_median_deg": median,
        "peak_rotation_upper_quartile_deg": high,
        "control_tilt_deg": tilt,
        "control_tilt_low_deg": tilt_low,
        "control_tilt_high_deg": tilt_high,
        "fall_share_at_control_tilt": curves.fall_share_there,
        "fall_share_at_control_tilt_low": there_low,
        "fall_share_at_control_tilt_high": there_high,
        "safe_width_m": result.safe_width,
        "note": item.note,
        **_criteria(result),
        **_sliding(result),
    }


def _criteria(result: ItemResult) -> dict[str, Any]:
    if result.criteria is None or result.floor_ratios is None:
        return {}
    row: dict[str, Any] = {}
    for name, found in result.criteria.items():
        begin = name.lower().replace(" ", "_")
        row[f"{begin}_share"] = found.share
        row[f"{begin}_missed"] = found.missed
    return row | {
        "kaneko_hayashi_ratio": result.floor_ratios.kaneko_hayashi,
        "cimellaro_ratio": result.floor_ratios.cimellaro,
        "cimellaro_out_of_range_share": result.floor_ratios.cimellaro_out_of_range,
    }


def _sliding(result: ItemResult) -> dict[str, Any]:
    sliding, length = result.sliding, result.item.support_length
    if sliding is None:
        return {}
    return {
        "slides_share": sliding.share,
        "slip_lower_quartile_m": sliding.slip.lower,
        "slip_median_m": sliding.slip.median,
        "slip_upper_quartile_m": sliding.slip.upper,
        "support_length_m": np.nan if length is None else length,
        "walks_off_share": sliding.walks_off,
    }
