"""A base that slips flat: its short ways against the reactions of any contact."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from shaketable import General, Solid
from shaketable.models.solid_input import shapes_of
from shaketable.physics.space.closing import close_all
from shaketable.physics.space.constraints import react
from shaketable.physics.space.contacts import axes_at
from shaketable.physics.space.flat_slip import (
    is_upright,
    slide_and_turn,
    slide_straight,
    slides_straight,
)
from shaketable.physics.space.modes import arrange
from shaketable.physics.space.touches import add_near, begin_list
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.workspace import (
    FLAT,
    SLIPS,
    STATE,
    P,
    Q,
    V,
    W,
)

ANGLES = 2 * math.pi * np.arange(5) / 5
PRISM = Solid.polygon(0.2 * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)]), 0.8)
# its axes of inertia are inclined to those of its base
ASKEW = np.array([[0.12, 0.01, 0.02], [0.01, 0.13, -0.03], [0.02, -0.03, 0.05]])
FEET = np.array([[-0.3, -0.2], [0.35, -0.2], [0.3, 0.25], [-0.3, 0.2]])
SOLIDS = {
    "box": Solid.box(0.4, 0.3, 1.0, eccentricity=(0.45, 0.6)),
    "prism": PRISM,
    "askew": replace(PRISM, inertia=ASKEW),
    "losses": Solid.cylinder(0.4, 0.6, drilling_friction=0.01),
    "castors": Solid.on_feet(FEET, 1.0, castors=(True, True, False, False)),
}
PULL = Vec(1.0, -2.0, -9.8)


def sliding(name: str, friction: float, rng: np.random.Generator, spin: float) -> tuple[Any, Any]:
    """A solid that lies flat somewhere and slips with all of its points."""
    shapes, workspaces = shapes_of(SOLIDS[name], General(static_friction=friction))
    shape, work = shapes[0], workspaces[0]
    n = int(shape.contacts)
    state, half = np.zeros(STATE), rng.uniform(-math.pi, math.pi)
    state[P : P + 3] = 0.3, 0.2, shape.h
    state[V : V + 2] = rng.normal(size=2)
    state[W + 2] = spin
    state[Q], state[Q + 3] = math.cos(half), math.sin(half)
    work.state[:] = state
    begin_list(work)
    for point in range(n):
        add_near(work, point)
        work.touches[point].slip_x = 1.0
    close_all(shape, work)
    arrange(shape, work, SLIPS, -1)
    assert work.mode.kind == FLAT
    return shape, work


@pytest.mark.parametrize(
    ("name", "friction", "spin"),
    [("box", 0.1, 1.0), ("box", 0.25, 3.0), ("prism", 0.2, 1.0), ("askew", 0.15, 2.0),
     ("losses", 0.3, 1.0), ("castors", 0.3, 1.0), ("box", 0.1, 0.0)],
)  # fmt: skip
def test_it_slides_and_turns_as_any_contact(name: str, friction: float, spin: float) -> None:
    """Both solve the same equations, to round-off, also where some points bear nothing."""
    rng = np.random.default_rng(20261127)
    borne = []
    for _ in range(20):
        shape, work = sliding(name, friction, rng, spin)
        n = work.mode.closed
        q, y = axes_at(work.state), work.state
        linear, rate, found = slide_and_turn(shape, work, q, y, PULL)
        shares = work.touches["share"][:n].copy()
        work.touches["share"] = 0.0
        expected_linear, expected_turn = react(shape, work, q, y, PULL)
        assert found == (work.touches["share"][:n, 2].min() >= 0.0)
        if not found:
            continue
        # of accelerations up to ten, and systems whose condition is below 1e3
        np.testing.assert_allclose(linear, expected_linear, rtol=0.0, atol=1e-11)
        np.testing.assert_allclose((0.0, 0.0, rate), expected_turn, rtol=0.0, atol=1e-10)
        np.testing.assert_allclose(shares[:, 2], work.touches["share"][:n, 2], rtol=0.0, atol=1e-10)
        borne.append(int((shares[:, 2] > 0.0).sum()))
    assert borne
    if name == "box" and friction == 0.25:
        assert min(borne) < 4


@pytest.mark.parametrize(("name", "friction"), [("box", 0.1), ("box", 0.4), ("losses", 0.3)])
def test_it_slides_straight_as_any_contact(name: str, friction: float) -> None:
    """The sign of the margin tells whether the pressures can bear it flat."""
    rng = np.random.default_rng(20261127)
    flat = []
    for _ in range(20):
        shape, work = sliding(name, friction, rng, 0.0)
        q, y = axes_at(work.state), work.state
        assert slides_straight(shape, work, y)
        linear, press = slide_straight(shape, work, q, y, PULL)
        expected_linear, expected_turn = react(shape, work, q, y, PULL)
        shares = work.touches["share"][: work.mode.closed, 2]
        stays = bool(shares.min() >= -1e-12 * shares.sum())
        assert (press >= 0.0) == stays
        flat.append(stays)
        if stays:
            np.testing.assert_allclose(linear, expected_linear, rtol=0.0, atol=1e-11)
            np.testing.assert_allclose(expected_turn, 0.0, rtol=0.0, atol=1e-9)
    assert any(flat)
    assert all(flat) == (friction < 0.4)


def test_what_decides_between_the_ways() -> None:
    rng = np.random.default_rng(20261127)
    shape, work = sliding("box", 0.1, rng, 0.0)
    y = work.state
    assert is_upright(y)
    assert slides_straight(shape, work, y)
    y[V], y[V + 1] = 0.1 * shape.limits.turning, 0.0
    assert slides_straight(shape, work, y)  # so slow that friction opposes the slip as it began
    work.touches[1].slip_x, work.touches[1].slip_y = 0.0, 1.0
    assert not slides_straight(shape, work, y)
    turning = sliding("box", 0.1, rng, 1e-12)
    assert not slides_straight(*turning, turning[1].state)
    castors = sliding("castors", 0.3, rng, 0.0)
    assert not slides_straight(*castors, castors[1].state)
    work.state[Q + 1] = 1e-9
    assert not is_upright(work.state)


def test_how_sure_a_straight_slide_is() -> None:
    """N (b - h μ) / R where it cannot tip; b the distance of the nearest side, R of a corner."""
    rng = np.random.default_rng(20261127)
    shape, work = sliding("box", 0.1, rng, 0.0)
    linear, press = slide_straight(shape, work, axes_at(work.state), work.state, PULL)
    nearest, corner = 0.4 * 0.3, math.hypot(0.55 * 0.4, 0.6 * 0.3)
    expected = 9.8 * (nearest - 0.5 * 0.1) / corner
    assert press == pytest.approx(expected, rel=1e-12)
    slip = work.state[V] / math.hypot(work.state[V], work.state[V + 1])
    assert linear.x == pytest.approx(1.0 - 0.98 * slip, rel=1e-12)
