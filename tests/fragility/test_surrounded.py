"""Fragility functions, incremental dynamic analysis and tilts of what stands among things."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import (
    Body,
    Edge,
    General,
    InputError,
    Motion,
    Solid,
    Strap,
    Surroundings,
    Wall,
    fragility,
    ida,
    simulate_each,
    simulate_many,
)
from shaketable.fragility.exported import demand_of
from shaketable.tilting import design_tilt, tilt_effect

G = 9.80665
BODY = Body.rectangle(0.3, 1.5, mass=80.0, name="shelf")
MODEL = General(static_friction=0.6)
WALL = Surroundings(walls=(Wall(gap=0.01, restitution=0.3),))
BACK = Surroundings(walls=(Wall(vertical=False, restitution=0.3),))


def motions(count: int) -> list[Motion]:
    """Waves of random phases, each of a recording of its own."""
    rng = np.random.default_rng(1)
    t = 0.02 * np.arange(500)
    found = []
    for k in range(count):
        wave = np.sum(
            [
                np.sin(2 * math.pi * f * t + rng.uniform(0, 6.3))
                for f in rng.uniform(0.5, 2.0, 6)
            ],
            axis=0,
        ) * np.sin(math.pi * t / t[-1])  # fmt: skip
        found.append(Motion(1.6 * wave / np.abs(wave).max() * G / 9.81, 0.02, name=f"wave {k}"))
    return found


@pytest.fixture(scope="module")
def shaking() -> list[Motion]:
    return motions(6)


@pytest.mark.filterwarnings("ignore")
def test_a_wall_changes_fragility_as_it_changes_its_simulations(shaking: list[Motion]) -> None:
    scales = [0.5, 1.0, 2.0, 4.0]
    given = {"scales": scales, "model": MODEL, "draws": 20, "surroundings": WALL}
    found = fragility(BODY, shaking, measure="PGA", **given)  # type: ignore[arg-type]
    free = fragility(BODY, shaking, measure="PGA", scales=scales, model=MODEL, draws=20)
    runs = simulate_many(
        [BODY], shaking, scales=scales, model=MODEL, surroundings=WALL, progress=False
    )
    fell = (runs.outcome.values != 0).sum()
    assert sum(found.curve.falls or ()) == fell
    assert sum(free.curve.falls or ()) > fell
    assert found.surroundings == (WALL,)
    assert "surrounded by Surroundings(walls=(Wall(azimuth=0.0, gap=0.01" in demand_of(found)
    assert "surrounded" not in demand_of(free)
    again = fragility(BODY, shaking, measure="PGA", runs=runs, model=MODEL, draws=20,
                      surroundings=WALL)  # fmt: skip
    assert again.curve.falls == found.curve.falls
    with pytest.raises(InputError, match="runs= were simulated with surroundings=Surroundings"):
        fragility(BODY, shaking, measure="PGA", runs=runs, model=MODEL, draws=20)
    stripes = fragility(
        BODY, shaking, measure="PGA", method="stripes", levels=[2.0, 4.0], model=MODEL, draws=20,
        surroundings=WALL,
    )  # fmt: skip
    assert stripes.surroundings == (WALL,)


@pytest.mark.filterwarnings("ignore")
def test_the_lowest_level_that_overturns_is_one_that_does(shaking: list[Motion]) -> None:
    """Beside a wall, and over an edge, to which it slides at less than what tips it."""
    box = Body.rectangle(0.4, 0.4, name="box")
    slippery = General(static_friction=0.15)
    for body, around, model in (
        (BODY, WALL, MODEL),
        (box, Surroundings(edge=Edge(at=0.21)), slippery),
    ):
        found = ida(body, shaking[1:2], "PGA", model=model, surroundings=around, precision=0.04,
                    multiple=14.0)  # fmt: skip
        scale = found.scale.isel(body=0).values
        assert np.isfinite(scale).all()
        for share, falls in ((1.0, True), (1 / 1.08, False)):
            runs = simulate_each(
                body, shaking[1:2] * 2, scales=share * scale.ravel(), polarities=[1, -1],
                model=model, surroundings=around, progress=False,
            )  # fmt: skip
            assert ((runs.outcome.values != 0) == falls).all()
    assert scale.min() * 1.6 < 0.6 * G  # it tips from a_x = g on


def test_a_body_falls_away_from_the_back_of_its_tilted_shelf(shaking: list[Motion]) -> None:
    loud = [motion.scaled(3.0) for motion in shaking]
    tilt = math.radians(2.0)
    behind = Surroundings(walls=(Wall(azimuth=math.pi, vertical=False, restitution=0.3),))
    free = tilt_effect(BODY, loud, tilt, model=MODEL, progress=False)
    caught = tilt_effect(BODY, loud, tilt, model=MODEL, surroundings=behind, progress=False)
    assert free.downhill > 0
    assert caught.downhill == 0  # the wall is downhill
    assert caught.falls < free.falls
    assert (
        design_tilt(BODY, loud[:3], model=MODEL, surroundings=BACK, progress=False).level.falls
        <= design_tilt(BODY, loud[:3], model=MODEL, progress=False).level.falls
    )


def test_what_surrounds_a_solid_is_turned_with_it() -> None:
    """A wall toward its x stays there, however it is turned to the motion."""
    strap = Strap(point=(0.1, 0.0, 1.0), anchor=(0.3, 0.1, 1.0), stiffness=1e4)
    turned = Surroundings(walls=(Wall(azimuth=0.2),), straps=(strap,)).turned(math.pi / 2)
    assert turned.walls[0].azimuth == pytest.approx(0.2 + math.pi / 2)
    assert turned.straps[0].anchor == pytest.approx((-0.1, 0.3, 1.0))
    assert turned.straps[0].point == strap.point
    t = 0.02 * np.arange(150)
    motion = Motion(5.0 * np.sin(5.0 * t) * np.sin(math.pi * t / 3.0), 0.02, name="one")
    solid = Solid.box(0.3, 0.3, 1.5)
    behind = Surroundings(walls=(Wall(azimuth=math.pi, vertical=False),))
    effect = tilt_effect(solid, [motion], math.radians(2), surroundings=behind, progress=False)
    free = tilt_effect(solid, [motion], math.radians(2), progress=False)
    assert effect.downhill < free.downhill
