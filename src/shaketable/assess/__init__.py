"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from shaketable.assess.alike import alike
from shaketable.assess.anchors import ANCHOR_SHARE
from shaketable.assess.assessment import Assessment, FloorAssessment, Level, LevelSummary
from shaketable.assess.bases import BASE_GRID, FINER_BASES, widened
from shaketable.assess.castors import CastorFriction
from shaketable.assess.classes import (
    CLASSES,
    ENOUGH_RECORDINGS,
    FEW_FALLS,
    FEWEST_RECORDINGS,
    NOT_CLASSED,
    class_of,
)
from shaketable.assess.fate import PlaceFate, fate_of
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.item_result import ItemResult, ProfileResult
from shaketable.assess.job import assess
from shaketable.assess.mitigation import LEADING, MOST_TRIED, PREMISES, Premises
from shaketable.assess.profiles import Direction, Profile
from shaketable.assess.ranking import Weights
from shaketable.assess.results import (
    ACCEPTED_FALLS,
    REACHED,
    ROLLS_FAR,
    AnchorForce,
    CriterionResult,
    FloorRatios,
    FrictionResult,
    LevelResult,
    Mitigation,
    MitigationKind,
    Sides,
    Sliding,
    SolidResult,
    StrapForce,
    SurroundedResult,
)
from shaketable.assess.shares import Quartiles, Share, apart, is_worse
from shaketable.assess.straps import DAMPING, SLACKS, STIFFNESSES, STRAP_SHARE
from shaketable.assess.walls import Walls

__all__ = [
    "ACCEPTED_FALLS",
    "ANCHOR_SHARE",
    "BASE_GRID",
    "CLASSES",
    "DAMPING",
    "ENOUGH_RECORDINGS",
    "FEWEST_RECORDINGS",
    "FEW_FALLS",
    "FINER_BASES",
    "FRICTIONS",
    "LEADING",
    "MOST_TRIED",
    "NOT_CLASSED",
    "PREMISES",
    "REACHED",
    "ROLLS_FAR",
    "SLACKS",
    "STIFFNESSES",
    "STRAP_SHARE",
    "AnchorForce",
    "Assessment",
    "CastorFriction",
    "CriterionResult",
    "Direction",
    "FloorAssessment",
    "FloorRatios",
    "FrictionResult",
    "ItemResult",
    "Level",
    "LevelResult",
    "LevelSummary",
    "Mitigation",
    "MitigationKind",
    "PlaceFate",
    "Premises",
    "Profile",
    "ProfileResult",
    "Quartiles",
    "Share",
    "Sides",
    "Sliding",
    "SolidResult",
    "StrapForce",
    "SurroundedResult",
    "Walls",
    "Weights",
    "alike",
    "apart",
    "assess",
    "class_of",
    "fate_of",
    "is_worse",
    "widened",
]
