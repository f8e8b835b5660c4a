"""Forces and series of the general model (contact, phase_series, complementarity)."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from shaketable import Body, General, Phase
from shaketable.physics.plane import codes, complementarity, contact, phase_series
from shaketable.physics.plane.codes import RIGHT
from shaketable.physics.plane.contact import Force, Pose
from shaketable.physics.plane.forcing import Forcing
from tests.support.builders import G, contact_body

BODY = Body.rectangle(0.4, 1.1, eccentricity=0.44)


def forces(a_x: float, a_y: float, tilt: float) -> Force:
    return contact.force_of(contact_body(BODY, tilt=tilt), Forcing(G + a_y, 0.0, a_x, 0.0))


def test_signs_of_the_apparent_force() -> None:
    # Errata of Boroschek and Iruretagoyena (2006) eqs. 3, 5, 8, 9, 10 (theory, section 8).
    # Printed, R_y and ÿ have the other sign of a_x sin β; but turning the axes cannot change the
    # size of the force on the body.
    a_x, a_y, tilt = 3.0, -2.0, 0.2
    force = forces(a_x, a_y, tilt)
    f_t, f_n = force.along, force.normal
    assert f_t**2 + f_n**2 == pytest.approx(a_x**2 + (G + a_y) ** 2, rel=1e-14)
    printed = (a_y + G) * math.cos(tilt) + a_x * math.sin(
        tilt
    )  # Boroschek and Iruretagoyena (2006) eq. 3
    assert f_t**2 + printed**2 != pytest.approx(a_x**2 + (G + a_y) ** 2, rel=1e-2)


@pytest.mark.parametrize("rotation", [0.15, -0.15])
def test_pure_rotation_is_equation_2(rotation: float) -> None:
    # The general model's rotation about a corner that sticks is Boroschek and Iruretagoyena (2006)
    # eq. 2. Eq. 6 agrees with θ mirrored and the sign of theory, section 8, and not as printed.
    a_x, a_y, tilt = -2.5, 1.5, 0.1
    s = contact_body(BODY, tilt=tilt)
    side = math.copysign(1.0, rotation)
    force = forces(a_x, a_y, tilt)
    X, Y = contact.corner(s, side, rotation)
    arm = BODY.right if side > 0 else BODY.left
    alpha, r, i2 = math.atan2(arm, s.h), math.hypot(arm, s.h), s.i2
    phi = side * alpha - rotation + tilt
    equation_2 = -r / (i2 + r * r) * ((G + a_y) * math.sin(phi) + a_x * math.cos(phi))
    found = contact.stick(s, X, Y, 1.3, force).spin_rate
    assert found == pytest.approx(equation_2, rel=1e-13)

    def equation_6(sign: float) -> float:  # its θ is -rotation
        lean = alpha - abs(rotation)
        normal = (a_y + G) * math.cos(tilt) + sign * a_x * math.sin(tilt)
        along = (a_y + G) * math.sin(tilt) + a_x * math.cos(tilt)
        return r / (i2 + r * r) * (math.cos(lean) * along + side * math.sin(lean) * normal)

    assert -equation_6(-1.0) == pytest.approx(equation_2, rel=1e-13)
    assert -equation_6(1.0) != pytest.approx(equation_2, rel=1e-2)


@pytest.mark.parametrize("sigma", [1.0, -1.0])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_slip_is_equations_9_and_10(side: float, sigma: float) -> None:
    # Boroschek and Iruretagoyena (2006) eqs. 9 and 10 for a symmetric body with + a_x sin β for
    # the printed - (theory, section 8), their θ > 0 downhill, c and s cos and sin of α - |θ|.
    body = Body.rectangle(0.4, 1.1)
    mu, a_x, a_y, tilt, rotation, spin = 0.35, -2.5, 1.5, 0.1, side * 0.12, 0.8
    s = contact_body(body, General(static_friction=mu), tilt)
    force = forces(a_x, a_y, tilt)
    X, Y = contact.corner(s, side, rotation)
    found = contact.slip(s, X, Y, spin, sigma, force)
    alpha, r = math.atan2(body.left, s.h), math.hypot(body.left, s.h)
    c, sn = math.cos(alpha - abs(rotation)), math.sin(alpha - abs(rotation))
    across = r * c * spin**2 - (a_y + G) * math.cos(tilt) + a_x * math.sin(tilt)
    # s' is the direction of slip; s'' that of the rotation, whose θ is ours
    turn = side * r * across * (sn - sigma * side * mu * c)
    turn /= r * r * sn * (sn - sigma * side * mu * c) + s.i2
    assert found.spin_rate == pytest.approx(turn, rel=1e-12)
    normal = found.normal
    assert found.along == pytest.approx(-mu * sigma * normal, rel=1e-13)
    # a slipping corner stays on the support: c'' = ÿ - θ'' X - θ'² Y = 0
    assert force.normal + normal - turn * X - spin**2 * Y == pytest.approx(0.0, abs=1e-12)


def test_painleve_is_found_where_equation_9_has_its_pole() -> None:
    # theory, section 3, for a rectangle: μ = (sin²φ + i²/r²)/(sin φ cos φ), φ = α - |θ|
    body = Body.rectangle(0.2, 1.0)
    r2, i2 = 0.1**2 + 0.5**2, body.gyration_radius**2
    for rotation in (0.0, 0.05, 0.1):
        phi = math.atan2(0.1, 0.5) - rotation
        pole = (math.sin(phi) ** 2 + i2 / r2) / (math.sin(phi) * math.cos(phi))
        for factor, jams in ((0.99, False), (1.01, True)):
            s = contact_body(body, General(static_friction=factor * pole))
            Y = contact.corner(s, 1.0, rotation)[1]
            moving = Pose(0, 0.0, -Y, rotation, 1.0, 0.0, 0.0)
            phase = complementarity.choose(s, moving, RIGHT, Force(0.0, 0.0, -G, 0.0), -1)
            assert (phase == complementarity.JAM_RIGHT) == jams
            if not jams:
                assert phase == Phase.SLIDE_ROCK_RIGHT_UPHILL


def test_something_follows_where_the_pressure_ends() -> None:
    # a corner without slip whose pressure goes through zero flies or slips: it has no other force.
    # Radii of gyration ten times the body make the denominator of a slip small, but no jam.
    rng = np.random.default_rng(31)
    found = set()
    for _ in range(2000):
        body = Body(
            base=0.1,
            cg_height=rng.uniform(0.05, 0.3),
            left=rng.uniform(0.02, 0.08),
            gyration_radius=10 ** rng.uniform(-1.5, 0.0),
        )
        s = contact_body(body)
        rotation, f_t, f_n = rng.uniform(-0.8, 0.8), rng.normal() * 10, -rng.uniform(1, 20)
        force = Force(f_t, 0.0, f_n, 0.0)
        contact_code, side = (RIGHT, 1.0) if rotation > 0 else (codes.LEFT, -1.0)
        X, Y = contact.corner(s, side, rotation)
        turn = contact.stick(s, X, Y, 0.0, force).spin_rate
        if (f_n - turn * X) / Y < 0.0:  # no rate of rotation takes the pressure away
            continue
        spin = math.sqrt((f_n - turn * X) / Y) * rng.choice([1, -1])
        pose = Pose(0, 0.0, -Y, rotation, -spin * Y, spin * X, spin)
        sticking = codes.phase_of(contact_code, 0.0)
        after = complementarity.choose(s, pose, contact_code, force, sticking)
        assert after != sticking
        found.add(codes.slip_of(after))
    assert found == {0.0, 1.0, -1.0}


def test_infinite_friction_is_the_limit_of_large() -> None:
    X, Y = contact.corner(contact_body(BODY), 1.0, -0.4)  # pushed up by its own slip
    limit = contact.slip(contact_body(BODY), X, Y, 0.3, 1.0, Force(1.0, 0.0, -G, 0.0))
    finite = contact_body(BODY, General(static_friction=1e9))
    close = contact.slip(finite, X, Y, 0.3, 1.0, Force(1.0, 0.0, -G, 0.0))
    assert limit[:3] == pytest.approx(close[:3], rel=1e-6, abs=1e-6)


POSES = {
    "flight": (Phase.FLIGHT, 0.6, 0.1, (0.4, 1.2, 2.0)),
    "slide": (Phase.SLIDE_UPHILL, None, 0.0, (0.7, 0.0, 0.0)),
    "rock right": (Phase.ROCK_RIGHT, None, 0.2, (None, None, 0.9)),
    "rock left": (Phase.ROCK_LEFT, None, -0.2, (None, None, 0.5)),
    "slide-rock right": (Phase.SLIDE_ROCK_RIGHT_UPHILL, None, 0.2, (0.8, None, 0.6)),
    "slide-rock left": (Phase.SLIDE_ROCK_LEFT_DOWNHILL, None, -0.3, (-0.9, None, 0.4)),
}


@pytest.mark.parametrize("name", POSES)
def test_series_solve_the_equations_of_motion(name: str) -> None:
    # against DOP853 on the three equations of theory, section 3, with the contact forces put in
    phase, y, rotation, (x_rate, y_rate, spin) = POSES[name]
    s = contact_body(BODY, General(static_friction=0.45, kinetic_friction=0.4))
    side, sigma = codes.side_sign(codes.contact_of(phase)), codes.slip_of(phase)
    X, Y = contact.corner(s, side or 1.0, rotation)
    y = -Y if y is None else y
    x_rate = -spin * Y if x_rate is None else x_rate
    y_rate = spin * X if y_rate is None else y_rate
    pose = Pose(int(phase), 0.3, y, rotation, x_rate, y_rate, spin)
    h, force = 0.01, Force(-1.5, 0.8, -9.0, -0.9)

    def rates(t: float, state: np.ndarray) -> list[float]:
        theta, vx, vy, omega = state[2:]
        f_t = force.along + force.along_change * t / h
        f_n = force.normal + force.normal_change * t / h
        if phase == Phase.FLIGHT:
            return [vx, vy, omega, f_t, f_n, 0.0]
        if side == 0.0:
            return [vx, vy, omega, f_t + sigma * 0.4 * f_n, 0.0, 0.0]
        X, Y = contact.corner(s, side, theta)
        if sigma == 0.0:
            r = contact.stick(s, X, Y, omega, Force(f_t, 0.0, f_n, 0.0))
        else:
            r = contact.slip(s, X, Y, omega, sigma, Force(f_t, 0.0, f_n, 0.0))
        turn = (Y * r.along - X * r.normal) / s.i2
        return [vx, vy, omega, f_t + r.along, f_n + r.normal, turn]

    start = [0.3, y, rotation, x_rate, y_rate, spin]
    run = solve_ivp(rates, (0.0, h), start, method="DOP853", rtol=1e-13, atol=1e-15)
    table = np.zeros((phase_series.ROWS, phase_series.TERMS))
    phase_series.expand(table, s, pose, force, h)
    ones = np.ones(phase_series.TERMS)
    end_x, end_y, theta, vx, _, omega = run.y[:, -1]
    assert table[phase_series.ROTATION] @ ones == pytest.approx(theta, abs=1e-13)
    assert table[phase_series.SPIN] @ ones / h == pytest.approx(omega, abs=1e-12)
    assert table[phase_series.ALONG] @ ones == pytest.approx(end_x, abs=1e-13)
    slopes = np.arange(phase_series.TERMS)
    assert table[phase_series.ALONG] @ slopes / h == pytest.approx(vx, abs=1e-11)
    if phase == Phase.FLIGHT:
        assert table[phase_series.NORMAL] @ ones == pytest.approx(end_y, abs=1e-13)


def test_guards_of_a_table_are_the_forces_at_its_end() -> None:
    # phases.TABLE: cone uphill, cone downhill, landing; slip, pressure, jam, landing
    s = contact_body(BODY, General(static_friction=0.45))
    h, force = 0.01, Force(-1.5, 0.8, -9.0, -0.9)
    ones = np.ones(phase_series.TERMS)
    table = np.zeros((phase_series.ROWS, phase_series.TERMS))
    for phase in (Phase.ROCK_RIGHT, Phase.SLIDE_ROCK_RIGHT_UPHILL):
        X, Y = contact.corner(s, 1.0, 0.2)
        slip = 0.0 if phase == Phase.ROCK_RIGHT else 0.5
        pose = Pose(int(phase), 0.0, -Y, 0.2, slip - 0.9 * Y, 0.9 * X, 0.9)
        phase_series.expand(table, s, pose, force, h)
        theta, omega = table[phase_series.ROTATION] @ ones, table[phase_series.SPIN] @ ones / h
        X, Y = contact.corner(s, 1.0, theta)
        last = Force(force.along + force.along_change, 0.0, force.normal + force.normal_change, 0.0)
        found = [table[phase_series.GUARDS + k] @ ones for k in range(codes.GUARD_COUNT[phase])]
        if phase == Phase.ROCK_RIGHT:
            r = contact.stick(s, X, Y, omega, last)
            a, b = s.a_stick, s.b_stick
            expected = [a * r.normal + b * r.along, a * r.normal - b * r.along, theta]
        else:
            r = contact.slip(s, X, Y, omega, 1.0, last)
            denominator = contact.slip_arm(s, X, Y, 1.0)[1]
            slope = table[phase_series.ALONG] @ np.arange(phase_series.TERMS) / h
            expected = [
                slope + omega * Y,
                r.normal / s.b_slip * denominator,
                denominator - contact.jam_limit(s, *contact.corner(s, 1.0, 0.2)),
                theta,
            ]
        # two derivatives were taken of series good to 1e-13
        assert found == pytest.approx(expected, abs=1e-9)
