"""What a solid touches where it touches a wall: points on the support and on walls, in one list.

A touch has the shape of every contact: a lever from the centre of gravity, a frame of two tangents
and a normal, frictions. Its vectors are along that frame: two tangents, then the normal.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import LEAST_SLIP, arm, axes_at, drift, find_rim, height
from shaketable.physics.space.vectors import ZERO, Axes, Vec, add, cross, on_body, on_support
from shaketable.physics.space.walls import outline_arm, outline_drift, wall_gap, wall_speed
from shaketable.physics.space.workspace import (
    ALONG,
    BINORMAL,
    CARRIES,
    FRAME,
    FRICTION,
    KINETIC,
    KINETIC_AT,
    LEVER,
    MOST_TOUCHES,
    MOVES,
    NEAR,
    NORMAL,
    OF_PLANE,
    SLIP_DIRECTION,
    STATIC,
    STATIC_AT,
    TANGENT,
    TOUCHES,
    WHICH,
    Floats,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)


@kernel
def plane_of(work: Workspace, place: int) -> int:
    """The plane of a touch, 0 for the support."""
    return int(work.touches[place, OF_PLANE])


@kernel
def point_of(work: Workspace, place: int) -> int:
    """Which point of the support's contacts, or of the outline, a touch is."""
    return int(work.touches[place, WHICH])


@kernel
def frame_of(work: Workspace, place: int) -> Axes:
    """Tangents and normal of a touch, body frame."""
    row = work.touches[place]
    return Axes(vec(row, FRAME), vec(row, FRAME + 3), vec(row, FRAME + 6))


@kernel
def lever_of(work: Workspace, place: int) -> Vec:
    """r of a touch, body frame."""
    return vec(work.touches[place], LEVER)


@routine
def add_touch(work: Workspace, plane: int, point: int) -> None:
    """Add a touch that does not slip and carries nothing; frame and lever are not written yet."""
    place = work.mode[TOUCHES]
    if place == MOST_TOUCHES:
        return
    row = work.touches[place]
    row[OF_PLANE], row[WHICH] = float(plane), float(point)
    row[MOVES] = row[CARRIES] = row[SLIP_DIRECTION] = row[SLIP_DIRECTION + 1] = 0.0
    if plane == 0:
        row[STATIC_AT], row[KINETIC_AT] = work.points[point, STATIC], work.points[point, KINETIC]
    else:
        row[STATIC_AT] = row[KINETIC_AT] = work.planes[plane, FRICTION]
    put(work.shares[place], 0, ZERO)
    work.mode[TOUCHES] = place + 1


@routine
def look_at_touches(shape: SolidParameters, work: Workspace, q: Axes, y: Floats) -> None:
    """Write frame and lever of each touch in a state."""
    spin = vec(y, W)
    for place in range(work.mode[TOUCHES]):
        row, plane, point = work.touches[place], plane_of(work, place), point_of(work, place)
        n = on_body(q, vec(work.planes[plane], NORMAL))
        put(row, FRAME, on_body(q, vec(work.planes[plane], TANGENT)))
        put(row, FRAME + 3, on_body(q, vec(work.planes[plane], BINORMAL)))
        put(row, FRAME + 6, n)
        if plane == 0:
            if shape.radius > 0.0 and point == shape.contacts:
                find_rim(shape, work, q, spin)
            put(row, LEVER, arm(shape, work, point))
            put(row, ALONG, drift(shape, work, point))
        else:
            put(row, LEVER, outline_arm(shape, work, n, point))
            put(row, ALONG, outline_drift(shape, n, spin))


@routine
def gather_touches(
    shape: SolidParameters, work: Workspace, within: float, leaving: float, ahead: float
) -> int:
    """List the points on the support that are noted (`near`), and those on walls; count these.

    Args:
        within: how near to a wall a point must be [m], after the time ahead [s].
        leaving: a point that leaves its wall faster is not listed [m/s].
    """
    y = work.state
    work.mode[TOUCHES] = 0
    for k in range(work.mode[NEAR]):
        add_touch(work, 0, work.near[k])
    q, support = axes_at(y), work.mode[TOUCHES]
    for wall in range(1, shape.walls + 1):
        for point in range(shape.outline):
            speed = wall_speed(shape, work, q, y, wall, point)
            gap = wall_gap(shape, work, q, y, wall, point) + ahead * speed
            if gap <= within and speed <= leaving:
                add_touch(work, wall, point)
    look_at_touches(shape, work, q, y)
    return int(work.mode[TOUCHES] - support)


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
    own = cross(spin, add(cross(spin, r), vec(work.touches[place], ALONG)))
    moves = add(add(on_body(q, linear), cross(turn, r)), own)
    return on_support(frame_of(work, place), moves)


@routine
def touch_gap(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, place: int) -> float:
    """Distance of a touch from its plane [m]."""
    plane, point = plane_of(work, place), point_of(work, place)
    if plane == 0:
        return height(shape, work, q, y, point)
    return wall_gap(shape, work, q, y, plane, point)


@routine
def is_carrying(work: Workspace, plane: int, point: int) -> bool:
    """Whether a point is a touch that carries."""
    found = False
    for place in range(work.mode[TOUCHES]):
        same = plane_of(work, place) == plane and point_of(work, place) == point
        found = found or (same and work.touches[place, CARRIES] > 0.0)
    return found


@routine
def touch_slip(shape: SolidParameters, work: Workspace, place: int, u: Vec) -> tuple[float, float]:
    """Unit vector that friction at a slipping touch opposes (as `slip_direction`)."""
    x, y = u.x, u.y
    speed = math.sqrt(x * x + y * y)
    kept = shape.limits.turning - speed
    if kept > 0.0:
        x += kept * work.touches[place, SLIP_DIRECTION]
        y += kept * work.touches[place, SLIP_DIRECTION + 1]
        speed = max(math.sqrt(x * x + y * y), LEAST_SLIP)
    return x / speed, y / speed


@routine
def drop_touch(work: Workspace, place: int) -> None:
    """Take a touch off the list; those after it move up."""
    last = work.mode[TOUCHES] - 1
    for at in range(place, last):
        for j in range(work.touches.shape[1]):
            work.touches[at, j] = work.touches[at + 1, j]
        for j in range(3):
            work.shares[at, j] = work.shares[at + 1, j]
    work.mode[TOUCHES] = last


@routine
def note_moving(shape: SolidParameters, work: Workspace, q: Axes, least: float) -> None:
    """Write which touches slip faster [m/s], and along what."""
    for place in range(work.mode[TOUCHES]):
        touch = work.touches[place]
        u = touch_velocity(work, q, work.state, place)
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        touch[MOVES] = 1.0 if speed > least and touch[STATIC_AT] < math.inf else 0.0
        if touch[MOVES] > 0.0:
            touch[SLIP_DIRECTION], touch[SLIP_DIRECTION + 1] = u.x / speed, u.y / speed


@routine
def note_slips(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Write along what the touches slip that do, as a step begins."""
    for place in range(work.mode[TOUCHES]):
        touch = work.touches[place]
        u = touch_velocity(work, q, work.state, place)
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        if touch[MOVES] > 0.0 and speed > shape.limits.turning:
            touch[SLIP_DIRECTION], touch[SLIP_DIRECTION + 1] = u.x / speed, u.y / speed
