"""Parts of the engine that whole runs seldom show: an impact, an interval, a bound of energy."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import General, Solid, Surroundings, Wall
from shaketable.models.solid_input import shapes_of
from shaketable.physics.space.ending import cannot_fall
from shaketable.physics.space.impact import strike
from shaketable.physics.space.run import place
from shaketable.physics.space.settling import creep
from shaketable.physics.space.step import Pull
from shaketable.physics.space.touches import gather_touches
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.walls import stand_at_walls
from shaketable.physics.space.workspace import P, V, W
from shaketable.units import STANDARD_GRAVITY as G

BOX = Solid.box(0.4, 0.7, 1.1)


@pytest.mark.parametrize("share", [1.0, 0.6, 0.25])
def test_an_impact_takes_a_share_of_a_wall_s_restitution(share: float) -> None:
    """In the air, its back strikes flat: of 0.7 m/s times 0.8 that share comes back.

    Where an impact would give a body energy it is taken again with a smaller share.
    """
    around = Surroundings(walls=(Wall(gap=0.0, friction=0.0, restitution=0.8),))
    shapes, workspaces = shapes_of(BOX, General(static_friction=0.5), around)
    shape, work = shapes[0], workspaces[0]
    place(shape, work, 0.0)
    stand_at_walls(shape, work, Vec(0.0, 1.0, 0.0), 0.0, 1.0)
    work.state[P + 2] += 0.5
    work.state[V] = 0.7
    work.trial[:] = work.state
    assert gather_touches(shape, work, shape.limits.landing, shape.limits.settle, 0.0) > 0
    strike(shape, work, share, 0.0)
    assert work.state[V : V + 3] == pytest.approx(
        [-share * 0.8 * 0.7, 0.0, 0.0], abs=1e-10
    )  # where sweeps of the impact end
    assert work.state[W : W + 3] == pytest.approx(
        np.zeros(3), abs=1e-10
    )  # where sweeps of the impact end


@pytest.mark.slow  # compiles for 20 s; runs that step are held against Moreau's in test_walls.py
def test_time_stepping_takes_the_force_in_the_middle_of_each_step() -> None:
    """In flight under a force that grows linearly the velocity is its exact integral."""
    shapes, workspaces = shapes_of(BOX, General(static_friction=0.5))
    shape, work = shapes[0], workspaces[0]
    place(shape, work, 0.0)
    work.state[P + 2] += 3.0
    force, change, length = Vec(0.3, -0.7, -G), Vec(4.0, 2.5, 3.0), 0.01
    assert not creep(shape, work, Pull(force, change, length), 0.25)
    # from a quarter of the interval on: 0.75 T (f + 0.625 Δf)
    expected = [0.75 * length * (f + 0.625 * d) for f, d in zip(force, change, strict=True)]
    assert work.state[V : V + 3] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(("part", "cannot"), [(0.999, True), (1.001, False)])
@pytest.mark.parametrize("rise", [0.0, 0.002])
def test_the_energy_that_tips_a_cylinder_on_high_points(
    rise: float, part: float, cannot: bool
) -> None:
    """Over its rim, by hand: g (√(R² + (h - rise)²) - h); the rim is higher than the points."""
    points = {"high_points": (0.0, 2.1, 4.2), "rise": rise} if rise else {}
    rod = Solid.cylinder(0.24, 1.5, **points)  # type: ignore[arg-type]
    shapes, workspaces = shapes_of(rod, General(static_friction=0.5))
    shape, work = shapes[0], workspaces[0]
    place(shape, work, 0.0)
    h = rod.cg_height
    energy = G * (math.hypot(0.12, h - rise) - h)
    work.state[V] = math.sqrt(2.0 * part * energy)
    assert cannot_fall(shape, work, Vec(0.0, 0.0, -G)) is cannot
