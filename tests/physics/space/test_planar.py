"""The plane as a special case of three dimensions."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import Body, General, Motion, Outcome, Solid, Support, simulate
from tests.support.recorded import random_case

NEAR = 1e-9  # of the width
PEAK, SLIP = 1e-4, 1e-4  # rad, m: what the planar model's solid has to reach
SLIP_SHARE = 1e-3  # of the slip: hundreds of small bounces, which it gives up a little earlier


def compare(body: Body, depth: float, motion: Motion, support: Support, model: General) -> None:
    """The solid does what the planar body does."""
    planar = simulate(body, motion, support, model=model)
    solid = Solid.box(
        body.base, depth, 2 * body.cg_height, eccentricity=(body.left / body.base, 0.5)
    )
    found = simulate(solid, motion, support, model=model)
    assert found.outcome is planar.outcome
    assert found.peak_rotation == pytest.approx(planar.peak_rotation, abs=PEAK)
    if planar.outcome is Outcome.STANDING:
        assert found.displacement_x == pytest.approx(planar.slip[-1], abs=SLIP, rel=SLIP_SHARE)
        assert abs(found.displacement_y) < SLIP
    else:
        assert abs(math.sin(found.fall_azimuth)) < 1e-3
        assert found.overturning_time == pytest.approx(planar.overturning_time, abs=1e-3)


def pulse_case(seed: int) -> tuple[Body, float, Motion, Support, General]:
    """A pulse of three cycles and a vertical one; half of them with restitution."""
    rng = np.random.default_rng(seed)
    t = np.arange(1000) * 0.01
    width = rng.uniform(0.15, 0.6)
    height, mu = width * rng.uniform(1.5, 6), rng.uniform(0.1, 1.0)
    restitution = 0.0 if seed % 2 == 0 else rng.uniform(0, 0.3)
    share = rng.uniform(0.35, 0.65)
    tilt = rng.choice([0.0, rng.uniform(0, 0.3 * min(2 * share * width / height, mu))])
    size = rng.uniform(0.5, 2.0) * 9.81 * min(width / height, mu)
    rate = rng.uniform(0.5, 3)
    push = np.sin(2 * np.pi * rate * t) * np.exp(-(((t - 2) / 1.5) ** 2))
    push = size * (push + 0.3 * np.sin(7 * rate * t)) * (t < 6)
    above = 0.2 * size * np.sin(13 * t) * (t < 6)
    return (
        Body.rectangle(width, height, eccentricity=share),
        float(rng.uniform(0.1, 0.5)),
        Motion(push, 0.01, vertical=above),
        Support(tilt=tilt),
        General(static_friction=mu, normal_restitution=restitution),
    )


def well_conditioned(body: Body, motion: Motion, support: Support, model: General) -> bool:
    """Whether a width that is larger by 1e-9 changes the peak, or the time of the fall, by little.

    By less than the tolerance for an error of 1e-7, which is more than what the solid's steps,
    accepted at errors of 1e-9, and its slower settling bring in.
    """
    near = replace(body, base=body.base * (1 + NEAR))
    one, other = (simulate(b, motion, support, model=model) for b in (body, near))
    change = abs(one.peak_rotation - other.peak_rotation)
    if one.outcome is not Outcome.STANDING:
        change = abs(one.overturning_time - other.overturning_time)
    return one.outcome is other.outcome and change / NEAR * 1e-7 < PEAK


@pytest.mark.parametrize("seed", range(24))
def test_pulses(seed: int) -> None:
    compare(*pulse_case(seed))


@pytest.mark.slow
def test_three_hundred_recorded_cases(p695: list[Motion]) -> None:
    """Friction 0.2 to 1, e = 0 and 0.2; those compared that are well conditioned."""
    rng = np.random.default_rng(20)
    compared = 0
    for case in range(300):
        body, motion, support = random_case(rng, p695)
        mu = rng.uniform(0.2, 1.0)
        model = General(static_friction=mu, normal_restitution=0.2 * (case % 2))
        if mu < math.tan(support.tilt) or not well_conditioned(body, motion, support, model):
            continue
        compare(body, float(rng.uniform(0.1, 0.6)), motion, support, model)
        compared += 1
    assert compared > 250


def test_with_much_friction_it_does_what_the_rocking_model_does() -> None:
    """e_n = 0 and no slip: the rocking model, in x and, turned by 90°, in y."""
    t = np.arange(800) * 0.01
    push = 3.5 * np.sin(2 * np.pi * 1.2 * t) * np.exp(-t / 2)
    body = Body.rectangle(0.3, 1.2)
    planar = simulate(body, Motion(push, 0.01), model="rocking")
    assert planar.outcome is Outcome.STANDING
    along = simulate(Solid.box(0.3, 0.5, 1.2), Motion(push, 0.01), model=General())
    across = simulate(
        Solid.box(0.5, 0.3, 1.2), Motion(0 * push, 0.01, transverse=push), model=General()
    )
    n = planar.rotation.size
    for found in (along, across):
        assert found.peak_rotation == pytest.approx(planar.peak_rotation, abs=1e-7)
        m = min(n, found.nutation.size)
        # below 1e-4 m/s a base is laid flat, at 1e-4 / 0.3 rad/s
        assert found.nutation[:m] == pytest.approx(np.abs(planar.rotation[:m]), abs=1e-5)


@pytest.mark.parametrize(("height", "amplitude"), [(1.0, 4.0), (1.5, 3.0), (0.6, 8.0)])
def test_what_cannot_slide_falls_as_the_rocking_model_does(height: float, amplitude: float) -> None:
    """Its side would be pulled before it lies, and neither leaves nor slips: it turns on about it.

    Times are those of integrations with a tolerance of 1e-9.
    """
    t = np.arange(400) * 0.01
    motion = Motion(amplitude * np.sin(2 * np.pi * t / 0.8) * (t < 0.8), 0.01)
    planar = simulate(Body.rectangle(0.3, height), motion, model="rocking")
    found = simulate(Solid.box(0.3, 0.9, height), motion, model=General(static_friction=math.inf))
    assert found.overturning_time == pytest.approx(planar.overturning_time, abs=1e-8)
    assert found.impacts == planar.impacts == 1
    assert found.fallbacks == 0
