"""Where a body meets the edge of its support.

The support is a board that ends at the line e·p = d, where it may have a lip: a board as high that
stands on it. What lies beyond bears nothing, and a corner of the base touches the support only
before the line. Two kinds of contact are new: a corner of the body at the face of the lip, and the
line (the upper end of the lip) at a side of the body.

| symbol | word | unit |
|---|---|---|
| a, d | a point of the line and its direction, body frame | m |
| A, s | a point of a side and its direction, body frame | m |
| n = ±d × s/\\|d × s\\| | normal of the contact, toward the body | |
| g = n·(A - a) | gap | m |
| u | velocity of the body's point at the contact, body frame | m/s |

Sides of a prism are those of its base, those that rise from its corners, and those of its top; of a
cylinder the rim of its base where the line crosses it (twice), the nearest line of its mantle, and
its upper rim. A contact moves along its side at the rate λ̇ = -(u × d)·n / (s × d)·n, and as its
normal turns ġ = n·u changes by (ṅ + ω × n)·u besides. A surface is met from its front: what hangs
past the edge may swing under it (`look_behind`).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import arm, axes_at, height, lies_on_rim, rim_height
from shaketable.physics.space.vectors import (
    ZERO,
    Axes,
    Vec,
    add,
    cross,
    dot,
    on_body,
    on_support,
    subtract,
    times,
    unit,
)
from shaketable.physics.space.walls import wall_gap
from shaketable.physics.space.workspace import (
    BEHIND_LIP,
    BEHIND_SIDES,
    Floats,
    P,
    SolidParameters,
    Touch,
    V,
    W,
    Workspace,
    put,
    vec,
)

# m: a corner so far past the line leaves the support, and has it again once it is so far past it;
# those that are so near to either do it together
PAST, BACK, TIE = 1e-9, 5e-10, 1e-10
ENDS = 1e-9  # m: how near to its end an upright side is not met any more
INSIDE = 1e-9  # m: how near to its upper end the face of a lip is not
LEAST_SINE = 1e-3  # of the angle between the line and a side that it crosses
GRAZES = 0.02  # likewise, of a rim: what only grazes that touches the mantle, or nothing
ASKEW = 0.05  # a normal may be so far out of what two faces of the body, or the board, allow
DEEP = 1e-6  # m: what is deeper in a surface is on its other side
UP = Vec(0.0, 0.0, 1.0)


class Crossing(NamedTuple):
    """The line at a side of the body, in the body's frame."""

    gap: float  # [m]; infinite where they cannot meet
    left: float  # how much of the side is left until they cannot meet any more [m]
    rate: float  # how fast that grows, but where they become parallel [m/s]
    normal: Vec
    lever: Vec  # r of the side's point
    line: Vec  # d
    side: Vec  # s
    sine: float  # of the angle between them
    rim: float  # how fast a rim turns along itself [1/m]; 0 of what is straight
    mantle: float  # radius of a mantle [m], else 0


@kernel
def has_edge(shape: SolidParameters) -> bool:
    return shape.edge_at < math.inf


@kernel
def lip_plane(shape: SolidParameters) -> int:
    """The plane of the face of the lip."""
    return shape.walls + 1


@kernel
def line_plane(shape: SolidParameters) -> int:
    """What stands for a plane in touches of the line."""
    return shape.walls + 2


@kernel
def beyond(shape: SolidParameters, place: Vec) -> float:
    """How far a place of the support's frame is past the line [m]."""
    return shape.edge_x * place.x + shape.edge_y * place.y - shape.edge_at


@kernel
def is_off(shape: SolidParameters, y: Floats) -> bool:
    """Whether the centre of gravity is past the line."""
    return bool(has_edge(shape) and beyond(shape, vec(y, P)) > 0.0)


@kernel
def near_line(shape: SolidParameters, y: Floats) -> bool:
    """Whether the line may meet the body."""
    if not has_edge(shape):
        return False
    off, up = beyond(shape, vec(y, P)), y[P + 2] - shape.lip
    return bool(off * off + up * up <= shape.size * shape.size)


@kernel
def past_line(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, point: int) -> float:
    """How far a point of the base is past the line [m]."""
    return beyond(shape, add(vec(y, P), on_support(q, arm(shape, work, point))))


@kernel
def support_gap(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, point: int) -> float:
    """Clearance under a point [m]; infinite where there is no support under it."""
    if has_edge(shape) and (work.behind[point] == 1 or past_line(shape, work, q, y, point) > 0.0):
        return math.inf
    return float(height(shape, work, q, y, point))


