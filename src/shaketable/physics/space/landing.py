"""What lands, is struck or passes the edge: which points touch then, and which mode follows."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.beside import choose, choose_together
from shaketable.physics.space.contacts import (
    LEVEL,
    axes_at,
    begin_rim,
    find_rim,
    lies_on_rim,
    on_rim,
    velocity,
)
from shaketable.physics.space.edge import is_of_base, line_plane, support_gap
from shaketable.physics.space.guards import GAP
from shaketable.physics.space.impact import collide, lose_spin
from shaketable.physics.space.in_plane import keep_in_plane
from shaketable.physics.space.modes import lay_ring
from shaketable.physics.space.settling import (
    all_but_flat,
    gather_leaning,
    gather_settling_at_edge,
    lay_flat,
)
from shaketable.physics.space.straps import pull_or_not
from shaketable.physics.space.touches import (
    add_near,
    begin_list,
    gather_touches,
    plane_of,
    point_of,
    touch_velocity,
    touches_more,
)
from shaketable.physics.space.walls import push_out
from shaketable.physics.space.workspace import (
    CORNER,
    FLAT,
    FLIGHT,
    WALLED,
    Floats,
    SolidParameters,
    W,
    Workspace,
    vec,
)


@routine
def collect_contacts(shape: SolidParameters, work: Workspace, leaving: float) -> None:
    """List the points that are on the support and do not leave it faster than `leaving`.

    The lowest point of a rim comes last; a circle that lies flat has its ring of points instead.
    """
    y = work.state
    q = axes_at(y)
    leans = shape.radius > 0.0 and q.z.x**2 + q.z.y**2 > LEVEL * LEVEL
    if leans:
        find_rim(shape, work, q.z, vec(y, W))
    first = shape.contacts if leans and lies_on_rim(shape) else 0
    begin_list(work)
    for point in range(first, shape.contacts + (1 if leans else 0)):
        if (
            support_gap(shape, work, q, y, point) <= shape.limits.landing
            and velocity(shape, work, q, y, point).z <= leaving
        ):
            add_near(work, point)


@routine
def land(  # type: ignore[no-untyped-def]
    shape: SolidParameters, work: Workspace, f, kind: int, impact_times: Floats
) -> None:
    """Resolve a landing, or what meets a wall (`kind` of guard), and choose the next mode."""
    if lies_on_rim(shape) and kind == GAP:
        q = axes_at(work.state)
        sine = math.sqrt(q.z.x**2 + q.z.y**2)
        if work.mode.kind == CORNER and sine > 2.0 * LEVEL:  # it has rolled past its bottom
            begin_rim(work)
            find_rim(shape, work, q.z, vec(work.state, W))
            return
        if sine <= 2.0 * LEVEL:
            lay_ring(shape, work)
            lay_flat(shape, work)
            work.mode.kind = FLAT
    collect_contacts(shape, work, math.inf)
    number = work.tally.impacts
    if number < impact_times.size:
        impact_times[number] = work.clock.begun + work.clock.passed
    work.tally.impacts += 1
    beside = touches_more(shape)
    if beside and gather_touches(shape, work, shape.limits.landing, math.inf, 0.0) > 0:
        work.tally.met = 1
        if shape.walls > 0:
            push_out(shape, work)
    collide(shape, work)
    if shape.planar:
        lose_spin(shape, work)
        keep_in_plane(work.state)
    pull_or_not(shape, work)
    if all_but_flat(shape, work, 0.0):
        if lies_on_rim(shape):
            lay_ring(shape, work)
        lay_flat(shape, work)
    elif gather_settling_at_edge(shape, work):
        choose_together(shape, work, f)
        return
    elif not gather_leaning(shape, work, 0.0):
        collect_contacts(shape, work, shape.limits.leaving)
    choose(shape, work, f)


@routine
def gather_what_meets(shape: SolidParameters, work: Workspace) -> bool:
    """List what touches after a passage of the edge; whether any of it is struck."""
    collect_contacts(shape, work, math.inf)
    gather_touches(shape, work, shape.limits.landing, math.inf, 0.0)
    q, found = axes_at(work.state), False
    for place in range(work.mode.touches):
        u = touch_velocity(work, q, work.state, place)
        found = found or u.z < -shape.limits.leaving
    return found


@routine
def gather_closed(shape: SolidParameters, work: Workspace) -> None:
    """List the closed points on the support alone; beside a wall some may have left it."""
    q, beside = axes_at(work.state), work.mode.kind == WALLED
    if beside and on_rim(work):
        find_rim(shape, work, q.z, vec(work.state, W))
    n = work.mode.touches if beside else work.mode.closed
    begin_list(work)
    for k in range(n):
        touch = work.touches[k if beside else work.closed[k]]
        plane, point = touch.plane, touch.point
        near = not beside or support_gap(shape, work, q, work.state, point) <= shape.limits.landing
        if plane == 0 and near:
            add_near(work, point)


@routine
def bears(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a body stands on its support, or with its base on the edge of it."""
    if work.mode.kind != WALLED:
        return bool(work.mode.kind != FLIGHT)
    found = False
    for place in range(work.mode.touches):
        plane = plane_of(work, place)
        on_edge = plane > shape.walls and not is_upright_side(shape, work, place)
        found = found or (work.touches[place].carries > 0 and (plane == 0 or on_edge))
    return found


@kernel
def is_upright_side(shape: SolidParameters, work: Workspace, place: int) -> bool:
    """Whether a touch is the line of the edge at a side that is none of the base."""
    line = plane_of(work, place) == line_plane(shape)
    return line and not is_of_base(shape, point_of(work, place))
