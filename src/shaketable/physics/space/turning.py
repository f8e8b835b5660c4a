"""Steps of a body that turns about a point, a side or a rolling rim that does not slip.

Its rotation and its spin say all: where its centre of gravity is and how fast that moves follows
from what it turns about (`hold_point`), but for the place that a rim has rolled to. These numbers
come first in a state, and they alone are integrated.
"""

from __future__ import annotations

from typing import NamedTuple

from shaketable.compiled import kernel
from shaketable.physics.space.contacts import arm, long_axes_at, lowest_of_rim, on_rim
from shaketable.physics.space.losses import loses
from shaketable.physics.space.straps import pulls_any
from shaketable.physics.space.vectors import (
    Sym,
    Vec,
    about,
    add,
    applied,
    cross,
    dot,
    inverse,
    on_body,
    subtract,
    times,
)
from shaketable.physics.space.workspace import (
    CORNER,
    EDGE,
    STICKS,
    Floats,
    P,
    Q,
    SolidParameters,
    W,
    Workspace,
    put,
    vec,
)

# What a body turns about alone: nothing; a point or a side that sticks; a rim that rolls.
NOT_ALONE, TURNS, ROLLS = range(3)


class Pivot(NamedTuple):
    """What a body turns about, in the body's frame."""

    arm: Vec  # from the centre of gravity
    inertia: Sym  # about it, by the mass [m²]
    mobility: Sym  # ω̇ by the moment about it [1/m²]


@kernel
def turning_kind(shape: SolidParameters, work: Workspace) -> int:
    """What a body turns about, if nothing but that and f acts on it: TURNS, ROLLS or NOT_ALONE."""
    if work.mode.grip != STICKS or pulls_any(shape, work) or loses(shape):
        return NOT_ALONE
    rolls = on_rim(work)
    if work.mode.kind == CORNER:
        return ROLLS if rolls else TURNS
    return TURNS if work.mode.kind == EDGE and not rolls else NOT_ALONE


@kernel
def pivot_of(shape: SolidParameters, work: Workspace) -> Pivot:
    """The corner or the side that a body turns about."""
    if work.mode.kind == CORNER:
        r = arm(shape, work, work.touches[work.closed[0]].point)
        inertia = about(shape.inertia, r)
        return Pivot(r, inertia, inverse(inertia))
    first = arm(shape, work, work.touches[work.mode.first].point)
    side = subtract(arm(shape, work, work.touches[work.mode.last].point), first)
    middle = add(first, times(0.5, side))
    inertia = about(shape.inertia, middle)
    s = 1.0 / dot(side, applied(inertia, side))
    x, y, z = side.x, side.y, side.z
    along = Sym(s * x * x, s * y * y, s * z * z, s * x * y, s * x * z, s * y * z)
    return Pivot(middle, inertia, along)


@kernel
def write_turning(y: Floats, spin: Vec, turn: Vec, dy: Floats) -> None:
    """Write the rates of a rotation and a spin, from the spin and its own rate."""
    w, x, i, z = y[Q], y[Q + 1], y[Q + 2], y[Q + 3]
    a, b, c = spin.x, spin.y, spin.z
    dy[Q] = -0.5 * (x * a + i * b + z * c)
    dy[Q + 1] = 0.5 * (w * a + i * c - z * b)
    dy[Q + 2] = 0.5 * (w * b - x * c + z * a)
    dy[Q + 3] = 0.5 * (w * c + x * b - i * a)
    put(dy, W, turn)


@kernel
def turn_about(pivot: Pivot, y: Floats, f: Vec, dy: Floats) -> None:
    """Write the rates about a point or a side of the body."""
    spin, long = vec(y, W), long_axes_at(y)
    here = times(long.one, on_body(long.axes, f))
    moment = add(cross(pivot.arm, here), cross(spin, applied(pivot.inertia, spin)))
    write_turning(y, spin, applied(pivot.mobility, times(-1.0, moment)), dy)


@kernel
def turn_on_rim(shape: SolidParameters, work: Workspace, y: Floats, f: Vec, dy: Floats) -> None:
    """Write the rates on a rim that rolls, and of the place where it does."""
    spin, long = vec(y, W), long_axes_at(y)
    low = lowest_of_rim(shape, work, long.axes.z, spin)
    r = Vec(shape.radius * low.x, shape.radius * low.y, shape.rise - shape.h)
    velocity = cross(spin, r)
    moment = cross(spin, add(velocity, Vec(low.along_x, low.along_y, 0.0)))
    moment = cross(r, add(moment, times(long.one, on_body(long.axes, f))))
    moment = add(moment, cross(spin, applied(shape.inertia, spin)))
    mobility = inverse(about(shape.inertia, r))
    write_turning(y, spin, applied(mobility, times(-1.0, moment)), dy)
    dy[P] = -long.one * dot(long.axes.x, velocity)
    dy[P + 1] = -long.one * dot(long.axes.y, velocity)
