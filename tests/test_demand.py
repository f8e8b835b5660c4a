"""The friction that rocking asks for."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, Support, simulate
from shaketable.criteria.boroschek_romo_2004 import friction_needed
from shaketable.demand import friction_demand, largest_demand
from tests.support.builders import G


def test_a_body_that_rocks_freely_by_hand() -> None:
    """Released at rest at θ0 its corner feels R_x = -θ'' Y, R_y = g + θ'' X with θ' = 0."""
    body = Body.rectangle(0.5, 1.0)
    run = simulate(body, Motion(np.zeros(400), 0.01), initial_rotation=0.3)
    x = 0.25 * math.cos(0.3) - 0.5 * math.sin(0.3)
    y = -0.25 * math.sin(0.3) - 0.5 * math.cos(0.3)
    fall = -x * G / (body.gyration_radius**2 + x * x + y * y)
    assert friction_demand(run)[0] == pytest.approx(abs(-fall * y) / (G + fall * x))


def test_as_it_lifts_it_is_eq_25(p695: list[Motion]) -> None:
    """Boroschek and Romo (2004), eq. 25: under a jolt of A g the friction needed as it lifts."""
    body = Body.rectangle(0.3, 1.0)
    jolt = 0.6
    run = simulate(body, Motion(np.full(50, -jolt * G), 1e-4))
    gamma, kappa = 1.0 / 0.3, body.gyration_radius**2 / 0.15**2
    found = friction_demand(run)
    # the first sample that rocks is 0.1 ms after the uplift
    assert found[1] == pytest.approx(float(friction_needed(jolt, gamma, kappa)), rel=1e-3)


def test_with_more_friction_than_that_nothing_slides(p695: list[Motion]) -> None:
    """The general model slides with less and not with more; samples miss peaks by some per cent."""
    body = Body.rectangle(0.3, 1.2)
    tried = 0
    for motion in p695[:40:4]:
        run = simulate(body, motion, Support(tilt=0.02))
        needed = largest_demand(run)
        if not run.impacts or math.isinf(needed):
            continue
        tried += 1
        for factor, slides in ((1.1, False), (0.9, True)):
            model = General(static_friction=factor * needed)
            again = simulate(body, motion, Support(tilt=0.02), model=model)
            upright = np.abs(run.rotation) <= body.slenderness_left
            before = again.time < run.time[np.flatnonzero(upright)[-1]]
            assert bool((np.abs(again.slip[before]) > 1e-9).any()) == slides
    assert tried > 3


def test_what_falls_asks_for_all_the_friction_there_is_only_as_it_falls(p695: list[Motion]) -> None:
    """Beyond the corner the reaction tends to zero, and its direction says nothing more."""
    run = next(
        run
        for run in (simulate(Body.rectangle(0.1, 1.0), motion) for motion in p695)
        if run.outcome
    )
    assert largest_demand(run) < 2.0 < float(np.nanmax(friction_demand(run)))


def test_at_rest_nothing_is_asked_for() -> None:
    run = simulate(Body.rectangle(0.5, 0.5), Motion(np.full(10, 0.1), 0.01))
    assert largest_demand(run) == 0.0
    assert np.isnan(friction_demand(run)).all()


def test_a_run_that_slides_is_refused() -> None:
    run = simulate(Body.rectangle(0.5, 0.5), Motion(np.ones(10), 0.01), model=General())
    with pytest.raises(InputError, match="rocking model"):
        friction_demand(run)
