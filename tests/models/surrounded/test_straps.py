"""Straps of planar bodies against closed forms and an independent integration."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, General, Motion, Strap, Support, Surroundings, simulate
from tests.support.surrounded import move

G = 9.80665
MASS = 100.0
BOOKCASE = Body.rectangle(0.32, 1.80, mass=MASS)


def half_sine(size: float, duration: float, after: float = 2.0) -> Motion:
    """A half sine of a size [g], sampled at 1 ms, and then nothing."""
    t = 1e-3 * np.arange(round((duration + after) * 1e3) + 1)
    pulse = np.where(t <= duration, size * G * np.sin(math.pi * t / duration), 0.0)
    return Motion(pulse, 1e-3)


def body_of(width: float, height: float, share: float, cg: float) -> Body:
    return Body(
        base=width, cg_height=cg, left=share * width, mass=MASS, height=height,
        gyration_radius=math.sqrt((width**2 + height**2) / 12),
    )  # fmt: skip


def strap(
    body: Body, z: float, away: float, z_anchor: float, k: float, c: float = 0.0, **more: float
) -> Surroundings:
    """From the right side of a body at height z, k and c by the mass."""
    return Surroundings(
        straps=(
            Strap(
                point=(body.right, z), anchor=(body.right + away, z_anchor),
                stiffness=k * MASS, damping=c * MASS, **more,
            ),
        )
    )  # fmt: skip


OTHER = body_of(0.45, 1.2, 0.4, 0.55)
THIRD = body_of(0.45, 1.2, 0.6, 0.65)
# body, tilt [°], size [g], duration [s], surroundings, peak force by the weight: a hinge under a
# strap integrated by DOP853 at 1e-12 until the first landing, after which nothing is larger
PULLED = {
    "S1": (BOOKCASE, 0, 0.4, 0.5, strap(BOOKCASE, 1.8, 0.05, 1.8, 2000), 0.123547191),
    "S2": (BOOKCASE, 0, 0.4, 0.5, strap(BOOKCASE, 1.8, 0.05, 1.8, 2000, slack=0.02), 1.017512311),
    "S3": (
        BOOKCASE, 0, 0.4, 0.5, strap(BOOKCASE, 1.8, 0.05, 1.8, 2000, 20, slack=0.02), 0.807394807,
    ),
    "S4": (BOOKCASE, 0, 0.8, 0.3, strap(BOOKCASE, 1.5, 0.30, 1.7, 500, 5), 0.786472718),
    "S5": (OTHER, 3, 0.6, 0.4, strap(OTHER, 1.2, 0.10, 1.2, 3000, slack=0.01), 1.014218096),
    "S6": (THIRD, -2, 0.5, 0.6, strap(THIRD, 1.0, 0.20, 1.3, 1500, 10), 0.120864550),
}  # fmt: skip


@pytest.mark.parametrize("name", PULLED)
def test_the_largest_force_of_a_strap(name: str) -> None:
    """1e-6 of it, as the reference is printed to nine digits and the force is inside a phase."""
    body, tilt, size, duration, around, peak = PULLED[name]
    run = simulate(
        body, half_sine(size, duration), Support(tilt=math.radians(tilt)),
        model=General(static_friction=100.0), surroundings=around,
    )  # fmt: skip
    assert run.strap_force[0] / (MASS * G) == pytest.approx(peak, rel=1e-6)
    assert run.strap_forces.max() == pytest.approx(run.strap_force[0], rel=1e-2)  # at samples
    assert math.isnan(run.strap_broke_at[0])


@pytest.mark.parametrize(
    ("strength", "damping", "when"), [(0.5, 0.0, 0.190580505), (0.9, 20.0, 0.185757572)]
)
def test_when_a_strap_breaks(strength: float, damping: float, when: float) -> None:
    """S7 and S8: it breaks, and what it held falls away."""
    around = strap(
        BOOKCASE, 1.8, 0.05, 1.8, 2000, damping, slack=0.02, strength=strength * MASS * G
    )
    run = simulate(
        BOOKCASE, half_sine(0.6, 0.5), model=General(static_friction=100.0), surroundings=around
    )
    assert run.strap_broke_at[0] == pytest.approx(when, abs=1e-8)
    assert run.strap_force[0] == strength * MASS * G
    assert run.outcome == -1
    assert run.strap_forces[run.time >= when].max() == 0.0


@pytest.mark.parametrize(
    ("size", "period", "stiffness", "force"),
    [
        (-0.4, 0.6, 1e3, 0.155), (-0.4, 0.6, 1e4, 0.591),
        (0.4, 0.6, 1e3, 0.204), (0.4, 0.6, 1e4, 0.652), (0.6, 0.5, 1e4, 1.022),
    ],
)  # fmt: skip
def test_one_full_sine(size: float, period: float, stiffness: float, force: float) -> None:
    """To the three digits that are known of it (DOP853; no slip; half a unit of the last).

    A strap that first pulls in the second half of the wave bears less: it has no swing to stop.
    """
    t = 1e-3 * np.arange(round((period + 2.0) * 1e3) + 1)
    wave = np.where(t <= period, size * G * np.sin(2 * math.pi * t / period), 0.0)
    around = strap(BOOKCASE, 1.8, 0.10, 1.8, stiffness / MASS)
    run = simulate(BOOKCASE, Motion(wave, 1e-3), model=General(), surroundings=around)
    assert run.strap_force[0] / (MASS * G) == pytest.approx(force, abs=6e-4)


@pytest.mark.parametrize(
    ("slack", "k", "force"),
    [(0.0, 2000.0, 0.22246), (0.02, 2000.0, 1.08590), (0.02, 20000.0, 3.161016)],
)
def test_a_strap_that_is_applied_suddenly(slack: float, k: float, force: float) -> None:
    """The force of a hinge under a strap, to the digits known: it does not slip at μ = 100.

    The stiffest one is `hinged` below, whose corner presses with 0.42 g at least, and needs a
    friction of 4.1 not to slip.
    """
    around = strap(BOOKCASE, 1.8, 0.05, 1.8, k, slack=slack)
    quiet = np.full(400, 0.4 * G)
    found = move(BOOKCASE, quiet, 1e-3, General(static_friction=100.0), around)
    assert found.held.strap_force[0, 0] / (MASS * G) == pytest.approx(force, rel=1e-5)


def test_the_corner_under_a_stiff_strap_slips_before_it_lifts() -> None:
    """Integrated as a hinge about the left corner, by SciPy at 1e-11."""
    b, h, away, slack, k = 0.16, 0.9, 0.05, 0.02, 2e4
    inertia = (0.32**2 + 1.8**2) / 12 + b * b + h * h

    def forces(theta: float, spin: float) -> tuple[float, float, float, float]:
        """ω', the strap's force, and N and T at the corner [m/s²]."""
        sine, cosine = math.sin(theta), math.cos(theta)
        q_x, q_y = b * cosine + h * sine, h * cosine - b * sine
        p_x, p_y = 2 * b * cosine + 2 * h * sine, 2 * h * cosine - 2 * b * sine
        d_x, d_y = 2 * b + away - p_x, 2 * h - p_y
        length = math.hypot(d_x, d_y)
        pull = max(0.0, k * (length - away - slack))
        f_x, f_y = pull * d_x / length, pull * d_y / length
        turning = (-0.4 * G * q_y + G * q_x + p_y * f_x - p_x * f_y) / inertia
        press = -turning * q_x - spin * spin * q_y + G - f_y
        drag = turning * q_y - spin * spin * q_x + 0.4 * G - f_x
        return turning, pull, press, drag

    from scipy.integrate import solve_ivp

    found = solve_ivp(
        lambda _, y: [y[1], forces(y[0], y[1])[0]], (0.0, 0.15), [0.0, 0.0], rtol=1e-11,
        atol=1e-13, max_step=1e-4,
    )  # fmt: skip
    told = np.array([forces(theta, spin) for theta, spin in found.y.T])
    assert told[:, 1].max() / G == pytest.approx(3.161016, rel=1e-5)
    assert told[:, 2].min() / G > 0.4
    assert np.abs(told[:, 3] / told[:, 2]).max() == pytest.approx(4.08, abs=0.02)
    around = strap(BOOKCASE, 1.8, away, 1.8, k, slack=slack)
    slips = move(BOOKCASE, np.full(400, 0.4 * G), 1e-3, General(static_friction=2.0), around)
    assert slips.held.strap_force[0, 0] / (MASS * G) == pytest.approx(2.943, abs=5e-4)


def test_two_straps_of_half_the_stiffness_are_one() -> None:
    motion = half_sine(0.8, 0.3)
    one = strap(BOOKCASE, 1.5, 0.30, 1.7, 500, 5)
    half = strap(BOOKCASE, 1.5, 0.30, 1.7, 250, 2.5)
    whole = simulate(BOOKCASE, motion, model=General(static_friction=0.5), surroundings=one)
    both = simulate(
        BOOKCASE, motion, model=General(static_friction=0.5),
        surroundings=Surroundings(straps=half.straps * 2),
    )  # fmt: skip
    assert sum(both.strap_force) == pytest.approx(whole.strap_force[0], rel=1e-9)
    assert both.peak_rotation == pytest.approx(whole.peak_rotation, rel=1e-9)


def test_a_strap_may_hold_what_leans() -> None:
    """Pushed over beyond its balance, it hangs in its strap when that has ended, to either side."""
    for side in (1.0, -1.0):
        x = -side * 0.16
        around = Surroundings(
            straps=(
                Strap(
                    point=(x, 1.8), anchor=(x - side * 0.3, 1.8), stiffness=1e4, damping=2e3,
                    slack=0.4,
                ),
            )
        )  # fmt: skip
        run = simulate(
            BOOKCASE, half_sine(-side * 0.25, 1.5), model=General(static_friction=0.6),
            surroundings=around,
        )  # fmt: skip
        assert run.outcome == 0
        assert run.settled
        assert run.held_up
        assert side * run.rotation[-1] > math.atan2(0.16, 0.9)
        # the moment of its weight about the corner that it stands on is that of its strap
        theta, corner = side * run.rotation[-1], run.position[-1]
        turned = np.array([[math.cos(theta), math.sin(theta)], [-math.sin(theta), math.cos(theta)]])
        point = np.array([side * corner[0], corner[1]]) + turned @ [-0.16, 0.9]
        foot = np.array([side * corner[0], corner[1]]) + turned @ [0.16, -0.9]
        toward = np.array([-0.46, 1.8]) - point
        toward /= np.hypot(*toward)
        arm = point - foot
        held = run.strap_forces[-1, 0] * (arm[1] * toward[0] - arm[0] * toward[1])
        weight = MASS * G * (side * corner[0] - foot[0])
        assert held == pytest.approx(-weight, rel=1e-6)
