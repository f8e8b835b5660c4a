"""Solids at the edge of their support, and at a lip there; planar ones: tests/models/surrounded."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from shaketable import (
    Body,
    Edge,
    General,
    InputError,
    Motion,
    Solid,
    Surroundings,
    simulate,
    simulate_many,
)
from tests.support.solids import energy, quiet, released

G = 9.80665
BOX = Solid.box(0.30, 0.40, 0.25)
SLIPPERY = General(static_friction=0.2)
FIVE = [(0.16, 0.0), (0.08, 0.15), (-0.1, 0.12), (-0.15, -0.05), (0.05, -0.15)]


def push(size: float = 0.6, along: float = 0.0) -> Motion:
    """A half sine of a size [g] that throws things toward an azimuth [rad]."""
    t = 1e-3 * np.arange(1500)
    pulse = -np.where(t <= 0.4, size * G * np.sin(math.pi * t / 0.4), 0.0)
    return Motion(pulse * math.cos(along), 1e-3, transverse=pulse * math.sin(along))


@pytest.mark.parametrize(("past", "falls"), [(-1e-3, False), (1e-3, True)])
@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_a_body_stands_while_its_centre_of_gravity_is_over_the_support(
    past: float, falls: bool, turn: float
) -> None:
    """Placed at rest with its foot 1 mm inside, or outside, of a bare edge, also askew."""
    run = released(
        Solid.box(0.32, 0.5, 0.6), General(static_friction=0.5), quiet(4.0),
        position=(0.4 + past, 0.0, 0.3), rotation=Rotation.from_rotvec((0.0, 0.0, turn)),
        surroundings=Surroundings(edge=Edge(at=0.4, friction=0.5)),
    )  # fmt: skip
    assert (run.found.off_edge == 1) == falls


@pytest.mark.parametrize("turn", [0.0, 0.3, 1.1, 2.9])
def test_what_is_flush_with_the_edge_stands_on_all_of_its_base(turn: float) -> None:
    """Its front is on the line but for round-off, to either side: nothing differs (to 1e-9)."""
    push_back = push(0.35, along=turn + math.pi)
    model = General(static_friction=0.2)
    around = Surroundings(edge=Edge(at=0.15, azimuth=turn))
    flush = simulate(BOX, push_back, model=model, orientation=turn, surroundings=around)
    alone = simulate(BOX, push_back, model=model, orientation=turn)
    assert flush.displacement_x == pytest.approx(alone.displacement_x, abs=1e-9)
    assert flush.peak_rotation == pytest.approx(alone.peak_rotation, abs=1e-9)
    assert abs(alone.displacement_x) + abs(alone.displacement_y) > 0.01


def test_where_it_leaves_and_where_it_lands() -> None:
    """As the planar body, in both doors; it falls to the side of the edge."""
    around = Surroundings(edge=Edge(at=0.25, drop=0.9))
    run = simulate(BOX, push(), model=SLIPPERY, surroundings=around)
    assert run.off_edge
    assert run.outcome == 1
    assert run.fall_azimuth == 0.0
    assert run.overturning_time == run.landing_time > run.left_support_at > 0.4
    assert run.time[-1] == run.landing_time
    assert run.position[-1, 0] == pytest.approx(run.landing_x, abs=1e-12)
    assert run.landing_speed == pytest.approx(float(np.linalg.norm(run.velocity[-1])), abs=1e-12)
    assert "EDGE" in {each.name for each in run.contact}
    plane = simulate(Body.rectangle(0.30, 0.25), push(), model=SLIPPERY, surroundings=around)
    assert run.landing_time == pytest.approx(plane.landing_time, abs=1e-6)
    assert run.landing_x == pytest.approx(plane.landing_x, abs=1e-6)
    many = simulate_many([BOX], [push()], polarities=[1], model=SLIPPERY, surroundings=around,
                         progress=False)  # fmt: skip
    assert float(many.landing_x.item()) == run.landing_x
    assert bool(many.off_edge.item())


@pytest.mark.parametrize(
    "solid",
    [
        BOX,
        Solid.cylinder(0.3, 0.3),
        Solid.polygon(FIVE, 0.3),
        Solid.on_feet([(0.15, 0.12), (-0.15, 0.12), (-0.15, -0.12), (0.15, -0.12)], 0.3,
                      inertia=np.diag([0.01, 0.012, 0.015])),
    ],
    ids=["box", "cylinder", "polygon", "feet"],
)  # fmt: skip
@pytest.mark.parametrize("lip", [0.0, 0.01])
def test_an_edge_in_any_direction(solid: Solid, lip: float) -> None:
    """Edge, push and body turned together by 50°: the same, turned; mirrored, the mirror image."""
    turn = math.radians(50.0)
    edge = Edge(at=0.18, lip=lip, drop=0.8)
    straight = simulate(solid, push(0.7), model=SLIPPERY, surroundings=Surroundings(edge=edge))
    turned = simulate(
        solid, push(0.7, along=turn), model=SLIPPERY, orientation=turn,
        surroundings=Surroundings(edge=Edge(at=0.18, lip=lip, drop=0.8, azimuth=turn)),
    )  # fmt: skip
    assert turned.off_edge == straight.off_edge
    assert straight.off_edge == (lip == 0.0)
    assert turned.peak_rotation == pytest.approx(straight.peak_rotation, rel=1e-4, abs=1e-7)
    if straight.off_edge:
        assert turned.landing_time == pytest.approx(straight.landing_time, abs=1e-5)
        x, y = straight.landing_x, straight.landing_y
        there = (x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn))
        assert (turned.landing_x, turned.landing_y) == pytest.approx(there, abs=1e-4)


def test_an_edge_out_of_reach_changes_no_bit() -> None:
    run = simulate(BOX, push(), model=SLIPPERY)
    far = simulate(BOX, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=5.0)))
    assert np.array_equal(run.position, far.position)
    assert not far.off_edge
    assert math.isnan(far.landing_x)
    away = simulate(
        BOX, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=0.16, azimuth=math.pi))
    )
    assert not away.off_edge


@pytest.mark.parametrize("seed", range(12))
def test_energy_never_rises_at_an_edge(seed: int) -> None:
    """Of boxes and cylinders thrown at a bare edge or a lip on a resting support; to 1e-8."""
    rng = np.random.default_rng(100 + seed)
    solid = Solid.cylinder(0.3, 0.4) if seed % 3 == 0 else Solid.box(0.3, 0.4, 0.5)
    edge = Edge(at=0.3, lip=(0.0, 0.02)[seed % 2], friction=rng.uniform(0.0, 0.6), drop=0.5)
    yaw = Rotation.from_rotvec((0.0, 0.0, rng.uniform(-3.0, 3.0)))
    run = released(
        solid, General(static_friction=rng.uniform(0.1, 0.5), normal_restitution=0.2), quiet(1.5),
        position=(0.0, 0.0, solid.cg_height), rotation=yaw,
        velocity=(rng.uniform(0.8, 2.0), rng.uniform(-0.5, 0.5), 0.0),
        spin=(0.0, 0.0, rng.uniform(-3.0, 3.0)), surroundings=Surroundings(edge=edge),
    )  # fmt: skip
    total = energy(solid, run)
    assert np.diff(total).max() <= 1e-8 * total[0]


def test_a_post_that_tips_toward_the_edge_falls_over_it() -> None:
    post = Solid.box(0.12, 0.12, 0.6)
    around = Surroundings(edge=Edge(at=0.08, drop=1.0))
    run = simulate(post, push(0.5), model=General(static_friction=0.3), surroundings=around)
    assert run.outcome == 1


def test_a_lip_holds_what_would_slide_off() -> None:
    """In lists, too, it is simulated: the box that leaves a bare edge stays behind 5 mm."""
    bare = simulate(BOX, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=0.25)))
    lip = Surroundings(edge=Edge(at=0.25, lip=0.005))
    held = simulate(BOX, push(), model=SLIPPERY, surroundings=lip)
    assert bare.off_edge
    assert not held.off_edge
    assert held.outcome == 0
    assert 0.08 < held.displacement_x <= 0.1  # its front is 0.10 m from the lip


def test_what_cannot_be_near_an_edge_is_told() -> None:
    with pytest.raises(InputError, match=r"its base reaches 0\.25 m"):
        simulate(
            BOX, push(), orientation=math.atan2(0.4, 0.3), model=SLIPPERY,
            surroundings=Surroundings(edge=Edge(at=0.2)),
        )  # fmt: skip
    around = np.linspace(0.0, 2.0 * math.pi, 18)[:-1]
    many = Solid.polygon(0.2 * np.column_stack([np.cos(around), np.sin(around)]), 0.3)
    with pytest.raises(InputError, match="near an edge has at most 16 corners, got 17"):
        simulate(many, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=0.3)))
