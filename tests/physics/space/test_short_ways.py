"""Slipping contacts by their own short way, beside the way of any contact."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import General, Solid
from shaketable.models.solid_input import shapes_of
from shaketable.physics.space.closing import close_all
from shaketable.physics.space.constraints import react
from shaketable.physics.space.contacts import axes_at, find_rim
from shaketable.physics.space.modes import arrange
from shaketable.physics.space.short_ways import slip, slip_on_two
from shaketable.physics.space.touches import add_near, begin_list
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.workspace import (
    CORNER,
    EDGE,
    SLIPS,
    STATE,
    P,
    Q,
    V,
    W,
    vec,
)

ANGLES = 2 * math.pi * np.arange(5) / 5
SOLIDS = {
    "box": Solid.box(0.4, 0.3, 1.0),
    "prism": Solid.polygon(0.2 * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)]), 0.8),
    "with losses": Solid.cylinder(
        0.4, 1.0, rolling_friction=0.01, contour_friction=0.005, drilling_friction=0.01
    ),
}


@pytest.mark.parametrize(
    ("name", "points"), [("box", (2,)), ("with losses", None), ("box", (1, 2)), ("prism", (4, 0))]
)
def test_slips_are_those_of_any_contact(name: str, points: tuple[int, ...] | None) -> None:
    """Leaning, turning and slipping at random; both solve the same equations, to round-off."""
    rng = np.random.default_rng(20261126)
    shapes, workspaces = shapes_of(SOLIDS[name], General(static_friction=0.5, kinetic_friction=0.4))
    shape, work = shapes[0], workspaces[0]
    closed = points or (int(shape.contacts),)  # the row of a rim's lowest point
    for _ in range(20):
        state = np.zeros(STATE)
        state[P : P + 3], state[V : V + 3] = rng.normal(size=(2, 3))
        state[W : W + 3] = rng.normal(size=3)
        state[Q : Q + 4] = 1.0, *(0.2 * rng.normal(size=3))
        state[Q : Q + 4] /= np.linalg.norm(state[Q : Q + 4])
        work.state[:] = state
        begin_list(work)
        for point in closed:
            add_near(work, point)
        close_all(shape, work)
        arrange(shape, work, SLIPS, -1)
        assert work.mode.kind == (CORNER if len(closed) == 1 else EDGE)
        q = axes_at(work.state)
        if points is None:
            find_rim(shape, work, q.z, vec(work.state, W))
        f = Vec(*rng.normal(size=2), -9.8)
        short = slip if len(closed) == 1 else slip_on_two
        linear, turn = short(shape, work, q, work.state, f)
        shares = work.touches["share"][: len(closed)].copy()
        work.touches["share"] = 0.0
        expected_linear, expected_turn = react(shape, work, q, work.state, f)
        assert np.abs(shares).max() > 0.1
        # of accelerations up to some hundred, and systems whose condition is below 1e3
        np.testing.assert_allclose(linear, expected_linear, rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(turn, expected_turn, rtol=0.0, atol=1e-9)
        found = work.touches["share"][: len(closed)]
        np.testing.assert_allclose(found, shares, rtol=0.0, atol=1e-9)
