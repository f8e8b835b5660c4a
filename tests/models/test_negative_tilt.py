"""A support that falls toward +x is the mirrored problem: said once, and held to here."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from shaketable import (
    Body,
    General,
    Motion,
    Outcome,
    Phase,
    Rocking,
    Support,
    simulate,
    simulate_many,
)
from shaketable.criteria import gcor, slide_acceleration, uplift_acceleration
from shaketable.drawing.film import _draw_scene
from tests.support.builders import mirrored

BODY = Body.rectangle(0.25, 1.0, eccentricity=0.46)
MODELS = [Rocking(), General(static_friction=0.35, kinetic_friction=0.3, normal_restitution=0.1)]


@pytest.mark.parametrize("model", MODELS, ids=["rocking", "general"])
@pytest.mark.parametrize("scale", [0.6, 1.2])
def test_one_is_the_mirrored_one(
    model: Rocking | General, scale: float, p695: list[Motion]
) -> None:
    vertical = 0.4 * p695[1].horizontal[:2900]
    motion = Motion(p695[0].horizontal[:2900], 0.01, vertical=vertical).scaled(scale)
    run = simulate(BODY, motion, Support(tilt=0.03), model=model)
    other = simulate(mirrored(BODY), motion.reversed(), Support(tilt=-0.03), model=model)
    assert other.outcome == run.outcome  # downhill of its own tilt
    # the mirrored body's left corner is given to round-off
    assert other.peak_rotation == pytest.approx(run.peak_rotation, rel=1e-6)
    count = min(run.time.size, 600)
    assert other.rotation[:count] == pytest.approx(-run.rotation[:count], abs=1e-8)
    assert other.slip[:count] == pytest.approx(-run.slip[:count], abs=1e-8)
    assert other.position[:count, 0] == pytest.approx(-run.position[:count, 0], abs=1e-8)


@pytest.mark.parametrize("model", MODELS, ids=["rocking", "general"])
def test_many_are_the_mirrored_many(model: Rocking | General, p695: list[Motion]) -> None:
    motions, body = p695[:6], Body.rectangle(0.25, 1.0)  # symmetric: mirrored to the bit
    runs = simulate_many(
        [body], motions, tilts=[0.05, -0.05], scales=[1.3], model=model, progress=False
    )
    right, left = runs.isel(tilt=0), runs.isel(tilt=1)
    reversed_left = left.sel(polarity=[-1, 1])
    assert np.array_equal(right.outcome.values, reversed_left.outcome.values)
    assert (right.outcome == Outcome.DOWNHILL).sum() > (right.outcome == Outcome.UPHILL).sum()
    if model.slides:
        down, up = right.slip_downhill.values, right.slip_uphill.values
        assert down == pytest.approx(reversed_left.slip_downhill.values, abs=1e-9)
        assert up == pytest.approx(reversed_left.slip_uphill.values, abs=1e-9)
        assert right.displacement_x.values == pytest.approx(
            -reversed_left.displacement_x.values, abs=1e-9
        )
        assert down.max() > 0.0


def test_a_needle_falls_downhill_of_either_tilt() -> None:
    needle = Body.rectangle(0.1, 1.0)
    for tilt, side in ((0.05, -1.0), (-0.05, 1.0)):
        # the ground runs away uphill
        push = Motion(np.full(60, -side * 1.2), 0.01)
        run = simulate(needle, push, Support(tilt=tilt))
        assert run.outcome is Outcome.DOWNHILL
        assert np.sign(run.rotation[-1]) == side  # rotation keeps its sign in x


def test_what_rests_on_no_tilt_moves_at_once() -> None:
    slippery = General(static_friction=0.1)
    quiet = Motion(np.zeros(40), 0.01)
    for tilt in (0.2, -0.2):
        run = simulate(Body.rectangle(1.0, 1.0), quiet, Support(tilt=tilt), model=slippery)
        assert np.sign(run.slip[-1]) == -np.sign(tilt)
        many = simulate_many(
            [Body.rectangle(1.0, 1.0)], [quiet], tilts=[tilt], model=slippery, progress=False
        )
        assert many.displacement_x.values.ravel() == pytest.approx(run.slip[-1], rel=1e-9)
        assert (many.slip_downhill > 0.0).all()


def test_phases_are_named_as_the_tilt_has_it() -> None:
    slippery, quiet = General(static_friction=0.1), Motion(np.zeros(40), 0.01)
    for tilt in (0.2, -0.2):
        run = simulate(Body.rectangle(1.0, 1.0), quiet, Support(tilt=tilt), model=slippery)
        assert run.phases[0] is Phase.SLIDE_DOWNHILL


def test_the_published_curves_and_limits_are_mirrored() -> None:
    tilt = np.radians([1.0, 4.0])
    assert np.array_equal(gcor(-tilt), gcor(tilt))
    for mine, other in zip(
        uplift_acceleration(mirrored(BODY), -tilt), uplift_acceleration(BODY, tilt), strict=True
    ):
        assert mine == pytest.approx(other, rel=1e-13)
    assert np.array_equal(slide_acceleration(0.3, -tilt), slide_acceleration(0.3, tilt))


def test_a_film_shows_the_whole_scene() -> None:
    push = Motion(np.r_[np.full(30, 4.0), np.zeros(60)], 0.01)
    limits = []
    for tilt, motion in ((0.2, push), (-0.2, push.reversed())):
        run = simulate(
            Body.rectangle(1.0, 1.0),
            motion,
            Support(tilt=tilt),
            model=General(static_friction=0.25),
        )
        poses = np.column_stack([run.position, run.rotation])
        scene = Figure().subplots()
        _draw_scene(run, poses, scene)
        limits.append(scene.get_ylim())
    assert abs(run.slip).max() > 0.05
    assert limits[0] == pytest.approx(limits[1], rel=1e-9)
