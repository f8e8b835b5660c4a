"""Planar bodies at walls against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import (
    Body,
    General,
    InputError,
    Motion,
    Strap,
    Support,
    Surroundings,
    Wall,
    simulate,
)
from shaketable.errors import SimulationError
from tests.support.surrounded import move

G = 9.80665
BOOKCASE = Body.rectangle(0.32, 1.80)
ALPHA = math.atan2(0.16, 0.9)
QUIET = np.zeros(1500)


def wall(gap: float = 0.0, friction: float = 0.3, e: float = 0.0, **more: float) -> Surroundings:
    return Surroundings(walls=(Wall(gap=gap, friction=friction, restitution=e, **more),))  # type: ignore[arg-type]


@pytest.mark.parametrize("friction", [0.2, 0.5, 3.0])
@pytest.mark.parametrize(("e", "amplitude"), [(0.3, 0.016347), (0.5, 0.046094), (0.9, 0.158366)])
def test_against_its_wall_a_body_leaves_with_e_of_its_rate(
    e: float, amplitude: float, friction: float
) -> None:
    """Base and back close at once, and ω⁺ = -e ω⁻ whatever the friction: cos(α - θ₁) follows.

    The amplitude is read off samples at 0.2 ms: to 1e-6 of α. Only the first impact is told: a
    hair later the order of contacts decides.
    """
    found = move(
        BOOKCASE, np.zeros(6000), 2e-4, General(static_friction=friction), wall(e=e),
        rotation=-0.2 * ALPHA, samples=6000,
    )  # fmt: skip
    theta = -found.state[:, 2] / ALPHA
    first = int(np.argmax(theta < 1e-3))
    assert first * 2e-4 == pytest.approx(0.489604 / 2, abs=1e-3)
    after = theta[first : first + 1500]
    assert after[np.argmax(after)] == pytest.approx(amplitude, abs=2e-6)


def test_it_slides_into_its_wall_and_back() -> None:
    """v₁² = v₀² - 2 μ g gap at the wall, e of that after it; then it stops, and never turns."""
    body = Body.rectangle(0.6, 0.8)
    found = move(
        body, QUIET, 2e-3, General(static_friction=0.3), wall(0.2, 0.3, 0.4),
        state=(0.0, 0.4, 0.0, 1.5, 0.0, 0.0),
    )  # fmt: skip
    assert found.end.slip == pytest.approx(0.170817, abs=1e-6)
    assert found.end.peak < 1e-12
    assert found.end.impacts == 1
    assert not found.end.held_up


@pytest.mark.parametrize(("share", "leans"), [(0.9, False), (1.1, True)])
def test_it_leans_where_friction_holds_its_foot(share: float, leans: bool) -> None:
    """Its top on a smooth wall it rests where μ >= (h tan θ - b)/H, 0.055690 at a gap of 0.5 m."""
    rotation = math.asin(0.5 / 1.8) - 1e-12
    found = simulate(
        BOOKCASE, Motion(QUIET, 0.01), model=General(static_friction=share * 0.055690),
        initial_rotation=rotation, surroundings=wall(0.5, 0.0),
    )  # fmt: skip
    assert found.held_up == leans
    assert (found.outcome == 0) == leans
    if leans:
        assert found.rotation[-1] == pytest.approx(rotation, abs=1e-9)


def test_a_top_that_strikes_a_smooth_wall_lifts_its_foot() -> None:
    """e = 0, no friction at the wall: ω'/ω = 1 - 6 cos²α/(1 + 3 cos²α) of a rectangle, upright.

    It turns about its right corner by 2e-6 until its top is at the wall: so nearly is it upright.
    """
    turn, spin = 1e-6, 0.4
    sine, cosine = math.sin(turn), math.cos(turn)
    X, Y = 0.16 * cosine - 0.9 * sine, -0.16 * sine - 0.9 * cosine
    found = move(
        BOOKCASE, np.zeros(3), 1e-5, General(static_friction=5.0), wall(1.8 * 2e-6, 0.0),
        state=(0.16 - X, -Y, turn, -spin * Y, spin * X, spin), samples=3,
    )  # fmt: skip
    rate = found.state[:, 5] / spin
    assert rate[0] == pytest.approx(1.0)
    expected = 1 - 6 * math.cos(ALPHA) ** 2 / (1 + 3 * math.cos(ALPHA) ** 2)
    assert expected == pytest.approx(-0.488241, abs=1e-6)
    assert rate[1] == pytest.approx(expected, abs=1e-4)  # and gravity for 1e-5 s
    assert found.end.impacts >= 1


def test_a_tilt_opens_the_gap_to_a_vertical_wall() -> None:
    """By 3° the top of a shelf of 1.8 m is 94 mm farther from it than its base."""
    tilted = Support(tilt=math.radians(3))
    push = Motion(np.r_[np.full(30, -2.5), np.zeros(300)], 0.01)
    peaks = []
    for vertical in (True, False):
        run = simulate(
            BOOKCASE, push, tilted, model=General(static_friction=2.0),
            surroundings=wall(0.0, 0.3, 0.0, vertical=vertical),
        )  # fmt: skip
        peaks.append(run.rotation.max())
    assert peaks[1] < 1e-9  # the back of a tilted shelf: it cannot rotate toward it
    assert 0.0 < peaks[0] < 0.094 / 1.8


def test_a_wall_and_its_mirror_image() -> None:
    t = 0.01 * np.arange(800)
    wave = 4.0 * np.sin(7.0 * t) * np.sin(math.pi * t / 8.0)
    body = Body.rectangle(0.3, 1.2)
    model = General(static_friction=0.5, normal_restitution=0.2)
    one = simulate(body, Motion(wave, 0.01), model=model, surroundings=wall(0.01, 0.3, 0.3))
    other = simulate(
        body, Motion(-wave, 0.01), model=model,
        surroundings=wall(0.01, 0.3, 0.3, azimuth=math.pi),
    )  # fmt: skip
    assert one.impacts > 5
    assert other.impacts == one.impacts
    assert other.rotation == pytest.approx(-one.rotation, abs=1e-9)
    assert other.position[:, 0] == pytest.approx(-one.position[:, 0], abs=1e-9)


def test_a_wall_out_of_reach_changes_no_bit() -> None:
    t = 0.01 * np.arange(800)
    motion = Motion(4.0 * np.sin(7.0 * t) * np.sin(math.pi * t / 8.0), 0.01)
    for model in (General(static_friction=0.5), General(normal_restitution=0.4)):
        free = simulate(BOOKCASE, motion, model=model)
        far = simulate(BOOKCASE, motion, model=model, surroundings=wall(3.0))
        assert np.array_equal(free.rotation, far.rotation)
        assert np.array_equal(free.impact_times, far.impact_times)
        assert far.held_up is False
        assert far.displacement_x == free.displacement_x


def test_what_touches_a_wall_rests_on_its_static_friction() -> None:
    """Between kinetic and static friction it stays, flush with a wall that it does not press."""
    t = 0.01 * np.arange(300)
    push = 0.45 * G * np.minimum(t, 1.0) * np.where(t < 2.5, 1.0, 0.0)
    model = General(static_friction=0.5, kinetic_friction=0.3)
    rng = np.random.default_rng(3)
    for _ in range(40):
        body = Body.rectangle(rng.uniform(0.45, 0.7), rng.uniform(0.40, 0.47))
        for side in (1.0, -1.0):
            azimuth = 0.0 if side > 0 else math.pi
            around = wall(0.0, 0.3, 0.0, vertical=False, azimuth=azimuth)
            found = move(body, side * push, 0.01, model, around)
            assert abs(found.end.slip) < 1e-9, body


def test_what_is_given_up_in_mid_motion_is_not_resolved() -> None:
    """A strap that damps so much that its steps are countless: no verdict, and the user is told."""
    t = 0.01 * np.arange(4000)
    motion = Motion(5.0 * np.sin(2.1 * math.pi * t) * np.sin(math.pi * t / 40.0), 0.01)
    strap = Strap(point=(0.05, 0.4), anchor=(0.1, 0.4), stiffness=1e6, damping=1e6)
    body = Body.rectangle(0.1, 0.4, mass=2.0)
    with pytest.raises(SimulationError, match="200,000 steps and ten a sample"):
        simulate(body, motion, model=General(static_friction=0.6),
                 surroundings=Surroundings(straps=(strap,)))  # fmt: skip


def test_what_swings_in_a_strap_does_not_lean() -> None:
    body = Body.rectangle(0.3, 0.6, mass=10.0)
    strap = Strap(point=(-0.15, 0.6), anchor=(-0.3, 0.6), stiffness=1e4)
    run = simulate(body, Motion(QUIET, 0.01), model=General(static_friction=1.0),
                   initial_rotation=-0.1, surroundings=Surroundings(straps=(strap,)))  # fmt: skip
    assert not run.settled
    assert not run.held_up


def test_what_cannot_stand_so_is_told() -> None:
    motion = Motion(QUIET, 0.01)
    with pytest.raises(InputError, match=r"stands 0\.13 m in wall 1"):
        simulate(BOOKCASE, motion, model=General(), initial_rotation=0.1, surroundings=wall(0.05))
    with pytest.raises(InputError, match="belongs to one-sided rocking"):
        simulate(BOOKCASE, motion, model=General(), surroundings=wall(e="sequential"))  # type: ignore[arg-type]
    with pytest.raises(InputError, match="wall is toward"):
        simulate(BOOKCASE, motion, model=General(), surroundings=wall(azimuth=1.0))
    with pytest.raises(InputError, match="must be above the centre of gravity"):
        Body(base=0.3, cg_height=0.6, left=0.1, gyration_radius=0.3, height=0.5)


def test_where_nothing_slips_it_only_rocks_and_jumps() -> None:
    """Without a bound on friction, beside a wall that strikes it off the support at times."""
    t = 0.01 * np.arange(1200)
    motion = Motion(4.5 * np.sin(2.2 * math.pi * t) * np.sin(math.pi * t / 12.0), 0.01)
    run = simulate(BOOKCASE, motion, model=General(), surroundings=wall(0.01, 0.3, 0.3))
    seen = {phase.name for phase in run.phases}
    assert seen == {"REST", "ROCK_RIGHT", "ROCK_LEFT", "FLIGHT"}
    assert run.max_lift > 0.0
    assert run.impacts == run.impact_times.size > 50
