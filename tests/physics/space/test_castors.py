"""Feet of different friction: a cart with castors beside locked wheels."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

from shaketable import General, Motion, Outcome, Solid, Support, simulate, suite
from shaketable.solid_response import Contact, Grip
from shaketable.units import STANDARD_GRAVITY
from tests.support.flat_feet import slide

STILL = Motion(np.zeros(40), 0.01, transverse=np.zeros(40))
CORNERS = [[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]]
SIDES = 128  # of the polygon that stands for a friction disc: it lacks 0.03 %
NEAR = 1e-3  # of a tilt


def stays(solid: Solid, tilt: float, azimuth: float, mu: float) -> bool:
    """Whether it does not move on a quiet slope."""
    run = simulate(
        solid, STILL, Support(tilt=tilt, azimuth=azimuth), model=General(static_friction=mu)
    )
    still = float(np.abs(run.velocity).max()) + float(np.abs(run.angular_velocity).max())
    return run.outcome is Outcome.STANDING and still < 1e-6


@pytest.mark.parametrize("toward", [0.0, math.pi])
def test_a_cart_stands_on_a_slope_until_its_locked_wheels_slip(toward: float) -> None:
    """Castors in front (x > 0): with k = h/a and the pressures (1/2 ± k tan β) of both pairs,
    tan β = μ (1/2 ∓ k tan β) + μ_c (1/2 ± k tan β)."""
    mu, castor, k = 0.4, 0.02, 0.3 / 0.6
    cart = Solid.on_feet(
        CORNERS, 0.6, castors=[True, False, False, True], rolling_resistance=castor
    )
    sign = math.cos(toward)
    limit = math.atan(0.5 * (mu + castor) / (1.0 + sign * k * (mu - castor)))
    assert stays(cart, limit * (1 - NEAR), toward, mu)
    assert not stays(cart, limit * (1 + NEAR), toward, mu)


def held(feet: np.ndarray, frictions: np.ndarray, h: float, tilt: float, azimuth: float) -> bool:
    """Whether some friction holds a body under the pressures of least ΣN²: a linear programme."""
    down = math.tan(tilt) * np.array([math.cos(azimuth), math.sin(azimuth)])
    basis = np.column_stack([np.ones(len(feet)), feet])
    # the resultant meets the base at h tan β downhill of the foot of the centre of gravity
    moments = np.array([1.0, *(h * down)])
    pressures = basis @ np.linalg.solve(basis.T @ basis, moments)
    if (pressures < 0.0).any():
        return False
    angles = 2 * math.pi * (np.arange(SIDES) + 0.5) / SIDES
    edges = np.column_stack([np.cos(angles), np.sin(angles)])
    n = len(feet)
    upper, most = np.zeros((n * SIDES, 2 * n)), np.zeros(n * SIDES)
    for k in range(n):
        upper[k * SIDES : (k + 1) * SIDES, 2 * k : 2 * k + 2] = edges
        most[k * SIDES : (k + 1) * SIDES] = frictions[k] * pressures[k]
    balance = np.zeros((3, 2 * n))
    balance[0, 0::2] = balance[1, 1::2] = 1.0
    balance[2, 0::2], balance[2, 1::2] = -feet[:, 1], feet[:, 0]
    found = linprog(
        np.zeros(2 * n), upper, most, balance, [-down[0], -down[1], 0.0], bounds=(None, None)
    )
    return bool(found.status == 0)


@pytest.mark.parametrize("seed", range(6))
def test_rest_ends_where_no_friction_can_hold(seed: int) -> None:
    """Against a linear programme, in a random direction, with some castors."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 7))
    angles = (np.arange(n) + rng.uniform(-0.2, 0.2, n)) * 2 * math.pi / n
    feet = 0.3 * np.column_stack([np.cos(angles), np.sin(angles)])
    castors = rng.random(n) < 0.5
    castors[0], castors[1] = True, False
    mu, h, azimuth = rng.uniform(0.2, 0.5), rng.uniform(0.1, 0.25), rng.uniform(-math.pi, math.pi)
    cart = Solid.on_feet(feet, 2 * h, castors=castors.tolist(), rolling_resistance=0.03)
    given = cart.contacts
    frictions = np.where(cart.castors, 0.03, mu)
    low, high = 0.0, 0.6
    for _ in range(20):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if held(given, frictions, h, middle, azimuth) else (low, middle)
    assert 0.01 < low < 0.5
    assert stays(cart, low * (1 - 2 * NEAR), azimuth, mu)
    assert not stays(cart, low * (1 + 2 * NEAR), azimuth, mu)


