"""Controlled overturning: how a tilted support chooses the side of a fall, and what it costs."""

from shaketable.tilting.counts import (
    TiltCounts,
    count_outcomes,
    pieces,
    steepest,
)
from shaketable.tilting.curves import TiltCurves, curves_of
from shaketable.tilting.design import (
    CONTROL,
    TILTS,
    TiltDesign,
    TiltEffect,
    design_tilt,
    require_control,
    shim_height,
    tilt_effect,
)
from shaketable.tilting.rates import (
    FEWEST_FALLS,
    control_tilt,
    downhill_interval,
    downhill_share,
    fall_share,
)
from shaketable.tilting.stands import SLIDES, TURNS

__all__ = [
    "CONTROL",
    "FEWEST_FALLS",
    "SLIDES",
    "TILTS",
    "TURNS",
    "TiltCounts",
    "TiltCurves",
    "TiltDesign",
    "TiltEffect",
    "control_tilt",
    "count_outcomes",
    "curves_of",
    "design_tilt",
    "downhill_interval",
    "downhill_share",
    "fall_share",
    "pieces",
    "require_control",
    "shim_height",
    "steepest",
    "tilt_effect",
]
