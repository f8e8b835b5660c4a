"""A state put back on its contact, from which it has moved by the error of a step."""

from __future__ import annotations

import math

from shaketable.compiled import routine
from shaketable.physics.space.contacts import (
    arm,
    axes_at,
    closed_point,
    find_rim,
    normalise,
    on_rim,
    side_direction,
)
from shaketable.physics.space.vectors import Vec, add, cross, dot, on_body, on_support, times
from shaketable.physics.space.walled import put_back_at_walls
from shaketable.physics.space.workspace import (
    CORNER,
    FLAT,
    FLIGHT,
    PIVOTS,
    SLIPS,
    STICKS,
    WALLED,
    Floats,
    P,
    Q,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)


@routine
def turn_state(y: Floats, axis: Vec, sine: float) -> None:
    """Turn a state's rotation by a small angle about a unit axis of the support's frame."""
    half = 0.5 * sine
    w, x, i, z = y[Q], y[Q + 1], y[Q + 2], y[Q + 3]
    a, b, c = half * axis.x, half * axis.y, half * axis.z
    y[Q] = w - a * x - b * i - c * z
    y[Q + 1] = x + a * w + b * z - c * i
    y[Q + 2] = i + b * w + c * x - a * z
    y[Q + 3] = z + c * w + a * i - b * x


@routine
def put_back(shape: SolidParameters, work: Workspace, y: Floats) -> None:
    """Put a state on its contact again, as far as it has left it."""
    rank, hold = work.mode.kind, work.mode.grip
    normalise(y)
    if rank == FLIGHT:
        return
    if rank == WALLED:
        put_back_at_walls(shape, work, y)
        return
    rolls = on_rim(work)
    if rank == FLAT:
        if rolls:
            keep_leaning(shape, work, y)
        else:
            y[Q + 1] = 0.0
            y[Q + 2] = 0.0
            normalise(y)
            y[W] = 0.0
            y[W + 1] = 0.0
            y[P + 2] = shape.h
        y[V + 2] = 0.0
        if hold == PIVOTS:
            hold_point(shape, work, y, work.touches[work.mode.pivot].point)
        elif hold == STICKS:  # whatever impacts that did not converge have left
            y[V] = y[V + 1] = y[W] = y[W + 1] = y[W + 2] = 0.0
        return
    if rolls:
        find_rim(shape, work, axes_at(y).z, vec(y, W))
    if rank != CORNER:
        level_side(shape, work, y, hold == STICKS, rolls)
        if rolls:
            find_rim(shape, work, axes_at(y).z, vec(y, W))
    point = work.touches[work.mode.pivot if hold == PIVOTS else work.closed[0]].point
    if hold != SLIPS:
        hold_point(shape, work, y, point)
        return
    q = axes_at(y)
    r = arm(shape, work, point)
    y[P + 2] = -dot(q.z, r)
    y[V + 2] = -dot(q.z, cross(vec(y, W), r))


@routine
def keep_leaning(shape: SolidParameters, work: Workspace, y: Floats) -> None:
    """Let a body that leans on its rim and two high points turn about the normal alone."""
    q = axes_at(y)
    find_rim(shape, work, q.z, vec(y, W))
    put(y, W, times(dot(q.z, vec(y, W)), q.z))
    deepest = 0.0
    for k in range(work.mode.closed):
        deepest = min(deepest, dot(q.z, arm(shape, work, closed_point(work, k))))
    y[P + 2] = -deepest


@routine
def level_side(
    shape: SolidParameters, work: Workspace, y: Floats, sticks: bool, rolls: bool
) -> None:
    """Lay a side on the support again, along its old line if it sticks and no end of it rolls."""
    e = side_direction(shape, work)
    q = axes_at(y)
    d = on_support(q, e)
    if sticks and not rolls:
        aim = Vec(work.anchor[2], work.anchor[3], 0.0)
    else:
        size = math.sqrt(d.x * d.x + d.y * d.y)
        aim = Vec(d.x / size, d.y / size, 0.0)
    axis = cross(d, aim)
    sine = math.sqrt(dot(axis, axis))
    if sine > 0.0:
        turn_state(y, times(1.0 / sine, axis), sine)
        normalise(y)
    spin = vec(y, W)
    if sticks:
        put(y, W, times(dot(e, spin), e))
    else:
        q = axes_at(y)
        d = on_support(q, e)
        lifts = on_body(q, Vec(-d.y, d.x, 0.0))
        put(y, W, add(spin, times(-dot(spin, lifts), lifts)))


@routine
def hold_point(shape: SolidParameters, work: Workspace, y: Floats, point: int) -> None:
    """Put a point that sticks where it was, on the support and at rest.

    Where a rim rolls, the place of its contact is left as it is.
    """
    q = axes_at(y)
    r = arm(shape, work, point)
    place = on_support(q, r)
    if not (shape.radius > 0.0 and point == shape.contacts):
        y[P] = work.anchor[0] - place.x
        y[P + 1] = work.anchor[1] - place.y
    y[P + 2] = -place.z
    put(y, V, times(-1.0, on_support(q, cross(vec(y, W), r))))
