"""Every column of results.csv: its value and its unit, from a result whose numbers are known."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import Body, Edge, Pad, Surroundings
from shaketable.assess import (
    AnchorForce,
    CriterionResult,
    Direction,
    FloorRatios,
    FrictionResult,
    ItemResult,
    LevelResult,
    Mitigation,
    MitigationKind,
    Profile,
    Quartiles,
    Share,
    Sides,
    Sliding,
    SolidResult,
    StrapForce,
    SurroundedResult,
    Weights,
)
from shaketable.assess.results import UncertainResult
from shaketable.assess.results_table import table_of
from shaketable.inventory import Castors, Item
from shaketable.tilting import TiltCurves

ACROSS = Body.rectangle(0.9, 1.8, name="shelf")
ITEM = Item(
    body=Body(base=0.32, cg_height=0.7, left=0.12, gyration_radius=0.5, name="shelf"),
    height=1.8, sideways=ACROSS, castors=Castors.LOCKED, mass=61.0, quantity=7,
    support_length=0.6, location="ward", note="blue", critical=2, people_nearby=True,
)  # fmt: skip
NOTHING = np.zeros(1)
SLIDING = Sliding(
    share=0.31, slip=Quartiles(0.011, 0.022, 0.033), reach=0.4, far=Share(0.12, 0.05, 0.3),
    falls_or_far=Share(0.5, 0.4, 0.6), walks_off=0.07, falls_or_off=Share(0.4, 0.3, 0.5),
)  # fmt: skip
FRONT = Profile(item=ITEM, direction=Direction.FRONT_TO_BACK, body=ITEM.body, support_length=0.6)
SIDE = Profile(item=ITEM, direction=Direction.SIDE_TO_SIDE, body=ACROSS)
RESULT = ItemResult(
    profile=FRONT, simulations=88, recordings=22, falls=33, falls_downhill=21,
    fall=Share(0.375, 0.21, 0.58), downhill=Share(0.64, 0.5, 0.77),
    peak_rotation=Quartiles(0.1, 0.2, 0.3), safe_base=0.45, sliding=SLIDING, not_settled=2,
    curves=TiltCurves(
        tilts=NOTHING, downhill_share=NOTHING, downhill_band=(NOTHING, NOTHING),
        fall_share=NOTHING, fall_band=(NOTHING, NOTHING), control_tilt=0.05,
        control_tilt_interval=(0.04, 0.06), fall_share_there=0.44,
        fall_share_there_interval=(0.35, 0.55),
    ),
    criteria={"Housner 1963": CriterionResult(0.61, 3)},
    floor_ratios=FloorRatios(0.17, 0.19, 0.23), rocking_friction=0.53,
    frictions=(FrictionResult(0.3, Share(0.27, 0.1, 0.5), 0.1),),
    anchor_forces=(AnchorForce(1.8, 0.9, 1.7, 2.0), AnchorForce(1.2, 1.35, 2.55, 3.0)),
    levels=(LevelResult(Share(0.1, 0.0, 0.2), Share(0.14, 0.1, 0.3)),),
    uncertain=UncertainResult("equipment", Share(0.41, 0.3, 0.52), 0.08, 0.37),
    solid=SolidResult(
        simulations=160, recordings=20, falls=72,
        level=LevelResult(Share(0.45, 0.25, 0.66), Share(0.46, 0.26, 0.67)),
        sides=Sides(0.4, 0.3, 0.2, 0.1),
        turned=(Share(0.43, 0.2, 0.6), Share(0.47, 0.3, 0.7)),
        frictions=(FrictionResult(0.5, Share(0.36, 0.2, 0.5), 0.2),),
        moved=Quartiles(0.02, 0.04, 0.09), yaw=Quartiles(0.1, 0.5, 0.9), not_settled=4,
    ),
)  # fmt: skip
OTHER = replace(RESULT, fall=Share(0.05, 0.0, 0.2), safe_base=0.95, profile=SIDE)

#: A degree has π/180 rad.
EXPECTED = {
    "name": "shelf", "floor": "3", "location": "ward", "quantity": 7,
    "priority": 1.0 + 2.0 + 3.0,  # two steps of critical, people near it
    "castors": "locked", "mass_kg": 61.0, "risk": "high", "fall_share": 0.45,
    "fall_share_low": 0.25, "fall_share_high": 0.66,
    "governing_share": 0.46, "governing_share_low": 0.26, "governing_share_high": 0.67,
    "recordings": 20, "dimensions": 3, "simulations": 160, "falls": 72, "not_settled": 4,
    "fall_share_at_friction_0.5": 0.36, "stands_on": "", "depth_known": True, "height_m": 1.8,
    "cg_height_m": 0.7, "surroundings": "", "shape": "castors",
    "fall_share_least_turn": 0.43, "fall_share_most_turn": 0.47, "falls_share_forward": 0.4,
    "falls_share_backward": 0.3, "falls_share_left": 0.2, "falls_share_right": 0.1,
    "moved_median_m": 0.04, "moved_upper_quartile_m": 0.09, "turned_median_deg": 28.647890,
    "uncertain_as": "equipment", "fall_probability": 0.41, "fall_probability_low": 0.3,
    "fall_probability_high": 0.52, "std_between_objects": 0.08,
    "std_between_motions": 0.37, "matters_more": "motion", "note": "blue",
    "direction": "front to back", "base_along_direction_m": 0.32,
    "eccentricity": 0.12 / 0.32, "gyration_radius_m": 0.5,
    "plane_simulations": 88, "plane_falls": 33, "plane_fall_share": 0.375,
    "plane_falls_downhill": 21, "plane_downhill_share": 0.64,
    "plane_downhill_share_low": 0.5, "plane_downhill_share_high": 0.77,
    "plane_other_direction_base_m": 0.9, "plane_other_direction_safe_base_m": 0.95,
    "plane_other_direction_fall_share": 0.05, "plane_safe_base_m": 0.45,
    "plane_friction_while_rocking": 0.53,
    "plane_peak_rotation_lower_quartile_deg": 5.729578,
    "plane_peak_rotation_median_deg": 11.459156,
    "plane_peak_rotation_upper_quartile_deg": 17.188734, "plane_control_tilt_deg": 2.864789,
    "plane_control_tilt_low_deg": 2.291831, "plane_control_tilt_high_deg": 3.437747,
    "plane_fall_share_at_control_tilt": 0.44, "plane_fall_share_at_control_tilt_low": 0.35,
    "plane_fall_share_at_control_tilt_high": 0.55,
    "slides_share": 0.31,
    "slip_lower_quartile_m": 0.011, "slip_median_m": 0.022, "slip_upper_quartile_m": 0.033,
    "goes_far_share": 0.46 - 0.45, "support_length_m": 0.6, "walks_off_share": 0.07,
    "static_force_against_lifting_at_top_median_n_per_kg": 0.9,
    "static_force_against_lifting_at_top_90_percent_n_per_kg": 1.7,
    "static_force_against_lifting_at_two_thirds_median_n_per_kg": 1.35,
    "static_force_against_lifting_at_two_thirds_90_percent_n_per_kg": 2.55,
    "housner_1963_share": 0.61, "housner_1963_missed": 3, "kaneko_hayashi_ratio": 0.17,
    "cimellaro_ratio": 0.19, "cimellaro_out_of_range_share": 0.23, "share_at_half": 0.14,
}  # fmt: skip


#: What an object among surroundings, on which straps were tried, has beside these.
HELD = {
    "held_up_share": 0.11, "fall_or_held_up_share": 0.56, "fall_or_held_up_share_low": 0.4,
    "fall_or_held_up_share_high": 0.7, "strap_force_median_over_weight": 0.2,
    "strap_force_90_percent_over_weight": 0.6, "strap_force_largest_over_weight": 0.8,
    "strap_broke_share": 0.33, "off_edge_share": 0.06,
    "try_strap_share": 0.24, "try_strap_share_low": 0.11, "try_strap_share_high": 0.45,
    "try_strap_held_up_share": 0.09,
    "try_strap_2000_20mm_share": 0.41, "try_strap_2000_20mm_at_wall_share": 0.24,
    "try_strap_2000_20mm_at_wall_force_median_over_weight": 0.35,
    "try_strap_2000_20mm_at_wall_force_90_percent_over_weight": 0.95,
    "try_strap_2000_20mm_at_wall_force_largest_over_weight": 1.6,
    "try_strap_2000_20mm_force_median_over_weight": 0.7,
    "try_strap_2000_20mm_force_90_percent_over_weight": 1.3,
    "try_strap_2000_20mm_force_largest_over_weight": 2.9,
    "try_base_share": 0.08, "try_base_share_low": 0.02, "try_base_share_high": 0.2,
    "try_base_held_up_share": 0.01, "try_base_depth_m": 0.57, "try_base_width_m": 0.91,
}  # fmt: skip


def test_every_column() -> None:
    """A column that is not here fails, as does a value in another unit."""
    result = replace(RESULT, other=OTHER)
    (row,) = table_of([("3", [result])], Weights(), ["half"]).to_dict("records")
    about = {
        "stiffness_per_mass": 2000.0, "slack_m": 0.02, "height_m": 1.8, "wall_gap_m": math.nan
    }  # fmt: skip
    strapped = Mitigation(
        MitigationKind.STRAP, about, 80, Share(0.14, 0.0, 0.2), Share(0.26, 0.1, 0.4),
        Share(0.41, 0.2, 0.6), StrapForce(0.7, 1.3, 2.9),
    )  # fmt: skip
    walled = Mitigation(
        MitigationKind.STRAP, about | {"wall_gap_m": 0.02}, 80, Share(0.15, 0.0, 0.3),
        Share(0.09, 0.02, 0.25), Share(0.24, 0.11, 0.45), StrapForce(0.35, 0.95, 1.6),
    )  # fmt: skip
    based = Mitigation(
        MitigationKind.BASE, {"depth_m": 0.57, "width_m": 0.91}, 80, Share(0.07, 0.0, 0.2),
        Share(0.01, 0.0, 0.1), Share(0.08, 0.02, 0.2),
    )  # fmt: skip
    around = Surroundings(edge=Edge(at=0.4), pad=Pad(pull_off=20.0))
    held = SurroundedResult(
        held_up=Share(0.11, 0.0, 0.2), falls_or_held_up=Share(0.56, 0.4, 0.7),
        force=StrapForce(0.2, 0.6, 0.8), broke=Share(0.33, 0.2, 0.5), off=Share(0.06, 0.0, 0.1),
    )  # fmt: skip
    assert RESULT.solid is not None
    beside = replace(
        result, mitigations=(strapped, walled, based), solid=RESULT.solid._replace(surrounded=held),
        profile=replace(FRONT, item=replace(ITEM, surroundings=around)),
    )  # fmt: skip
    (more,) = table_of([("3", [beside])], Weights(), ["half"]).to_dict("records")
    assert more["surroundings"] == repr(around)
    assert {name: value for name, value in more.items() if name not in row} == HELD
    assert set(row) == set(EXPECTED)
    for name, value in EXPECTED.items():
        if isinstance(value, float):
            assert row[name] == pytest.approx(value, rel=1e-6), name
        else:
            assert row[name] == value, name
    assert all(not (isinstance(each, float) and math.isnan(each)) for each in row.values())
