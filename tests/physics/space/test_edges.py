"""Solids that leave their support over an edge."""

from __future__ import annotations

import math

import numpy as np
import pytest

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

G = 9.80665
BOX = Solid.box(0.30, 0.40, 0.25)
SLIPPERY = General(static_friction=0.2)


def push(size: float = 0.6, along: float = 0.0) -> Motion:
    """A half sine of a size [g] that throws things toward an azimuth [rad]."""
    t = 1e-3 * np.arange(1500)
    pulse = -np.where(t <= 0.4, size * G * np.sin(math.pi * t / 0.4), 0.0)
    return Motion(pulse * math.cos(along), 1e-3, transverse=pulse * math.sin(along))


def test_where_it_leaves_and_where_it_lands() -> None:
    """It slides until its centre of pressure, μ h ahead of its foot, is at the edge; then it falls.

    To what it moves in a sample of 1 ms; the fall is √(2 drop/g).
    """
    around = Surroundings(edge=Edge(at=0.25, drop=0.9))
    run = simulate(BOX, push(), model=SLIPPERY, surroundings=around)
    assert run.off_edge
    assert run.outcome == 1
    assert run.fall_azimuth == 0.0
    x, v = run.position[-1, 0], run.velocity[-1, 0]
    assert x == pytest.approx(0.25 - 0.2 * 0.125, abs=1.1e-3 * v)
    assert run.time[-1] == pytest.approx(run.left_support_at, abs=1.1e-3)
    fall = math.sqrt(2 * 0.9 / G)
    assert run.landing_time == pytest.approx(run.left_support_at + fall, abs=1e-9)
    assert run.overturning_time == run.landing_time
    assert run.landing_x == pytest.approx(x + v * fall, abs=2e-3 * v)
    assert run.landing_y == pytest.approx(0.0, abs=1e-9)
    assert run.landing_speed == pytest.approx(math.hypot(v, G * fall), rel=1e-3)
    assert run.landing_rotation == pytest.approx(0.0, abs=1e-6)
    plane = simulate(Body.rectangle(0.30, 0.25), push(), model=SLIPPERY, surroundings=around)
    assert plane.off_edge
    assert plane.landing_x == pytest.approx(run.landing_x, rel=0.2)  # slowed by the edge
    many = simulate_many([BOX], [push()], polarities=[1], model=SLIPPERY, surroundings=around,
                         progress=False)  # fmt: skip
    assert float(many.landing_x.item()) == run.landing_x
    assert bool(many.off_edge.item())


def test_an_edge_in_any_direction() -> None:
    """Edge, push and box turned together by 50°: the same, turned."""
    turn = math.radians(50.0)
    straight = simulate(BOX, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=0.25)))
    turned = simulate(
        BOX, push(along=turn), model=SLIPPERY, orientation=turn,
        surroundings=Surroundings(edge=Edge(at=0.25, azimuth=turn)),
    )  # fmt: skip
    assert turned.off_edge
    assert turned.left_support_at == pytest.approx(straight.left_support_at, abs=1e-9)
    assert math.hypot(turned.landing_x, turned.landing_y) == pytest.approx(
        straight.landing_x, abs=1e-6
    )
    assert math.atan2(turned.landing_y, turned.landing_x) == pytest.approx(turn, abs=1e-6)


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


def test_what_stands_on_a_corner_beyond_the_edge_has_left() -> None:
    """A slender box that tips toward the edge slides on its corner over it."""
    post = Solid.box(0.12, 0.12, 0.6)
    around = Surroundings(edge=Edge(at=0.08, drop=1.0))
    run = simulate(post, push(0.5), model=General(static_friction=0.3), surroundings=around)
    assert run.outcome == 1
    plane = simulate(
        Body.rectangle(0.12, 0.6), push(0.5), model=General(static_friction=0.3),
        surroundings=around,
    )  # fmt: skip
    assert plane.outcome == 1


def test_what_space_does_not_know_is_told() -> None:
    lip = Surroundings(edge=Edge(at=0.3, lip=0.01))
    with pytest.raises(InputError, match="lips are of planar bodies so far"):
        simulate(BOX, push(), model=SLIPPERY, surroundings=lip)
    with pytest.raises(InputError, match=r"its base reaches 0\.25 m"):
        simulate(
            BOX, push(), orientation=math.atan2(0.4, 0.3), model=SLIPPERY,
            surroundings=Surroundings(edge=Edge(at=0.2)),
        )  # fmt: skip