def test_a_cart_turns_about_its_locked_wheels() -> None:
    """Pushed across, it swings about them: one of them stays, its front goes farthest."""
    push = np.zeros(150)
    push[20:60] = 2.0
    motion = Motion(np.zeros(150), 0.01, transverse=push)
    cart = Solid.on_feet(CORNERS, 0.6, castors=[True, False, False, True])
    run = simulate(cart, motion, model=General(static_friction=0.5))
    assert run.outcome is Outcome.STANDING
    assert math.radians(5.0) < -run.yaw < math.radians(90.0)
    assert run.contact[-1] is Contact.BASE
    assert run.grip[-1] is Grip.STICKS
    ends = run.rotation[-1].apply(np.column_stack([cart.contacts, np.full(4, -0.3)]))
    moved = np.hypot(*(ends[:, :2] + run.position[-1, :2] - cart.contacts).T)
    assert moved[np.array(cart.castors)].min() > 1.5 * moved[~np.array(cart.castors)].max()


def test_a_cart_under_an_earthquake_does_not_chatter() -> None:
    """Half a minute of a recorded motion: it slides, turns and rests, with few impacts."""
    motion = next(m for m in suite("fema-p695-far-field", pairs=True) if m.transverse is not None)
    cart = Solid.on_feet(CORNERS, 1.3, castors=[True, True, False, False])
    run = simulate(
        cart, motion, Support(tilt=0.03, azimuth=0.7), model=General(static_friction=0.5)
    )
    assert run.impacts < 1000
    assert run.fallbacks < 20


def test_feet_inside_the_hull_are_feet() -> None:
    """A fifth foot in the middle carries its share."""
    castors = [True] * 4 + [False]
    five = Solid.on_feet([*CORNERS, [0.0, 0.0]], 0.6, castors=castors, rolling_resistance=0.01)
    assert len(ConvexHull(five.contacts).vertices) == 4
    limit = math.atan(0.2 * 0.5 + 0.8 * 0.01)
    # no moment about the normal: the force passes through the middle
    assert stays(five, limit * (1 - NEAR), 0.0, 0.5)
    assert not stays(five, limit * (1 + NEAR), 0.0, 0.5)


@pytest.mark.parametrize("seed", [*range(5), 156, 256, 374])  # of the last three points pulled
def test_a_cart_that_coasts_downhill_gains_no_energy(seed: int) -> None:
    """Pressures must not pull: one did, and a cart on a slope spun ever faster."""
    rng = np.random.default_rng(100 + seed)
    n = int(rng.integers(4, 7))
    angles = (np.arange(n) + rng.uniform(-0.3, 0.3, n)) * 2 * math.pi / n
    feet = 0.3 * np.column_stack([np.cos(angles), np.sin(angles)])
    castors = rng.random(n) < 0.7
    castors[0], castors[1] = True, False
    push = np.zeros((300, 3))
    push[:60] = rng.uniform(-8.0, 8.0, 3)
    push[:60, 2] *= 0.3
    x, y, z = push.T
    cart = Solid.on_feet(feet, rng.uniform(0.5, 2.0), castors=castors.tolist())
    support = Support(tilt=0.05, azimuth=rng.uniform(-math.pi, math.pi))
    run = simulate(
        cart, Motion(x, 0.01, transverse=y, vertical=z), support, model=General(static_friction=0.5)
    )
    lean = np.array([math.cos(support.azimuth), math.sin(support.azimuth), 0.0])
    gravity = STANDARD_GRAVITY * (
        math.sin(0.05) * lean - math.cos(0.05) * np.array([0.0, 0.0, 1.0])
    )
    energy = (
        0.5 * (run.velocity**2).sum(axis=1)
        + 0.5 * np.einsum("ki,ij,kj->k", run.angular_velocity, cart.inertia, run.angular_velocity)
        - run.position @ gravity
    )
    quiet = energy[62:]
    assert (np.diff(quiet) <= 1e-7 * np.abs(quiet[0])).all()


