"""The tilt tool."""

from __future__ import annotations

import math

import numpy as np
import pytest
from statsmodels.stats.proportion import proportion_confint

from shaketable import Body, InputError, Motion, Outcome, Support, simulate_many
from shaketable.criteria.boroschek_iruretagoyena_2006 import gcor, scor
from shaketable.tilting import TiltDesign, design_tilt, shim_height, tilt_effect

CABINET = Body.rectangle(0.25, 1.0, name="cabinet")


@pytest.fixture(scope="module")
def motions(p695: list[Motion]) -> list[Motion]:
    return p695[:24]


@pytest.fixture(scope="module")
def design(motions: list[Motion]) -> TiltDesign:
    return design_tilt(CABINET, motions, progress=False)


def test_the_tilt_does_what_was_asked(design: TiltDesign, motions: list[Motion]) -> None:
    curves = design.curves
    assert 0.0 < curves.tilt_interval[0] < curves.tilt < curves.tilt_interval[1]
    assert (curves.control[curves.tilts > curves.tilt] >= 0.95).all()
    assert np.interp(curves.tilt, curves.tilts, curves.control) == pytest.approx(0.95, abs=1e-12)
    low, high = curves.falls_at_tilt_interval
    assert low < curves.falls_at_tilt < high
    assert float(gcor(design.gcor_tilt)) == pytest.approx(0.95)
    assert float(scor(design.scor_tilt, 0.25, 1.0)) == pytest.approx(0.95)
    assert (design.motions, design.recordings) == (24, 12)
    # level by symmetry, in every draw
    assert design.level.control == 0.5
    assert design.level.control_interval == (0.5, 0.5)
    assert design.level.likelier == 1.0


def test_effects_are_those_of_the_simulations(design: TiltDesign, motions: list[Motion]) -> None:
    effect = design.effect
    assert effect is not None
    outcome = simulate_many(
        [CABINET], motions, tilts=[design.curves.tilt], progress=False
    ).outcome.values
    falls, downhill = int((outcome != 0).sum()), int((outcome == Outcome.DOWNHILL).sum())
    assert (effect.falls, effect.downhill, effect.simulations) == (falls, downhill, 48)
    assert effect.control == downhill / falls
    assert effect.control_binomial == pytest.approx(
        proportion_confint(downhill, falls, method="wilson")
    )
    assert effect.likelier == pytest.approx(falls / design.level.falls)
    assert effect.likelier_interval[0] <= effect.likelier <= effect.likelier_interval[1]
    assert math.isnan(effect.slides_share)


def test_results_repeat_and_do_not_depend_on_the_order(motions: list[Motion]) -> None:
    once, again = (design_tilt(CABINET, motions, seed=3, progress=False) for _ in range(2))
    assert once.curves.tilt_interval == again.curves.tilt_interval
    assert (
        design_tilt(CABINET, motions[::-1], seed=3, progress=False).curves.tilt == once.curves.tilt
    )


def test_what_hardly_falls_and_what_no_curve_reaches(motions: list[Motion]) -> None:
    crate = design_tilt(Body.rectangle(0.8, 0.5), motions[:4], control=0.99, progress=False)
    assert math.isnan(crate.curves.tilt)
    assert crate.effect is None
    assert math.isinf(crate.gcor_tilt)  # above its limit of 98 %
    assert math.isnan(crate.level.control)


def test_friction(motions: list[Motion]) -> None:
    box = Body.rectangle(0.3, 0.5)
    slippery = Support(static_friction=0.2)
    effects = [
        tilt_effect(box, motions, tilt, model="general", support=slippery, progress=False)
        for tilt in np.radians([0.0, 6.0])
    ]
    assert effects[0].slides_share < effects[1].slides_share
    with pytest.raises(InputError, match=r"slides or falls by itself, 11.31°"):
        tilt_effect(box, motions, math.radians(12), model="general", support=slippery)


def test_shim() -> None:
    assert shim_height(0.4, math.radians(30)) == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"control": 0.5}, "control"),
        ({"scale": -1.0}, "scale"),
        ({"model": "x"}, "unknown model"),
        ({"motions": []}, "at least one motion"),
        ({"support": Support(tilt=0.1)}, "must be 0"),
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
