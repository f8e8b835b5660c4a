"""Walls beside a solid: planes with a friction and a restitution of their own.

A wall is the half space n·p ≥ d, n its unit normal toward the body. It is touched by the points of
the body's outline: a prism's lower and upper corners, or the point of a cylinder's lower and upper
rim that is nearest to the wall, which moves along the rim as the body turns.
"""

from __future__ import annotations

import math

from shaketable.compiled import routine
from shaketable.physics.space.contacts import LEVEL, axes_at
from shaketable.physics.space.vectors import Axes, Vec, cross, dot, on_body, unit
from shaketable.physics.space.workspace import (
    Floats,
    P,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)

UP = Vec(0.0, 0.0, 1.0)


@routine
def outline_arm(shape: SolidParameters, work: Workspace, n: Vec, point: int) -> Vec:
    """r of a point of the outline, on a rim the one nearest to a plane of this normal.

    Args:
        n: the normal, in the body's frame as the result.
    """
    r = vec(work.outline[point], 0)
    if shape.radius > 0.0:
        across = max(math.sqrt(n.x * n.x + n.y * n.y), LEVEL)
        out = -shape.radius / across
        r = Vec(out * n.x, out * n.y, r.z)
    return r


@routine
def outline_drift(shape: SolidParameters, n: Vec, spin: Vec) -> Vec:
    """How fast the nearest point of a rim moves along the body (as `find_rim`), body frame."""
    across = math.sqrt(n.x * n.x + n.y * n.y)
    if shape.radius == 0.0 or across <= LEVEL:
        return Vec(0.0, 0.0, 0.0)
    x, y = -n.x / across, -n.y / across
    turn = cross(n, spin)
    along = -x * turn.x - y * turn.y
    size = shape.radius / across
    return Vec(size * (-turn.x - x * along), size * (-turn.y - y * along), 0.0)


@routine
def wall_gap(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, wall: int, point: int
) -> float:
    """Distance of a point of the outline from a wall [m]."""
    normal = vec(work.planes[wall].normal, 0)
    n = on_body(q, normal)
    r = outline_arm(shape, work, n, point)
    return float(dot(normal, vec(y, P)) + dot(n, r) - work.planes[wall].offset)


@routine
def wall_speed(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, wall: int, point: int
) -> float:
    """How fast that distance grows [m/s]."""
    normal = vec(work.planes[wall].normal, 0)
    n = on_body(q, normal)
    r = outline_arm(shape, work, n, point)
    return dot(normal, vec(y, V)) + dot(n, cross(vec(y, W), r))


@routine
def stand_at_walls(
    shape: SolidParameters, work: Workspace, axis: Vec, sine: float, cosine: float
) -> None:
    """Write the planes, from where the body is at the start and how the support is tilted.

    Args:
        axis, sine, cosine: the support is tilted about this axis by an angle of this sine, as in
            `run.Tilted`.
    """
    put(work.planes[0].normal, 0, UP)
    put(work.planes[0].tangent, 0, Vec(1.0, 0.0, 0.0))
    put(work.planes[0].binormal, 0, Vec(0.0, 1.0, 0.0))
    work.planes[0].offset, work.planes[0].restitution = 0.0, shape.restitution
    q = axes_at(work.state)
    for wall in range(1, shape.walls + 1):
        plane = work.planes[wall]
        n = Vec(-math.cos(plane.toward), -math.sin(plane.toward), 0.0)
        if plane.vertical > 0.0:  # Rᵀ n (Rodrigues)
            along = dot(axis, n) * (1.0 - cosine)
            turned = cross(axis, n)
            n = Vec(
                cosine * n.x - sine * turned.x + along * axis.x,
                cosine * n.y - sine * turned.y + along * axis.y,
                cosine * n.z - sine * turned.z + along * axis.z,
            )
        t = unit(cross(UP, n))
        put(plane.normal, 0, n)
        put(plane.tangent, 0, t)
        put(plane.binormal, 0, cross(n, t))
        plane.offset = 0.0
        nearest = math.inf
        for point in range(shape.outline):
            nearest = min(nearest, wall_gap(shape, work, q, work.state, wall, point))
        plane.offset = nearest - plane.free_gap


@routine
def push_out(shape: SolidParameters, work: Workspace) -> None:
    """Shift a state that stands in a wall along the support until it does not."""
    q, y = axes_at(work.state), work.state
    for wall in range(1, shape.walls + 1):
        nearest = 0.0
        for point in range(shape.outline):
            nearest = min(nearest, wall_gap(shape, work, q, y, wall, point))
        n = vec(work.planes[wall].normal, 0)
        level2 = n.x * n.x + n.y * n.y
        y[P] -= nearest * n.x / level2
        y[P + 1] -= nearest * n.y / level2
