"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from shaketable.assess.bases import ACCEPTED_FALLS, BASE_GRID, FINER_BASES
from shaketable.assess.criteria import COLUMNS
from shaketable.assess.floors import Part, assess_floors, part_of, whole_table
from shaketable.assess.job import TILT_GRID_DEG, Assessment, assess

__all__ = [
    "ACCEPTED_FALLS",
    "BASE_GRID",
    "COLUMNS",
    "FINER_BASES",
    "TILT_GRID_DEG",
    "Assessment",
    "Part",
    "assess",
    "assess_floors",
    "part_of",
    "whole_table",
]
