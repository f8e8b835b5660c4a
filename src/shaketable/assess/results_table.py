"""An assessment as a table: one row per item, units in the columns' names."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shaketable.assess.item_result import ItemResult
from shaketable.assess.ranking import Weights
from shaketable.assess.results import StrapForce
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
    decides = result.solid or result
    return {
        "location": item.location,
        "quantity": item.quantity,
        "priority": weights.of(item),
        "castors": str(item.castors),
        "mass_kg": np.nan if item.mass is None else item.mass,
        "risk": result.risk,
        "fall_share": result.overturns.value,
        "fall_share_low": result.overturns.low,
        "fall_share_high": result.overturns.high,
        "governing_share": result.governing_share.value,
        "governing_share_low": result.governing_share.low,
        "governing_share_high": result.governing_share.high,
        "recordings": result.by,
        "dimensions": 3 if result.solid else 2,
        "simulations": decides.simulations,
        "falls": decides.falls,
        "not_settled": decides.not_settled,
        **{f"fall_share_at_friction_{e.friction:g}": e.fall.value for e in decides.frictions},
        "stands_on": item.stands_on,
        "depth_known": item.depth_known,
        "height_m": item.height,
        "cg_height_m": body.cg_height,
        "surroundings": repr(item.surroundings) if item.surroundings else "",
        **_solid(result),
        **_surrounded(result),
        **_uncertain(result),
        **_measures(result),
        "note": item.note,
        "direction": str(profile.direction),
        "base_along_direction_m": body.base,
        "eccentricity": body.left / body.base,
        "gyration_radius_m": body.gyration_radius,
        **_plane(result),
        **_sliding(result),
        **_holds(result),
        **_criteria(result),
    }


def _plane(result: ItemResult) -> dict[str, Any]:
    """In a plane, in the worse direction; what three dimensions decide is not of these."""
    other = result.other
    return {
        "plane_simulations": result.simulations,
        "plane_falls": result.falls,
        "plane_fall_share": result.fall.value,
        "plane_falls_downhill": result.falls_downhill,
        "plane_downhill_share": result.downhill.value,
        "plane_downhill_share_low": result.downhill.low,
        "plane_downhill_share_high": result.downhill.high,
        "plane_other_direction_base_m": np.nan if other is None else other.profile.body.base,
        "plane_other_direction_fall_share": np.nan if other is None else other.fall.value,
        "plane_other_direction_safe_base_m": np.nan if other is None else other.safe_base,
        "plane_safe_base_m": result.safe_base,
        "plane_friction_while_rocking": result.rocking_friction,
        **_rotations(result),
        **_tilts(result),
    }


def _solid(result: ItemResult) -> dict[str, Any]:
    """In three dimensions; empty where it was not simulated so."""
    solid = result.solid
    if solid is None:
        return {}
    turned = [each.value for each in solid.turned]
    return {
        "shape": "castors" if result.item.rolls else str(result.item.shape),
        "fall_share_least_turn": min(turned),
        "fall_share_most_turn": max(turned),
        **{f"falls_share_{side}": share for side, share in solid.sides._asdict().items()},
        "moved_median_m": solid.moved.median,
        "moved_upper_quartile_m": solid.moved.upper,
        "turned_median_deg": math.degrees(solid.yaw.median),
    }


def _surrounded(result: ItemResult) -> dict[str, float]:
    """What its surroundings do in three dimensions; empty where it stands alone."""
    held = result.solid and result.solid.surrounded
    if not held:
        return {}
    row = {
        "held_up_share": held.held_up.value,
        "fall_or_held_up_share": held.falls_or_held_up.value,
        "fall_or_held_up_share_low": held.falls_or_held_up.low,
        "fall_or_held_up_share_high": held.falls_or_held_up.high,
    }
    if held.force is not None and held.broke is not None:
        row |= {f"strap_{name}_over_weight": each for name, each in _named(held.force).items()}
        row["strap_broke_share"] = held.broke.value
    if held.off is not None:
        row["off_edge_share"] = held.off.value
    return row


def _measures(result: ItemResult) -> dict[str, Any]:
    """What each measure leaves that was tried, the one that leaves most of its kind.

    Of straps also what they bear, without a wall and beside one.
    """
    row: dict[str, Any] = {}
    for each in result.tried:
        begin = f"try_{each.kind}"
        row |= {
            f"{begin}_share": each.left.value,
            f"{begin}_share_low": each.left.low,
            f"{begin}_share_high": each.left.high,
            f"{begin}_held_up_share": each.held_up.value,
        }
        if each.force is None:
            row |= {f"{begin}_{name}": value for name, value in each.about.items()}
    for each in result.straps:
        assert each.force is not None
        about = each.about
        beside = "" if each.to_a_post else "_at_wall"
        stiff, slack = f"{about['stiffness_per_mass']:g}", f"{1e3 * about['slack_m']:g}mm"
        begin = f"try_{each.kind}_{stiff}_{slack}{beside}"
        row |= {f"{begin}_share": each.left.value}
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
        "plane_peak_rotation_lower_quartile_deg": low,
        "plane_peak_rotation_median_deg": median,
        "plane_peak_rotation_upper_quartile_deg": high,
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
        "plane_control_tilt_deg": tilt,
        "plane_control_tilt_low_deg": tilt_low,
        "plane_control_tilt_high_deg": tilt_high,
        "plane_fall_share_at_control_tilt": curves.fall_share_there,
        "plane_fall_share_at_control_tilt_low": there_low,
        "plane_fall_share_at_control_tilt_high": there_high,
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
        "goes_far_share": result.goes_far if result.item.rolls else sliding.far.value,
        "support_length_m": np.nan if length is None else length,
        "walks_off_share": support.sliding.walks_off,
    }
