"""What the page of a calibration says, in numbers and sentences."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import Motion
from shaketable.calibration import ShakeTest
from shaketable.report.calibration import _in_digits, foreseen, joined_by_or


@pytest.mark.parametrize(
    ("probability", "shown"),
    [
        (0.0, "0.00"),
        (1e-9, "<0.01"),
        (0.006, "0.01"),
        (0.5, "0.50"),
        (0.9999, ">0.99"),
        (1.0, "1.00"),
    ],
)
def test_what_is_not_quite_certain_is_not_told_as_if_it_were(
    probability: float, shown: str
) -> None:
    assert _in_digits(probability) == shown


def test_what_is_open_is_named_the_most_open_first() -> None:
    motion = Motion(np.zeros(3), 0.01)
    tests = [ShakeTest(name=name, motion=motion) for name in "abcde"]
    said = foreseen(tests, np.array([0.01, 0.99, 0.3, 0.55, 0.0]))
    assert said == (
        "Of 5 tests to predict the probability of a fall is below 5 % in 2 and above 95 % in 1; "
        "2 are open (d 0.55, c 0.30)."
    )


def test_names_in_a_row() -> None:
    assert joined_by_or(["a"]) == "a"
    assert joined_by_or(["a", "b", "c"]) == "a, b or c"
