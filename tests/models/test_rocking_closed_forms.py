"""The rocking model against theory, section 9 and other closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq

from shaketable import Body, Motion, Outcome, Response, Rocking, Support, simulate
from tests.support.builders import G, block, sampled

P, ALPHA = 2.14, 0.25  # Zhang & Makris 2001's block, C fig. 2
QUIET = Motion(np.zeros(2), 0.01)


def border(overturns, low: float, high: float, digits: float = 1e-7) -> float:
    """Where overturns(level) changes between low and high."""
    at_low = overturns(low)
    assert at_low != overturns(high)
    while high - low > digits:
        middle = (low + high) / 2
        low, high = (middle, high) if overturns(middle) == at_low else (low, middle)
    return (low + high) / 2


def peak_after_impact(phi: float, keep: float) -> float:
    """Linear theory: the next peak θ/α after an impact that keeps `keep` of the velocity."""
    return 1 - math.sqrt(1 - keep**2 * (1 - (1 - phi) ** 2))


@pytest.mark.parametrize(("phi", "period"), [(0.2, 1.30032), (0.5, 2.46612)])
def test_period_of_free_rocking(phi: float, period: float) -> None:
    # theory, section 9, nonlinear; five decimals are printed
    run = simulate(block(ALPHA, P), QUIET, initial_rotation=phi * ALPHA)
    assert 4 * run.impact_times[0] == pytest.approx(period, abs=5.1e-6)


@pytest.mark.parametrize(
    ("phi", "peaks", "period"),
    [
        (0.2, [0.16151, 0.13104, 0.10669], 1.29560),
        (0.5, [0.38243, 0.30016, 0.23897], 2.46160),
    ],
)
def test_linear_theory_of_free_rocking(phi: float, peaks: list[float], period: float) -> None:
    # theory, section 9. A very slender block is linear to α² = 1e-6; η is that of α = 0.25.
    alpha = 1e-3
    model = Rocking(restitution=0.908187)
    quiet = Motion(np.zeros(80_000), 1e-4)
    run = simulate(block(alpha, P), quiet, model=model, initial_rotation=phi * alpha)
    # five decimals are printed; the block is linear to α² = 1e-6
    assert 4 * run.impact_times[0] == pytest.approx(period, abs=6e-6)
    start = phi
    for first, last, peak in zip(run.impact_times, run.impact_times[1:], peaks, strict=False):
        expected = peak_after_impact(start, 0.908187)
        assert expected == pytest.approx(peak, abs=5.1e-6)
        between = (run.time > first) & (run.time < last)
        found = np.abs(run.rotation[between]).max() / alpha
        # sampled every 1e-4 s, the top is missed by at most p² (5e-5 s)² / 2 = 6e-9
        assert found == pytest.approx(expected, abs=2e-6)
        start = expected


def test_peaks_of_free_rocking_keep_energy_between_impacts() -> None:
    body = block(ALPHA, P)
    keep = 1 - 1.5 * math.sin(ALPHA) ** 2
    assert keep == pytest.approx(0.908187, abs=5e-7)  # theory, section 9
    motion = Motion(np.zeros(80_000), 1e-4)
    run = simulate(body, motion, initial_rotation=0.5 * ALPHA)
    energy = math.cos(0.5 * ALPHA) - math.cos(ALPHA)  # of the release, in units of g r
    for first, last in zip(run.impact_times[:5], run.impact_times[1:6], strict=True):
        energy *= keep**2
        top = ALPHA - math.acos(math.cos(ALPHA) + energy)
        between = (run.time > first) & (run.time < last)
        # sampled every 1e-4 s: p² (5e-5 s)² α / 2
        assert np.abs(run.rotation[between]).max() == pytest.approx(top, abs=1e-8)


@pytest.mark.parametrize(
    ("steps", "eta", "borders", "digits"),
    [
        # theory, section 9 (Zhang & Makris 2001; Cimellaro et al. 2020, figure 2), four decimals:
        # they hold for the pulse sampled in 500 straight pieces
        (500, 0.9, (3.0324, 6.7431, 7.4931), 6e-5),
        (500, None, (2.9448, 6.8265, 7.4931), 6e-5),
        # The sine itself: SciPy's DOP853 (rtol 1e-12) on the equation with sin(ωt) in it. The
        # chords of 4000 pieces lose (ω h)²/12 = 2e-7 of its area.
        (4000, 0.9, (3.032339, 6.743019, 7.493000), 6e-6),
        (4000, None, (2.944765, 6.826450, 7.493000), 6e-6),
    ],
)
def test_one_sine_pulse(
    steps: int, eta: float | None, borders: tuple[float, float, float], digits: float
) -> None:
    # rest | overturns after one impact | safe | overturns without impact
    body = block(ALPHA, P)
    omega, length = 5 * P, 2 * math.pi / (5 * P)
    pulse = sampled(lambda t: ALPHA * G * np.sin(omega * t), length, length / steps)

    def run(level: float) -> Response:
        return simulate(body, pulse.scaled(level), model=Rocking(restitution=eta))

    def falls(level: float) -> bool:
        return run(level).outcome != Outcome.STANDING

    found = [border(falls, 2.5, 3.5), border(falls, 6.0, 7.2), border(falls, 7.2, 8.0)]
    assert found == pytest.approx(borders, abs=digits)
    assert run(borders[0] + 0.01).impacts == 1
    assert run(borders[1] - 0.01).impacts == 1
    assert run(borders[2] + 0.01).impacts == 0


def uplift_phase(k: float) -> float:
    return math.asin(1 / k)


def half_sine(w: float) -> float:
    return brentq(
        lambda k: (
            math.cos(uplift_phase(k))
            + math.exp(-(math.pi - uplift_phase(k)) / w)
            - w * math.sin(uplift_phase(k))
        ),
        1.0001,
        100,
    )


def one_sine(w: float) -> float:
    return brentq(
        lambda k: (
            math.cos(uplift_phase(k))
            - math.exp(-(2 * math.pi - uplift_phase(k)) / w)
            - w * math.sin(uplift_phase(k))
        ),
        1.0001,
        100,
    )


def one_cosine(w: float) -> float:
    return (1 + w * w) / (1 - math.exp(-2 * math.pi / w))


PULSES = [
    *[(np.sin, math.pi, half_sine, w, k) for w, k in [(1, 1.3224), (2, 1.8007), (3, 2.2939)]],
    *[
        (np.sin, 2 * math.pi, one_sine, w, k)
        for w, k in [(1, 1.4183), (2, 2.3499), (3, 3.6311), (5, 7.1681)]
    ],
    *[(np.cos, 2 * math.pi, one_cosine, w, None) for w in (1, 2, 4)],
]


@pytest.mark.parametrize(("shape", "phase", "closed_form", "w", "printed"), PULSES)
def test_pulses_of_the_linearised_theory(shape, phase, closed_form, w, printed) -> None:
    # theory, section 9; α = 1e-3 is linear to 1e-6, steps of 1/4000 rad to 1e-8
    alpha, p = 1e-3, 2.0
    expected = closed_form(w)
    if printed is not None:
        assert expected == pytest.approx(printed, abs=6e-5)
    omega = w * p
    pulse = sampled(lambda t: alpha * G * shape(omega * t), phase / omega, 2.5e-4 / omega * 4)

    def falls_at_once(level: float) -> bool:
        run = simulate(block(alpha, p), pulse.scaled(level))
        return run.outcome != Outcome.STANDING and run.impacts == 0

    found = border(falls_at_once, 0.97 * expected, 1.03 * expected, 1e-6)
    assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("k", [1.2, 2.0, 5.0])
def test_rectangular_pulse(k: float) -> None:
    # e^{pT} = k/(k-1), linearised; α = 1e-3
    alpha, p = 1e-3, 2.0
    length = math.log(k / (k - 1)) / p

    def falls(part: float) -> bool:
        pulse = sampled(lambda t: np.full_like(t, k * alpha * G), part * length, 1e-3)
        return simulate(block(alpha, p), pulse).outcome != Outcome.STANDING

    assert border(falls, 0.9, 1.1) == pytest.approx(1, rel=1e-5)


@pytest.mark.parametrize("seed", range(6))
def test_any_pulse(seed: int) -> None:
    # theory, section 9: without an impact first, a pulse overturns a slender block iff
    # max_T p ∫ e^{-p(t-t0)} a/(α g) dt reaches 1, from the uplift at t0 on
    alpha, p, length = 1e-3, 2.0, 1.5
    rng = np.random.default_rng(seed)
    # one hump, for between two the body may land
    middle, width, power = rng.uniform(0.3, 1.2), rng.uniform(0.1, 0.6), rng.uniform(0.6, 2)

    def hump(time: np.ndarray) -> np.ndarray:
        window = np.sin(math.pi * np.clip(time / length, 0, 1)) ** power
        return window * np.exp(-(((time - middle) / width) ** 2))

    pulse = sampled(hump, length, 2e-4)
    shape = pulse.horizontal / pulse.horizontal.max()

    def falls(level: float) -> bool:
        motion = Motion(shape * level * alpha * G, pulse.time_step)
        run = simulate(block(alpha, p), motion)
        return run.outcome != Outcome.STANDING and run.impacts == 0

    level = border(falls, 1.0, 60.0, 1e-7)
    lifted = np.flatnonzero(level * shape > 1.0)[0]
    time = pulse.time - pulse.time[lifted]
    integrand = p * np.exp(-p * time) * level * shape
    integral = cumulative_trapezoid(integrand[lifted:], dx=pulse.time_step)
    # the uplift is found to a sample: p · 2e-4 s; the block is linear to α² = 1e-6
    assert integral.max() == pytest.approx(1, abs=1e-3)


def impulse_velocity(body: Body) -> float:
    """The velocity impulse that just overturns a rectangle, exact and nonlinear [m/s]."""
    alpha, h = body.slenderness_right, body.cg_height
    r = math.hypot(body.right, h)
    return math.sqrt(8 / 3 * G * r * (1 - math.cos(alpha))) / math.cos(alpha)


SPIKE = 1e-7  # s, length of an impulse: its effect has an error of the order of p times that


@pytest.mark.parametrize("alpha", [0.1, 0.25, 0.6])
def test_velocity_impulse(alpha: float) -> None:
    body = block(alpha, 3.0)

    def falls(part: float) -> bool:
        a = part * impulse_velocity(body) / SPIKE
        return simulate(body, Motion([a, a], SPIKE)).outcome == Outcome.DOWNHILL

    assert border(falls, 0.9, 1.1) == pytest.approx(1, rel=1e-5)


@pytest.mark.parametrize("count", [2, 3, 4])
def test_alternating_impulses(count: int) -> None:
    # N impulses, each just after an impact, need v0 (1-e)/(1-e^N) (theory, section 9)
    body = block(ALPHA, P)
    e = 1 - 1.5 * math.sin(ALPHA) ** 2
    v0 = impulse_velocity(body) * (1 - e) / (1 - e**count)
    step = 1e-4

    def falls(part: float) -> bool:
        times = [0.0]
        while True:
            samples = np.zeros(round(times[-1] / step) + 3)
            for n, time in enumerate(times):
                at = round(time / step)
                samples[at : at + 2] += (-1) ** n * part * v0 / (2 * step)
            # two samples of a triangle of height v/(2 step) hold an impulse of v
            run = simulate(body, Motion(np.append(0.0, samples), step))
            if len(times) == count:
                return run.outcome != Outcome.STANDING
            if run.outcome != Outcome.STANDING:
                return True
            impacts = run.impact_times[run.impact_times > times[-1] + 0.01]
            times.append(impacts[0] + step)

    # an impulse is up to 4 steps late: v is off by about p² α 4e-4 s of some p α
    assert border(falls, 0.9, 1.1, 1e-4) == pytest.approx(1, abs=3e-3)


@pytest.mark.parametrize("vertical", [-3.0, 0.0, 4.0])
@pytest.mark.parametrize("tilt_deg", [0.0, 3.0, 7.0])
@pytest.mark.parametrize("eccentricity", [0.3, 0.5, 0.6])
def test_uplift_acceleration(vertical: float, tilt_deg: float, eccentricity: float) -> None:
    # Boroschek and Iruretagoyena (2006) eq. 1 with its errata: (g + a_y) tan(α_L - β) downhill, (g
    # + a_y) tan(α_R + β) uphill
    body = Body.rectangle(0.4, 1.0, eccentricity=eccentricity)
    support = Support(tilt=math.radians(tilt_deg))
    downhill = (G + vertical) * math.tan(body.slenderness_left - support.tilt)
    uphill = (G + vertical) * math.tan(body.slenderness_right + support.tilt)
    for level, sign in [(downhill, 1), (uphill, -1)]:
        for part in (1 - 1e-9, 1 + 1e-9):
            a = np.array([0.0, sign * part * level, 0.0])
            run = simulate(body, Motion(a, 0.02, vertical=np.full(3, vertical)), support)
            assert (run.peak_rotation > 0) == (part > 1)


def test_energy_kept_at_an_impact() -> None:
    # Boroschek and Romo (2004) eq. 38 (errata): δE = e² (i² + h² + b_{-s}²)/(i² + h² + b_s²)
    body = Body.rectangle(0.3, 1.0, eccentricity=0.35)
    i2, h = body.gyration_radius**2, body.cg_height
    inertia = {1: i2 + h * h + body.right**2, -1: i2 + h * h + body.left**2}
    r = {1: math.hypot(h, body.right), -1: math.hypot(h, body.left)}
    alpha = {1: body.slenderness_right, -1: body.slenderness_left}

    def energy(side: int, theta: float, omega: float) -> float:
        lift = r[side] * math.cos(side * alpha[side] - theta) - h
        return inertia[side] * omega**2 / 2 + G * lift

    run = simulate(body, Motion(np.zeros(3000), 1e-3), initial_rotation=0.1)
    states = np.column_stack([run.time, run.rotation, run.angular_velocity])
    before = states[run.time < run.impact_times[0] - 1e-3][-1]
    after = states[run.time > run.impact_times[0]][0]
    e = (i2 + h * h - body.left * body.right) / inertia[-1]
    expected = e**2 * inertia[-1] / inertia[1]
    ratio = energy(-1, after[1], after[2]) / energy(1, before[1], before[2])
    assert ratio == pytest.approx(expected, rel=1e-12)


def test_squat_body_rests_at_its_first_impact() -> None:
    body = Body.rectangle(1.0, 0.6)  # i² + h² < b_L b_R: e < 0
    run = simulate(body, QUIET, initial_rotation=0.05)
    assert run.outcome is Outcome.STANDING
    assert run.impacts == 1
    assert run.rotation[-1] == run.angular_velocity[-1] == 0.0


def test_let_go_beyond_the_balance_it_falls() -> None:
    body = block(ALPHA, P)
    assert simulate(body, QUIET, initial_rotation=1.001 * ALPHA).outcome is Outcome.UPHILL
    assert simulate(body, QUIET, initial_rotation=-1.001 * ALPHA).outcome is Outcome.DOWNHILL
    assert simulate(body, QUIET, initial_rotation=0.999 * ALPHA).outcome is Outcome.STANDING


def test_balanced_on_its_edge_it_counts_as_standing(caplog: pytest.LogCaptureFixture) -> None:
    # φ = 0 exactly: an equilibrium that no force ever leaves
    body = Body.rectangle(0.5, 0.5)
    run = simulate(body, QUIET, initial_rotation=body.slenderness_right)
    assert run.outcome is Outcome.STANDING
    assert "balanced on an edge" in caplog.text
