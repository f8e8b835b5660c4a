"""A planar body against a wall: closed forms, and what the model refuses."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import (
    Body,
    InputError,
    Motion,
    Outcome,
    Rocking,
    Strap,
    Support,
    Surroundings,
    Wall,
    simulate,
    simulate_each,
    simulate_many,
)
from shaketable.models.one_sided import restitution_of
from shaketable.units import STANDARD_GRAVITY as G

BOOKCASE = Body.rectangle(0.32, 1.8)
#: α 0.25 and p 2.14 1/s
SQUAT = Body.rectangle(*(2 * 0.75 * G / 2.14**2 * f(0.25) for f in (math.sin, math.cos)))


def against(restitution: float | str | None = None, azimuth: float = 0.0) -> Surroundings:
    wall = Wall(azimuth=azimuth, vertical=False, restitution=restitution)
    return Surroundings(walls=(wall,))


def quiet(seconds: float) -> Motion:
    return Motion(np.zeros(round(seconds / 1e-3)), 1e-3)


#: Body, φ₀, time between impacts (by quadrature) [s], and the amplitudes φ₁ that e_w of 0.3, 0.5
#: and 0.9 leave: cos(α - θ₁) = cos α + e² (cos(α - θ₀) - cos α).
SWINGS = [
    (BOOKCASE, 0.2, 0.489604, (0.016347, 0.046094, 0.158366)),
    (BOOKCASE, 0.5, 0.929405, (0.034401, 0.098763, 0.373680)),
    (SQUAT, 0.2, 0.650158, (0.016362, 0.046127, 0.158397)),
    (SQUAT, 0.5, 1.233062, (0.034464, 0.098918, 0.373862)),
]


@pytest.mark.parametrize(("body", "start", "period", "after"), SWINGS)
@pytest.mark.parametrize("azimuth", [0.0, math.pi])
def test_swings_from_a_wall(
    body: Body, start: float, period: float, after: tuple[float, ...], azimuth: float
) -> None:
    """To the printed digit: half a period until the first impact, and the next amplitude.

    Of samples of 1 ms the highest misses 1e-6 of a swing at most.
    """
    alpha = math.atan2(body.left, body.cg_height)
    away = -1.0 if azimuth == 0.0 else 1.0
    for restitution, known in zip((0.3, 0.5, 0.9), after, strict=True):
        found = simulate(
            body, quiet(2.5), initial_rotation=away * start * alpha,
            surroundings=against(restitution, azimuth),
        )  # fmt: skip
        assert 2 * found.impact_times[0] == pytest.approx(period, abs=1e-6)
        first, second = np.searchsorted(found.time, found.impact_times[:2])
        swing = away * found.rotation[first:second] / alpha
        assert swing.max() == pytest.approx(known, abs=2e-6)
        assert (away * found.rotation).min() >= 0.0


def test_uplift_is_away_from_the_wall_alone() -> None:
    """With a wall at +x from a_x > g tan α on; the other way it takes any acceleration."""
    least = G * math.tan(math.atan2(BOOKCASE.left, BOOKCASE.cg_height))
    for share, moves in ((0.999, False), (1.001, True), (-9.0, False)):
        push = Motion(np.full(50, share * least), 0.01)
        found = simulate(BOOKCASE, push, surroundings=against(0.5))
        assert (found.peak_rotation > 0.0) is moves
    tilted = Support(tilt=math.radians(2.0))
    toward = G * math.tan(math.atan2(BOOKCASE.left, BOOKCASE.cg_height) - tilted.tilt)
    for share, moves in ((0.999, False), (1.001, True)):
        # the ground's a_x in the level frame; on a tilted support uplift about the lower corner
        push = Motion(np.full(50, share * toward), 0.01)
        found = simulate(BOOKCASE, push, tilted, surroundings=against(0.5))
        assert (found.peak_rotation > 0.0) is moves


@pytest.mark.parametrize(
    ("alpha", "known"),
    [(0.10, 0.470655), (0.15, 0.435772), (0.20, 0.390147), (0.25, 0.336674), (0.30, 0.278657)],
)
def test_the_sequential_restitution(alpha: float, known: float) -> None:
    """(1 - 3/2 sin² α)² (3/2 cos² α - 1), Hogan (1992)."""
    body = Body.rectangle(math.sin(alpha), math.cos(alpha))
    assert restitution_of(Wall(), body, Rocking()) == pytest.approx(known, abs=1e-6)
    factored = Rocking(restitution_factor=0.9)
    assert restitution_of(Wall(), body, factored) == pytest.approx(0.9 * known, abs=1e-6)
    assert restitution_of(Wall(restitution=0.4), body, factored) == 0.4


def test_many_and_each_tell_what_one_does() -> None:
    """In the lanes, which bounce without a branch, as in the history of one."""
    t = np.arange(2000) * 5e-3
    wave = G * np.sin(2 * math.pi * t / 0.8) * np.sin(math.pi * t / 10)
    motions = [Motion(size * wave, 5e-3, name=f"{size}") for size in (0.2, 0.25, 0.35, 0.6)]
    bodies = [BOOKCASE, SQUAT]
    many = simulate_many(bodies, motions, surroundings=against(), progress=False)
    each = simulate_each(
        bodies * 4, [motion for motion in motions for _ in bodies], surroundings=against(),
        progress=False,
    )  # fmt: skip
    for k, motion in enumerate(motions):
        for n, body in enumerate(bodies):
            one = simulate(body, motion, surroundings=against())
            lane = many.isel(body=n, motion=k, tilt=0, scale=0).sel(polarity=1)
            assert int(lane.impacts) == one.impacts
            assert float(lane.peak_rotation) == pytest.approx(one.peak_rotation, rel=1e-9)
            assert float(each.peak_rotation[2 * k + n]) == float(lane.peak_rotation)
            assert int(lane.outcome) == int(one.outcome)
    assert int(many.impacts.max()) > 10
    fell = many.outcome.values[many.outcome.values != 0]
    assert fell.size
    assert (fell == int(Outcome.DOWNHILL)).all()


def test_what_does_not_bounce_stops_at_once() -> None:
    """e_w = 0: the first impact is the last."""
    alpha = math.atan2(BOOKCASE.left, BOOKCASE.cg_height)
    found = simulate(BOOKCASE, quiet(2.0), initial_rotation=-0.3 * alpha, surroundings=against(0.0))
    assert found.impacts == 1
    assert found.rotation[-1] == 0.0


def test_what_the_plane_cannot_do_is_told() -> None:
    motion, wall = quiet(0.1), Wall(vertical=False, restitution=0.3)
    strap = Strap(point=(0.16, 0, 1.8), anchor=(0.2, 0, 1.8), stiffness=1e4)
    with pytest.raises(InputError, match=r"without a gap, got 0\.01 m"):
        simulate(BOOKCASE, motion, surroundings=Surroundings(walls=(Wall(gap=0.01),)))
    with pytest.raises(InputError, match="one wall and nothing else"):
        simulate(BOOKCASE, motion, surroundings=Surroundings(walls=(wall,), straps=(strap,)))
    with pytest.raises(InputError, match="one wall and nothing else"):
        simulate_many([BOOKCASE], [motion], surroundings=Surroundings(walls=(wall, wall)))
    with pytest.raises(InputError, match=r"azimuth 0 or π, got 1\.0 rad"):
        simulate(BOOKCASE, motion, surroundings=Surroundings(walls=(Wall(azimuth=1.0),)))
    with pytest.raises(InputError, match=r"give Wall\(vertical=False\)"):
        simulate(BOOKCASE, motion, Support(tilt=0.02), surroundings=Surroundings(walls=(Wall(),)))
    with pytest.raises(InputError, match="is into the wall"):
        simulate(BOOKCASE, motion, initial_rotation=0.02, surroundings=against(0.3))
    off = Body.rectangle(0.32, 1.8, eccentricity=0.4)
    with pytest.raises(InputError, match="is a homogeneous rectangle's"):
        simulate(off, motion, surroundings=against())
    assert simulate(off, motion, surroundings=against(0.3)).outcome is Outcome.STANDING


def test_another_body_is_rocked_on_its_far_side() -> None:
    """Off centre it lifts from tan α of the side away from the wall, as it does without."""
    off = Body.rectangle(0.32, 1.8, eccentricity=0.4)
    push = Motion(np.r_[np.full(40, 0.16 * G), np.zeros(60)], 0.01)
    free, held = simulate(off, push), simulate(off, push, surroundings=against(0.3))
    assert held.peak_rotation == free.peak_rotation > 0.0
    other = simulate(off, push, surroundings=against(0.3, math.pi))
    assert other.peak_rotation == 0.0
