"""Where the contact points are and how they move."""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.space.vectors import (
    Axes,
    LongAxes,
    Vec,
    add,
    axes_of,
    cross,
    dot,
    long_axes_of,
    on_support,
    subtract,
    times,
)
from shaketable.physics.space.workspace import (
    Floats,
    P,
    Q,
    SolidParameters,
    V,
    W,
    Workspace,
    vec,
)

LEVEL = 1e-8  # sine of the nutation below which a circle lies flat
SHORT = 0.005  # tangent of half of a turn whose arctangent is a short series
LEAST_SLIP = 1e-30  # m/s: keeps the direction of none a number


@kernel
def axes_at(y: Floats) -> Axes:
    return axes_of(y[Q], y[Q + 1], y[Q + 2], y[Q + 3])


@kernel
def long_axes_at(y: Floats) -> LongAxes:
    """As `axes_at`, before the division."""
    return long_axes_of(y[Q], y[Q + 1], y[Q + 2], y[Q + 3])


@kernel
def normalise(y: Floats) -> None:
    size = math.sqrt(y[Q] ** 2 + y[Q + 1] ** 2 + y[Q + 2] ** 2 + y[Q + 3] ** 2)
    for j in range(Q, Q + 4):
        y[j] /= size


@kernel
def turn_in_body(y: Floats, turn: Vec) -> None:
    """Turn a state's rotation by a small angle given in the body's frame [rad]."""
    w, x, i, z = y[Q], y[Q + 1], y[Q + 2], y[Q + 3]
    a, b, c = 0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z
    y[Q] = w - (x * a + i * b + z * c)
    y[Q + 1] = x + (w * a + i * c - z * b)
    y[Q + 2] = i + (w * b - x * c + z * a)
    y[Q + 3] = z + (w * c + x * b - i * a)
    normalise(y)


@kernel
def lies_on_rim(shape: SolidParameters) -> bool:
    """Whether a base is a circle whose whole rim can lie on the support, as its ring of points."""
    return shape.radius > 0.0 and shape.rise == 0.0


@kernel
def on_rim(work: Workspace) -> bool:
    """Whether a rim's lowest point is closed: alone, or as the last of the touches."""
    return bool(work.mode.rolls > 0)


@kernel
def closed_point(work: Workspace, k: int) -> int:
    """The point of the support's contacts that the k-th of the closed touches is."""
    return int(work.touches[work.closed[k]].point)


@kernel
def arm(shape: SolidParameters, work: Workspace, point: int) -> Vec:
    """r of a contact point, in the body's frame."""
    rise = shape.rise if point == shape.contacts else 0.0
    return Vec(work.points[point].x, work.points[point].y, rise - shape.h)


@kernel
def drift(shape: SolidParameters, work: Workspace, point: int) -> Vec:
    """How fast the contact moves along the body: zero but on a rim that rolls."""
    if shape.radius > 0.0 and point == shape.contacts:
        return Vec(work.rim.along_x, work.rim.along_y, 0.0)
    return Vec(0.0, 0.0, 0.0)


@kernel
def height(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, point: int) -> float:
    """Clearance under a point [m]."""
    return float(y[P + 2] + dot(q.z, arm(shape, work, point)))


@kernel
def point_velocity(q: Axes, y: Floats, r: Vec) -> Vec:
    """Velocity of a point of the body, support frame."""
    return add(vec(y, V), on_support(q, cross(vec(y, W), r)))


@kernel
def velocity(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, point: int) -> Vec:
    """u of a contact point."""
    return add(vec(y, V), on_support(q, cross(vec(y, W), arm(shape, work, point))))


@kernel
def acceleration(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, dy: Floats, point: int
) -> Vec:
    """How fast the velocity of a contact changes, at the rates of a state."""
    r, spin = arm(shape, work, point), vec(y, W)
    own = add(cross(spin, r), drift(shape, work, point))
    return add(vec(dy, V), on_support(q, add(cross(vec(dy, W), r), cross(spin, own))))


class Lowest(NamedTuple):
    """The lowest point of a circle's rim."""

    x: float  # its azimuth, body frame
    y: float
    along_x: float  # how fast it moves along the rim [m/s]
    along_y: float
    sine: float  # of the nutation


@kernel
def lowest_of_rim(shape: SolidParameters, work: Workspace, n: Vec, spin: Vec) -> Lowest:
    """Where a circle's rim is lowest, and how fast that moves along it.

    The sine is negative where the axis has passed the normal since the step began: a rim that rolls
    goes on past its bottom until that is found as an event.

    Args:
        n: the support's normal in the body's frame; but for the sine its length does not matter.
        spin: ω.
    """
    rim = work.rim
    square = n.x * n.x + n.y * n.y
    sine = math.sqrt(square)
    if sine <= LEVEL:
        return Lowest(rim.x, rim.y, 0.0, 0.0, sine)
    one = sine * (1.0 / square)  # which need not wait for the root
    x, y = -n.x * one, -n.y * one
    if on_rim(work) and x * rim.before_x + y * rim.before_y < 0.0:
        x, y, one, sine = -x, -y, -one, -sine
    turn = cross(n, spin)  # the rate of the normal, which stands still, as the body sees it
    along = -x * turn.x - y * turn.y
    speed = shape.radius * one
    return Lowest(x, y, speed * (-turn.x - x * along), speed * (-turn.y - y * along), sine)


