"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from shaketable.assess.assessment import Assessment, FloorAssessment
from shaketable.assess.bases import ACCEPTED_FALLS, BASE_GRID, FINER_BASES
from shaketable.assess.job import assess
from shaketable.assess.results import (
    CriterionResult,
    FloorRatios,
    ItemResult,
    Quartiles,
    Share,
    Sliding,
)

__all__ = [
    "ACCEPTED_FALLS",
    "BASE_GRID",
    "FINER_BASES",
    "Assessment",
    "CriterionResult",
    "FloorAssessment",
    "FloorRatios",
    "ItemResult",
    "Quartiles",
    "Share",
    "Sliding",
    "assess",
]
