"""What a solid touches, in one list: points on the support first, then on walls and at the edge.

A touch has the shape of every contact: a lever from the centre of gravity, a frame of two tangents
and a normal, frictions. Its vectors are along that frame: two tangents, then the normal. Of points
on the support these are known without it (`contacts`), so that it is written where all that touches
decides together.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import (
    acceleration,
    arm,
    axes_at,
    drift,
    find_rim,
    height,
    velocity,
)
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
    PIVOTS,
    STICKS,
    WALLED,
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
def begin_list(work: Workspace) -> None:
    """Begin a list anew: nothing is touched."""
    work.mode.touches = work.mode.near = 0


@routine
def add_touch(work: Workspace, plane: int, point: int) -> None:
    """Add a touch that does not slip and carries nothing; frame and lever are not written yet."""
    place = work.mode.touches
    if place >= MOST_TOUCHES - (plane > 0):  # a rim may have to follow
        return
    row = work.touches[place]
    row.plane, row.point = plane, point
    if plane == 0:
        row.static, row.kinetic = work.points[point].static, work.points[point].kinetic
    else:
        row.static = row.kinetic = work.planes[plane].friction
    let_be(row)
    work.mode.touches = place + 1


@kernel
def let_be(touch: Touch) -> None:
    """Let a touch neither slip nor carry."""
    touch.moves = touch.carries = 0
    touch.slip_x = touch.slip_y = 0.0
    put(touch.share, 0, ZERO)


@routine
def add_near(work: Workspace, point: int) -> None:
    """Add a point on the support to those that the list begins with."""
    add_touch(work, 0, point)
    work.mode.near = work.mode.touches


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
                find_rim(shape, work, q.z, spin)
            put(row.lever, 0, arm(shape, work, point))
            put(row.along, 0, drift(shape, work, point))
        else:
            put(row.lever, 0, outline_arm(shape, work, n, point))
            put(row.along, 0, outline_drift(shape, n, spin))


@routine
def gather_touches(
    shape: SolidParameters, work: Workspace, within: float, leaving: float, ahead: float
) -> int:
    """List what touches beside the points on the support, with which the list begins; count these.

    Args:
        within: how near to its surface a touch must be [m], after the time ahead [s].
        leaving: one that leaves it faster is not listed [m/s].
    """
    y = work.state
    q, support = axes_at(y), work.mode.near
    work.mode.touches = support
    for place in range(support):
        let_be(work.touches[place])
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
def is_closed(work: Workspace, plane: int, point: int) -> bool:
    """Whether a point, of the support's contacts or of the outline, is closed on a plane."""
    found = False
    for k in range(work.mode.closed):
        touch = work.touches[work.closed[k]]
        found = found or (touch.plane == plane and touch.point == point)
    return found


@kernel
def copy_touch(to: Touch, other: Touch) -> None:
    """Write a touch over another."""
    to.plane, to.point, to.moves, to.carries = other.plane, other.point, other.moves, other.carries
    to.slip_x, to.slip_y, to.static, to.kinetic = (
        other.slip_x, other.slip_y, other.static, other.kinetic,
    )  # fmt: skip
    to.bend = other.bend
    put(to.share, 0, vec(other.share, 0))
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
    work.mode.touches = last
    work.mode.near -= place < work.mode.near


@kernel
def slip_velocity(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, place: int) -> Vec:
    """Velocity of a touch, along its frame, which of one on the support need not be written."""
    touch = work.touches[place]
    if touch.plane == 0:
        return velocity(shape, work, q, y, touch.point)
    return touch_velocity(work, q, y, place)


@kernel
def slip_acceleration(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, dy: Floats, place: int
) -> Vec:
    """How fast that changes, at the rates of the state."""
    touch = work.touches[place]
    if touch.plane == 0:
        return acceleration(shape, work, q, y, dy, touch.point)
    return touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)


@routine
def note_moving(shape: SolidParameters, work: Workspace, q: Axes, n: int, least: float) -> int:
    """Write which of the first n touches slip faster [m/s], and along what; count them."""
    moving = 0
    for place in range(n):
        touch = work.touches[place]
        u = slip_velocity(shape, work, q, work.state, place)
        speed = math.sqrt(u.x * u.x + u.y * u.y)
        touch.moves = 1 if speed > least and touch.static < math.inf else 0
        if touch.moves > 0:
            moving += 1
            touch.slip_x, touch.slip_y = u.x / speed, u.y / speed
    return moving


@kernel
def slips_at(work: Workspace, place: int) -> bool:
    """Whether a closed touch slips in the present mode."""
    if work.mode.kind == WALLED:
        return work.touches[place].moves > 0
    return work.mode.grip != STICKS and not (work.mode.grip == PIVOTS and place == work.mode.pivot)


@routine
def note_slips(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Write along what the closed touches slip that do, as a step begins."""
    for k in range(work.mode.closed):
        place = work.closed[k]
        if slips_at(work, place):
            touch, u = work.touches[place], slip_velocity(shape, work, q, work.state, place)
            speed = math.sqrt(u.x * u.x + u.y * u.y)
            if speed > shape.limits.turning:
                touch.slip_x, touch.slip_y = u.x / speed, u.y / speed


@kernel
def closed_on_support(work: Workspace) -> int:
    """How many touches on the support are closed."""
    n = 0
    for k in range(work.mode.closed):
        n += work.touches[work.closed[k]].plane == 0
    return n
