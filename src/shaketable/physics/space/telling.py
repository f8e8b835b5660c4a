"""Writes what a run tells, from where it ended and what it has noted on its way."""

from __future__ import annotations

import math

from shaketable.compiled import routine
from shaketable.physics.space.contacts import arm, axes_at, foot_of, height
from shaketable.physics.space.edge import has_edge, is_off
from shaketable.physics.space.found import OVERTURNED, Found
from shaketable.physics.space.in_plane import slip_of
from shaketable.physics.space.landing import bears
from shaketable.physics.space.vectors import dot, subtract
from shaketable.physics.space.workspace import P, SolidParameters, V, Workspace, vec

SIDE_SLOPE = 0.05  # a side that is more level than this at the fall is the one it fell over


@routine
def tell(shape: SolidParameters, work: Workspace, found: Found) -> None:
    """Write all that is told of a run, but whether what holds the body alone holds it up."""
    gone = has_left(shape, work)
    write_end(shape, work, gone, found)
    write_fall(shape, work, found)
    write_edge(shape, work, gone, found)
    for k in range(shape.straps):
        found.strap_force[k] = work.straps[k].force_peak
        found.strap_broke_at[k] = work.straps[k].broke_at
    write_in_plane(shape, work, found)


@routine
def has_left(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a body has left its support over the edge: it came down, or hangs on."""
    landed, fell = work.tally.landed > 0, work.tally.ending == OVERTURNED
    return landed or (not fell and is_off(shape, work.state) and not bears(shape, work))


@routine
def write_end(shape: SolidParameters, work: Workspace, gone: bool, found: Found) -> None:
    """Write where a body ended, and what was noted on its way.

    Args:
        gone: whether it has left its support over the edge.
    """
    tally, foot = work.tally, foot_of(shape, work)
    found.ending = OVERTURNED if gone else tally.ending
    found.peak = math.asin(min(1.0, math.sqrt(max(tally.peak, 0.0))))
    found.lift, found.yaw = tally.lift, tally.yaw - tally.start_yaw
    found.displacement_x, found.displacement_y = foot.x - tally.start_x, foot.y - tally.start_y
    found.impacts, found.events, found.steps = tally.impacts, tally.events, tally.steps
    found.energy_cuts, found.fallbacks = tally.energy_cuts, tally.fallbacks
    found.samples = tally.samples
    found.shaken_x, found.shaken_y = tally.shaken_x, tally.shaken_y
    found.shaken_yaw = tally.shaken_yaw
    found.farthest = math.sqrt(tally.farthest)
    found.held_up = 0


@routine
def write_fall(shape: SolidParameters, work: Workspace, found: Found) -> None:
    """Write when, to where and over what a body fell that has not left its support."""
    tally, q, y = work.tally, axes_at(work.state), work.state
    found.time = found.fall_azimuth = math.nan
    found.lowest = found.beside = -1
    if tally.ending != OVERTURNED or tally.landed:
        return
    found.time = tally.ended
    found.fall_azimuth = math.atan2(q.y.z, q.x.z)
    if shape.radius > 0.0:
        return
    lowest = 0
    for k in range(shape.hull):
        if height(shape, work, q, y, k) < height(shape, work, q, y, lowest):
            lowest = k
    found.lowest = lowest
    for k in (lowest + 1, lowest + shape.hull - 1):
        j = k % shape.hull
        rise = height(shape, work, q, y, j) - height(shape, work, q, y, lowest)
        span = subtract(arm(shape, work, j), arm(shape, work, lowest))
        if rise < SIDE_SLOPE * math.sqrt(dot(span, span)):
            found.beside = j


@routine
def write_edge(shape: SolidParameters, work: Workspace, gone: bool, found: Found) -> None:
    """Write when a body left its support over the edge, and how it came down.

    A fall of it is to the side of the edge, when it came down, or left where it hangs on.
    """
    tally = work.tally
    found.off_edge = 1 if gone and has_edge(shape) else 0
    found.left_at = found.landing_time = found.landing_x = found.landing_y = math.nan
    found.landing_speed = found.landing_rotation = math.nan
    if not found.off_edge:
        return
    found.left_at = found.time = tally.left_at
    found.fall_azimuth = math.atan2(shape.edge_y, shape.edge_x)
    if tally.landed:
        v, axis = vec(work.state, V), axes_at(work.state).z
        found.landing_time = found.time = tally.ended
        found.landing_x, found.landing_y = work.state[P], work.state[P + 1]
        found.landing_speed = math.sqrt(dot(v, v))
        turned = math.acos(min(1.0, max(-1.0, axis.z)))
        tips = abs(tally.tips)
        found.landing_rotation = tips if tips > math.pi else turned


@routine
def write_in_plane(shape: SolidParameters, work: Workspace, found: Found) -> None:
    """Write how far the corners of a body in the plane have slipped."""
    q, lowest = axes_at(work.state), 0
    for point in range(shape.contacts):
        if height(shape, work, q, work.state, point) < height(shape, work, q, work.state, lowest):
            lowest = point
    found.slip = slip_of(shape, work, lowest)
    found.slip_back, found.slip_front = work.tally.slip_back, work.tally.slip_front
    found.met = work.tally.met