@routine
def clearance(shape: SolidParameters, work: Workspace, q: Axes, y: Floats) -> float:
    """Least clearance under the base [m]; infinite if none of it is over the support."""
    least = math.inf
    if shape.radius > 0.0:
        sine = math.sqrt(q.z.x**2 + q.z.y**2)
        if has_edge(shape):  # its lowest point, if there is support under it
            out = 0.0 if sine == 0.0 else -shape.radius / sine
            r = Vec(out * q.z.x, out * q.z.y, shape.rise - shape.h)
            if beyond(shape, add(vec(y, P), on_support(q, r))) <= PAST:
                least = rim_height(shape, q, y, sine)
        else:
            least = rim_height(shape, q, y, sine)
    if not lies_on_rim(shape):
        for point in range(shape.hull):
            least = min(least, support_gap(shape, work, q, y, point))
    return least


@routine
def hangs_over(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a part of the base is past the line."""
    if not has_edge(shape):
        return False
    found = False
    for point in range(shape.hull):
        found = found or work.past[point] == 1
    return found


@kernel
def side_count(shape: SolidParameters) -> int:
    return 5 if shape.radius > 0.0 else 3 * (shape.outline // 2)


@kernel
def is_of_base(shape: SolidParameters, side: int) -> bool:
    """Whether a side is one of the base."""
    return side < (2 if shape.radius > 0.0 else shape.outline // 2)


@routine
def lip_gap(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, point: int) -> float:
    """Distance of a point of the outline from the face of the lip [m], infinite above it."""
    if lip_left(shape, work, q, y, point) <= 0.0:
        return math.inf
    return wall_gap(shape, work, q, y, lip_plane(shape), point)


@routine
def lip_left(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, point: int) -> float:
    """How much of the face of the lip is left above a point of the outline [m]."""
    r = vec(work.outline[point], 0)
    if shape.radius > 0.0:
        n = on_body(q, vec(work.planes[lip_plane(shape)].normal, 0))
        size = math.sqrt(n.x * n.x + n.y * n.y)
        r = Vec(-shape.radius * n.x / size, -shape.radius * n.y / size, r.z)
    return float(shape.lip - INSIDE - y[P + 2] - dot(q.z, r))


@routine
def crossing(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, side: int) -> Crossing:
    """The line at a side, in a state."""
    out = Vec(shape.edge_x, shape.edge_y, 0.0)
    start = add(times(shape.edge_at, out), Vec(0.0, 0.0, shape.lip))
    a = on_body(q, subtract(start, vec(y, P)))
    d = on_body(q, Vec(-shape.edge_y, shape.edge_x, 0.0))
    if shape.radius > 0.0:
        found = at_mantle(shape, work, q, y, a, d) if side == 2 else at_rim(shape, work, a, d, side)
    else:
        found = at_straight_side(shape, work, q, y, a, d, side)
    # the lip bears what is above it, a bare board's end also what swings under it
    allowed = dot(q.z, found.normal) if shape.lip > 0.0 else dot(on_body(q, out), found.normal)
    left = min(found.left, shape.size * (allowed + ASKEW))
    return with_left(found, left, math.inf if left <= 0.0 else found.gap)


@kernel
def with_left(found: Crossing, left: float, gap: float) -> Crossing:
    rate = found.rate if left == found.left else 0.0
    return Crossing(
        gap, left, rate, found.normal, found.lever, found.line, found.side, found.sine,
        found.rim, found.mantle,
    )  # fmt: skip


@kernel
def no_crossing(d: Vec) -> Crossing:
    return Crossing(math.inf, -1.0, 0.0, UP, ZERO, d, d, 1.0, 0.0, 0.0)


@kernel
def passing(q: Axes, y: Floats, lever: Vec, d: Vec, s: Vec, n: Vec) -> float:
    """How fast the line moves along a side [m/s]: λ̇."""
    u = add(on_body(q, vec(y, V)), cross(vec(y, W), lever))
    return -dot(cross(u, d), n) / dot(cross(s, d), n)


@kernel
def along_line(a: Vec, d: Vec, other: Vec, s: Vec, n: Vec) -> float:
    """How far along s from `other` the line through a is nearest."""
    return -dot(cross(subtract(other, a), d), n) / dot(cross(s, d), n)


@kernel
def outward(n: Vec, inward: Vec, upward: Vec) -> tuple[float, float]:
    """1 or -1: n or its opposite points out of two faces, into which these lead; how surely."""
    first, second = dot(n, inward), dot(n, upward)
    along, against = ASKEW - max(first, second), ASKEW + min(first, second)
    return (1.0, along) if along >= against else (-1.0, against)


@routine
def at_straight_side(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, a: Vec, d: Vec, side: int
) -> Crossing:
    """At a side of a prism: of its base, upright, or of its top."""
    corners = shape.outline // 2
    kind, k = side // corners, side % corners
    low = 0 if kind < 2 else corners
    after = k + 1 if k + 1 < corners else 0
    first = vec(work.outline[low + k], 0)
    if kind == 1:
        before = k - 1 if k > 0 else corners - 1
        along = subtract(vec(work.outline[corners + k], 0), first)
        inward = unit(subtract(vec(work.outline[after], 0), first))
        other = unit(subtract(vec(work.outline[before], 0), first))
    else:
        along = subtract(vec(work.outline[low + after], 0), first)
        other = UP if kind == 0 else Vec(0.0, 0.0, -1.0)
        inward = unit(cross(UP, along))
    length = math.sqrt(dot(along, along))
    s = times(1.0 / length, along)
    n = cross(d, s)
    sine = math.sqrt(dot(n, n))
    if sine <= LEAST_SINE:
        return no_crossing(d)
    n = times(1.0 / sine, n)
    out, sure = outward(n, inward, other)
    n = times(-out, n)
    at = along_line(a, d, first, s, n)
    lever = add(first, times(at, s))
    left, rate = shape.size * min(sine - LEAST_SINE, sure), 0.0
    if kind == 0 and work.past[k] == work.past[after]:
        return no_crossing(d)
    if kind > 0 and min(at, length - at) - ENDS < left:
        left, rate = min(at, length - at) - ENDS, passing(q, y, lever, d, s, n)
        rate = rate if at < length - at else -rate
    gap = dot(n, subtract(first, a))
    return Crossing(gap, left, rate, n, lever, d, s, sine, 0.0, 0.0)


@routine
def at_rim(shape: SolidParameters, work: Workspace, a: Vec, d: Vec, side: int) -> Crossing:
    """At a rim, where the line as seen along the axis crosses it."""
    upper, z = side > 2, work.outline[1 if side > 2 else 0, 2]
    square = d.x * d.x + d.y * d.y
    middle = a.x * d.x + a.y * d.y
    root = middle * middle - square * (a.x * a.x + a.y * a.y - shape.radius * shape.radius)
    if square <= LEAST_SINE or root <= 0.0:
        return no_crossing(d)
    way = math.sqrt(root) if side in (0, 3) else -math.sqrt(root)
    part = (way - middle) / square
    at = Vec(a.x + part * d.x, a.y + part * d.y, z)
    out = Vec(at.x / shape.radius, at.y / shape.radius, 0.0)
    s = cross(UP, out)
    n = cross(d, s)
    sine = math.sqrt(dot(n, n))
    if sine <= LEAST_SINE:
        return no_crossing(d)
    n = times(1.0 / sine, n)
    sign, sure = outward(n, times(-1.0, out), Vec(0.0, 0.0, -1.0 if upper else 1.0))
    n = times(-sign, n)
    gap = n.z * (z - a.z - part * d.z)
    left = shape.size * min(sine - GRAZES, abs(n.z) - GRAZES, sure)
    return Crossing(gap, left, 0.0, n, at, d, s, sine, 1.0 / shape.radius, 0.0)


@routine
def at_mantle(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, a: Vec, d: Vec
) -> Crossing:
    """At the nearest line of a cylinder's mantle."""
    n = cross(d, UP)
    sine = math.sqrt(dot(n, n))
    if sine <= LEAST_SINE:
        return no_crossing(d)
    n = times((-1.0 if dot(n, a) > 0.0 else 1.0) / sine, n)  # from the line to the axis
    at = along_line(a, d, ZERO, UP, n)
    below, above = at - work.outline[0, 2], work.outline[1, 2] - at
    lever = add(times(-shape.radius, n), times(at, UP))
    gap = -dot(n, a) - shape.radius
    rate = passing(q, y, lever, d, UP, n)
    rate = rate if below < above else -rate
    left = min(below, above, shape.size * (sine - LEAST_SINE)) - ENDS
    return Crossing(gap, left, rate, n, lever, d, UP, sine, 0.0, shape.radius)


@routine
def write_line_touch(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, row: Touch, side: int
) -> None:
    """Write frame and lever of a touch of the line at a side, and how they turn."""
    found = crossing(shape, work, q, y, side)
    n, d, s, spin = found.normal, found.line, found.side, vec(y, W)
    u = add(on_body(q, vec(y, V)), cross(spin, found.lever))
    across = dot(cross(s, d), n)
    if abs(across) < TIE:  # they meet no more in a state on trial: as it was
        return
    turns = times(-1.0, cross(spin, d))  # of the line, as the body sees it
    sign = 1.0 if dot(cross(d, s), n) > 0.0 else -1.0
    rate = -dot(cross(u, d), n) / across
    change = cross(turns, s)
    if found.rim > 0.0:
        out = cross(s, UP)
        change = add(change, cross(d, times(-found.rim * rate, out)))
    change = times(sign / found.sine, change)
    change = subtract(change, times(dot(change, n), n))
    along = times(rate, s)
    if found.mantle > 0.0:
        rate += found.mantle * dot(cross(change, d), n) / across
        along = subtract(times(rate, s), times(found.mantle, change))
    put(row.tangent, 0, d)
    put(row.binormal, 0, cross(n, d))
    put(row.normal, 0, n)
    put(row.lever, 0, found.lever)
    put(row.along, 0, along)
    row.bend = dot(add(change, cross(spin, n)), u)


@kernel
def crossing_speed(q: Axes, y: Floats, found: Crossing) -> float:
    """How fast the gap at a side grows [m/s]."""
    u = add(on_body(q, vec(y, V)), cross(vec(y, W), found.lever))
    return dot(found.normal, u)


@routine
def note_past(shape: SolidParameters, work: Workspace, anew: bool) -> None:
    """Note which points of the base are past the line in the present state.

    Args:
        anew: whatever was noted before; else only what is about to pass does.
    """
    q, y = axes_at(work.state), work.state
    for point in range(shape.contacts + 1):
        off = past_line(shape, work, q, y, point)
        if anew:
            work.past[point] = 1 if off > PAST else 0
        elif work.past[point] == 0:
            work.past[point] = 1 if off > PAST - TIE else 0
        else:
            work.past[point] = 1 if off > BACK + TIE else 0


@routine
def look_behind(shape: SolidParameters, work: Workspace) -> None:
    """Note the surfaces that the body is behind in its present state: they are not met."""
    y = work.state
    if not has_edge(shape):
        return
    q = axes_at(y)
    for point in range(shape.contacts + 1):
        work.behind[point] = 1 if height(shape, work, q, y, point) < -DEEP else 0
    for point in range(shape.outline if shape.lip > 0.0 else 0):
        gap = wall_gap(shape, work, q, y, lip_plane(shape), point)
        work.behind[BEHIND_LIP + point] = 1 if gap < -DEEP else 0
    for side in range(side_count(shape) if near_line(shape, y) else 0):
        gap = crossing(shape, work, q, y, side).gap
        work.behind[BEHIND_SIDES + side] = 1 if gap < -DEEP else 0


@routine
def lowest_of_body(shape: SolidParameters, work: Workspace, y: Floats) -> tuple[float, float]:
    """Height of the lowest point of a body over its support [m], and how fast it rises [m/s]."""
    q, least, rate = axes_at(y), math.inf, 0.0
    for point in range(shape.outline):
        r = vec(work.outline[point], 0)
        if shape.radius > 0.0:
            size = math.sqrt(q.z.x * q.z.x + q.z.y * q.z.y)
            size = shape.radius / max(size, LEAST_SINE * LEAST_SINE)
            r = Vec(-size * q.z.x, -size * q.z.y, r.z)
        up = y[P + 2] + dot(q.z, r)
        if up < least:
            least, rate = up, y[V + 2] + dot(q.z, cross(vec(y, W), r))
    return least, rate


@routine
def stand_at_edge(shape: SolidParameters, work: Workspace) -> None:
    """Write the plane of the lip's face; nothing is behind anything yet."""
    if not has_edge(shape):
        return
    for k in range(work.behind.size):
        work.behind[k] = 0
    lip = work.planes[lip_plane(shape)]
    n = Vec(-shape.edge_x, -shape.edge_y, 0.0)
    put(lip.normal, 0, n)
    put(lip.tangent, 0, cross(UP, n))
    put(lip.binormal, 0, cross(n, cross(UP, n)))
    lip.offset = -shape.edge_at


@routine
def push_off_line(shape: SolidParameters, work: Workspace, h: float) -> None:
    """Shift a state in which the line has entered the body until it has not.

    It has entered through the side that is nearest, and no deeper than the body moves in the step:
    others it lies behind.

    Args:
        h: how long that took [s].
    """
    y = work.state
    v, spin = vec(y, V), vec(y, W)
    moves = math.sqrt(dot(v, v)) + shape.size * math.sqrt(dot(spin, spin))
    q, nearest, out = axes_at(y), -DEEP - 2.0 * h * moves, ZERO
    entered = False
    for side in range(side_count(shape) if near_line(shape, y) else 0):
        found = crossing(shape, work, q, y, side)
        if nearest < found.gap < 0.0 and work.behind[BEHIND_SIDES + side] == 0:
            nearest, out, entered = found.gap, found.normal, True
    if entered:
        put(y, P, add(vec(y, P), times(-nearest, on_support(q, out))))
