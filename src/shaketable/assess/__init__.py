"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from shaketable.assess.job import (
    ACCEPTED_FALLS,
    BASE_GRID,
    FINER_BASES,
    Assessment,
    assess,
)
from shaketable.assess.sliding import SLIDES
from shaketable.assess.table import FEWEST_FALLS, RISK_CLASSES, TILT_GRID_DEG, risk_class

__all__ = [
    "ACCEPTED_FALLS",
    "BASE_GRID",
    "FEWEST_FALLS",
    "FINER_BASES",
    "RISK_CLASSES",
    "SLIDES",
    "TILT_GRID_DEG",
    "Assessment",
    "assess",
    "risk_class",
]
