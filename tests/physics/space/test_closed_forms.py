"""Solids against closed forms (theory, section 11)."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from scipy.special import ellipj, ellipkinc

from shaketable import Body, General, Motion, Outcome, Solid, Support, simulate
from shaketable.simulate.standing import standing_limit
from shaketable.units import STANDARD_GRAVITY
from tests.support.solids import energy, quiet, released

G = STANDARD_GRAVITY
HIGH = (0.0, 0.0, 100.0)  # m: nothing lands within the runs of these tests


def test_a_flying_solid_is_a_torque_free_top() -> None:
    """Ballistic centre; ω by Jacobi's elliptic functions (Landau & Lifshitz, Mechanics, § 37).

    It spins about the axis of its least moment, which stays upright. Tolerance: steps are accepted
    at errors of 1e-9 in the state, some two hundred of them.
    """
    solid = Solid.box(0.2, 0.5, 0.9)
    i1, i2, i3 = np.diag(solid.inertia)[[2, 1, 0]]  # about z, y, x
    run = released(
        solid, General(), quiet(2.0), position=HIGH, rotation=Rotation.identity(),
        velocity=(1.0, -2.0, 3.0), spin=(0.2, 0.3, 3.0),
    )  # fmt: skip
    t = run.time
    assert t.size == 201
    fall = 0.5 * G * t[:, None] ** 2 * np.array([0.0, 0.0, 1.0])
    assert run.position == pytest.approx(HIGH + t[:, None] * [1.0, -2.0, 3.0] - fall, abs=1e-7)
    momentum = run.rotation.apply(run.spin @ solid.inertia)
    assert np.abs(momentum - momentum[0]).max() < 1e-8
    twice = np.einsum("ni,ij,nj->n", run.spin, solid.inertia, run.spin)
    assert np.ptp(twice) < 1e-8
    e2, m2 = twice[0], float(momentum[0] @ momentum[0])
    assert m2 < e2 * i2  # the axis of the least moment is circled
    rate = math.sqrt((i2 - i1) * (e2 * i3 - m2) / (i1 * i2 * i3))
    k2 = (i3 - i2) * (m2 - e2 * i1) / ((i2 - i1) * (e2 * i3 - m2))
    across = math.sqrt((m2 - e2 * i1) / (i2 * (i2 - i1)))
    along = math.sqrt((m2 - e2 * i1) / (i3 * (i3 - i1)))
    least = math.sqrt((e2 * i3 - m2) / (i1 * (i3 - i1)))
    # Euler's equation about x: I3 ω3' = (I2 − I1) ω2 ω1 > 0 at the start, where ω2, ω1 > 0, and
    # about y: I2 ω2' = (I1 − I3) ω1 ω3 < 0: sn falls from its value there
    start = float(ellipkinc(math.asin(0.3 / across), k2))
    sn, cn, dn, _ = ellipj(start - rate * t, k2)
    assert run.spin[:, 0] == pytest.approx(along * cn, abs=1e-7)
    assert run.spin[:, 1] == pytest.approx(across * sn, abs=1e-7)
    assert run.spin[:, 2] == pytest.approx(least * dn, abs=1e-7)


def test_the_middle_axis_flips() -> None:
    """Spin about the axis of the middle moment turns over (Dzhanibekov).

    When its axis passes the horizontal, against SciPy's DOP853; the perturbation grows by e^12
    until then, and with it the integrators' errors of 1e-9.
    """
    solid = Solid.box(0.2, 0.9, 0.5)
    spin = np.array([1e-4, 1e-4, 6.0])
    run = released(
        solid, General(), quiet(4.0), position=HIGH, rotation=Rotation.identity(), spin=spin
    )
    moments = np.diag(solid.inertia)

    def rates(_: float, y: NDArray[np.float64]) -> NDArray[np.float64]:
        normal, w = y[:3], y[3:]  # the support's normal as the body sees it
        return np.concatenate([np.cross(normal, w), -np.cross(w, moments * w) / moments])

    def upright(_: float, y: NDArray[np.float64]) -> float:
        return float(y[2])

    upright.terminal = True  # type: ignore[attr-defined]  # as solve_ivp asks for it
    reference = solve_ivp(
        rates, (0.0, 4.0), [0.0, 0.0, 1.0, *spin], "DOP853", rtol=1e-12, atol=1e-14, events=upright
    )
    assert reference.t_events[0].size == 1
    assert run.time[-1] == pytest.approx(reference.t_events[0][0], abs=1e-3)


@pytest.mark.parametrize("azimuth", [math.pi, 0.7, -2.1])
@pytest.mark.parametrize("solid", [Solid.box(0.5, 0.7, 0.4), Solid.cylinder(0.6, 0.3)])
def test_a_block_slides_down_a_plane(solid: Solid, azimuth: float) -> None:
    """½ (sin β − μ cos β) g t² toward the azimuth of the tilt, without turning."""
    tilt, mu, seconds = 0.3, 0.2, 1.0
    model = General(static_friction=mu)
    motion = Motion(np.zeros(101), 0.01)
    found = simulate(solid, motion, Support(tilt=tilt, azimuth=azimuth), model=model)
    way = 0.5 * (math.sin(tilt) - mu * math.cos(tilt)) * G * seconds**2
    expected = way * np.array([math.cos(azimuth), math.sin(azimuth)])
    assert found.foot[100, :2] == pytest.approx(expected, abs=1e-9)  # a step's error
    assert found.outcome is Outcome.STANDING
    assert abs(found.yaw) < 1e-9


def test_a_disc_spins_under_drilling_friction_alone() -> None:
    """ω falls by δ g / C a second, and with neither friction nor drilling stays."""
    seconds, spin, length = 0.5, 3.0, 0.002
    for drilling in (0.0, length):
        solid = Solid.cylinder(0.3, 0.1, drilling_friction=drilling)
        run = released(
            solid, General(static_friction=0.0), quiet(seconds), position=(0.0, 0.0, 0.05),
            rotation=Rotation.identity(), spin=(0.0, 0.0, spin),
        )  # fmt: skip
        expected = spin - drilling * G / solid.inertia[2, 2] * run.time
        # drilling friction is 5e-10 less than full at this rate (`losses.SLOW`)
        assert run.spin[:, 2] == pytest.approx(expected, abs=1e-6)


def steady_rate(solid: Solid, nutation: float, spin3: float) -> float:
    """Ω of a circle that rolls in a steady precession, the axial rate ω3 given.

    Ω sin φ (C ω3 − A Ω cos φ) = −g (a cos φ − h sin φ) + Ω² ρ (a sin φ + h cos φ) with
    ρ = h sin φ − a ω3/Ω, solved for Ω; derived anew in theory, section 11.
    """
    a, h = (solid.diameter or 0.0) / 2, solid.cg_height
    across, axial = solid.inertia[0, 0], solid.inertia[2, 2]
    s, c = math.sin(nutation), math.cos(nutation)

    def rest(rate: float) -> float:
        rho = h * s - a * spin3 / rate
        return (
            rate * s * (axial * spin3 - across * rate * c)
            + G * (a * c - h * s)
            - rate**2 * rho * (a * s + h * c)
        )

    roots = [
        brentq(rest, low, high)
        for low, high in zip(
            np.linspace(0.5, 60, 800)[:-1], np.linspace(0.5, 60, 800)[1:], strict=True
        )
        if rest(low) * rest(high) < 0.0
    ]
    return float(roots[-1])


@pytest.mark.parametrize(("nutation", "spin3"), [(0.3, 0.0), (0.15, 0.5), (0.6, -1.0)])
def test_a_cylinder_rolls_in_a_steady_precession(nutation: float, spin3: float) -> None:
    """The steady motion of a circle that rolls without slip, for as long as it stays in it.

    It is unstable, or it is neutral: 0.3 s of it to 1e-6.
    """
    solid = Solid.cylinder(0.4, 0.3)
    rate = steady_rate(solid, nutation, spin3)
    rotation = Rotation.from_euler("y", nutation)  # the axis leans toward +x
    s, c = math.sin(nutation), math.cos(nutation)
    # ω = Ω z + (ω3 − Ω cos φ) k, in the body's frame; z there is (−sin φ, 0, cos φ)
    spin = rate * np.array([-s, 0.0, c]) + (spin3 - rate * c) * np.array([0.0, 0.0, 1.0])
    low = np.array([0.2, 0.0, -0.15])  # the lowest point: toward +x in the body's frame
    arm = rotation.apply(low)
    position = -arm * [0, 0, 1]
    velocity = -np.cross(rotation.apply(spin), arm)
    run = released(
        solid, General(), quiet(0.3, 0.005), position=position, rotation=rotation,
        velocity=velocity, spin=spin,
    )  # fmt: skip
    axis = run.rotation.apply([0.0, 0.0, 1.0])
    assert np.arccos(axis[:, 2]) == pytest.approx(nutation, abs=1e-6)
    turned = np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]))
    assert turned == pytest.approx(rate * run.time, abs=1e-5)
    assert np.ptp(energy(solid, run)) < 1e-8


def test_eulers_disk() -> None:
    """Ω² = 4 g / (r sin φ) for a thin disc whose centre does not move, at any nutation φ."""
    disc = Solid.cylinder(0.2, 1e-4)
    nutation = 0.4
    rate = math.sqrt(4 * G / (0.1 * math.sin(nutation)))
    # the centre stands still where the contact's velocity is that of the spin: ω3 = 0 but for h
    assert steady_rate(disc, nutation, 0.0) == pytest.approx(rate, rel=2e-3)  # h/r is 5e-4


def test_release_along_a_square_s_diagonal_stays_in_its_plane() -> None:
    """A square base let go over a corner keeps to the diagonal's plane until it lands."""
    solid = Solid.box(0.3, 0.3, 1.2)
    angle = 0.15
    axis = np.array([-1.0, 1.0, 0.0]) / math.sqrt(2)  # leans toward (1, 1)
    rotation = Rotation.from_rotvec(angle * axis)
    corner = rotation.apply([0.15, 0.15, -0.6])
    run = released(solid, General(), quiet(0.5), position=[0.0, 0.0, -corner[2]], rotation=rotation)
    lean = run.rotation.apply([0.0, 0.0, 1.0])
    flying = np.flatnonzero(run.rank != 1)
    until = int(flying[0]) if flying.size else len(lean)
    assert until > 20
    assert np.abs(lean[:until, 0] - lean[:until, 1]).max() < 1e-9


