"""Where events accumulate: what lies all but flat is laid flat, and what chatters is stepped over.

A wobbling base comes to rest by ever more impacts in ever less time. Once the energy that is left
could lift no corner higher, nor move one faster, than `Thresholds.settle` allows, the base is laid
flat, which takes energy out, and forces decide what follows; likewise one that leans on its rim and
two of its high points. Where an interval has more events than its budget, the rest of it is taken
by time stepping (Moreau 1988, Jean 1999), which knows no events. A tilted circle stands on its ring
of points meanwhile.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.beside import choose, choose_together
from shaketable.physics.space.complementarity import MAX_UNCONVERGED
from shaketable.physics.space.constraints import free_turning
from shaketable.physics.space.contacts import (
    axes_at,
    find_rim,
    lies_on_rim,
    normalise,
    turn_in_body,
    velocity,
)
from shaketable.physics.space.edge import (
    clearance,
    crossing,
    crossing_speed,
    has_edge,
    is_of_base,
    is_off,
    look_behind,
    lowest_of_body,
    near_line,
    note_past,
    push_off_line,
    side_count,
    support_gap,
)
from shaketable.physics.space.impact import strike
from shaketable.physics.space.in_plane import keep_in_plane
from shaketable.physics.space.modes import fly
from shaketable.physics.space.rest_flat import stand_all
from shaketable.physics.space.step import Pull, pull_at
from shaketable.physics.space.straps import hold_on, pull_or_not, with_straps
from shaketable.physics.space.touches import add_near, begin_list, gather_touches, touches_more
from shaketable.physics.space.vectors import Axes, Vec, add, times
from shaketable.physics.space.walls import push_out
from shaketable.physics.space.workspace import (
    STATE,
    P,
    Q,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)
from shaketable.units import STANDARD_GRAVITY

GOES_ON, FELL, LANDED = range(3)  # how an interval ends; the last is beside its support
CREEP_STEP, LONG_STEP = 1e-4, 1e-3  # s: of the time stepping; once reactions often do not converge


@routine
def all_but_flat(shape: SolidParameters, work: Workspace, hovers: float) -> bool:
    """Whether no corner is higher, nor moves faster along the normal, than a settling base's.

    Or, if that is more, than by `hovers` [m].
    """
    q, most = axes_at(work.state), settling_height(shape, hovers)
    found = True
    for point in range(shape.contacts):
        found = found and settles(shape, work, q, point, most)
    return found


@kernel
def settling_height(shape: SolidParameters, hovers: float) -> float:
    """How high a settling base's corners may be [m], `hovers` if that is more."""
    return max(hovers, shape.limits.settle * shape.limits.settle / (2.0 * STANDARD_GRAVITY))


@routine
def settles(shape: SolidParameters, work: Workspace, q: Axes, point: int, most: float) -> bool:
    """Whether a point is no higher [m], and no faster, than a settling base's corners."""
    y = work.state
    if support_gap(shape, work, q, y, point) > most:
        return False
    return abs(velocity(shape, work, q, y, point).z) <= shape.limits.settle


@routine
def gather_leaning(shape: SolidParameters, work: Workspace, hovers: float) -> bool:
    """List two high points and the rim, if they are as near as a settling base's corners."""
    if shape.radius == 0.0 or lies_on_rim(shape):
        return False
    q, most = axes_at(work.state), settling_height(shape, hovers)
    find_rim(shape, work, q.z, vec(work.state, W))
    begin_list(work)
    for point in range(shape.contacts + 1):
        if settles(shape, work, q, point, most):
            add_near(work, point)
    return work.mode.near == 3 and work.touches[2].point == shape.contacts


@routine
def lay_flat(shape: SolidParameters, work: Workspace) -> None:
    """Put the whole base on the support, its foot where it is; velocities are left."""
    y = work.state
    axis = axes_at(y)
    y[P] -= shape.h * axis.x.z
    y[P + 1] -= shape.h * axis.y.z
    y[P + 2] = shape.h
    y[Q + 1] = y[Q + 2] = 0.0
    normalise(y)
    if shape.walls > 0:
        push_out(shape, work)
    stand_all(shape, work)
    if has_edge(shape):
        keep_supported(shape, work)


@routine
def keep_supported(shape: SolidParameters, work: Workspace) -> None:
    """List those points of the base that have the support under them."""
    note_past(shape, work, True)
    q = axes_at(work.state)
    begin_list(work)
    for point in range(shape.contacts):
        if support_gap(shape, work, q, work.state, point) < math.inf:
            add_near(work, point)


