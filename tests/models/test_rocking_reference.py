"""The rocking model against an independent integrator (tests/reference.py)."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, Motion, Response, Rocking, Support, simulate
from tests.support.recorded import WELL_CONDITIONED, conditioning, random_case
from tests.support.reference import G, integrate

CASES = 8


@pytest.mark.parametrize(
    ("cases", "seed"), [(CASES, 20261121), pytest.param(1000, 1, marks=pytest.mark.slow)]
)
def test_recorded_motions(p695: list[Motion], cases: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    compared, left_out, outcomes = 0, 0, set()
    while compared < cases:
        body, motion, support = random_case(rng, p695)
        run = simulate(body, motion, support)
        if run.peak_rotation == 0.0:
            continue
        if conditioning(body, motion, support) > WELL_CONDITIONED:
            left_out += 1
            continue
        compared += 1
        expected = integrate(body, motion, support.tilt)
        assert run.outcome == expected.outcome
        # the issue asks for 1e-8; DOP853 at rtol 1e-13 is good for this
        assert run.peak_rotation == pytest.approx(expected.peak, abs=1e-9)
        if run.outcome:
            # where θ' is small when the balance point is passed, time is worse conditioned
            assert run.overturning_time == pytest.approx(expected.overturning_time, abs=1e-6)
        outcomes.add(int(run.outcome))
    assert outcomes == {-1, 0, 1}
    # a fifth at most, and two deviations of a binomial share where the cases are few
    assert left_out < 0.2 * compared + 2.0 * math.sqrt(0.2 * 0.8 * compared)


@pytest.mark.parametrize("kept", [0.3, 0.9])
@pytest.mark.parametrize("theta0", [0.13, -0.2])
def test_released_with_a_given_restitution(p695: list[Motion], kept: float, theta0: float) -> None:
    body = Body.rectangle(0.4, 1.2, eccentricity=0.45)
    motion = p695[3].scaled(0.4)
    run = simulate(
        body,
        motion,
        Support(tilt=0.02),
        model=Rocking(restitution=kept),
        initial_rotation=theta0,
    )
    expected = integrate(body, motion, 0.02, kept=kept, theta0=theta0)
    assert run.outcome == expected.outcome
    assert run.peak_rotation == pytest.approx(expected.peak, abs=1e-9)
    first = expected.impact_times[:3]
    assert run.impact_times[: len(first)] == pytest.approx(first, abs=1e-9)


def test_several_impacts_in_one_sample() -> None:
    # A coarse record: two samples a second, and dozens of bounces between them.
    body = Body.rectangle(0.3, 0.8)
    motion = Motion(np.array([0.0, 4.2, -3.0, 2.0, 0.0, 0.0]), 0.5)
    run = simulate(body, motion)
    expected = integrate(body, motion)
    assert run.outcome == expected.outcome
    assert run.peak_rotation == pytest.approx(expected.peak, abs=1e-9)
    shared = min(run.impacts, 12)
    assert run.impact_times[:shared] == pytest.approx(expected.impact_times[:shared], abs=1e-9)
    assert np.bincount((run.impact_times / 0.5).astype(int)).max() >= 3


@pytest.mark.parametrize("seed", range(4))
def test_squat_bodies_and_small_rotations(p695: list[Motion], seed: int) -> None:
    # where hardly more than the last bounces is left of the motion, peaks count all the same
    rng = np.random.default_rng(seed)
    compared = 0
    while compared < 5:
        height = rng.uniform(0.2, 1.0)
        body = Body.rectangle(
            height * rng.uniform(0.4, 1.6), height, eccentricity=rng.uniform(0.4, 0.6)
        )
        motion = p695[rng.integers(len(p695))]
        peak = motion.peak_ground_acceleration
        needed = G * math.tan(min(body.slenderness_left, body.slenderness_right))
        motion = motion.scaled(needed / peak * rng.uniform(1.01, 1.4))
        run = simulate(body, motion)
        if run.peak_rotation == 0.0 or conditioning(body, motion, Support()) > WELL_CONDITIONED:
            continue
        compared += 1
        expected = integrate(body, motion)
        assert run.outcome == expected.outcome
        assert run.peak_rotation == pytest.approx(expected.peak, abs=1e-9)


@pytest.mark.parametrize(
    ("width", "horizontal", "vertical", "step"),
    [
        # the moment is zero at a sample and rises: 0.25 g and, with nothing pressing, none at all
        (0.25, [None, 8, 0, 0, 0, 0], [0] * 6, 0.1),
        (0.30, [None, 8, 0, 0, 0, 0], [0] * 6, 0.1),
        (0.20, [0, 0, 5, 5, 0, 0], [-G, -G, 0, 0, 0, 0], 0.1),
        (0.20, [0, 0, 5, 5, 0, 0], [0, -G, -G, 0, 0, 0], 0.3),
    ],
)
def test_lifts_at_a_sample_to_the_bit(
    width: float, horizontal: list, vertical: list[float], step: float
) -> None:
    body = Body.rectangle(width, 1.0)
    threshold = G * math.tan(body.slenderness_left)
    # the float at which the moment vanishes, and its neighbours
    for nudge in (0.0, 1e-15, -1e-15, 4e-16, -4e-16):
        a = [threshold * (1 + nudge) if value is None else value for value in horizontal]
        motion = Motion(np.array(a, float), step, vertical=np.array(vertical, float))
        run, expected = simulate(body, motion), integrate(body, motion)
        assert run.outcome == expected.outcome
        assert run.peak_rotation == pytest.approx(expected.peak, abs=1e-9)
        if run.outcome:
            assert run.overturning_time == pytest.approx(expected.overturning_time, abs=1e-6)


def test_two_turns_in_one_sample() -> None:
    # The push reverses within a sample of a body that hangs at the top of its rotation: it turns
    # down, up and down again, and its peak is the third turn (found among random bodies).
    rng = np.random.default_rng(5)
    found = 0
    for _ in range(2000):
        height = rng.uniform(0.05, 2)
        body = Body.rectangle(
            height * rng.uniform(0.1, 2.5), height, eccentricity=rng.uniform(0.3, 0.7)
        )
        motion = Motion(rng.normal(size=60) * rng.uniform(2, 30), rng.choice([0.01, 0.02, 0.05]))
        coarse = simulate(body, motion)
        at = np.arange(59 * 8 + 1) / 8
        fine = simulate(
            body, Motion(np.interp(at, range(60), motion.horizontal), motion.time_step / 8)
        )
        assert coarse.outcome == fine.outcome
        if conditioning(body, motion, Support()) < WELL_CONDITIONED:
            found += 1
            assert coarse.peak_rotation == pytest.approx(fine.peak_rotation, abs=1e-8)
    assert found > 1000


def test_grazing_impact() -> None:
    # Let go at 0.05 rad, caught by a push just before it lands. The push at which it just
    # touches is found to round-off; on either side of it the run must be the same.
    body = Body.rectangle(0.3, 1.2)

    def run(level: float) -> Response:
        return simulate(body, caught(level), initial_rotation=0.05)

    def caught(level: float) -> Motion:
        samples = np.zeros(60)
        samples[5:25] = -level * 9.80665 * 0.25
        return Motion(samples, 0.02)

    def touches(level: float) -> bool:
        times = run(level).impact_times
        return bool(times.size and times[0] < 0.45)

    low, high = 0.5, 3.0
    assert touches(low)
    assert not touches(high)
    while high - low > 1e-14:
        middle = (low + high) / 2
        low, high = (middle, high) if touches(middle) else (low, middle)
        if middle in (low, high) and high - low < 1e-13:
            break
    touching, clear = run(low), run(high)
    expected = integrate(body, caught(high), theta0=0.05)
    assert touching.outcome == clear.outcome == expected.outcome
    # a touch at speed v loses (1 - e) v; v = √(2 A δ) ~ 1e-7 rad/s for δ ~ 1e-14 rad
    assert touching.peak_rotation == pytest.approx(clear.peak_rotation, abs=1e-6)
    assert clear.peak_rotation == pytest.approx(expected.peak, abs=1e-6)
    assert touching.impacts >= clear.impacts
