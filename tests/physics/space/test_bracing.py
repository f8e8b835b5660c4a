"""Reactions that are not unique: of touches that stick, some inside their cones are enough."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from shaketable import General, Solid, Surroundings, Wall, simulate, suite
from shaketable.physics.space.bracing import brace
from shaketable.physics.space.walled import FIRST_TANGENT, PRESSURE, SECOND_TANGENT, plane_margin
from shaketable.physics.space.workspace import PRESSES, make_workspaces

FOOT, TOP = np.array([0.16, 0.45, -0.9]), np.array([0.16, 0.45, 0.9])


def workspace(*touches: tuple[int, np.ndarray, np.ndarray, float, tuple[float, ...]]) -> Any:
    """Touches that stick: plane, lever, normal, friction and share (along tangents and normal)."""
    work = make_workspaces()[0]
    work.mode.touches = len(touches)
    for place, (plane, lever, normal, friction, share) in enumerate(touches):
        touch = work.touches[place]
        tangent = np.array([0.0, 1.0, 0.0])
        touch.plane, touch.carries, touch.moves = plane, PRESSES, 0
        touch.lever[:], touch.normal[:], touch.tangent[:] = lever, normal, tangent
        touch.binormal[:] = np.cross(normal, tangent)
        touch.static = touch.kinetic = friction
        touch.share[:] = share
    return work


def resultant(work: Any) -> np.ndarray:
    """Force and moment of all shares."""
    total = np.zeros(6)
    for touch in work.touches[: work.mode.touches]:
        axes = np.array([touch.tangent, touch.binormal, touch.normal])
        force = np.array(touch.share) @ axes
        total += np.concatenate([force, np.cross(touch.lever, force)])
    return total


def spare(work: Any, place: int) -> float:
    touch = work.touches[place]
    return float(touch.static * touch.share[2] - math.hypot(touch.share[0], touch.share[1]))


UP, TOWARD = np.array([0.0, 0.0, 1.0]), np.array([-1.0, 0.0, 0.0])


def test_a_wall_holds_a_foot_down() -> None:
    """A foot that needs half of 9.51 holds where the friction of the wall above presses it down.

    Force and moment stay what they were: round-off of 14 m/s² is 1e-14.
    """
    work = workspace(
        (0, FOOT, UP, 0.5, (1.42, -4.54, 9.51)), (1, TOP, TOWARD, 0.3, (0.66, 0.0, 4.03))
    )
    before = resultant(work)
    assert spare(work, 0) < -1e-3
    brace(work)
    assert spare(work, 0) > 0.0 < spare(work, 1)
    assert resultant(work) == pytest.approx(before, abs=1e-13)


def test_what_no_reaction_holds_stays_outside() -> None:
    """The foot needs 6.7 m/s²; with all that the wall's friction adds it has 5.3."""
    work = workspace(
        (0, FOOT, UP, 0.5, (1.42, -6.54, 9.51)), (1, TOP, TOWARD, 0.3, (0.66, 0.0, 4.03))
    )
    before = resultant(work)
    brace(work)
    assert min(spare(work, 0), spare(work, 1)) < -0.5
    assert resultant(work) == pytest.approx(before, abs=1e-13)


@pytest.mark.parametrize("seed", range(20))
def test_one_touch_has_the_friction_that_it_has_left(seed: int) -> None:
    """μ N - |T|, wherever it is: it turned by round-off over round-off, and seemed to slip."""
    rng = np.random.default_rng(seed)
    lever, pressure, (x, y) = rng.normal(size=3), rng.uniform(1.0, 9.0), rng.normal(size=2)
    work = workspace((0, lever, UP, 0.5, (0.0, 0.0, pressure)))
    work.mode.rows, work.mode.pressures = 3, 1
    work.kept[:3] = [[0, PRESSURE], [0, FIRST_TANGENT], [0, SECOND_TANGENT]]
    work.solved[:3] = pressure, x, y
    assert plane_margin(work, 0) == pytest.approx(0.5 * pressure - math.hypot(x, y), abs=1e-12)
    assert work.touches[0].share == pytest.approx([x, y, pressure], abs=1e-12)


def test_beside_a_wall_few_runs_need_time_steps() -> None:
    """Of 20 strong motions 8 do (16 before): with chaos it may be one or two more."""
    pairs = [motion for motion in suite("far-field", pairs=True) if motion.transverse is not None]
    runs = [
        simulate(
            Solid.box(0.32, 0.90, 1.80), motion.scaled(2.0), model=General(static_friction=0.5),
            surroundings=Surroundings(walls=(Wall(gap=0.01, restitution=0.3),)),
        )
        for motion in pairs
    ]  # fmt: skip
    assert len(runs) == 20
    assert sum(run.fallbacks > 0 for run in runs) <= 11