def test_one_corner_rocks_like_a_planar_body_with_the_diagonal_s_half_length() -> None:
    """A square base under a pulse along its diagonal: its moment about a corner is a planar one's.

    The planar body has r and i about that corner; compared up to its return (no impact before).
    """
    solid = Solid.box(0.3, 0.3, 1.2)
    t = np.arange(60) * 0.01
    pulse = 4.5 * np.sin(2 * np.pi * t / 0.6)
    found = simulate(
        solid, Motion(pulse / math.sqrt(2), 0.01, transverse=pulse / math.sqrt(2)), model=General()
    )
    half = 0.15 * math.sqrt(2)
    across = solid.inertia[0, 0]  # about any horizontal axis: the base is square
    body = Body(base=2 * half, cg_height=0.6, left=half, gyration_radius=math.sqrt(across))
    planar = simulate(body, Motion(pulse, 0.01), model=General())
    rise = np.abs(planar.rotation[:40])
    assert rise.max() > 0.01
    assert found.nutation[:40] == pytest.approx(rise, abs=1e-8)


def test_a_solid_begins_to_rock_at_its_inscribed_distance() -> None:
    """The least |a_h| / g over directions is the base's inscribed distance over its height."""
    rng = np.random.default_rng(4)
    for _ in range(20):
        angles = rng.uniform(-0.4, 0.4, 3) + np.array([0.0, 2.1, 4.2])
        corners = 0.2 * np.column_stack([np.cos(angles), np.sin(angles)])
        solid = Solid.polygon(corners, 1.0)
        limits = [standing_limit(solid, azimuth) for azimuth in np.linspace(-np.pi, np.pi, 2001)]
        # 2001 directions miss the best by 1.6e-3 rad at most, and its limit by its square
        assert min(limits) == pytest.approx(solid.least_slenderness, rel=1e-5)
        azimuth = float(rng.uniform(-np.pi, np.pi))
        limit = math.tan(standing_limit(solid, azimuth)) * G
        for factor, moves in ((0.999, False), (1.001, True)):
            push = np.full(20, -factor * limit)  # the force on the body is against it
            motion = Motion(push * math.cos(azimuth), 0.01, transverse=push * math.sin(azimuth))
            assert (simulate(solid, motion).peak_rotation > 0.0) is moves
