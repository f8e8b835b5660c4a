"""Accelerations of a solid in the contact modes that it is in most of the time.

It rolls on a corner or a rim without slip (three degrees of freedom), rocks on a side whose corners
stick (one), or slips on a corner (five) or on both corners of a side (four). Each function gives v̇
and ω̇ and writes the reactions to the shares, as `react` of `constraints` does in any mode.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel
from shaketable.physics.space.constraints import free_turning, pressure
from shaketable.physics.space.contacts import arm, drift, slip_direction
from shaketable.physics.space.linear import SINGULAR
from shaketable.physics.space.losses import resistance
from shaketable.physics.space.vectors import (
    Axes,
    Vec,
    about,
    add,
    applied,
    cross,
    dot,
    inverse,
    on_body,
    on_support,
    subtract,
    times,
)
from shaketable.physics.space.workspace import (
    Floats,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)


@kernel
def roll(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec) -> tuple[Vec, Vec]:
    """v̇ and ω̇ on a corner or a rim that does not slip; its reaction is written to the shares."""
    touch = work.touches[work.closed[0]]
    point = touch.point
    r = arm(shape, work, point)
    spin = vec(y, W)
    own = add(cross(spin, r), drift(shape, work, point))
    centre = times(-1.0, cross(spin, own))  # acceleration of the centre at ω̇ = 0, body frame
    here = on_body(q, f)
    moment = cross(r, subtract(centre, here))
    moment = subtract(moment, cross(spin, applied(shape.inertia, spin)))
    if shape.straps > 0:
        moment = add(moment, vec(work.torque, 0))
    turn = applied(inverse(about(shape.inertia, r)), moment)
    acceleration = on_support(q, subtract(centre, cross(turn, r)))
    put(touch.share, 0, subtract(acceleration, f))
    return acceleration, turn


@kernel
def rock(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec) -> tuple[Vec, Vec]:
    """v̇ and ω̇ on a side whose corners stick; its reaction is written as `write_side` does."""
    start, end = work.touches[work.mode.first], work.touches[work.mode.last]
    first, last = arm(shape, work, start.point), arm(shape, work, end.point)
    side = subtract(last, first)
    length = math.sqrt(dot(side, side))
    e = times(1.0 / length, side)
    middle = times(0.5, add(first, last))
    spin = vec(y, W)
    inertia = about(shape.inertia, middle)
    here = on_body(q, f)
    drive = -dot(e, cross(middle, here))
    if shape.straps > 0:
        drive += dot(e, vec(work.torque, 0))
    rate = drive / dot(e, applied(inertia, e))
    turn = times(rate, e)
    acceleration = times(-1.0, add(cross(turn, middle), cross(spin, cross(spin, middle))))
    reaction = subtract(acceleration, here)
    moment = add(applied(shape.inertia, turn), cross(spin, applied(shape.inertia, spin)))
    moment = subtract(moment, cross(middle, reaction))
    if shape.straps > 0:
        moment = subtract(moment, vec(work.torque, 0))
    difference = times(1.0 / length, cross(moment, e))  # half of last less first, across the side
    along = dot(reaction, e)
    across = times(0.5, subtract(reaction, times(along, e)))
    put(start.share, 0, on_support(q, subtract(across, difference)))
    put(end.share, 0, on_support(q, add(across, difference)))
    work.judged.along = along
    return on_support(q, acceleration), turn


@kernel
def rising(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, place: int, f: Vec, turn: Vec
) -> float:
    """How fast a closed touch leaves the support, at v̇ = f and an ω̇ [m/s²]."""
    point, spin = work.touches[place].point, vec(y, W)
    r = arm(shape, work, point)
    own = add(cross(spin, r), drift(shape, work, point))
    return f.z + dot(q.z, add(cross(turn, r), cross(spin, own)))


@kernel
def lifted(shape: SolidParameters, work: Workspace, q: Axes, place: int, turn: Vec) -> float:
    """How fast a closed touch leaves the support, at the ω̇ that a unit of pressure brings."""
    return 1.0 + dot(q.z, cross(turn, arm(shape, work, work.touches[place].point)))


@kernel
def slip(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec) -> tuple[Vec, Vec]:
    """On a corner or a rim that slips."""
    spin, place = vec(y, W), work.closed[0]
    touch = work.touches[place]
    r = arm(shape, work, touch.point)
    turning = cross(spin, r)
    x, z = slip_direction(shape, work, place, add(vec(y, V), on_support(q, turning)))
    force = Vec(-touch.kinetic * x, -touch.kinetic * z, 1.0)
    torque = add(cross(r, on_body(q, force)), resistance(shape, q, spin))
    free = cross(applied(shape.inertia, spin), spin)
    if shape.straps > 0:
        free = add(free, vec(work.torque, 0))
    gives = applied(shape.mobility, cross(r, q.z))  # how a torque lifts the point
    own = add(turning, drift(shape, work, touch.point))
    rises = f.z + dot(gives, free) + dot(q.z, cross(spin, own))
    gets = 1.0 + dot(gives, torque)
    a = -rises / gets if gets != 0.0 else 0.0
    put(touch.share, 0, times(a, force))
    return add(f, times(a, force)), applied(shape.mobility, add(free, times(a, torque)))


@kernel
def slip_on_two(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec
) -> tuple[Vec, Vec]:
    """On a side both of whose corners slip."""
    spin, first, last = vec(y, W), work.closed[0], work.closed[1]
    free = free_turning(shape, work, spin)
    resists = resistance(shape, q, spin)
    force_a, torque_a = pressure(shape, work, q, y, first, resists)
    force_b, torque_b = pressure(shape, work, q, y, last, resists)
    turn_a, turn_b = applied(shape.mobility, torque_a), applied(shape.mobility, torque_b)
    aa, ab = lifted(shape, work, q, first, turn_a), lifted(shape, work, q, first, turn_b)
    ba, bb = lifted(shape, work, q, last, turn_a), lifted(shape, work, q, last, turn_b)
    rise_a = rising(shape, work, q, y, first, f, free)
    rise_b = rising(shape, work, q, y, last, f, free)
    determinant, a, b = aa * bb - ab * ba, 0.0, 0.0
    if abs(determinant) > SINGULAR * (aa * aa + ab * ab + ba * ba + bb * bb):
        a = (ab * rise_b - bb * rise_a) / determinant
        b = (ba * rise_a - aa * rise_b) / determinant
    put(work.touches[first].share, 0, times(a, force_a))
    put(work.touches[last].share, 0, times(b, force_b))
    linear = add(f, add(times(a, force_a), times(b, force_b)))
    return linear, add(free, add(times(a, turn_a), times(b, turn_b)))
