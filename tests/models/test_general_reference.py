"""The general model against an independent time-stepping (tests/time_stepping.py).

It has one coefficient of friction; that μ_k may be smaller is in the tests of Newmark's block, of
Boroschek and Iruretagoyena (2006) eqs. 9 and 10, of the initial modes, and of the laws of impact.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from benchmarks.time_stepping import Stepped, time_stepping

from shaketable import Response
from tests.support.pulses import Case, random_pulse

CASES = 30
STEP = 1e-5  # s: its error is of first order, some 1e-4 of a peak here
FINER = 10  # times, where the first comparison fails
WITHIN = 0.02  # the bound
# Below these a relative difference says nothing: 2 % of them are 1e-4 rad, 0.02 mm and 0.002 mm,
# what some steps of 10 μs at 1 m/s or 1 g amount to.
FLOORS = {"peak": 0.005, "slip": 1e-3, "lift": 1e-4}


def stepped(case: Case, run: Response, step: float) -> Stepped:
    end = run.overturning_time + 1.0 if run.outcome else run.time[-1] + 0.2
    return time_stepping(case, end, step)


def deviation(run: Response, expected: Stepped) -> float:
    """The largest relative difference of peak rotation, slip at the end and lift."""
    if run.outcome != expected.outcome:
        return math.inf
    # the slip of a body that stands; one that falls is somewhere on its way
    found = {"peak": run.peak_rotation, "slip": run.slip[-1], "lift": run.max_lift}
    if run.outcome:
        del found["slip"]
    return max(
        abs(value - getattr(expected, name)) / max(abs(getattr(expected, name)), FLOORS[name])
        for name, value in found.items()
    )


@pytest.mark.parametrize(
    ("cases", "seed"), [(CASES, 3), pytest.param(2000, 4, marks=pytest.mark.slow)]
)
def test_pulses(cases: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    outcomes, sliding, flying, bouncing, finer, unlike = set(), 0, 0, 0, 0, 0
    for _ in range(cases):
        case = random_pulse(rng)
        run = case.run()
        far = deviation(run, stepped(case, run, STEP))
        if far > WITHIN:  # is it the time-stepping that is too coarse?
            finer += 1
            unlike += deviation(run, stepped(case, run, STEP / FINER)) > WITHIN
        outcomes.add(int(run.outcome))
        sliding += run.peak_slip > 0.01
        flying += run.max_lift > 0.01
        bouncing += case.model.normal_restitution > 0.0 and run.impacts > 0
    assert outcomes == {-1, 0, 1}
    assert min(sliding, flying, bouncing) > 0.1 * cases
    # rarely: chaotic bounces, and speeds so large that a step is a long way
    assert finer <= 0.05 * cases
    # A body that lands all but flat, by 1e-6 rad, strikes with one corner first. A step in which
    # it falls farther than that strikes with both; of 1500 cases one did, at any practical step.
    assert unlike <= 0.002 * cases
