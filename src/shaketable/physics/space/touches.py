"""What a solid touches where it touches a wall: points on the support and on walls, in one list.

A touch has the shape of every contact: a lever from the centre of gravity, a frame of two tangents
and a normal, frictions. Its vectors are along that frame: two tangents, then the normal.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import LEAST_SLIP, arm, axes_at, drift, find_rim, height
from shaketable.physics.space.edge import (
    DEEP,
    TIE,
    crossing,
    crossing_speed,
    has_edge,
    line_plane,
    lip_gap,
    lip_plane,
    near_line,
    side_count,
    write_line_touch,
)
from shaketable.physics.space.vectors import ZERO, Axes, Vec, add, cross, on_body, on_support
from shaketable.physics.space.walls import outline_arm, outline_drift, wall_gap, wall_speed
from shaketable.physics.space.workspace import (
    BEHIND_LIP,
    BEHIND_SIDES,
    MOST_TOUCHES,
    Floats,
    SolidParameters,
    Touch,
    V,
    W,
    Workspace,
    put,
    vec,
)


@kernel
def plane_of(work: Workspace, place: int) -> int:
    """The plane of a touch, 0 for the support."""
    return work.touches[place].plane


@kernel
def point_of(work: Workspace, place: int) -> int:
    """Which point of the support's contacts, or of the outline, a touch is."""
    return work.touches[place].point


@kernel
def frame_of(work: Workspace, place: int) -> Axes:
    """Tangents and normal of a touch, body frame."""
    row = work.touches[place]
    return Axes(vec(row.tangent, 0), vec(row.binormal, 0), vec(row.normal, 0))


@kernel
def lever_of(work: Workspace, place: int) -> Vec:
    """r of a touch, body frame."""
    return vec(work.touches[place].lever, 0)


@routine
def add_touch(work: Workspace, plane: int, point: int) -> None:
    """Add a touch that does not slip and carries nothing; frame and lever are not written yet."""
    place = work.mode.touches
    if place == MOST_TOUCHES:
        return
    row = work.touches[place]
    row.plane, row.point = plane, point
    row.moves = row.carries = 0
    row.slip_x = row.slip_y = 0.0
    if plane == 0:
        row.static, row.kinetic = work.points[point].static, work.points[point].kinetic
    else:
        row.static = row.kinetic = work.planes[plane].friction
    put(work.shares[place], 0, ZERO)
    work.mode.touches = place + 1


@routine
def look_at_touches(shape: SolidParameters, work: Workspace, q: Axes, y: Floats) -> None:
    """Write frame and lever of each touch in a state."""
    spin = vec(y, W)
    for place in range(work.mode.touches):
        row, plane, point = work.touches[place], plane_of(work, place), point_of(work, place)
        row.bend = 0.0
        if plane == line_plane(shape):
            write_line_touch(shape, work, q, y, row, point)
            continue
        n = on_body(q, vec(work.planes[plane].normal, 0))
        put(row.tangent, 0, on_body(q, vec(work.planes[plane].tangent, 0)))
        put(row.binormal, 0, on_body(q, vec(work.planes[plane].binormal, 0)))
        put(row.normal, 0, n)
        if plane == 0:
            if shape.radius > 0.0 and point == shape.contacts:
                find_rim(shape, work, q, spin)
            put(row.lever, 0, arm(shape, work, point))
            put(row.along, 0, drift(shape, work, point))
        else:
            put(row.lever, 0, outline_arm(shape, work, n, point))
            put(row.along, 0, outline_drift(shape, n, spin))


@routine
def gather_touches(
    shape: SolidParameters, work: Workspace, within: float, leaving: float, ahead: float
) -> int:
    """List the points on the support that are noted (`near`), and what else touches; count these.

    Args:
        within: how near to its surface a touch must be [m], after the time ahead [s].
        leaving: one that leaves it faster is not listed [m/s].
    """
    y = work.state
    work.mode.touches = 0
    for k in range(work.mode.near):
        add_touch(work, 0, work.near[k])
    q, support = axes_at(y), work.mode.touches
    for wall in range(1, shape.walls + 1):
        for point in range(shape.outline):
            speed = wall_speed(shape, work, q, y, wall, point)
            gap = wall_gap(shape, work, q, y, wall, point) + ahead * speed
            if gap <= within and speed <= leaving:
                add_touch(work, wall, point)
    if has_edge(shape):
        gather_at_edge(shape, work, q, within, leaving, ahead)
    look_at_touches(shape, work, q, y)
    return int(work.mode.touches - support)


