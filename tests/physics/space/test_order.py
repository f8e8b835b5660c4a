"""The error falls with the tolerance of the steps, across landings and impacts."""

from __future__ import annotations

import math

import pytest

from shaketable.models.solid_input import TOLERANCE
from tests.support.solid_order import TOLERANCES, cases, ended, errors


@pytest.mark.parametrize("name", ["rolls on its rim", "impacts"])
def test_order_of_convergence(name: str) -> None:
    """Dormand & Prince's pair is of order 5: ten times the steps, 100,000 times less error.

    Events are found in the steps and must not lower it. Between 1e-8, from which on the steps are
    no longer those of the samples alone, and 1e-12 errors fall by 4 decades with the tolerance.
    """
    found = {tolerance: (error, steps) for tolerance, error, steps in errors(cases()[name])}
    (coarse, few), (fine, many) = found[1e-8], found[1e-12]
    assert math.log(coarse / fine) / math.log(many / few) > 4.5
    for tolerance, (error, _) in found.items():
        # the state's numbers are about 1 in SI; what a step leaves grows by an order or two
        assert error < 100 * max(tolerance, 1e-12)
    assert found[TOLERANCE][0] < 1e-8


def test_the_end_of_a_slip_is_known_to_nanometres() -> None:
    """Where a slip ends it is stopped below a speed, and not before: some nm a stop, no more.

    It does that with any tolerance from the default one on; two slips end in this case.
    """
    for tolerance, error, _ in errors(cases()["sticks and slips"]):
        if tolerance <= 1e-9:
            assert error < 1e-8
    assert min(TOLERANCES) < 1e-11


def test_the_cases_do_what_their_names_say() -> None:
    known = cases()
    assert ended(known["sticks and slips"], TOLERANCE).found.events > 4
    assert ended(known["impacts"], TOLERANCE).found.impacts > 10
    assert ended(known["rolls on its rim"], TOLERANCE).found.peak > 0.1