@routine
def find_rim(shape: SolidParameters, work: Workspace, n: Vec, spin: Vec) -> float:
    """Write the lowest point of a circle's rim as `lowest_of_rim` finds it; return its sine."""
    low, last = lowest_of_rim(shape, work, n, spin), shape.contacts
    work.rim.x, work.rim.y = low.x, low.y
    work.rim.along_x, work.rim.along_y = low.along_x, low.along_y
    work.points[last].x = shape.radius * low.x
    work.points[last].y = shape.radius * low.y
    return low.sine


@kernel
def begin_rim(work: Workspace) -> None:
    """Let a step begin where the rim is."""
    work.rim.before_x = work.rim.x
    work.rim.before_y = work.rim.y


@kernel
def slip_direction(
    shape: SolidParameters, work: Workspace, place: int, u: Vec
) -> tuple[float, float]:
    """Unit vector that friction at a slipping touch opposes: along its slip, if that is fast."""
    x, y = u.x, u.y
    speed = math.sqrt(x * x + y * y)
    kept = shape.limits.turning - speed
    if kept > 0.0:  # a slip that has turned round within a step is found as an event
        x += kept * work.touches[place].slip_x
        y += kept * work.touches[place].slip_y
        speed = max(math.sqrt(x * x + y * y), LEAST_SLIP)
    return x / speed, y / speed


@kernel
def rim_height(shape: SolidParameters, q: Axes, y: Floats, sine: float) -> float:
    """Clearance under a rim [m], from the sine of the nutation."""
    return float(y[P + 2] + (shape.rise - shape.h) * q.z.z - shape.radius * sine)


@kernel
def side_direction(shape: SolidParameters, work: Workspace) -> Vec:
    """Unit vector from the first to the last of the closed points, in the body's frame."""
    first = arm(shape, work, work.touches[work.mode.first].point)
    side = subtract(arm(shape, work, work.touches[work.mode.last].point), first)
    length = math.sqrt(dot(side, side))
    return Vec(side.x / length, side.y / length, side.z / length)


@routine
def flat_margin(
    shape: SolidParameters, work: Workspace, total: float, along: float, across: float
) -> float:
    """How far the resultant of the pressures is inside a flat base, as a pressure.

    Args:
        total, along, across: the pressure, and its first moments.
    """
    if lies_on_rim(shape):
        outward = math.sqrt(along * along + across * across)
        return min(total, total - outward / shape.radius)
    least = total
    for k in range(shape.hull):
        j = k + 1 if k + 1 < shape.hull else 0
        x, z = work.points[k].x, work.points[k].y
        dx, dz = work.points[j].x - x, work.points[j].y - z
        inward = dx * (across - total * z) - dz * (along - total * x)
        least = min(least, inward / (math.sqrt(dx * dx + dz * dz) * shape.reach))
    return least


@routine
def standing_margin(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> float:
    """As `flat_margin`, of what holds a body that stands flat at rest, under f and its straps."""
    along = shape.h * (q.x.x * f.x + q.y.x * f.y)
    across = shape.h * (q.x.y * f.x + q.y.y * f.y)
    if shape.straps > 0:  # Σ r × λ + τ = 0 about the centre of gravity
        along += work.torque[1]
        across -= work.torque[0]
    return flat_margin(shape, work, -f.z, along, across)


@kernel
def twist(y) -> float:  # type: ignore[no-untyped-def]
    """Turn about the support's normal (swing and twist), in (-π, π]."""
    angle = 2.0 * math.atan2(y[Q + 3], y[Q])
    return angle - 2.0 * math.pi * math.floor((angle + math.pi) / (2.0 * math.pi))


@kernel
def turned_since(y: Floats, w: float, z: float) -> float:
    """How far a body has turned about the support's normal since its rotation had these numbers.

    In less than half a turn of it.
    """
    along, across = w * y[Q] + z * y[Q + 3], w * y[Q + 3] - z * y[Q]
    if abs(across) < SHORT * abs(along):
        part = across / along  # twice its arctangent, to the last digit
        square = part * part
        series = 1.0 - square * (1.0 / 3.0 - square * (0.2 - square / 7.0))
        return float(2.0 * part * series)
    return 2.0 * math.atan(across / along) if along != 0.0 else 0.0


@kernel
def foot_of(shape: SolidParameters, work: Workspace) -> Vec:
    """Foot of the centre of gravity on the base."""
    q = axes_at(work.state)
    return subtract(vec(work.state, P), times(shape.h, Vec(q.x.z, q.y.z, q.z.z)))
