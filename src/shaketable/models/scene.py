"""A planar body among its surroundings: where it is, and whether it can stand so."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.models.one_sided import side_of
from shaketable.models.solid_input import ContactLaws
from shaketable.surroundings import SEQUENTIAL, Surroundings, Wall

MARGIN = 1e-9  # m: of what is inside


class Scene(NamedTuple):
    """A planar body among its surroundings, if it has any.

    Attributes:
        body, tilt, surroundings: what stands, how its support is tilted [rad], and among what.
        laws: of its contacts with the support.
        clearance: what is nearest of its surroundings is no nearer than this as it stands [m].
    """

    body: Body
    tilt: float
    surroundings: Surroundings | None
    laws: ContactLaws
    clearance: float


class Place(NamedTuple):
    """Where a planar body is: its centre of gravity, and how it is turned."""

    x: float  # m
    z: float
    rotation: float  # rad


def scenes_of(
    bodies: Sequence[Body],
    tilts: NDArray[np.float64],
    surroundings: Sequence[Surroundings | None],
    laws: ContactLaws,
) -> NDArray[np.object_]:
    """A Scene of each body on its support, (body,)."""
    scenes = np.empty(len(bodies), np.object_)
    for k, (body, tilt, around) in enumerate(zip(bodies, tilts, surroundings, strict=True)):
        near = clearance(body, float(tilt), around) if around else math.inf
        scenes[k] = Scene(body, float(tilt), around, laws, near)
    return scenes


def require_surrounded(body: Body, around: Surroundings) -> None:
    """InputError if a planar body cannot stand in its surroundings."""
    name = body.name or repr(body)
    for k, wall in enumerate(around.walls, 1):
        side_of(wall.azimuth, "wall")
        if wall.restitution == SEQUENTIAL:
            raise InputError(
                f'{name}, wall {k}: restitution="{SEQUENTIAL}" belongs to one-sided rocking, '
                "Rocking(...); give a number from 0 to 1"
            )
    held = [f"strap {k}" for k in range(1, len(around.straps) + 1)] + ["pad"] * bool(around.pad)
    if held and body.mass is None:
        raise InputError(f"{name}, {held[0]}: newtons need a mass; give Body(mass=...) [kg]")
    for k, strap in enumerate(around.straps, 1):
        if len(strap.point) != 2:
            raise InputError(
                f"{name}, strap {k}: in the plane its point and its anchor are (x, z), got "
                f"{strap.point}"
            )
        x, z = strap.point
        slack = MARGIN * body.base
        inside = -body.left - slack <= x <= body.right + slack
        if not (inside and 0.0 <= z <= body.whole_height * (1.0 + MARGIN)):
            raise InputError(
                f"{name}, strap {k}: its point {strap.point} [m] lies outside the body, whose "
                "frame begins at the foot of its centre of gravity and which is "
                f"{body.whole_height:g} m high"
            )
        length = math.dist(strap.point, strap.anchor)
        if not length > strap.stretch_at_start:
            raise InputError(
                f"{name}, strap {k}: from its point to its anchor are {length:g} m at the start, "
                f"which must be more than its stretch of {strap.stretch_at_start:g} m"
            )
    if around.edge:
        reach = body.right if side_of(around.edge.azimuth, "edge") > 0.0 else body.left
        if not around.edge.at >= reach * (1.0 - MARGIN):
            raise InputError(
                f"{name}: its base reaches {reach:g} m from the foot of the centre of gravity, "
                f"beyond the edge of the support at {around.edge.at:g} m"
            )


def placed(body: Body, points: NDArray[np.float64], place: Place) -> NDArray[np.float64]:
    """Where points of its frame are on its support, (n, 2) [m]."""
    sine, cosine = math.sin(place.rotation), math.cos(place.rotation)
    x, up = points[:, 0], points[:, 1] - body.cg_height
    return np.column_stack([place.x + x * cosine + up * sine, place.z + up * cosine - x * sine])


def upright_of(body: Body) -> Place:
    """Where a body stands at rest."""
    return Place(0.0, body.cg_height, 0.0)


def let_go(body: Body, rotation: float) -> Place:
    """Where it is at a rotation [rad], on the corner that it then stands on, where that stood."""
    pivot = body.right if rotation > 0.0 else -body.left
    sine, cosine = math.sin(rotation), math.cos(rotation)
    return Place(
        pivot - (pivot * cosine - body.cg_height * sine),
        body.cg_height * cosine + pivot * sine,
        rotation,
    )


def corners_of(body: Body) -> NDArray[np.float64]:
    """Its four, in its frame; (4, 2) [m]."""
    height = body.whole_height
    return np.array([(x, z) for x in (body.right, -body.left) for z in (0.0, height)])


def gap_of(wall: Wall, scene: Scene, place: Place) -> float:
    """Distance of a body from a wall that is given as it stands upright [m]."""
    side, lean = side_of(wall.azimuth, "wall"), scene.tilt if wall.vertical else 0.0
    normal = np.array([-side * math.cos(lean), side * math.sin(lean)])
    corners = corners_of(scene.body)
    upright, now = (
        (placed(scene.body, corners, each) @ normal).min()
        for each in (upright_of(scene.body), place)
    )
    return float(wall.gap + now - upright)


def clearance(body: Body, tilt: float, around: Surroundings) -> float:
    """How far something of a body can move, upright at first, and meet nothing [m]."""
    if around.pad:
        return 0.0
    near = [wall.gap for wall in around.walls] + [strap.excess for strap in around.straps]
    if around.edge:
        side = side_of(around.edge.azimuth, "edge")
        near.append(around.edge.at - (body.right if side > 0.0 else body.left))
    return min(near, default=math.inf)


def require_clear(scene: Scene, rotation: float) -> None:
    """InputError if a body that is let go at a rotation [rad] stands in a wall, or in the lip."""
    place = let_go(scene.body, rotation)
    for k, wall in enumerate(scene.surroundings.walls if scene.surroundings else (), 1):
        gap = gap_of(wall, scene, place)
        if gap < -MARGIN:
            raise InputError(
                f"initial_rotation [rad]: at {rotation!r} the body stands {-gap:.3g} m in wall {k}"
            )
    _require_clear_of_lip(scene, rotation)


def _require_clear_of_lip(scene: Scene, rotation: float) -> None:
    """InputError if the lip of the edge is inside of a body that is let go at a rotation [rad]."""
    body, edge = scene.body, scene.surroundings.edge if scene.surroundings else None
    if edge is None:
        return
    pivot = body.right if rotation > 0.0 else -body.left
    x, z = side_of(edge.azimuth, "edge") * edge.at - pivot, edge.lip
    xi = pivot + x * math.cos(rotation) - z * math.sin(rotation)
    up = x * math.sin(rotation) + z * math.cos(rotation)
    inside = -body.left + MARGIN < xi < body.right - MARGIN
    if inside and MARGIN < up < body.whole_height - MARGIN:
        raise InputError(f"initial_rotation [rad]: at {rotation!r} the body stands in the lip")
