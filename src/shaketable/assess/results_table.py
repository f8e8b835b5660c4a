"""An assessment as a table: one row per item, units in the columns' names."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shaketable.assess.ranking import Weights
from shaketable.assess.results import ItemResult, StrapForce
from shaketable.assess.straps import STRAP_SHARE

if TYPE_CHECKING:
    import pandas as pd


def table_of(
    floors: Iterable[tuple[str, Sequence[ItemResult]]], weights: Weights, levels: Sequence[str]
) -> pd.DataFrame:
    """All items of labelled floors; if a label is empty the column of floors is left out.

    Args:
        floors: labels and results.
        weights: of the order of objects.
        levels: names of those of shaking.
    """
    import pandas as pd

    rows = []
    for label, results in floors:
        place = {"floor": label} if label else {}
        rows += [
            {"name": each.item.name, **place, **_row(each, weights), **_levels(each, levels)}
            for each in results
        ]
    return pd.DataFrame(rows)


def _row(result: ItemResult, weights: Weights) -> dict[str, Any]:
    item, profile, body = result.item, result.profile, result.profile.body
    other, holds = result.other, result.base_holds_in_space
    return {
        "location": item.location,
        "quantity": item.quantity,
        "priority": weights.of(item),
        "castors": str(item.castors),
        "mass_kg": np.nan if item.mass is None else item.mass,
        "direction": str(profile.direction),
        "depth_known": item.depth_known,
        "base_along_direction_m": body.width,
        "height_m": item.height,
        "cg_height_m": body.cg_height,
        "eccentricity": body.left / body.width,
        "gyration_radius_m": body.gyration_radius,
        "simulations": result.simulations,
        "recordings": result.recordings,
        "falls": result.falls,
        "not_settled": result.not_settled,
        "fall_share": result.fall.value,
        "fall_share_low": result.fall.low,
        "fall_share_high": result.fall.high,
        "risk": result.risk,
        "governing_share": result.governing_share.value,
        "governing_share_low": result.governing_share.low,
        "governing_share_high": result.governing_share.high,
        "surroundings": repr(item.surroundings) if item.surroundings else "",
        "other_direction_base_m": np.nan if other is None else other.profile.body.width,
        "other_direction_safe_width_m": other.safe_width if other and holds else np.nan,
        "other_direction_fall_share": np.nan if other is None else other.fall.value,
        "falls_downhill": result.falls_downhill,
        "downhill_share": result.downhill.value,
        "downhill_share_low": result.downhill.low,
        "downhill_share_high": result.downhill.high,
        **_rotations(result),
        **_tilts(result),
        "safe_width_m": result.safe_width if holds else np.nan,
        "note": item.note,
        **{f"fall_share_at_friction_{e.friction:g}": e.fall.value for e in result.frictions},
        "friction_while_rocking": result.rocking_friction,
        **_holds(result),
        **_criteria(result),
        **_sliding(result),
        **_uncertain(result),
        **_solid(result),
        **_surrounded(result),
        **_straps(result),
    }


def _solid(result: ItemResult) -> dict[str, Any]:
    """In three dimensions; empty where it was not simulated so."""
    solid = result.solid
    if solid is None:
        return {}
    turned = [each.value for each in solid.turned]
    frictions = {f"fall_share_3d_at_friction_{e.friction:g}": e.fall.value for e in solid.frictions}
    return {
        "shape": "castors" if result.item.rolls else str(result.item.shape),
        "simulations_3d": solid.simulations,
        "recordings_3d": solid.recordings,
        "falls_3d": solid.falls,
        "fall_share_3d": solid.fall.value,
        "fall_share_3d_low": solid.fall.low,
        "fall_share_3d_high": solid.fall.high,
        "fall_share_3d_least_turn": min(turned),
        "fall_share_3d_most_turn": max(turned),
        **frictions,
        **{f"falls_share_3d_{side}": share for side, share in solid.sides._asdict().items()},
        "moved_median_3d_m": solid.moved.median,
        "moved_upper_quartile_3d_m": solid.moved.upper,
        "turned_median_3d_deg": math.degrees(solid.yaw.median),
        "not_settled_3d": solid.not_settled,
        "on_ground_3d": solid.on_ground,
    }


def _surrounded(result: ItemResult) -> dict[str, float]:
    """What its surroundings do in three dimensions; empty where it stands alone."""
    held = result.solid and result.solid.surrounded
    if not held:
        return {}
    row = {
        "leaning_share_3d": held.leans.value,
        "fall_or_lean_share_3d": held.falls_or_leans.value,
        "fall_or_lean_share_3d_low": held.falls_or_leans.low,
        "fall_or_lean_share_3d_high": held.falls_or_leans.high,
    }
    if held.force is not None and held.broke is not None:
        row |= {f"strap_{name}_over_weight_3d": each for name, each in _named(held.force).items()}
        row["strap_broke_share_3d"] = held.broke.value
    if held.off is not None:
        row["off_edge_share_3d"] = held.off.value
    return row


def _straps(result: ItemResult) -> dict[str, float]:
    """What becomes of it in each strap that was tried; stiffness per mass [1/s²], slack [mm]."""
    row: dict[str, float] = {}
    for each in result.straps:
        begin = f"tried_strap_{each.stiffness:g}_{1e3 * each.slack:g}mm"
        row[f"{begin}_fall_share"] = each.fall.value
        row[f"{begin}_leaning_share"] = each.leans.value
        row |= {f"{begin}_{name}_over_weight": it for name, it in _named(each.force).items()}
    return row


def _named(force: StrapForce) -> dict[str, float]:
    return {
        "force_median": force.median,
        f"force_{100 * STRAP_SHARE:g}_percent": force.high,
        "force_largest": force.largest,
    }


def _uncertain(result: ItemResult) -> dict[str, Any]:
    found = result.uncertain
    if found is None:
        return {}
    return {
        "uncertain_as": found.kind,
        "fall_probability": found.fall.value,
        "fall_probability_low": found.fall.low,
        "fall_probability_high": found.fall.high,
        "std_between_objects": found.by_object,
        "std_between_motions": found.by_motion,
        "matters_more": found.matters_more,
    }


def _levels(result: ItemResult, levels: Sequence[str]) -> dict[str, float]:
    """How often it falls, or goes far on castors, at each level."""
    found = zip(levels, result.levels, strict=True)
    return {
        f"share_at_{name.replace(' ', '_')}": each.governing_share.value for name, each in found
    }


def _rotations(result: ItemResult) -> dict[str, float]:
    low, median, high = np.degrees(result.peak_rotation)
    return {
        "peak_rotation_lower_quartile_deg": low,
        "peak_rotation_median_deg": median,
        "peak_rotation_upper_quartile_deg": high,
    }


def _tilts(result: ItemResult) -> dict[str, float]:
    curves = result.curves
    if curves is None:
        return {}
    known = math.isfinite(curves.control_tilt)
    tilts = (curves.control_tilt, *curves.control_tilt_interval) if known else (np.nan,) * 3
    tilt, tilt_low, tilt_high = np.degrees(tilts)
    there_low, there_high = curves.fall_share_there_interval
    return {
        "control_tilt_deg": tilt,
        "control_tilt_low_deg": tilt_low,
        "control_tilt_high_deg": tilt_high,
        "fall_share_at_control_tilt": curves.fall_share_there,
        "fall_share_at_control_tilt_low": there_low,
        "fall_share_at_control_tilt_high": there_high,
    }


def _holds(result: ItemResult) -> dict[str, float]:
    """Static forces per mass against lifting, of the median and of 90 % of the motions."""
    row: dict[str, float] = {}
    for name, hold in zip(("top", "two_thirds"), result.anchor_forces, strict=False):
        row[f"static_force_against_lifting_at_{name}_median_n_per_kg"] = hold.median
        row[f"static_force_against_lifting_at_{name}_90_percent_n_per_kg"] = hold.high
    return row


def _criteria(result: ItemResult) -> dict[str, Any]:
    if result.criteria is None or result.floor_ratios is None:
        return {}
    row: dict[str, Any] = {}
    for name, found in result.criteria.items():
        begin = name.lower().replace(" ", "_").replace(",", "")
        row[f"{begin}_share"] = found.share
        row[f"{begin}_missed"] = found.missed
    return row | {
        "kaneko_hayashi_ratio": result.floor_ratios.kaneko_hayashi,
        "cimellaro_ratio": result.floor_ratios.cimellaro,
        "cimellaro_out_of_range_share": result.floor_ratios.cimellaro_out_of_range,
    }


def _sliding(result: ItemResult) -> dict[str, Any]:
    sliding, support = result.sliding, result.along_support
    if sliding is None or support.sliding is None:
        return {}
    length = support.profile.support_length
    return {
        "slides_share": sliding.share,
        "slip_lower_quartile_m": sliding.slip.lower,
        "slip_median_m": sliding.slip.median,
        "slip_upper_quartile_m": sliding.slip.upper,
        "goes_far_share": sliding.far.value,
        "support_length_m": np.nan if length is None else length,
        "walks_off_share": support.sliding.walks_off,
    }
