"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from shaketable.assess.assessment import Assessment, CastorFriction, FloorAssessment, Level
from shaketable.assess.bases import ACCEPTED_FALLS, BASE_GRID, FINER_BASES, widened
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.holds import HIGH
from shaketable.assess.job import assess
from shaketable.assess.profiles import Direction, Profile
from shaketable.assess.ranking import Weights
from shaketable.assess.results import (
    ENOUGH_RECORDINGS,
    FEWEST_RECORDINGS,
    NOT_CLASSED,
    ROLLS_FAR,
    CriterionResult,
    FloorRatios,
    FrictionResult,
    Hold,
    ItemResult,
    LevelResult,
    ProfileResult,
    Quartiles,
    Share,
    Sliding,
)

__all__ = [
    "ACCEPTED_FALLS",
    "BASE_GRID",
    "ENOUGH_RECORDINGS",
    "FEWEST_RECORDINGS",
    "FINER_BASES",
    "FRICTIONS",
    "HIGH",
    "NOT_CLASSED",
    "ROLLS_FAR",
    "Assessment",
    "CastorFriction",
    "CriterionResult",
    "Direction",
    "FloorAssessment",
    "FloorRatios",
    "FrictionResult",
    "Hold",
    "ItemResult",
    "Level",
    "LevelResult",
    "Profile",
    "ProfileResult",
    "Quartiles",
    "Share",
    "Sliding",
    "Weights",
    "assess",
    "widened",
]
