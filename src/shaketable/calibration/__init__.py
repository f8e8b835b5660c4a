"""Bodies that are not known exactly: ensembles, and their weights from shake-table tests.

A planar simulation of one body is a matter of luck near the limit of falling: rocking is chaotic.
What can be predicted is a probability, from many bodies that may be the one in question (theory,
section 10).
"""

from shaketable.calibration.calibrate import Calibration, Predicted, calibrate
from shaketable.calibration.prior import PARAMETERS, BodyEnsemble, Prior, Range
from shaketable.calibration.prior_file import read_prior
from shaketable.calibration.scores import Reliability, Scores, brier_difference, reliability, scores
from shaketable.calibration.shake_tests import ShakeTest, ordered_by_number, read_tests
from shaketable.calibration.uncertainty import (
    Probability,
    Uncertainty,
    overturning_probability,
)

__all__ = [
    "PARAMETERS",
    "BodyEnsemble",
    "Calibration",
    "Predicted",
    "Prior",
    "Probability",
    "Range",
    "Reliability",
    "Scores",
    "ShakeTest",
    "Uncertainty",
    "brier_difference",
    "calibrate",
    "ordered_by_number",
    "overturning_probability",
    "read_prior",
    "read_tests",
    "reliability",
    "scores",
]
