"""Boroschek and Iruretagoyena (2006)'s curves, as printed and as computed, and its uplift
acceleration."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, Support, simulate
from shaketable.criteria.boroschek_iruretagoyena_2006 import (
    C1,
    C1_OF_TABLE_2,
    controlled_rate,
    curve_error,
    gcor,
    outside_of_scor,
    scor,
    scor_c1,
    slide_acceleration,
    tilt_for,
    uplift_acceleration,
)
from tests.support.builders import TABLE_1, G

TILTS = np.radians(np.arange(0.0, 7.01, 0.5))
# Boroschek and Iruretagoyena (2006), table II [%]
TABLE_2 = [50, 59, 67, 75, 81, 85, 89, 92, 94, 95, 96, 97, 97, 97, 98]


def test_table_2_as_computed_and_as_printed() -> None:
    # theory, section 8: 0.046 gives all 15 entries, the printed 0.048 only 7
    assert np.array_equal(np.round(100 * controlled_rate(TILTS, C1_OF_TABLE_2)), TABLE_2)
    assert int((np.round(100 * gcor(TILTS)) == TABLE_2).sum()) == 7
    assert C1 == 0.048


def test_seven_degrees() -> None:
    # the abstract says more than 98 %, the printed equation gives 97.4 % (theory, section 8)
    assert float(gcor(math.radians(7.0))) == pytest.approx(0.974, abs=5e-4)
    assert float(gcor(10.0)) == pytest.approx(0.98, abs=1e-9)


def test_tilt_for_is_the_inverse() -> None:
    for control in (0.5, 0.6, 0.9, 0.95, 0.979):
        tilt = tilt_for(control, C1)
        assert float(gcor(tilt)) == pytest.approx(control, abs=1e-12)
    assert math.isinf(tilt_for(0.98, C1))
    assert math.isnan(tilt_for(0.9, -0.01))
    with pytest.raises(InputError, match="control"):
        tilt_for(0.4, C1)


def test_scor_by_hand() -> None:
    # eq. 13 for body 11 of table I: b/h = 0.2, r = 0.7649 m
    assert scor_c1(0.3, 1.5) == pytest.approx(0.1136 * 0.2 - 0.0283 * 0.76485 + 0.0279, abs=1e-6)
    assert float(scor(0.05, 0.3, 1.5)) == pytest.approx(
        0.48 * math.tanh(0.05 / scor_c1(0.3, 1.5)) + 0.5
    )
    # the bigger of two like shapes is easier to control
    assert float(scor(0.03, 0.3, 1.5)) > float(scor(0.03, 0.04, 0.2))


def test_scor_ends_with_large_bodies() -> None:
    assert scor_c1(0.36, 3.6) < 0.0
    assert np.isnan(scor(0.05, 0.36, 3.6))
    assert all(outside_of_scor(width, height) == [] for width, height in TABLE_1)
    said = outside_of_scor(0.36, 3.6)
    assert len(said) == 2
    assert "r [m] = 1.81 is outside 0.10 to 0.77" in said


def test_uplift_by_hand_and_by_simulation() -> None:
    body, tilt = Body.rectangle(0.25, 1.0, eccentricity=0.4), math.radians(3.0)
    downhill, uphill = uplift_acceleration(body, tilt)
    # eq. 1 for a symmetric body on a level support: b/h g
    assert uplift_acceleration(Body.rectangle(0.2, 1.0), 0.0)[0] == pytest.approx(0.2 * G)
    # tan(α - β) = (b/h - tan β)/(1 + b/h tan β), with 2 b_L/h_CG in place of b/h: 0.2
    lean = math.tan(tilt)
    assert downhill == pytest.approx(G * (0.2 - lean) / (1 + 0.2 * lean))
    for limit, sign in ((float(downhill), 1), (float(uphill), -1)):
        for part, moves in ((1 - 1e-9, False), (1 + 1e-9, True)):
            push = Motion(np.full(50, sign * limit * part), 0.01)
            assert (simulate(body, push, Support(tilt=tilt)).peak_rotation > 0.0) == moves


def test_slide_by_simulation() -> None:
    body, tilt, friction = Body.rectangle(0.5, 0.5), math.radians(5.0), 0.3
    support, model = Support(tilt=tilt), General(static_friction=friction)
    for limit, sign in zip(slide_acceleration(friction, tilt), (1, -1), strict=True):
        for part, moves in ((1 - 1e-9, False), (1 + 1e-6, True)):
            push = Motion(np.full(50, sign * float(limit) * part), 0.01)
            run = simulate(body, push, support, model=model)
            assert (run.peak_slip > 1e-9) == moves
    assert slide_acceleration(0.05, tilt)[0] < 0.0  # slides by itself
    assert slide_acceleration(20.0, math.radians(10.0))[1] == np.inf


def test_curve_error_by_hand() -> None:
    assert curve_error([0.5, 0.9], [0.5, 0.8]) == pytest.approx(0.1 / math.sqrt(0.25 + 0.64))
    assert curve_error([0.5, np.nan], [0.4, 0.8]) == pytest.approx(0.25)
