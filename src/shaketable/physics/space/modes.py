"""How the closed points lie, and the change into a mode."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.closing import close_one, end_closed
from shaketable.physics.space.contacts import (
    arm,
    axes_at,
    closed_point,
    find_rim,
    lies_on_rim,
    on_rim,
    side_direction,
)
from shaketable.physics.space.keeping import put_back
from shaketable.physics.space.touches import add_touch, slip_velocity, slips_at
from shaketable.physics.space.vectors import Vec, on_support
from shaketable.physics.space.walled import end_velocities, let_closed_carry, write_mode
from shaketable.physics.space.workspace import (
    CORNER,
    EDGE,
    FLAT,
    FLIGHT,
    PIVOTS,
    SLIPS,
    P,
    SolidParameters,
    W,
    Workspace,
    vec,
)

IN_LINE = 1e-9  # of the farthest point's distance: points this near to a line are on it
OPPOSITE_TOLERANCE = 1e-6  # of the radius: points whose middle is nearer to the centre are opposite


@kernel
def distance2(work: Workspace, a: int, b: int) -> float:
    x, y = work.points[a].x - work.points[b].x, work.points[a].y - work.points[b].y
    return float(x * x + y * y)


@routine
def farthest(work: Workspace, origin: int) -> int:
    """The place in the list of the closed point that is farthest from a point."""
    best, most = work.closed[0], -1.0
    for k in range(work.mode.closed):
        d = distance2(work, origin, closed_point(work, k))
        if d > most:
            best, most = work.closed[k], d
    return int(best)


@routine
def arrange(shape: SolidParameters, work: Workspace, hold: int, pivot: int) -> None:
    """Write the mode of the closed points: how they lie, and how they may share the pressure."""
    mode, n = work.mode, work.mode.closed
    mode.grip, mode.pivot = hold, pivot
    mode.first = mode.last = work.closed[0]
    mode.kind = min(n, CORNER) if n > 0 else FLIGHT
    if n == 0:
        mode.grip = SLIPS
    if n >= 2:
        mode.last = farthest(work, closed_point(work, 0))
        mode.first = farthest(work, work.touches[mode.last].point)
        e = side_direction(shape, work)
        origin = work.touches[mode.first].point
        off = 0.0
        for k in range(n):
            point = closed_point(work, k)
            across = e.x * (work.points[point].y - work.points[origin].y)
            across -= e.y * (work.points[point].x - work.points[origin].x)
            off = max(off, abs(across))
        mode.kind = EDGE if off <= IN_LINE * shape.reach else FLAT
    e = side_direction(shape, work) if mode.kind == EDGE else Vec(1.0, 0.0, 0.0)
    for k in range(n):
        touch = work.touches[work.closed[k]]
        point = touch.point
        touch.active = 1
        touch.basis[0] = 1.0
        # in parts of the reach: in metres those of a small body in a line would look singular
        along, across = work.points[point].x / shape.reach, work.points[point].y / shape.reach
        touch.basis[1] = e.x * along + e.y * across if mode.kind == EDGE else along
        touch.basis[2] = across


@routine
def lay_ring(shape: SolidParameters, work: Workspace) -> None:
    """Turn a circle's ring of points so that one of the rim is at its contact."""
    first = math.atan2(work.rim.y, work.rim.x)
    for k in range(shape.contacts):
        angle = first + 2.0 * math.pi * k / shape.hull
        radius = shape.radius if k < shape.hull else shape.inner * shape.radius
        work.points[k].x = radius * math.cos(angle)
        work.points[k].y = radius * math.sin(angle)


@routine
def take_rim(shape: SolidParameters, work: Workspace) -> None:
    """Let a circle that stands on one or two points of its ring stand on its rim there."""
    n = work.mode.closed
    if not lies_on_rim(shape) or n == 0 or work.mode.kind == FLAT:
        return
    x, y = 0.0, 0.0
    for k in range(n):
        x += work.points[closed_point(work, k)].x
        y += work.points[closed_point(work, k)].y
    size = math.sqrt(x * x + y * y)
    if (
        size < OPPOSITE_TOLERANCE * shape.radius
    ):  # two points across from each other: either will do
        x, y = work.points[closed_point(work, 0)].x, work.points[closed_point(work, 0)].y
        size = math.sqrt(x * x + y * y)
    stand_on_rim(shape, work, x / size, y / size)


@routine
def stand_on_rim(shape: SolidParameters, work: Workspace, x: float, y: float) -> None:
    """Close the rim at an azimuth (unit vector) alone.

    It is listed last and moves as the first of what was closed did.
    """
    last, first = shape.contacts, work.touches[work.closed[0]]
    work.rim.x = work.rim.before_x = x
    work.rim.y = work.rim.before_y = y
    work.rim.along_x = work.rim.along_y = 0.0
    work.points[last].x = shape.radius * x
    work.points[last].y = shape.radius * y
    place = work.mode.touches
    add_touch(work, 0, last)
    touch = work.touches[place]
    touch.moves, touch.slip_x, touch.slip_y = first.moves, first.slip_x, first.slip_y
    close_one(shape, work, place)


@routine
def keep_anchor(shape: SolidParameters, work: Workspace) -> None:
    """Remember where a contact that sticks is."""
    if work.mode.grip == SLIPS or work.mode.closed == 0:
        return
    place = work.mode.pivot if work.mode.grip == PIVOTS else work.closed[0]
    point = work.touches[place].point
    q = axes_at(work.state)
    at = on_support(q, arm(shape, work, point))
    work.anchor[0] = work.state[P] + at.x
    work.anchor[1] = work.state[P + 1] + at.y
    if work.mode.kind == EDGE:
        d = on_support(q, side_direction(shape, work))
        size = math.sqrt(d.x * d.x + d.y * d.y)
        work.anchor[2] = d.x / size
        work.anchor[3] = d.y / size


@routine
def fly(shape: SolidParameters, work: Workspace) -> None:
    """Write the mode of a body that touches nothing."""
    end_closed(shape, work, 0)
    arrange(shape, work, SLIPS, 0)


@routine
def enter(shape: SolidParameters, work: Workspace) -> None:
    """Begin the mode that is written: end the velocities that it does not allow."""
    if work.mode.closed == 0:
        return
    y = work.state
    let_closed_carry(work)
    write_mode(shape, work, axes_at(y))
    end_velocities(shape, work, y)
    if on_rim(work):
        find_rim(shape, work, axes_at(y).z, vec(y, W))
    keep_anchor(shape, work)
    put_back(shape, work, y)


@routine
def end_slow_slips(shape: SolidParameters, work: Workspace) -> None:
    """End the slips that have turned round, where they are so slow that friction does not follow.

    Else friction would jump from one direction to another across it, again and again.
    """
    q, ends = axes_at(work.state), False
    let_closed_carry(work)
    for k in range(work.mode.closed):
        place = work.closed[k]
        touch, slips = work.touches[place], slips_at(work, place)
        u = slip_velocity(shape, work, q, work.state, place)
        turned = u.x * touch.slip_x + u.y * touch.slip_y <= 0.0
        slow = touch.static > 0.0 and math.sqrt(u.x * u.x + u.y * u.y) < shape.limits.turning
        touch.moves = 1 if slips and not (turned and slow) else 0
        ends = ends or (slips and touch.moves == 0)
    if ends:
        write_mode(shape, work, q)
        end_velocities(shape, work, work.state)