ROLLING = 0.03
STEP, LASTS = 0.02, 2.0  # s


def random_cart(seed: int) -> tuple[Solid, np.ndarray, float]:
    """A low cart on castors and locked feet, a smooth motion in two directions, and a friction."""
    rng = np.random.default_rng(seed)
    n = 3 if seed % 2 == 0 else int(rng.integers(4, 7))
    angles = (np.arange(n) + rng.uniform(-0.2, 0.2, n)) * 2 * math.pi / n
    castors = rng.random(n) < 0.5
    castors[0], castors[1] = True, False
    cart = Solid.on_feet(
        0.3 * np.column_stack([np.cos(angles), np.sin(angles)]), rng.uniform(0.2, 0.5),
        castors=castors.tolist(), rolling_resistance=ROLLING,
    )  # fmt: skip
    t = np.arange(0.0, LASTS, STEP)
    motion = np.zeros((t.size, 2))
    for j in range(2):
        for _ in range(4):
            rate, phase = 2 * math.pi * rng.uniform(0.3, 2.5), rng.uniform(0.0, 2 * math.pi)
            motion[:, j] += rng.uniform(0.5, 1.5) * np.sin(rate * t + phase)
    ramp = np.minimum(1.0, np.minimum(t, t[-1] - t) / 0.4)[:, None]
    return cart, ramp * motion, rng.uniform(0.2, 0.5)


def ends(cart: Solid, motion: np.ndarray, mu: float, finer: int = 1) -> np.ndarray:
    """Where a cart ends, its motion sampled more finely: (x, y, yaw)."""
    t = np.arange(len(motion)) * STEP
    at = np.arange((len(motion) - 1) * finer + 1) * STEP / finer
    x, y = (np.interp(at, t, each) for each in motion.T)
    run = simulate(cart, Motion(x, STEP / finer, transverse=y), model=General(static_friction=mu))
    assert run.settled
    return np.array([run.displacement_x, run.displacement_y, run.yaw])


@pytest.mark.parametrize("seed", range(10))
def test_finer_samples_of_the_same_motion_change_nothing(seed: int) -> None:
    """They did by up to 0.08 rad: a contact kept on beyond its limit until an interval's end.

    Below 1 mm/s friction keeps a direction that hangs on the steps: 0.1 mm and 0.1 mrad are let
    pass, of which less than a tenth is usual.
    """
    cart, motion, mu = random_cart(seed)
    assert ends(cart, motion, mu, 7) == pytest.approx(ends(cart, motion, mu), abs=1e-4)


@pytest.mark.slow  # the stepping alone compiles for ten seconds
@pytest.mark.parametrize("seed", [0, 4, 6, 8])
def test_castors_beside_locked_feet_against_time_stepping(seed: int) -> None:
    """Of three feet, whose pressures are unique. The stepping is of first order: extrapolated."""
    cart, motion, mu = random_cart(seed)
    frictions = np.where(cart.castors, ROLLING, mu)
    until_it_rests = np.vstack([motion, np.zeros((30, 2))])
    given = cart.contacts, frictions, cart.cg_height, cart.inertia[2, 2], until_it_rests, STEP
    coarse, fine = (slide(*given, parts) for parts in (20, 40))
    truth = 2.0 * fine - coarse
    assert np.abs(fine - coarse).max() < 2e-3  # it has converged
    assert ends(cart, motion, mu) == pytest.approx(truth, abs=3e-4)


def test_how_far_it_comes_is_told_though_it_rolls_back() -> None:
    """Free castors under one full sine: out by a known way, and nearly back at its end."""
    cart = Solid.on_feet(CORNERS, 0.6, castors=[True] * 4, rolling_resistance=0.02)
    t = np.arange(0.0, 8.0, 0.01)
    push = 0.5 * np.sin(2 * math.pi * t / 4.0) * (t < 4.0)
    back = np.concatenate([push, -push])  # the same the other way
    run = simulate(cart, Motion(back, 0.01, transverse=0 * back), model=General())
    path = np.hypot(*(run.foot[:, :2] - run.foot[0, :2]).T)
    ended = math.hypot(run.displacement_x, run.displacement_y)
    assert run.farthest_displacement == pytest.approx(path.max(), rel=1e-3)  # samples, and steps
    assert run.farthest_displacement > 3 * ended