@routine
def gather_at_edge(
    shape: SolidParameters, work: Workspace, q: Axes, within: float, leaving: float, ahead: float
) -> None:
    """List the touches on the edge of the support, as `gather_touches` does those on walls."""
    y = work.state
    for point in range(shape.outline if shape.lip > 0.0 else 0):
        speed = wall_speed(shape, work, q, y, lip_plane(shape), point)
        gap = lip_gap(shape, work, q, y, point)
        near = gap > -DEEP and gap + ahead * speed <= within
        if work.behind[BEHIND_LIP + point] == 0 and near and speed <= leaving:
            add_touch(work, lip_plane(shape), point)
    for side in range(side_count(shape) if near_line(shape, y) else 0):
        if work.behind[BEHIND_SIDES + side] == 0:
            found = crossing(shape, work, q, y, side)
            speed = crossing_speed(q, y, found)
            near = found.gap > -DEEP and found.gap + ahead * speed <= within
            near = near and found.left > TIE
            if near and speed <= leaving:
                add_touch(work, line_plane(shape), side)


@kernel
def touches_more(shape: SolidParameters) -> bool:
    """Whether there is more to touch than a support without an end."""
    return shape.walls > 0 or has_edge(shape)


@routine
def is_at_edge(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a touch that is listed is on the edge of the support."""
    found = False
    for place in range(work.mode.touches):
        found = found or plane_of(work, place) > shape.walls
    return found


@routine
def touch_velocity(work: Workspace, q: Axes, y: Floats, place: int) -> Vec:
    """Velocity of a touch, along its frame."""
    moves = add(on_body(q, vec(y, V)), cross(vec(y, W), lever_of(work, place)))
    return on_support(frame_of(work, place), moves)


@routine
def touch_acceleration(
    work: Workspace, q: Axes, y: Floats, linear: Vec, turn: Vec, place: int
) -> Vec:
    """How fast that changes.

    Args:
        linear, turn: accelerations of the centre of gravity (support frame) and of the rotation
            (body frame).
    """
    r, spin = lever_of(work, place), vec(y, W)
    own = cross(spin, add(cross(spin, r), vec(work.touches[place].along, 0)))
    moves = add(add(on_body(q, linear), cross(turn, r)), own)
    a = on_support(frame_of(work, place), moves)
    return Vec(a.x, a.y, a.z + work.touches[place].bend)


@routine
def touch_gap(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, place: int) -> float:
    """Distance of a touch from its plane [m]."""
    plane, point = plane_of(work, place), point_of(work, place)
    if plane == 0:
        return height(shape, work, q, y, point)
    if plane == line_plane(shape):
        return crossing(shape, work, q, y, point).gap
    return wall_gap(shape, work, q, y, plane, point)


@routine
def is_carrying(work: Workspace, plane: int, point: int) -> bool:
    """Whether a point is a touch that carries."""
    found = False
    for place in range(work.mode.touches):
        same = plane_of(work, place) == plane and point_of(work, place) == point
        found = found or (same and work.touches[place].carries > 0)
    return found


@routine
def touch_slip(shape: SolidParameters, work: Workspace, place: int, u: Vec) -> tuple[float, float]:
    """Unit vector that friction at a slipping touch opposes (as `slip_direction`)."""
    x, y = u.x, u.y
    speed = math.sqrt(x * x + y * y)
    kept = shape.limits.turning - speed
    if kept > 0.0:
        x += kept * work.touches[place].slip_x
        y += kept * work.touches[place].slip_y
        speed = max(math.sqrt(x * x + y * y), LEAST_SLIP)
    return x / speed, y / speed


@kernel
def copy_touch(to: Touch, other: Touch) -> None:
    """Write a touch over another."""
    to.plane, to.point, to.moves, to.carries = other.plane, other.point, other.moves, other.carries
    to.slip_x, to.slip_y, to.static, to.kinetic = (
        other.slip_x, other.slip_y, other.static, other.kinetic,
    )  # fmt: skip
    to.bend = other.bend
    put(to.lever, 0, vec(other.lever, 0))
    put(to.along, 0, vec(other.along, 0))
    put(to.tangent, 0, vec(other.tangent, 0))
    put(to.binormal, 0, vec(other.binormal, 0))
    put(to.normal, 0, vec(other.normal, 0))


@routine
def drop_touch(work: Workspace, place: int) -> None:
    """Take a touch off the list; those after it move up."""
    last = work.mode.touches - 1
    for at in range(place, last):
        copy_touch(work.touches[at], work.touches[at + 1])
        for j in range(3):
            work.shares[at, j] = work.shares[at + 1, j]
    work.mode.touches = last


@routine
def note_moving(shape: SolidParameters, work: Workspace, q: Axes, least: float) -> None:
    """Write which touches slip faster [m/s], and along what."""
    for place in range(work.mode.touches):
        touch = work.touches[place]
        u = touch_velocity(work, q, work.state, place)
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        touch.moves = 1 if speed > least and touch.static < math.inf else 0
        if touch.moves > 0:
            touch.slip_x, touch.slip_y = u.x / speed, u.y / speed


@routine
def note_slips(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Write along what the touches slip that do, as a step begins."""
    for place in range(work.mode.touches):
        touch = work.touches[place]
        u = touch_velocity(work, q, work.state, place)
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        if touch.moves > 0 and speed > shape.limits.turning:
            touch.slip_x, touch.slip_y = u.x / speed, u.y / speed
