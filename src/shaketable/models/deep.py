"""A planar body as a solid so deep that it moves in the plane of x and z alone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.models.held import held_of
from shaketable.models.model import Held
from shaketable.models.scene import Place, Scene, gap_of, placed, upright_of
from shaketable.models.solid_input import shapes_of
from shaketable.solid import Solid
from shaketable.surroundings import Pad, Strap, Surroundings
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from shaketable.physics.plane.forcing import Shaking
    from shaketable.physics.space.found import FoundRecords, SolidTrace
    from shaketable.physics.space.ground import GroundAcceleration
    from shaketable.physics.space.workspace import Workspaces

DEPTH = 4.4  # of its diagonal: any will do


class Moved(NamedTuple):
    """What became of the runs of one scene, (run,).

    Attributes:
        found: what is told of each.
        held: what the surroundings did.
    """

    found: FoundRecords
    held: Held


def deep(body: Body) -> Solid:
    """A planar body as a solid that moves in its plane alone, its radius of gyration as it is."""
    depth, i2 = DEPTH * math.hypot(body.base, body.whole_height), body.gyration_radius**2
    across = depth**2 / 12.0 + i2
    right, left, half = body.right, body.left, depth / 2.0
    return Solid(
        np.array([(right, half), (-left, half), (-left, -half), (right, -half)]),
        body.cg_height,
        np.diag([across, i2, across]),
        height=body.whole_height,
        name=body.name,
        mass=body.mass,
    )


def around_deep(scene: Scene, place: Place) -> Surroundings:
    """The surroundings of a body as those of its deep solid, which begins at a place."""
    around = scene.surroundings or Surroundings()
    walls = tuple(replace(wall, gap=max(gap_of(wall, scene, place), 0.0)) for wall in around.walls)
    straps = tuple(_strap_in_space(strap) for strap in around.straps)
    # its four corners pull as two do; what is let go at a rotation stands on none
    glued = around.pad is not None and place.rotation == 0.0
    pad = Pad(pull_off=0.5 * around.pad.pull_off) if around.pad and glued else None
    return replace(around, walls=walls, straps=straps, pad=pad)


def _strap_in_space(strap: Strap) -> Strap:
    (x, z), (anchor_x, anchor_z) = strap.point, strap.anchor
    return replace(strap, point=(x, 0.0, z), anchor=(anchor_x, 0.0, anchor_z))


def ground_of(shaking: Shaking) -> GroundAcceleration:
    """A planar motion in space."""
    from shaketable.physics.space.ground import GroundAcceleration

    acceleration = np.zeros((shaking.a_x.size, 3))
    acceleration[:, 0] = shaking.a_x
    acceleration[:, 2] = shaking.g_effective - STANDARD_GRAVITY
    return GroundAcceleration(acceleration, float(shaking.time_step))


def state_of(place: Place, rates: Sequence[float] = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """The state of its deep solid, (STATE,), its velocities along x and z and its spin given."""
    from shaketable.physics.space.workspace import STATE, P, Q, V, W

    state = np.zeros(STATE)
    state[[P, P + 2, V, V + 2, W + 1]] = place.x, place.z, *rates
    state[[Q, Q + 2]] = math.cos(0.5 * place.rotation), math.sin(0.5 * place.rotation)
    return state


def move(
    scene: Scene,
    ground: GroundAcceleration,
    polarity: NDArray[np.float64],
    trace: SolidTrace,
    place: Place | None = None,
    rates: Sequence[float] = (0.0, 0.0, 0.0),
) -> Moved:
    """Simulate the deep solid of a scene, once for each polarity; the last one is traced.

    Args:
        scene: what is simulated.
        ground: the motion.
        polarity: of each run, (run,).
        trace: for its history.
        place, rates: where it begins, and how fast it is there; None at rest on its base.
    """
    from shaketable.physics.space.drive import move_solid
    from shaketable.physics.space.found import make_found

    body, begins = scene.body, place or upright_of(scene.body)
    around = around_deep(scene, begins)
    reach = max(body.left, body.right)
    shapes, workspaces = shapes_of(deep(body), scene.laws, around, planar_reach=reach)
    if body.restitution_factor is not None:
        shapes["factor"] = body.restitution_factor
    if place is not None:
        workspaces["state"][0] = state_of(place, rates)
        _measure_upright(scene, place, workspaces)
    found = make_found(polarity.size)
    stands = np.zeros((polarity.size, 5))
    # toward azimuth 0 below zero, so that its sines are exact: downhill is -x on a positive tilt
    stands[:, 0], stands[:, 3], stands[:, 4] = -scene.tilt, 1.0, polarity
    move_solid(shapes, workspaces, ground, stands, place is not None, trace, found)
    held = held_of(found, around, body.mass)._replace(landing_y=None)
    return Moved(found, held)


def _measure_upright(scene: Scene, place: Place, workspaces: Workspaces) -> None:
    """Let the straps of what begins elsewhere be as long as where it stands upright."""
    for k, strap in enumerate(scene.surroundings.straps if scene.surroundings else ()):
        now = placed(scene.body, np.array([strap.point]), place)[0]
        longer = math.dist(strap.point, strap.anchor) - math.dist(now, strap.anchor)
        workspaces["straps"][0, k]["slack"] += longer
