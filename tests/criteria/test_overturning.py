"""Housner, Ishiyama, Boroschek and Romo, and the fitted rule."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, Motion, simulate
from shaketable.criteria import boroschek_romo_2004 as romo
from shaketable.criteria import housner_1963 as housner
from shaketable.criteria import ishiyama_1982 as ishiyama
from shaketable.criteria import shaketable_2026 as rule
from shaketable.criteria.overturning import (
    HOUSNER,
    ISHIYAMA,
    KNOWN,
    RULE,
    UNKNOWN,
    scores,
    verdicts,
)
from shaketable.criteria.shenton_1996 import shape_of, slip_limit
from tests.support.builders import G

SHELF = Body.rectangle(0.4, 1.8)


def test_housner_by_the_rectangle_s_formula() -> None:
    # Boroschek and Romo (2004) eq. 1: (1/cos α) √((8/3) g r (1 - cos α))
    r, alpha = math.hypot(0.2, 0.9), math.atan(0.2 / 0.9)
    expected = math.sqrt(8 / 3 * G * r * (1 - math.cos(alpha))) / math.cos(alpha)
    found = housner.overturning_velocity(0.2, 0.9, SHELF.gyration_radius)
    assert float(found) == pytest.approx(expected, rel=1e-12)
    # a slender one: 1 - cos α without cancellation; S_v → α √(4/3 g r) for small α
    thin = float(housner.overturning_velocity(1e-9, 1.0, math.sqrt(1 / 3)))
    assert thin == pytest.approx(1e-9 * math.sqrt(4 / 3 * G), rel=1e-9)


@pytest.mark.parametrize("eccentricity", [0.5, 0.3])
def test_housner_is_the_impulse_that_overturns(eccentricity: float) -> None:
    # theory, section 7: a velocity impulse V overturns iff V >= S_v, exact for any inertia
    body = Body(base=0.4, cg_height=0.9, left=0.4 * eccentricity, gyration_radius=0.7)
    limit = float(housner.overturning_velocity(body.left, 0.9, 0.7))
    step = 1e-5
    for part, falls in ((0.995, False), (1.005, True)):
        # the ground jumps toward +x within 10 µs: the body tips toward -x about its left corner
        push = np.zeros(500_000)
        push[:1] = 2 * part * limit / step
        run = simulate(body, Motion(push[:300_000], step))
        assert (run.overturning_time == run.overturning_time) == falls


def test_ishiyama_by_hand() -> None:
    velocity = 0.4 * float(housner.overturning_velocity(0.2, 0.9, SHELF.gyration_radius))
    shape = (0.2, 0.9, SHELF.gyration_radius)
    assert float(ishiyama.overturning_acceleration(0.2, 0.9)) == pytest.approx(0.4 / 1.8 * G)
    pga = np.array([0.2, 0.3, 0.3]) * G
    pgv = np.array([1.0, velocity * 0.999, velocity * 1.001])
    assert ishiyama.may_overturn(*shape, pga, pgv).tolist() == [False, False, True]


def test_rules_for_bodies_off_centre() -> None:
    # known: B' = 2νB; a symmetric body's is Ishiyama's
    i = SHELF.gyration_radius
    pga, pgv = np.linspace(0.5, 5.0, 40), np.linspace(0.05, 1.0, 40)
    same = romo.may_overturn_known(0.4, 0.5, 0.9, i, pga, pgv)
    assert np.array_equal(same, ishiyama.may_overturn(0.2, 0.9, i, pga, pgv))
    near = romo.may_overturn_known(0.4, [[0.3], [0.7]], 0.9, i, pga, pgv)
    assert np.array_equal(near[0], near[1])
    assert np.array_equal(near[0], ishiyama.may_overturn(0.12, 0.9, i, pga, pgv))
    # unknown: half of Ishiyama's velocity with the whole width
    half = float(ishiyama.overturning_velocity(0.2, 0.9, i)) / 2
    assert romo.may_overturn_unknown(0.4, 0.9, i, [half * 0.999, half]).tolist() == [False, True]


def test_friction_needed_is_the_inverse_of_the_slip_limit() -> None:
    # Boroschek and Romo (2004) eq. 25 from eq. 24, and eq. 26 at A = 1/γ
    body = Body.rectangle(0.4, 1.8, eccentricity=0.4)
    for direction in (1, -1):
        gamma, kappa = shape_of(body, direction)
        assert float(romo.friction_needed(1 / gamma, gamma, kappa)) == pytest.approx(1 / gamma)
        for a in (0.3, 0.5, 1.0):
            friction = float(romo.friction_needed(a, gamma, kappa))
            assert float(slip_limit(friction, gamma, kappa)) == pytest.approx(a, rel=1e-12)


def test_energy_kept() -> None:
    # a symmetric rectangle keeps (1 - 1.5 sin²α)² (Housner); either corner gives the same
    kept = float(romo.energy_kept(0.2, 0.2, 0.9, SHELF.gyration_radius))
    assert kept == pytest.approx((1 - 1.5 * math.sin(math.atan(0.2 / 0.9)) ** 2) ** 2, rel=1e-12)
    assert romo.energy_kept(0.1, 0.3, 0.9, 0.5) == pytest.approx(
        romo.energy_kept(0.3, 0.1, 0.9, 0.5)
    )
    # a free rocking: energy just before and just after the first impact, no motion of the ground
    body = Body.rectangle(0.4, 1.0, eccentricity=0.4)
    push = np.zeros(40_000)
    push[:400] = 4.0  # tips it, then lets it rock
    run = simulate(body, Motion(push, 5e-4))
    at = int(np.flatnonzero(np.diff(np.sign(run.rotation[800:])))[0]) + 800
    before, after = run.angular_velocity[at], run.angular_velocity[at + 1]
    about_left, about_right = (
        body.gyration_radius**2 + arm**2 + 0.25 for arm in (body.left, body.right)
    )
    assert run.rotation[at] > 0.0 > run.rotation[at + 1]  # from the right corner to the left one
    found = after**2 * about_left / (before**2 * about_right)
    expected = float(romo.energy_kept(body.left, body.right, 0.5, body.gyration_radius))
    assert found == pytest.approx(expected, rel=0.02)  # a sample of 0.5 ms beside the impact


def test_the_rule_by_hand_and_its_gate() -> None:
    i = SHELF.gyration_radius
    found = rule.measures(0.4, 0.5, 0.9, i, 0.5 * G, 0.6)
    p = math.sqrt(3 * G / (4 * math.hypot(0.2, 0.9)))  # theory, section 2
    assert float(found.velocity) == pytest.approx(p * 0.6 / (G * 0.2 / 0.9))
    assert float(found.acceleration) == pytest.approx(0.5 * 0.9 / 0.2)
    c = rule.FITTED
    x = c.constant + c.velocity * math.log(found.velocity) + c.eccentricity * 0.5
    x += c.acceleration * math.log(1 - 1 / found.acceleration)
    assert float(rule.overturning_chance(found)) == pytest.approx(1 / (1 + math.exp(-x)))
    still = rule.measures(0.4, 0.5, 0.9, i, np.array([0.0, 0.2222, 0.23]) * G, 2.0)
    chances = rule.overturning_chance(still)
    assert chances[:2].tolist() == [0.0, 0.0]  # B/H g = 0.2222 g lifts no corner
    assert chances[2] > 0.0
    # more of either never makes it safer
    grid = rule.overturning_chance(
        rule.measures(0.4, 0.5, 0.9, i, np.linspace(0.1, 20, 50)[:, None], np.linspace(0.01, 3, 60))
    )
    assert (np.diff(grid, axis=0) >= 0).all()
    assert (np.diff(grid, axis=1) >= 0).all()


def test_velocity_limit_is_the_rule_s_inverse() -> None:
    limit = rule.velocity_limit(SHELF, 0.4 * G)
    there = rule.measures(0.4, 0.5, 0.9, SHELF.gyration_radius, 0.4 * G, limit)
    assert float(rule.overturning_chance(there)) == pytest.approx(rule.SAFE)
    assert math.isinf(rule.velocity_limit(SHELF, 0.2 * G))


def test_verdicts_agree_with_the_scores() -> None:
    rng = np.random.default_rng(3)
    for _ in range(200):
        width, height = rng.uniform(0.1, 1.0), rng.uniform(0.3, 3.0)
        nu, pga, pgv = rng.uniform(0.2, 0.8), rng.uniform(0.1, 8.0), rng.uniform(0.02, 1.5)
        body = Body.rectangle(width, height, eccentricity=nu)
        said = verdicts(body, pga, pgv)
        scored = scores(width, nu, height / 2, body.gyration_radius, pga, pgv)
        names = (HOUSNER, ISHIYAMA, KNOWN, UNKNOWN, RULE)
        for verdict, name in zip(said, names, strict=True):
            assert verdict.overturns == (float(scored[name]) > 1.0)
            if name != RULE:
                assert verdict.margin == pytest.approx(1 / float(scored[name]))
            else:
                assert verdict.overturns == (verdict.margin <= 1.0)


def test_verdicts_in_words() -> None:
    said = {v.criterion: v for v in verdicts(SHELF, 0.2 * G, 0.5)}
    assert "the acceleration is too small" in said["Ishiyama"].sentence
    assert "too small to lift a corner" in said["shaketable"].sentence
    assert said["Ishiyama"].margin == pytest.approx(0.4 / 1.8 / 0.2)
    assert said["shaketable"].margin == pytest.approx(0.4 / 1.8 / 0.2)
    quick = {v.criterion: v for v in verdicts(SHELF, 0.4 * G, 0.05)}
    assert "it rocks, but the velocity is too small" in quick["Ishiyama"].sentence
    still = verdicts(SHELF, 0.0, 0.0)
    assert all(math.isinf(v.margin) and not v.overturns for v in still)
    leaning = {v.criterion: v for v in verdicts(Body.rectangle(0.9, 1.8, eccentricity=0.15), 1, 1)}
    assert leaning["Ishiyama"].beyond == "the centre of gravity is off centre"
    assert (
        leaning["Boroschek & Romo, known eccentricity"].beyond == "ν = 0.15 is outside 0.2 to 0.5"
    )
    assert leaning["Boroschek & Romo, unknown eccentricity"].beyond.endswith("outside 0.3 to 0.5")
    assert "B/2h = 0.5 is outside" in leaning["shaketable"].beyond
    assert {v.beyond for v in verdicts(SHELF, 1.0, 1.0)} == {""}
