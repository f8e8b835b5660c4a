"""Controlled overturning: how a tilted support chooses the side, and what it costs."""

from shaketable.tilting.counts import (
    BODIES_AT_ONCE,
    TILT_RESERVE,
    TiltCounts,
    count_outcomes,
)
from shaketable.tilting.curves import TiltCurves, curves_of
from shaketable.tilting.design import (
    SLIDES,
    TiltDesign,
    TiltEffect,
    design_tilt,
    require_control,
    shim_height,
    tilt_effect,
)
from shaketable.tilting.rates import FEWEST_FALLS, control_share, control_tilt, fall_share

__all__ = [
    "BODIES_AT_ONCE",
    "FEWEST_FALLS",
    "SLIDES",
    "TILT_RESERVE",
    "TiltCounts",
    "TiltCurves",
    "TiltDesign",
    "TiltEffect",
    "control_share",
    "control_tilt",
    "count_outcomes",
    "curves_of",
    "design_tilt",
    "fall_share",
    "require_control",
    "shim_height",
    "tilt_effect",
]
