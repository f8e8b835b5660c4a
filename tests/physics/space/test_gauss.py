"""A frictionless body in a corner is accelerated as Gauss's principle of least constraint says."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import nnls
from scipy.spatial.transform import Rotation

from shaketable import General, Motion, Solid, Surroundings, Wall
from tests.support.solids import Floats, released

G, STEP = 9.80665, 1e-4
SMOOTH = General(static_friction=0.0)
BOX = Solid.box(0.30, 0.40, 1.0, cg_height=0.4, eccentricity=(0.4, 0.65))
CORNER = Surroundings(
    walls=tuple(Wall(azimuth=at, gap=0.0, friction=0.0) for at in (0.0, 0.5 * np.pi))
)


def levers() -> list[tuple[Floats, Floats]]:
    """Normal and lever of each touch: four below, four on the faces toward x and y each."""
    low, high = np.min(BOX.points, axis=0), np.max(BOX.points, axis=0)
    found = []
    for x in (low[0], high[0]):
        for y in (low[1], high[1]):
            for z in (-BOX.cg_height, BOX.height - BOX.cg_height):
                at = np.array([x, y, z])
                found += [(np.array([0.0, 0.0, 1.0]), at)] if z < 0.0 else []
                found += [(np.array([-1.0, 0.0, 0.0]), at)] if x > 0.0 else []
                found += [(np.array([0.0, -1.0, 0.0]), at)] if y > 0.0 else []
    return found


def least_constrained(force: Floats) -> Floats:
    """v̇ and ω̇ by one least-squares problem with reactions above zero, of touches at rest."""
    rows = np.array([np.concatenate([n, np.cross(at, n)]) for n, at in levers()])
    mobility = np.zeros((6, 6))
    mobility[:3, :3], mobility[3:, 3:] = np.eye(3), np.linalg.inv(BOX.inertia)
    root = np.linalg.cholesky(mobility)
    free = np.concatenate([force, np.zeros(3)])
    reactions = nnls(root.T @ rows.T, -np.linalg.solve(root, free))[0]
    return np.asarray(free + mobility @ rows.T @ reactions)


@pytest.mark.parametrize("seed", range(60))
def test_a_body_in_a_corner_is_accelerated_with_the_least_constraint(seed: int) -> None:
    """The velocity after 0.1 ms, by that time; it has turned by less than 1e-6 meanwhile.

    Whichever of the twelve touches are said to carry, a smooth body has one acceleration.
    """
    rng = np.random.default_rng(seed)
    pushed = rng.normal(size=3) * np.array([6.0, 6.0, 8.0])
    motion = Motion(
        np.full(3, -pushed[0]), STEP,
        transverse=np.full(3, -pushed[1]), vertical=np.full(3, -pushed[2]),
    )  # fmt: skip
    run = released(
        BOX, SMOOTH, motion, position=(0.0, 0.0, BOX.cg_height), rotation=Rotation.identity(),
        surroundings=CORNER,
    )  # fmt: skip
    found = np.concatenate([run.velocity[1], run.spin[1]]) / STEP
    expected = least_constrained(pushed - np.array([0.0, 0.0, G]))
    assert found == pytest.approx(expected, abs=1e-3)
