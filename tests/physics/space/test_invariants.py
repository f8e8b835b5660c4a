"""What holds for every solid from any state: energy, cone, penetration, symmetry."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from shaketable import General, Motion, Outcome, Solid, Support, simulate, uneven_rims
from tests.support.solids import energy, quiet, released

PENETRATION = 1e-9  # m


def random_solid(rng: np.random.Generator, uneven: bool = False) -> Solid:
    kind = rng.integers(3)
    if kind == 0 or uneven:
        drum = Solid.cylinder(rng.uniform(0.1, 0.6), rng.uniform(0.1, 1.5))
        return uneven_rims(drum, 1, seed=3, rise=(1e-4, 5e-3))[0] if uneven else drum
    corners = int(rng.integers(3, 12))
    angles = (np.arange(corners) + rng.uniform(-0.3, 0.3, corners)) * 2 * np.pi / corners
    base = rng.uniform(0.05, 0.4) * np.column_stack([np.cos(angles), np.sin(angles)])
    # principal moments that a body can have, turned
    x, y, z = rng.uniform(0.01, 0.3, 3)
    turn = Rotation.random(random_state=int(rng.integers(2**31))).as_matrix()
    inertia = turn @ np.diag([y + z, x + z, x + y]) @ turn.T
    height = rng.uniform(0.2, 1.5)
    if kind == 1:
        return Solid.polygon(base, height, inertia=(inertia + inertia.T) / 2)
    feet = base[:8]
    return Solid.on_feet(feet, height, inertia=(inertia + inertia.T) / 2)


@pytest.mark.parametrize(
    ("seed", "uneven"), [*((k, False) for k in range(40)), *((k, True) for k in range(15))]
)
def test_energy_falls_and_nothing_sinks_in(seed: int, uneven: bool) -> None:
    """On a support at rest, from a random state: total energy never rises, no point sinks in.

    Tolerance of energy: steps are accepted at errors of 1e-9 in the velocities, a few hundred of
    them, of 1 m/s; a base is laid flat from up to 1e-9 m.
    """
    rng = np.random.default_rng(seed)
    solid = random_solid(rng, uneven)
    model = General(
        static_friction=rng.uniform(0.0, 1.2), normal_restitution=rng.choice([0.0, 0.4])
    )
    tilt, azimuth = rng.choice([0.0, 0.1]), rng.uniform(-np.pi, np.pi)
    rotation = Rotation.from_rotvec([*rng.normal(0.0, 0.15, 2), rng.uniform(-3, 3)])
    reach = 0.5 * solid.diameter if solid.diameter else float(np.hypot(*solid.contacts.T).max())
    run = released(
        solid, model, quiet(1.5), rotation=rotation,
        position=(0.0, 0.0, solid.cg_height + reach * math.sin(0.6)),
        velocity=rng.normal(0.0, 0.5, 3), spin=rng.normal(0.0, 1.0, 3),
        tilt=tilt, azimuth=azimuth,
    )  # fmt: skip
    assert np.isfinite(run.position).all()
    down = 9.80665 * np.array(
        [math.sin(tilt) * math.cos(azimuth), math.sin(tilt) * math.sin(azimuth), -math.cos(tilt)]
    )
    total = energy(solid, run, down)
    assert np.diff(total).max() < 1e-6
    assert total[-1] <= total[0]
    axis = run.rotation.apply([0.0, 0.0, 1.0])
    lows = [
        run.position[:, 2] + run.rotation.apply([*point, -solid.cg_height])[:, 2]
        for point in solid.contacts
    ]
    if solid.diameter:
        rim = (solid.rise - solid.cg_height) * axis[:, 2] - reach * np.hypot(*axis[:, :2].T)
        lows.append(run.position[:, 2] + rim)
    assert np.min(lows) > -PENETRATION


def shaken(seed: int) -> tuple[Solid, Motion, Support, General, float]:
    """A box under a short pulse, over before many impacts."""
    rng = np.random.default_rng(seed)
    solid = Solid.box(rng.uniform(0.2, 0.4), rng.uniform(0.2, 0.4), rng.uniform(0.8, 1.6))
    t = np.arange(80) * 0.01
    size = 1.6 * 9.81 * math.tan(solid.least_slenderness)
    motion = Motion(
        size * np.sin(2 * np.pi * t / 0.8),
        0.01,
        transverse=0.5 * size * np.sin(2 * np.pi * t / 0.8 + 0.6),
        vertical=0.1 * size * np.sin(13 * t),
    )
    model = General(static_friction=rng.uniform(0.5, 0.9))
    return solid, motion, Support(tilt=0.03, azimuth=rng.uniform(-3, 3)), model, 0.3


UP_TO = 60  # samples: to about the second impact; beyond it chaos decides


@pytest.mark.parametrize("seed", range(6))
def test_a_turn_of_the_whole_scene_turns_the_result(seed: int) -> None:
    solid, motion, support, model, orientation = shaken(seed)
    angle = 1.1
    found = simulate(solid, motion, support, model=model, orientation=orientation)
    turned = simulate(
        solid,
        motion.rotated(angle),
        Support(tilt=support.tilt, azimuth=support.azimuth + angle),
        model=model,
        orientation=orientation + angle,
    )
    n = min(UP_TO, len(found.time), len(turned.time))
    expected = Rotation.from_euler("z", angle).apply(found.position)
    assert turned.position[:n] == pytest.approx(expected[:n], abs=1e-6)


@pytest.mark.parametrize("seed", range(6))
def test_a_mirror_image_gives_the_mirrored_result(seed: int) -> None:
    """y reversed: the box is its own mirror image."""
    solid, motion, support, model, orientation = shaken(seed)
    assert motion.transverse is not None
    found = simulate(solid, motion, support, model=model, orientation=orientation)
    other = Motion(
        motion.horizontal, motion.time_step, transverse=-motion.transverse, vertical=motion.vertical
    )
    mirrored = simulate(
        solid,
        other,
        Support(tilt=support.tilt, azimuth=-support.azimuth),
        model=model,
        orientation=-orientation,
    )
    n = min(UP_TO, len(found.time), len(mirrored.time))
    assert mirrored.position[:n] == pytest.approx(found.position[:n] * [1, -1, 1], abs=1e-6)


@pytest.mark.parametrize("seed", range(6))
def test_relabelled_corners_give_the_same(seed: int) -> None:
    solid, motion, support, model, orientation = shaken(seed)
    found = simulate(solid, motion, support, model=model, orientation=orientation)
    order = Solid.polygon(np.roll(solid.corners, 2, axis=0)[::-1], solid.height or 0.0)
    again = simulate(order, motion, support, model=model, orientation=orientation)
    n = min(UP_TO, len(found.time), len(again.time))
    assert again.position[:n] == pytest.approx(found.position[:n], abs=1e-6)


def test_rings_of_ever_more_points_come_to_the_circle() -> None:
    """Prisms of 8, 16, 32 and 64 corners with a cylinder's inertia, before any impact."""
    t = np.arange(60) * 0.01
    motion = Motion(
        5.0 * np.sin(2 * np.pi * t / 0.6), 0.01, transverse=3.0 * np.sin(2 * np.pi * t / 0.6 + 0.5)
    )
    circle = Solid.cylinder(0.3, 1.0)
    until = 40
    expected = simulate(circle, motion, model=General(static_friction=0.8))
    errors = []
    for corners in (8, 16, 32, 64):
        angles = 2 * np.pi * (np.arange(corners) + 0.37) / corners
        base = 0.15 * np.column_stack([np.cos(angles), np.sin(angles)])
        prism = Solid.polygon(base, 1.0, inertia=circle.inertia)
        found = simulate(prism, motion, model=General(static_friction=0.8))
        n = min(until, len(found.time), len(expected.time))
        errors.append(float(np.abs(found.nutation[:n] - expected.nutation[:n]).max()))
    assert errors[3] < errors[2] < errors[0]
    assert errors[3] < 0.05 * float(expected.nutation[:until].max())


def test_polarity_reverses_the_fall() -> None:
    """A motion reversed in both horizontal components: the fall is on the other side."""
    solid, motion, _, model, _ = shaken(1)
    strong = motion.scaled(2.0)
    one = simulate(solid, strong, model=model)
    other = simulate(solid, strong.reversed(), model=model)
    assert one.outcome is not Outcome.STANDING
    apart = math.remainder(one.fall_azimuth - other.fall_azimuth - math.pi, 2 * math.pi)
    assert abs(apart) < 1e-6
