"""Where the contact points are and how they move."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.solids.room import (
    CLOSED,
    FIRST,
    LAST,
    Floats,
    P,
    Q,
    Room,
    Shape,
    V,
    W,
    X,
    Y,
    vec,
)
from shaketable.solids.vectors import Axes, Vec, add, axes_of, cross, dot, on_support, subtract

LEVEL = 1e-8  # sine of the nutation below which a circle lies flat
LEAST_SLIP = 1e-30  # m/s: keeps the direction of none a number


@kernel
def axes_at(y: Floats) -> Axes:
    return axes_of(y[Q], y[Q + 1], y[Q + 2], y[Q + 3])


@kernel
def lies_on_rim(shape: Shape) -> bool:
    """Whether a base is a circle whose whole rim can lie on the support, as its ring of points."""
    return shape.radius > 0.0 and shape.rise == 0.0


@kernel
def on_rim(shape: Shape, room: Room) -> bool:
    """Whether a rim's lowest point is closed: alone, or as the last of the places."""
    n = room.mode[CLOSED]
    return shape.radius > 0.0 and n > 0 and room.closed[n - 1] == shape.contacts


@kernel
def arm(shape: Shape, room: Room, point: int) -> Vec:
    """r of a contact point, in the body's frame."""
    rise = shape.rise if point == shape.contacts else 0.0
    return Vec(room.points[point, X], room.points[point, Y], rise - shape.h)


@kernel
def drift(shape: Shape, room: Room, point: int) -> Vec:
    """How fast the contact moves along the body: zero but on a rim that rolls."""
    if shape.radius > 0.0 and point == shape.contacts:
        return Vec(room.rim[2], room.rim[3], 0.0)
    return Vec(0.0, 0.0, 0.0)


@kernel
def height(shape: Shape, room: Room, q: Axes, y: Floats, point: int) -> float:
    """Clearance under a point [m]."""
    return float(y[P + 2] + dot(q.z, arm(shape, room, point)))


@kernel
def velocity(shape: Shape, room: Room, q: Axes, y: Floats, point: int) -> Vec:
    """u of a contact point."""
    return add(vec(y, V), on_support(q, cross(vec(y, W), arm(shape, room, point))))


@kernel
def acceleration(shape: Shape, room: Room, q: Axes, y: Floats, dy: Floats, point: int) -> Vec:
    """How fast the velocity of a contact changes, at the rates of a state."""
    r, spin = arm(shape, room, point), vec(y, W)
    own = add(cross(spin, r), drift(shape, room, point))
    return add(vec(dy, V), on_support(q, add(cross(vec(dy, W), r), cross(spin, own))))


@routine
def find_rim(shape: Shape, room: Room, q: Axes, spin: Vec) -> float:
    """Write the lowest point of a circle's rim and how fast it moves along it.

    Returns the sine of the nutation, negative where the axis has passed the normal since the step
    began: a rim that rolls goes on past its bottom until that is found as an event.
    """
    n, rim, last = q.z, room.rim, shape.contacts
    square = n.x * n.x + n.y * n.y
    sine = math.sqrt(square)
    if sine <= LEVEL:
        rim[2] = 0.0
        rim[3] = 0.0
    else:
        one = 1.0 / square  # beside the root, which it need not wait for
        x, y = -n.x * (one * sine), -n.y * (one * sine)
        if on_rim(shape, room) and x * rim[4] + y * rim[5] < 0.0:
            x, y, sine = -x, -y, -sine
        turn = cross(n, spin)  # the rate of the normal, which stands still, as the body sees it
        along = -x * turn.x - y * turn.y
        rim[0] = x
        rim[1] = y
        rim[2] = shape.radius * (-turn.x - x * along) * (one * sine)
        rim[3] = shape.radius * (-turn.y - y * along) * (one * sine)
    room.points[last, X] = shape.radius * rim[0]
    room.points[last, Y] = shape.radius * rim[1]
    return sine


@kernel
def begin_rim(room: Room) -> None:
    """Let a step begin where the rim is."""
    room.rim[4] = room.rim[0]
    room.rim[5] = room.rim[1]


@kernel
def slip_direction(shape: Shape, room: Room, point: int, u: Vec) -> tuple[float, float]:
    """Unit vector that friction at a slipping point opposes: along its slip, if that is fast."""
    x, y = u.x, u.y
    speed = math.sqrt(x * x + y * y)
    kept = shape.limits.turning - speed
    if kept > 0.0:  # a slip that has turned round within a step is found as an event
        x += kept * room.slip[point, 0]
        y += kept * room.slip[point, 1]
        speed = max(math.sqrt(x * x + y * y), LEAST_SLIP)
    return x / speed, y / speed


@kernel
def rim_height(shape: Shape, q: Axes, y: Floats, sine: float) -> float:
    """Clearance under a rim [m], from the sine of the nutation."""
    return float(y[P + 2] + (shape.rise - shape.h) * q.z.z - shape.radius * sine)


@kernel
def lowest(shape: Shape, room: Room, q: Axes, y: Floats) -> float:
    """Least clearance under the base [m]."""
    least = math.inf
    if shape.radius > 0.0:
        least = rim_height(shape, q, y, math.sqrt(q.z.x**2 + q.z.y**2))
    if not lies_on_rim(shape):
        for point in range(shape.hull):
            least = min(least, height(shape, room, q, y, point))
    return least


@kernel
def side_direction(shape: Shape, room: Room) -> Vec:
    """Unit vector from the first to the last of the closed points, in the body's frame."""
    first = arm(shape, room, room.closed[room.mode[FIRST]])
    side = subtract(arm(shape, room, room.closed[room.mode[LAST]]), first)
    length = math.sqrt(dot(side, side))
    return Vec(side.x / length, side.y / length, side.z / length)