@routine
def gather_settling_at_walls(shape: SolidParameters, work: Workspace) -> bool:
    """List touches; whether a body is as near to a wall as a settling base to the support."""
    q, most = axes_at(work.state), shape.limits.landing
    begin_list(work)
    rim = shape.radius > 0.0
    if rim:
        find_rim(shape, work, q.z, vec(work.state, W))
    first = shape.contacts if rim and lies_on_rim(shape) else 0
    for point in range(first, shape.contacts + (1 if rim else 0)):
        if settles(shape, work, q, point, most):
            add_near(work, point)
    return gather_touches(shape, work, most, shape.limits.settle, 0.0) > 0


@routine
def gather_settling_at_edge(shape: SolidParameters, work: Workspace) -> bool:
    """List touches; whether a body over the edge is as near to lying flat as a settling base."""
    q, most = axes_at(work.state), settling_height(shape, 0.0)
    if not near_line(shape, work.state):
        return False
    n, flat = 0, True
    for point in range(shape.contacts):
        gap = support_gap(shape, work, q, work.state, point)
        if gap < math.inf:
            flat = flat and settles(shape, work, q, point, most)
            n += 1
    over = n < shape.contacts
    for side in range(side_count(shape) if flat and over else 0):
        found = crossing(shape, work, q, work.state, side)
        if is_of_base(shape, side) and found.gap < math.inf:
            slow = abs(crossing_speed(q, work.state, found)) <= shape.limits.settle
            flat, n = flat and slow and found.gap <= most, n + 1
    if not flat or not over or n < 3:
        return False
    begin_list(work)
    for point in range(shape.contacts):
        if support_gap(shape, work, q, work.state, point) < math.inf:
            add_near(work, point)
    return gather_touches(shape, work, most, shape.limits.settle, 0.0) > 0


@kernel
def drift_state(y, h: float) -> None:  # type: ignore[no-untyped-def]
    """Move a state by its velocities for a short time."""
    for j in range(3):
        y[P + j] += h * y[V + j]
    turn_in_body(y, times(h, vec(y, W)))


@routine
def creep(shape: SolidParameters, work: Workspace, pull: Pull, u: float) -> int:
    """Take what is left of an interval by time stepping; return how it ended."""
    work.tally.fallbacks += 1
    y = work.state
    left = (1.0 - u) * pull.length
    longest = CREEP_STEP if work.tally.fallbacks < MAX_UNCONVERGED else LONG_STEP
    steps = max(1, math.ceil(left / longest))
    h = left / steps
    for k in range(steps):
        f = pull_at(pull, u + (1.0 - u) * (k + 0.5) / steps)
        spin = vec(y, W)
        if shape.straps > 0:
            work.clock.passed = (u + (1.0 - u) * k / steps) * pull.length
            hold_on(shape, work)
            f = with_straps(shape, work, f)
        turn = free_turning(shape, work, spin)
        put(y, V, add(vec(y, V), times(h, f)))
        put(y, W, add(spin, times(h, turn)))
        q = axes_at(y)
        points = shape.contacts
        if shape.radius > 0.0 and not lies_on_rim(shape):
            find_rim(shape, work, q.z, spin)
            points += 1
        begin_list(work)
        for point in range(points):
            speed = velocity(shape, work, q, y, point).z
            if support_gap(shape, work, q, y, point) + h * speed <= 0.0:
                add_near(work, point)
        for j in range(STATE):
            work.trial[j] = y[j]
        if touches_more(shape):
            gather_touches(shape, work, 0.0, math.inf, h)
        if work.mode.touches > 0:
            strike(shape, work, 0.0, h if touches_more(shape) else 0.0)
        if shape.planar:
            keep_in_plane(y)
        drift_state(y, h)
        if shape.walls > 0:
            push_out(shape, work)
        if has_edge(shape):
            push_off_line(shape, work, h)
            note_past(shape, work, True)
            look_behind(shape, work)
        if is_off(shape, y):
            if lowest_of_body(shape, work, y)[0] < -shape.drop:
                return LANDED
        elif axes_at(y).z.z <= 0.0:
            stand_clear(shape, work)
            return FELL
    pull_or_not(shape, work)
    settle_creep(shape, work, pull_at(pull, 1.0))
    return GOES_ON


@routine
def stand_clear(shape: SolidParameters, work: Workspace) -> None:
    """Lift what time stepping has left below the support."""
    y = work.state
    y[P + 2] -= min(0.0, clearance(shape, work, axes_at(y), y))


@routine
def settle_creep(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Go over from time stepping to a mode again: nothing below the support, and forces decide."""
    stand_clear(shape, work)
    if all_but_flat(shape, work, shape.limits.hovering):
        lay_flat(shape, work)
        choose(shape, work, f)
        return
    if gather_leaning(shape, work, shape.limits.hovering):
        choose(shape, work, f)
        return
    if touches_more(shape) and gather_settling_at_walls(shape, work):
        choose_together(shape, work, f)
        return
    fly(shape, work)
