"""What turns about a point, a side or a rolling rim: its rates are those of any such contact."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from shaketable import General, Solid
from shaketable.models.solid_input import shapes_of
from shaketable.physics.space.closing import close_all
from shaketable.physics.space.contacts import axes_at, find_rim, side_direction, turned_since, twist
from shaketable.physics.space.keeping import hold_point
from shaketable.physics.space.modes import arrange
from shaketable.physics.space.rates import rates
from shaketable.physics.space.straps import TAUT
from shaketable.physics.space.touches import add_near, begin_list
from shaketable.physics.space.turning import (
    NOT_ALONE,
    ROLLS,
    TURNS,
    pivot_of,
    turn_about,
    turn_on_rim,
    turning_kind,
)
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.workspace import SLIPS, STATE, STICKS, P, Q, V, W, vec
from shaketable.surroundings import Strap, Surroundings

OFF_AXIS = [[0.09, 0.01, -0.02], [0.01, 0.11, 0.03], [-0.02, 0.03, 0.05]]  # m²
CORNERS = [(0.3, 0.1), (-0.2, 0.15), (-0.1, -0.2), (0.25, -0.12)]
PRISM = Solid.polygon(CORNERS, 0.9, inertia=OFF_AXIS)
DISC = Solid.cylinder(0.5, 0.7)
ROUNDINGS = 1e-13  # of the largest rate: a few roundings each


def touching(solid: Solid, points: tuple[int, ...], around: Surroundings | None = None) -> Any:
    """A solid that sticks to the support with these points alone; -1 is a rim's lowest."""
    shapes, workspaces = shapes_of(solid, General(static_friction=0.5), around)
    shape, work = shapes[0], workspaces[0]
    begin_list(work)
    for point in points:
        add_near(work, point if point >= 0 else int(shape.contacts))
    close_all(shape, work)
    arrange(shape, work, STICKS, -1)
    return shape, work


def put_at_random(shape: Any, work: Any, rng: np.random.Generator, side: bool) -> Any:
    """Lean it somehow, let it turn somehow about what it touches, and put it on that."""
    state = work.state
    state[Q : Q + 4] = 1.0, *(0.2 * rng.normal(size=3))
    state[Q : Q + 4] /= np.linalg.norm(state[Q : Q + 4])
    state[W : W + 3] = rng.normal(size=3)
    if side:
        state[W : W + 3] = rng.normal() * np.array(side_direction(shape, work))
    state[P : P + 2] = rng.normal(size=2)
    if work.mode.rolls:
        find_rim(shape, work, axes_at(state).z, vec(state, W))
    hold_point(shape, work, state, work.touches[work.closed[0]].point)
    return state


def pulled(rng: np.random.Generator) -> Vec:
    """A force that shaking might bring [m/s²]."""
    return Vec(float(rng.normal()), float(rng.normal()), -9.8)


@pytest.mark.parametrize("points", [(2,), (1, 2)])
def test_a_corner_and_a_side(points: tuple[int, ...]) -> None:
    rng = np.random.default_rng(70)
    shape, work = touching(PRISM, points)
    assert turning_kind(shape, work) == TURNS
    for _ in range(20):
        state, f = put_at_random(shape, work, rng, len(points) > 1), pulled(rng)
        rates(shape, work, state, f, True, work.stages[0])
        turn_about(pivot_of(shape, work), state, f, work.stages[1])
        found, expected = work.stages[1][:V], work.stages[0][:V]
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=ROUNDINGS * abs(expected).max())


def test_a_rim_that_rolls() -> None:
    """And where it rolls to: its place goes on with the velocity that rolling gives it."""
    rng = np.random.default_rng(71)
    shape, work = touching(DISC, (-1,))
    assert turning_kind(shape, work) == ROLLS
    for _ in range(20):
        state, f = put_at_random(shape, work, rng, False), pulled(rng)
        rates(shape, work, state, f, True, work.stages[0])
        turn_on_rim(shape, work, state, f, work.stages[1])
        some = [*range(V), P, P + 1]
        found, expected = work.stages[1][some], work.stages[0][some]
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=ROUNDINGS * abs(expected).max())


def test_numbers_need_no_unit_length() -> None:
    """A stage's quaternion is longer than 1: its rotation is that of its direction."""
    rng = np.random.default_rng(72)
    shape, work = touching(DISC, (-1,))
    state, f = put_at_random(shape, work, rng, False).copy(), Vec(0.4, -0.3, -9.8)
    turn_on_rim(shape, work, state, f, work.stages[0])
    state[Q : Q + 4] *= 1.25
    turn_on_rim(shape, work, state, f, work.stages[1])
    np.testing.assert_allclose(work.stages[1][W : W + 3], work.stages[0][W : W + 3], rtol=1e-13)
    np.testing.assert_allclose(work.stages[1][P : P + 2], work.stages[0][P : P + 2], rtol=1e-13)


def test_what_does_not_turn_alone() -> None:
    """It slips, loses as it rolls, or a strap pulls; one that is loose changes nothing."""
    shape, work = touching(PRISM, (2,))
    work.mode.grip = SLIPS
    assert turning_kind(shape, work) == NOT_ALONE
    shape, work = touching(Solid.cylinder(0.5, 0.7, rolling_friction=0.003), (-1,))
    assert turning_kind(shape, work) == NOT_ALONE
    strap = Strap(point=(0.1, 0.0, 0.8), anchor=(0.6, 0.0, 0.8), stiffness=2e4)
    heavy = Solid.polygon(CORNERS, 0.9, mass=30.0)
    shape, work = touching(heavy, (2,), Surroundings(straps=(strap,)))
    assert turning_kind(shape, work) == TURNS
    work.held[0] = TAUT
    assert turning_kind(shape, work) == NOT_ALONE


@pytest.mark.parametrize("by", [1e-9, 0.004, 0.02, 1.3, -2.9])
def test_how_far_it_has_turned_since(by: float) -> None:
    """Of a body that leans as well, across the cut of its angle; to roundings of numbers near 3."""
    state = np.zeros(STATE)
    for half in (0.3, 1.5, 3.1):
        lean = np.array([0.05, -0.02])
        before = np.cos(half), np.sin(half)
        after = half + 0.5 * by
        state[Q], state[Q + 3] = np.cos(after), np.sin(after)
        state[Q + 1 : Q + 3] = lean
        assert turned_since(state, *before) == pytest.approx(by, abs=1e-15)
        assert twist(state) == pytest.approx(
            (2.0 * after + np.pi) % (2.0 * np.pi) - np.pi, abs=1e-14
        )
