"""The tilt tool."""

from __future__ import annotations

import math

import numpy as np
import pytest
from statsmodels.stats.proportion import proportion_confint

from shaketable import Body, General, InputError, Motion, Outcome, simulate_many
from shaketable.criteria.boroschek_iruretagoyena_2006 import gcor, scor
from shaketable.tilting import TiltDesign, design_tilt, shim_height, tilt_effect

CABINET = Body.rectangle(0.25, 1.0, name="cabinet")


@pytest.fixture(scope="module")
def motions(p695: list[Motion]) -> list[Motion]:
    return p695[:24]


@pytest.fixture(scope="module")
def design(motions: list[Motion]) -> TiltDesign:
    return design_tilt(CABINET, motions, progress=False)


def test_the_tilt_does_what_was_asked(design: TiltDesign) -> None:
    curves, tilt = design.curves, design.curves.control_tilt
    assert 0.0 < curves.control_tilt_interval[0] < tilt < curves.control_tilt_interval[1]
    # the smallest tried from which on the share is kept, so that it does what was asked
    assert (curves.downhill_share[curves.tilts >= tilt] >= 0.95).all()
    assert curves.downhill_share[curves.tilts < tilt][-1] < 0.95
    assert design.effect is not None
    assert design.effect.downhill_share >= 0.95
    low, high = curves.fall_share_there_interval
    assert low < curves.fall_share_there == design.effect.fall_share < high
    assert float(gcor(design.gcor_tilt)) == pytest.approx(0.95)
    assert float(scor(design.scor_tilt, 0.25, 1.0)) == pytest.approx(0.95)
    assert (design.motion_count, design.recording_count) == (24, 12)
    # level by symmetry, in every draw
    assert design.level.downhill_share == 0.5
    assert design.level.downhill_interval == (0.5, 0.5)
    assert design.level.likelier == 1.0


def test_effects_are_those_of_the_simulations(design: TiltDesign, motions: list[Motion]) -> None:
    effect = design.effect
    assert effect is not None
    outcome = simulate_many([CABINET], motions, tilts=[effect.tilt], progress=False).outcome
    # twelve recordings of two components: each is one experiment
    fallen = (outcome.values.reshape(12, -1) != 0).any(axis=1).sum()
    outcome = outcome.values
    falls, downhill = int((outcome != 0).sum()), int((outcome == Outcome.DOWNHILL).sum())
    assert (effect.falls, effect.downhill, effect.simulations) == (falls, downhill, 48)
    assert effect.downhill_share == downhill / falls
    assert effect.downhill_binomial == pytest.approx(
        proportion_confint(downhill / falls * fallen, fallen, method="wilson")
    )
    assert effect.likelier == pytest.approx(falls / design.level.falls)
    assert effect.likelier_interval[0] <= effect.likelier <= effect.likelier_interval[1]
    assert math.isnan(effect.slides_share)


def test_results_repeat_and_do_not_depend_on_the_order(motions: list[Motion]) -> None:
    once, again = (design_tilt(CABINET, motions, seed=3, progress=False) for _ in range(2))
    assert once.curves.control_tilt_interval == again.curves.control_tilt_interval
    reverse = design_tilt(CABINET, motions[::-1], seed=3, progress=False)
    assert reverse.curves.control_tilt == once.curves.control_tilt


def test_what_hardly_falls_and_what_no_curve_reaches(motions: list[Motion]) -> None:
    crate = design_tilt(Body.rectangle(0.8, 0.5), motions[:4], control=0.99, progress=False)
    assert math.isnan(crate.curves.control_tilt)
    assert crate.effect is None
    assert math.isinf(crate.gcor_tilt)  # above its limit of 98 %
    assert math.isnan(crate.level.downhill_share)
    # 0 of 2 recordings: z²/(n + z²) = 0.658 by Wilson (1927), z = 1.96
    assert crate.level.fall_share_interval == pytest.approx((0.0, 0.658), abs=0.001)


def test_no_interval_of_a_tilt_where_too_few_fall_to_tell(motions: list[Motion]) -> None:
    # 12 falls of 48: in many draws some tilt has none
    squat = design_tilt(Body.rectangle(0.5, 1.0), motions, scale=1.6, progress=False)
    falls = squat.level.falls
    assert falls < 12
    assert math.isnan(squat.curves.control_tilt_interval[0])


def test_friction(motions: list[Motion]) -> None:
    box = Body.rectangle(0.3, 0.5)
    slippery = General(static_friction=0.2)
    effects = [
        tilt_effect(box, motions, tilt, model=slippery, progress=False)
        for tilt in np.radians([0.0, 6.0])
    ]
    assert effects[0].slides_share < effects[1].slides_share
    with pytest.raises(InputError, match=r"take one below 11.06° or more friction"):
        tilt_effect(box, motions, math.radians(12), model=slippery)


def test_shim() -> None:
    assert shim_height(0.4, math.radians(30)) == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"control": 0.5}, "control"),
        ({"scale": -1.0}, "scale"),
        ({"model": "x"}, "unknown model"),
        ({"motions": []}, "motions= is empty"),
    ],
)
def test_bad_input(change: dict, message: str, motions: list[Motion]) -> None:
    given = {"motions": motions[:1], "progress": False, **change}
    with pytest.raises(InputError, match=message):
        design_tilt(CABINET, given.pop("motions"), **given)


def test_a_tilt_on_which_it_falls(motions: list[Motion]) -> None:
    with pytest.raises(InputError, match="falls by itself"):
        tilt_effect(CABINET, motions, math.radians(20.0), progress=False)
    with pytest.raises(InputError, match="tilt"):
        tilt_effect(CABINET, motions, -0.1, progress=False)


def test_a_tilt_too_near_to_the_one_on_which_it_falls(
    motions: list[Motion],
) -> None:
    body = Body.rectangle(0.1, 1.0)  # stands up to atan 0.1 = 5.71°
    with pytest.raises(InputError, match=r"on which it falls by itself: take one below 5.461°"):
        tilt_effect(
            body,
            motions,
            math.radians(5.6),
            progress=False,
        )
