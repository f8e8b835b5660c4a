"""What would fall without its walls and straps: the run goes on without them, the ground at rest.

Each case is let go, comes to rest in its surroundings, and is then let go again without them from
the state in which it rests, by a run of its own, whose ending must be that which the first tells.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from shaketable import Edge, General, Solid, Strap, Surroundings, Wall
from shaketable.physics.space.found import OVERTURNED
from tests.support.solids import Run, quiet, released

B, W, H, MASS = 0.32, 0.90, 1.80, 120.0
ALPHA = math.atan(B / H)
BOX = Solid.box(B, W, H, mass=MASS)
SQUARE = Solid.box(B, B, H, mass=MASS)
ROD = Solid.cylinder(0.24, 1.5, mass=70.0, rolling_friction=0.002, contour_friction=0.002,
                     drilling_friction=0.002)  # fmt: skip
ROUGH = General(static_friction=2.0)


def leaning(
    solid: Solid, nutation: float, toward: float, around: Surroundings, tilt: float = 0.0
) -> Run:
    """A solid at rest, turned about the horizontal line through its lowest point or side.

    Args:
        nutation: of its axis [rad].
        toward: azimuth of its axis [rad].
        around: what surrounds it; anchors count from where it would stand upright.
        tilt: of the support toward -x [rad].
    """
    axis = [-math.sin(toward), math.cos(toward), 0.0]
    rotation = Rotation.from_rotvec(nutation * np.array(axis))
    foot = np.array([math.cos(toward), math.sin(toward), 0.0])
    reach = solid.diameter / 2 if solid.diameter else (solid.corners @ foot[:2]).max()
    pivot = rotation.apply(reach * foot - [0.0, 0.0, solid.cg_height])
    return released(
        solid, ROUGH, quiet(25.0, 0.01), position=reach * foot - pivot, rotation=rotation,
        tilt=tilt, surroundings=around,
    )  # fmt: skip


def again(solid: Solid, run: Run, around: Surroundings | None = None, tilt: float = 0.0) -> bool:
    """Whether it falls from its last state on, alone or with an edge."""
    free = released(
        solid, ROUGH, quiet(30.0, 0.01), position=run.position[-1], rotation=run.rotation[-1],
        velocity=run.velocity[-1], spin=run.spin[-1], tilt=tilt, surroundings=around,
    )  # fmt: skip
    return bool(free.found.ending == OVERTURNED)  # type: ignore[attr-defined]


def strap(slack: float, side: float = -1.0, *, z: float = H, **more: float) -> Strap:
    """From the top of a side, level to an anchor 0.4 m away from it."""
    about = {"stiffness": 4e4, "damping": 3e3, **more}
    return Strap(point=(side * B / 2, 0.0, z), anchor=(side * (B / 2 + 0.4), 0.0, z), slack=slack,
                 **about)  # type: ignore[arg-type]  # fmt: skip


def nutation_of(run: Run) -> float:
    """At the end [rad]."""
    return float(np.arccos(run.rotation[-1].apply([0.0, 0.0, 1.0])[2]))


EDGE = Edge(at=B / 2 + 0.01)
NEAR = 0.003  # m: slack and gaps from where it is let go, so that what catches it hardly rebounds
CASES = {
    # solid, nutation as it is let go, toward, straps, walls or edge, tilt; whether it is held up
    "rights itself in its strap": (BOX, 0.15, 0.0, (strap(NEAR),), (), 0.0, False),
    "hangs in its strap": (BOX, 0.19, 0.0, (strap(NEAR),), (), 0.0, True),
    "tilted toward its fall": (BOX, 0.15, math.pi, (strap(NEAR, 1.0),), (), 0.05, True),
    "pulled up the tilt by its strap": (BOX, 0.02, 0.0, (
        strap(0.0, 1.0, pretension=122.2),
    ), (), 0.05, False),
    # it is raised by r [cos(α + β - θ) - cos(α + β)], more than the r [1 - cos(α - β)] from which
    # it falls the other way
    "pulled farther up the tilt": (BOX, 0.05, 0.0, (
        strap(0.0, 1.0, pretension=104.6),
    ), (), 0.05, True),
    "pulled far up the tilt": (BOX, 0.2, 0.0, (strap(0.0, 1.0, pretension=15.6),), (), 0.05, True),
    "leaning over an edge": (BOX, 0.19, 0.0, (strap(NEAR),), EDGE, 0.0, True),
    "on a corner": (SQUARE, 0.27, math.pi / 4, (
        Strap(point=(-B / 2, -B / 2, H), anchor=(-B, -B, H), stiffness=4e4, damping=3e3,
              slack=NEAR),
    ), (), 0.0, True),
    "one of two straps broke": (BOX, 0.19, 0.0, (
        strap(0.0, strength=20.0), strap(2 * NEAR, stiffness=5e4),
    ), (), 0.0, True),
    "between two walls": (BOX, 0.19, 0.0, (), (
        Wall(gap=NEAR, friction=0.4), Wall(azimuth=math.pi, gap=0.43, friction=0.4),
    ), 0.0, True),
    "between two near walls": (BOX, 0.02, 0.0, (), (
        Wall(gap=NEAR, friction=0.4), Wall(azimuth=math.pi, gap=2 * NEAR, friction=0.4),
    ), 0.0, False),
    "a wall half a metre away": (BOX, 0.281, 0.0, (), (Wall(gap=NEAR, friction=0.4),), 0.0, True),
    "a cylinder in its strap": (ROD, 0.19, 0.0, (
        Strap(point=(-0.12, 0.0, 1.2), anchor=(-0.4, 0.0, 1.2), stiffness=3e4, damping=2e3,
              slack=NEAR),
    ), (), 0.0, True),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_what_is_held_up_falls_once_it_is_let_go(name: str) -> None:
    solid, nutation, toward, straps, beside, tilt, falls = CASES[name]
    edge = beside if isinstance(beside, Edge) else None
    walls = () if isinstance(beside, Edge) else beside
    run = leaning(
        solid, nutation, toward, Surroundings(straps=straps, walls=walls, edge=edge), tilt
    )
    assert run.found.ending != OVERTURNED  # type: ignore[attr-defined]
    assert (run.found.held_up == 1) is falls
    assert again(solid, run, Surroundings(edge=edge) if edge else None, tilt) is falls


def test_how_far_it_is_turned_decides_nothing() -> None:
    """Held up at 0.15 rad on a tilt, at 0.19 on a level support; not at 0.15 there, at α = 0.176.

    Held at 0.02 rad by a strap that pulls, it rests turned, and stands once it is let go.
    """
    ends = {}
    for name, (solid, nutation, toward, straps, beside, tilt, _) in CASES.items():
        if solid is BOX and straps and beside == ():
            run = leaning(solid, nutation, toward, Surroundings(straps=straps), tilt)
            ends[name] = nutation_of(run), run.found.held_up
    assert ends["tilted toward its fall"] == (pytest.approx(0.152, abs=1e-3), True)
    assert ends["hangs in its strap"] == (pytest.approx(0.192, abs=1e-3), True)
    assert ends["pulled up the tilt by its strap"] == (pytest.approx(0.02, abs=1e-3), False)
    assert ends["rights itself in its strap"] == (pytest.approx(0.0, abs=1e-9), False)


def test_a_wall_alone_holds_up_what_leans_half_a_metre_away() -> None:
    """Its top is where sin θ = 0.5/1.8, beyond α."""
    solid, nutation, toward, _, walls, _, _ = CASES["a wall half a metre away"]
    run = leaning(solid, nutation, toward, Surroundings(walls=walls))
    assert nutation_of(run) == pytest.approx(math.asin(0.5 / H), abs=2e-3)
    assert nutation_of(run) > ALPHA
