"""The general model against closed forms: Newmark's block, flight, bounces, symmetry."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, General, Motion, Outcome, Phase, Rocking, Support, simulate
from shaketable.physics.plane import contact
from shaketable.physics.plane.forcing import Forcing
from tests.support.builders import G, contact_body, mirrored, sampled
from tests.support.pulses import random_pulse

SQUAT = Body.rectangle(2.0, 0.5)  # slides, does not tip


def move(body: Body, motion: Motion, *, tilt: float = 0.0, **parameters: float):
    return simulate(body, motion, Support(tilt=tilt), model=General(**parameters))


def constant(acceleration: float, duration: float, *, vertical: float = 0.0) -> Motion:
    """A rectangular pulse: it begins and ends at once, with the record."""
    flat = np.ones(101)
    return Motion(acceleration * flat, duration / 100, vertical=vertical * flat)


@pytest.mark.parametrize("pull", [0.35, -0.6])
@pytest.mark.parametrize(("static", "kinetic"), [(0.2, 0.2), (0.3, 0.15)])
@pytest.mark.parametrize("tilt", [0.0, 0.05])
def test_newmark_rectangular_pulse(pull: float, static: float, kinetic: float, tilt: float) -> None:
    # f_t and f_n of theory, section 1; the block starts where |f_t| > μ_s (-f_n)
    a, duration = pull * G, 0.4
    run = move(
        SQUAT,
        constant(a, duration),
        tilt=tilt,
        static_friction=static,
        kinetic_friction=kinetic,
    )
    along = -a * math.cos(tilt) - G * math.sin(tilt)
    normal = -a * math.sin(tilt) + G * math.cos(tilt)
    direction = math.copysign(1.0, along)
    gain = abs(along) - kinetic * normal
    speed = gain * duration
    # after the pulse gravity helps or hinders
    brake = kinetic * G * math.cos(tilt) + direction * G * math.sin(tilt)
    slip = direction * (gain * duration**2 / 2 + speed**2 / (2 * brake))
    assert run.slip[-1] == pytest.approx(slip, rel=1e-12)  # polynomials: exact
    assert run.outcome == Outcome.STANDING
    assert run.phases[-1] == Phase.REST
    sliding = Phase.SLIDE_UPHILL if direction > 0 else Phase.SLIDE_DOWNHILL
    assert run.phases[-2] == sliding


@pytest.mark.parametrize(
    ("factor", "direction"), [(0.999, 0), (1.001, -1), (-0.999, 0), (-1.001, 1)]
)
def test_yield_on_a_tilt(factor: float, direction: int) -> None:
    # downhill a_x = g tan(φ - β), uphill -a_x = g tan(φ + β), tan φ = μ
    tilt, friction = 0.06, 0.3
    angle = math.atan(friction)
    yields = G * math.tan(angle - tilt) if factor > 0 else G * math.tan(angle + tilt)
    run = move(SQUAT, constant(factor * yields, 0.2), tilt=tilt, static_friction=friction)
    assert np.sign(run.slip[-1]) == direction


def test_newmark_sine_pulse() -> None:
    peak, omega, friction = 0.5 * G, 2 * math.pi, 0.2
    yields = friction * G
    motion = sampled(lambda t: peak * np.sin(omega * t), math.pi / omega, 1e-4)
    run = move(SQUAT, motion, static_friction=friction)
    start = math.asin(yields / peak) / omega

    def speed(t: float) -> float:
        return peak / omega * (math.cos(omega * start) - math.cos(omega * t)) - yields * (t - start)

    end = math.pi / omega
    slip = (
        peak / omega * math.cos(omega * start) * (end - start)
        - peak / omega**2 * (math.sin(omega * end) - math.sin(omega * start))
        - yields * (end - start) ** 2 / 2
        + speed(end) ** 2 / (2 * yields)
    )
    # straight pieces of 1e-4 s make the sine smaller by (ω dt)²/12 = 3e-8, the slip by more
    assert run.slip[-1] == pytest.approx(-slip, rel=1e-6)


def test_flight_is_ballistic() -> None:
    # the floor drops at 2 g for 0.1 s: the body takes off with -g - a_y = g relative to it
    duration = 0.1
    run = move(SQUAT, constant(0.0, duration, vertical=-2 * G), static_friction=0.5)
    gap, speed = G * duration**2 / 2, G * duration
    assert run.max_lift == pytest.approx(gap + speed**2 / (2 * G), rel=1e-12)
    landing = duration + (speed + math.sqrt(speed**2 + 2 * G * gap)) / G
    # a body turns round to a guard's slack, 1e-12 m, of the floor
    assert run.impact_times[0] == pytest.approx(landing, abs=1e-11)
    assert run.phases == (Phase.FLIGHT, Phase.REST)


def test_a_spinning_body_flies_on_a_parabola() -> None:
    # thrown by a horizontal and a vertical pulse; then only gravity acts until it lands
    body = Body.rectangle(0.3, 0.6)
    run = move(body, constant(1.0 * G, 0.12, vertical=-2.5 * G), static_friction=0.6)
    assert run.phases[0] is Phase.FLIGHT
    landing = run.impact_times[0]
    free = (run.time > 0.12 + 1e-9) & (run.time < landing - 1e-9)
    assert free.sum() > 10
    t = run.time[free] - run.time[free][0]
    for place, bend in ((run.position[free, 0], 0.0), (run.position[free, 1], -G / 2)):
        fit = np.polynomial.Polynomial.fit(t, place, 2).convert().coef
        assert fit[2] == pytest.approx(bend, abs=1e-7)  # a fit to 0.1 s of doubles
    assert np.ptp(run.angular_velocity[free]) < 1e-12


@pytest.mark.parametrize("restitution", [0.3, 0.8])
def test_bouncing_plate(restitution: float) -> None:
    duration = 0.05
    run = move(
        SQUAT,
        constant(0.0, duration, vertical=-2 * G),
        static_friction=0.5,
        normal_restitution=restitution,
    )
    first = math.sqrt((G * duration) ** 2 + 2 * G * G * duration**2 / 2)  # landing speed
    flights = np.diff(run.impact_times)
    expected = 2 * first * restitution ** np.arange(1, flights.size + 1) / G
    assert flights == pytest.approx(expected, rel=1e-9, abs=1e-14)  # differences of times
    # it ends where a landing is slower than 1e-4 m/s
    last = first * restitution**flights.size
    assert 1e-4 * restitution < last <= 1e-4
    assert run.phases[-1] == Phase.REST


def test_rocking_energy_loss() -> None:
    # Boroschek and Romo (2004) eq. 38 for a non-symmetric body let go on one side: the height
    # reached on the other one
    body = Body.rectangle(0.3, 1.2, eccentricity=0.42)
    still = Motion(np.zeros(10), 0.01)
    run = simulate(body, still, model=General(static_friction=1.0), initial_rotation=0.1)
    i2, h = body.gyration_radius**2, body.cg_height
    e = (i2 + h * h - body.left * body.right) / (i2 + h * h + body.left**2)
    loss = e * e * (i2 + h * h + body.left**2) / (i2 + h * h + body.right**2)

    def raised(arm: float, theta: float) -> float:
        return arm * math.sin(theta) + h * math.cos(theta) - h

    reached = -run.rotation.min()
    # samples, after the motion's end, are 0.02/√(k g) apart: the turning point lies between two
    assert raised(body.left, reached) == pytest.approx(loss * raised(body.right, 0.1), rel=1e-3)


@pytest.mark.parametrize("seed", range(40))
def test_mirror_symmetry(seed: int) -> None:
    case = random_pulse(np.random.default_rng(seed), kinetic=True)
    run = case.run()
    facing = case._replace(
        body=mirrored(case.body),
        motion=case.motion.reversed(),
        support=Support(tilt=-case.support.tilt),
    )
    other = facing.run()
    # downhill is downhill of either tilt; without one it is the other side
    assert other.outcome == (run.outcome if case.support.tilt else -run.outcome)
    # where a sequence of bounces ends hangs on round-off: its last impacts are below 1e-4 m/s
    assert other.impacts == pytest.approx(run.impacts, abs=max(2, 0.1 * run.impacts))
    # round-off in width - left, made larger by bounces
    assert other.peak_rotation == pytest.approx(run.peak_rotation, abs=1e-7)
    assert other.peak_slip == pytest.approx(run.peak_slip, abs=1e-7)
    assert other.max_lift == pytest.approx(run.max_lift, abs=1e-7)


def test_the_friction_cone_is_never_left() -> None:
    # the reaction of a corner that sticks, from Newton's law at the samples; SLIDE and SLIDE_ROCK
    # have T = -μ_k N by construction
    checked = 0
    for seed in range(40):
        case = random_pulse(np.random.default_rng(300 + seed), kinetic=True)
        body, motion, support, model = case
        run = case.run()
        s = contact_body(body, model, support.tilt)
        for j, t in enumerate(run.time[: motion.horizontal.size - 1]):
            phase = run.phases[np.searchsorted(run.phase_times, t, side="right") - 1]
            if phase not in (Phase.ROCK_RIGHT, Phase.ROCK_LEFT):
                continue
            a_y = 0.0 if motion.vertical is None else motion.vertical[j]
            force = contact.force_of(s, Forcing(G + a_y, 0.0, motion.horizontal[j], 0.0))
            X, Y = contact.corner(s, 1.0 if phase is Phase.ROCK_RIGHT else -1.0, run.rotation[j])
            found = contact.stick(s, X, Y, run.angular_velocity[j], force)
            # a guard fires 1e-12 late; 1e-9 m/s² is round-off of the forces
            assert abs(found.along) <= model.static_friction * found.normal + 1e-9
            checked += 1
    assert checked > 1000


@pytest.mark.parametrize("seed", range(40))
def test_no_corner_goes_below_the_support(seed: int) -> None:
    case = random_pulse(np.random.default_rng(100 + seed), kinetic=True)
    body, run = case.body, case.run()
    sine, cosine = np.sin(run.rotation), np.cos(run.rotation)
    for arm in (body.right, -body.left):
        height = run.position[:, 1] - arm * sine - body.cg_height * cosine
        assert height.min() > -1e-9


def test_without_friction_only_gravity_pulls() -> None:
    # nothing pushes a smooth body sideways: its centre of gravity stays where it was in space
    motion = sampled(lambda t: 0.5 * G * np.sin(8 * t), math.pi / 4, 0.002)
    run = move(SQUAT, motion, static_friction=0.0)
    velocity = 0.5 * G / 8 * (1 - np.cos(8 * motion.time))
    ground = 0.5 * G / 8 * (motion.time - np.sin(8 * motion.time) / 8)
    assert velocity[-1] == pytest.approx(0.0, abs=1e-12)
    shaken = run.time <= motion.duration
    # straight pieces of 2 ms: (8 · 0.002)²/12 = 2e-5
    assert run.slip[shaken] == pytest.approx(-ground[: shaken.sum()], abs=5e-5 * ground.max())


@pytest.mark.parametrize("seed", range(40))
def test_energy_never_rises_on_a_support_at_rest(seed: int) -> None:
    case = random_pulse(np.random.default_rng(200 + seed), kinetic=True)
    body, motion, support, model = case
    still = np.zeros(400)
    quiet = Motion(
        np.r_[motion.horizontal, still],
        motion.time_step,
        vertical=np.r_[motion.vertical, still],
    )
    run = simulate(body, quiet, support, model=model)
    height = run.position @ [math.sin(support.tilt), math.cos(support.tilt)]
    speed = (run.velocity**2).sum(axis=1) + (body.gyration_radius * run.angular_velocity) ** 2
    energy = speed / 2 + G * height
    after = run.time > motion.duration + 1e-9
    # guards fire up to 1e-12 of their unit late
    assert np.diff(energy[after]).max(initial=0.0) < 1e-9


@pytest.mark.parametrize("restitution", [0.0, 0.6])
def test_energy_of_a_smooth_slide_stays_while_its_rocking_settles(restitution: float) -> None:
    # a fast body without friction, let go leaning: what settles must not take from the slide
    still, fast = np.zeros(600), np.full(60, 2.0 * G)
    body = Body.rectangle(0.5, 1.0)
    motion = Motion(np.r_[fast, still], 0.005)
    run = simulate(
        body,
        motion,
        model=General(static_friction=0.0, normal_restitution=restitution),
        initial_rotation=0.02,
    )
    after = run.time > 60 * 0.005 + 1e-9
    speed = (run.velocity**2).sum(axis=1) + (body.gyration_radius * run.angular_velocity) ** 2
    energy = (speed / 2 + G * run.position[:, 1])[after]
    assert run.phases[-1] in (Phase.SLIDE_DOWNHILL, Phase.SLIDE_UPHILL)
    assert np.diff(energy).max() < 1e-9


def test_velocity_is_the_rate_of_position() -> None:
    case = random_pulse(np.random.default_rng(5))
    body, motion, support, model = case
    for model in (Rocking(), case.model):
        run = simulate(body, motion, support, model=model)
        breaks = np.isin(np.arange(run.time.size - 1), np.searchsorted(run.time, run.phase_times))
        middle = np.diff(run.position, axis=0) / np.diff(run.time)[:, None]
        mean = (run.velocity[1:] + run.velocity[:-1]) / 2
        away = np.abs(middle - mean)[~breaks & ~np.r_[breaks[1:], False]]
        # the trapezoidal rule over a sample of 2 ms, with rates that change within 0.1 s
        assert np.quantile(away, 0.95) < 1e-3
