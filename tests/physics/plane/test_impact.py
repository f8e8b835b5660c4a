"""Impacts of the general model (physics/plane/impact.py)."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shaketable import Body, General
from shaketable.physics.plane import impact
from shaketable.physics.plane.codes import BOTH, LEFT, RIGHT
from shaketable.physics.plane.contact import ContactBody, Pose, corner, corner_speeds
from tests.support.builders import contact_body

speeds = st.floats(-5, 5, allow_nan=False)
cases = st.tuples(
    st.floats(0.05, 2),  # cg height
    st.floats(0.05, 2),  # right
    st.floats(0.05, 2),  # left
    st.floats(0.2, 1.5),  # i / cg height
    st.sampled_from([0.0, 0.05, 0.3, 0.7, 1.0, 2.0, 10.0, math.inf]),
    st.floats(0.3, 1.0),  # μ_k / μ_s
    st.sampled_from([0.0, 0.2, 0.6, 0.95]),
    st.one_of(st.just(0.0), st.floats(-1.2, 1.2)),  # rotation
    st.tuples(speeds, speeds, speeds),
)


def build(case: tuple) -> tuple[ContactBody, Pose, int]:
    h, right, left, ratio, friction, kinetic, restitution, rotation, rates = case
    body = Body(base=right + left, cg_height=h, left=left, gyration_radius=ratio * h)
    model = General(
        static_friction=friction,
        kinetic_friction=friction if math.isinf(friction) else friction * kinetic,
        normal_restitution=restitution,
    )
    contact = BOTH if rotation == 0.0 else RIGHT if rotation > 0.0 else LEFT
    return contact_body(body, model, bounce_speed=0.0), Pose(0, 0.0, h, rotation, *rates), contact


def closed(contact: int) -> list[float]:
    return {BOTH: [1.0, -1.0], RIGHT: [1.0], LEFT: [-1.0]}[contact]


@settings(max_examples=1000, deadline=None)
@given(cases)
def test_laws_hold_at_every_impact(case: tuple) -> None:
    s, pose, contact = build(case)
    after = impact.collide(s, pose, contact)
    assert after.found
    # speeds of up to 5 m/s and lever arms of 3 m: round-off of their sums
    slack = 1e-9 * (1 + s.h + s.right + s.left) * (1 + max(map(abs, case[-1])))
    before = impact.energy(s, pose.x_rate, pose.y_rate, pose.spin)
    kinetic = impact.energy(s, after.x_rate, after.y_rate, after.spin)
    assert kinetic <= before * (1 + 1e-9) + slack
    moved = Pose(0, 0.0, s.h, pose.rotation, after.x_rate, after.y_rate, after.spin)
    for side in closed(contact):
        offset = corner(s, side, pose.rotation)
        assert corner_speeds(moved, *offset)[1] >= -slack  # nothing goes on into the floor
    # the sum of the impulses lies in the cone of static friction, and pushes
    along, normal = after.x_rate - pose.x_rate, after.y_rate - pose.y_rate
    assert normal >= -slack
    assert s.b_stick * abs(along) <= s.a_stick * normal + slack
    offset = corner(s, closed(contact)[0], pose.rotation)
    slip = corner_speeds(moved, *offset)[0]
    if after.contact and not after.sticks:  # friction acts against the slip, with all it has
        assert along * slip <= slack
        assert s.b_slip * abs(along) == pytest.approx(s.a_slip * normal, abs=slack)
    if after.contact and after.sticks:
        assert abs(slip) <= slack


@settings(max_examples=500, deadline=None)
@given(cases)
def test_mirror(case: tuple) -> None:
    s, pose, contact = build(case)
    after = impact.collide(s, pose, contact)
    mirrored = s._replace(right=s.left, left=s.right)
    facing = Pose(0, 0.0, s.h, -pose.rotation, -pose.x_rate, pose.y_rate, -pose.spin)
    other = impact.collide(mirrored, facing, {BOTH: BOTH, RIGHT: LEFT, LEFT: RIGHT}[contact])
    slack = 1e-8 * (1 + max(map(abs, case[-1])))
    assert other.x_rate == pytest.approx(-after.x_rate, abs=slack)
    assert other.y_rate == pytest.approx(after.y_rate, abs=slack)
    assert other.spin == pytest.approx(-after.spin, abs=slack)


def falling(body: Body, side: float, spin: float = 1.0) -> Pose:
    """A body that turns about one corner onto its base."""
    arm = body.right if side > 0 else -body.left
    rate = -side * spin
    return Pose(0, 0.0, body.cg_height, 0.0, rate * body.cg_height, rate * arm, rate)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("eccentricity", [0.5, 0.4, 0.62])
def test_plastic_impact_without_slip_is_section_2(side: float, eccentricity: float) -> None:
    # theory, section 2, Boroschek and Romo (2004) eq. 34; and Boroschek and Romo (2004) eq. 38 for
    # the energy
    body = Body.rectangle(0.4, 1.4, eccentricity=eccentricity)
    s = contact_body(body, General(static_friction=1.0), bounce_speed=0.0)
    after = impact.collide(s, falling(body, side), BOTH)
    own, other = (body.right, body.left) if side > 0 else (body.left, body.right)
    i2, h = body.gyration_radius**2, body.cg_height
    keep = (i2 + h * h - own * other) / (i2 + h * h + other * other)
    assert after.contact == (LEFT if side > 0 else RIGHT)
    assert after.spin == pytest.approx(-side * keep, rel=1e-13)
    before = impact.energy(s, *falling(body, side)[-3:])
    left = impact.energy(s, after.x_rate, after.y_rate, after.spin) / before
    # Boroschek and Romo (2004) eq. 38 with the square that the print lost (theory, section 8)
    delta = keep**2 * (i2 + h * h + other**2) / (i2 + h * h + own**2)
    assert left == pytest.approx(delta, rel=1e-13)


def test_a_squat_body_stays_down() -> None:
    body = Body.rectangle(2.0, 0.5)  # e < 0
    s = contact_body(body, General(static_friction=3.0), bounce_speed=0.0)
    after = impact.collide(s, falling(body, 1.0), BOTH)
    assert after.contact == BOTH
    assert np.allclose(after[:3], 0.0, atol=1e-14)


def test_newton_and_kane_levinson() -> None:
    # a corner strikes obliquely with restitution: Newton's law as long as the energy allows it
    body = Body.rectangle(0.3, 1.0)
    model = General(static_friction=0.5, normal_restitution=0.9)
    s = contact_body(body, model, bounce_speed=0.0)
    rng = np.random.default_rng(5)
    obeyed = lowered = 0
    for _ in range(2000):
        pose = Pose(0, 0.0, 0.5, rng.uniform(0.05, 1.0), *rng.normal(size=3))
        offset = corner(s, 1.0, pose.rotation)
        approach = corner_speeds(pose, *offset)[1]
        if approach >= 0.0:
            continue
        after = impact.collide(s, pose, RIGHT)
        moved = pose._replace(x_rate=after.x_rate, y_rate=after.y_rate, spin=after.spin)
        ratio = -corner_speeds(moved, *offset)[1] / approach
        plain = impact.solve(s, pose, RIGHT, 0.9)
        gains = impact.energy(s, plain.x_rate, plain.y_rate, plain.spin) > impact.energy(
            s, pose.x_rate, pose.y_rate, pose.spin
        )
        if gains:
            lowered += 1
            assert 0.0 <= ratio < 0.9
        else:
            obeyed += 1
            assert ratio == pytest.approx(0.9, rel=1e-9)
    assert obeyed > 500
    assert lowered > 10


def test_a_slow_landing_does_not_bounce() -> None:
    body = Body.rectangle(0.3, 1.0)
    s = contact_body(body, General(static_friction=0.5, normal_restitution=0.5), bounce_speed=1e-4)
    slow, fast = (Pose(0, 0.0, 0.5, 0.0, 0.0, -v, 0.0) for v in (0.9e-4, 1.1e-4))
    assert impact.collide(s, slow, BOTH).y_rate == 0.0
    assert impact.collide(s, fast, BOTH).y_rate == pytest.approx(0.55e-4, rel=1e-12)


@settings(max_examples=1000, deadline=None)
@given(cases, st.floats(0.05, 1.0))
def test_a_lossy_impact_keeps_its_corner_and_takes_energy(case: tuple, factor: float) -> None:
    h, right, left, ratio, friction, kinetic, _, _, rates = case
    s, _, _ = build((h, right, left, ratio, friction, kinetic, 0.0, 0.0, rates))
    s = s._replace(restitution_factor=factor)
    for side in (1.0, -1.0):
        x_rate, _, spin = rates
        X, _ = corner(s, side, 0.0)
        before = Pose(0, 0.0, s.h, 0.0, x_rate, spin * X, spin)  # that corner is closed
        after = impact.lossy(s, before, side)
        offset = corner(s, side, 0.0)
        # speeds of up to 5 m/s at lever arms of 3 m: round-off of their sums
        assert corner_speeds(after, *offset) == pytest.approx(
            corner_speeds(before, *offset), abs=1e-9
        )
        energies = [
            impact.energy(s, pose.x_rate, pose.y_rate, pose.spin) for pose in (before, after)
        ]
        assert energies[1] <= energies[0] * (1 + 1e-12) + 1e-12
        assert abs(after.spin) <= abs(before.spin)
        assert abs(after.spin) >= factor * abs(before.spin) * (1 - 1e-12)
        if abs(corner_speeds(before, *offset)[0]) < 1e-12:  # what sticks loses all of the factor
            assert after.spin == pytest.approx(factor * before.spin, abs=1e-9)
