"""How fast a state changes in the present mode, and how sure its contact is.

What a body does most of the time has its own short way (`short_ways`), and flight another. All else
goes through `constraints`.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.solids.constraints import ROUND_OFF, free_turning, react
from shaketable.solids.contacts import arm, axes_at, find_rim, lies_on_rim, on_rim
from shaketable.solids.losses import loses
from shaketable.solids.room import (
    CLOSED,
    CONE,
    CORNER,
    EDGE,
    FIRST,
    FLIGHT,
    HOLD,
    LAST,
    PIVOT,
    PIVOTS,
    PRESS,
    RANK,
    SLIPS,
    STATIC,
    STICKS,
    Floats,
    P,
    Q,
    Room,
    Shape,
    V,
    W,
    X,
    Y,
    put,
    vec,
)
from shaketable.solids.short_ways import rock, roll, slip, slip_on_two
from shaketable.solids.vectors import Axes, Vec, on_support, subtract

NO_CONE = 1e9  # m/s²: margin of a contact without a cone to leave


@kernel
def write_rates(dy: Floats, y: Floats, linear: Vec, turn: Vec) -> None:
    """Write ẏ from the state and its accelerations."""
    put(dy, P, vec(y, V))
    put(dy, V, linear)
    put(dy, W, turn)
    w, x, i, z = y[Q], y[Q + 1], y[Q + 2], y[Q + 3]
    a, b, c = y[W], y[W + 1], y[W + 2]
    dy[Q] = -0.5 * (x * a + i * b + z * c)
    dy[Q + 1] = 0.5 * (w * a + i * c - z * b)
    dy[Q + 2] = 0.5 * (w * b - x * c + z * a)
    dy[Q + 3] = 0.5 * (w * c + x * b - i * a)


@routine
def rates(shape: Shape, room: Room, y: Floats, f: Vec, judge: bool, dy: Floats) -> None:
    """Write ẏ, and if asked for how sure the contact is (`judged`)."""
    q = axes_at(y)
    rank, hold = room.mode[RANK], room.mode[HOLD]
    if rank == FLIGHT:
        write_rates(dy, y, f, free_turning(shape, vec(y, W)))
        room.judged[PRESS] = NO_CONE
        room.judged[CONE] = NO_CONE
        return
    rolls = on_rim(shape, room)
    if rolls:
        find_rim(shape, room, q, vec(y, W))
    rocks = False
    if rank == CORNER and hold == STICKS and not loses(shape):
        linear, turn = roll(shape, room, q, y, f)
    elif rank == EDGE and hold == STICKS and not rolls and not loses(shape):
        rocks = True
        linear, turn = rock(shape, room, q, y, f)
    elif rank == CORNER and hold == SLIPS:
        linear, turn = slip(shape, room, q, y, f)
    elif rank == EDGE and hold == SLIPS and room.mode[CLOSED] == EDGE:
        linear, turn = slip_on_two(shape, room, q, y, f)
    else:
        linear, turn = react(shape, room, q, y, f)
    write_rates(dy, y, linear, turn)
    if judge:
        if hold == STICKS and rank == EDGE:
            if not rocks:
                write_side(shape, room, q)
            judge_side(room)
        else:
            judge_contact(shape, room, q, y)


@kernel
def spare(room: Room, place: int) -> float:
    """μ_s N less the friction of a closed place."""
    share = room.shares[place]
    size = math.sqrt(share[0] * share[0] + share[1] * share[1])
    return limit(room.points[room.closed[place], STATIC], share[2]) - size


@kernel
def limit(mu: float, pressure: float) -> float:
    """The most friction that a pressure gives."""
    return NO_CONE if mu > NO_CONE else mu * pressure


@routine
def write_side(shape: Shape, room: Room, q: Axes) -> None:
    """Write what each end of a side that sticks bears, from what `react` has found.

    The first place gets the reaction of the side's first corner, the second that of its last, but
    for the force along the side, of which only the sum is known: it is in the third row's x.
    """
    first, last = room.closed[room.mode[FIRST]], room.closed[room.mode[LAST]]
    a = on_support(q, arm(shape, room, first))
    side = subtract(on_support(q, arm(shape, room, last)), a)
    length = math.sqrt(side.x * side.x + side.y * side.y)
    e_x, e_y = side.x / length, side.y / length
    total, moment = 0.0, 0.0  # the pressure, and its moment about the first corner
    for place in range(room.mode[CLOSED]):
        r = on_support(q, arm(shape, room, room.closed[place]))
        total += room.shares[place, 2]
        moment += room.shares[place, 2] * (e_x * (r.x - a.x) + e_y * (r.y - a.y))
    f_x, f_y, torque = room.solved[EDGE], room.solved[EDGE + 1], room.solved[EDGE + 2]
    origin = on_support(q, arm(shape, room, room.closed[0]))
    off = e_x * (origin.x - a.x) + e_y * (origin.y - a.y)
    across = e_x * f_y - e_y * f_x
    of_last = (torque + off * across) / length
    of_first = across - of_last
    put(room.shares[0], 0, Vec(-e_y * of_first, e_x * of_first, total - moment / length))
    put(room.shares[1], 0, Vec(-e_y * of_last, e_x * of_last, moment / length))
    room.shares[2, 0] = e_x * f_x + e_y * f_y


@routine
def judge_side(room: Room) -> None:
    """How sure a side whose corners stick is: some split of the force along it has to hold."""
    first, last = room.shares[0], room.shares[1]
    room.judged[PRESS] = min(first[2], last[2])
    spares, excess = 0.0, 0.0
    for place in range(2):
        share = room.shares[place]
        point = room.closed[room.mode[FIRST] if place == 0 else room.mode[LAST]]
        most = max(limit(room.points[point, STATIC], share[2]), 0.0)
        across = math.sqrt(share[0] * share[0] + share[1] * share[1])
        if across > most:
            excess = max(excess, across - most)
        else:
            spares += math.sqrt((most - across) * (most + across))
    margin = spares - abs(room.shares[2, 0])
    room.judged[CONE] = -excess if excess > 0.0 else margin


@routine
def judge_contact(shape: Shape, room: Room, q: Axes, y: Floats) -> None:
    """How sure any other contact is."""
    rank, hold, n = room.mode[RANK], room.mode[HOLD], room.mode[CLOSED]
    total, along, across, least = 0.0, 0.0, 0.0, 0.0
    for place in range(n):
        point = room.closed[place]
        least = min(least, room.shares[place, 2])
        total += room.shares[place, 2]
        along += room.shares[place, 2] * room.points[point, X]
        across += room.shares[place, 2] * room.points[point, Y]
    room.judged[CONE] = NO_CONE
    if rank == CORNER:
        room.judged[PRESS] = total
        if hold == STICKS:
            room.judged[CONE] = spare(room, 0)
        return
    if rank == EDGE:
        a, b = room.closed[room.mode[FIRST]], room.closed[room.mode[LAST]]
        x, z = room.points[b, X] - room.points[a, X], room.points[b, Y] - room.points[a, Y]
        length2 = x * x + z * z
        part = x * (along - total * room.points[a, X]) + z * (across - total * room.points[a, Y])
        room.judged[PRESS] = min(part / length2, total - part / length2)
    else:
        room.judged[PRESS] = flat_margin(shape, room, total, along, across)
        if on_rim(shape, room):  # the three points of which one is the rim press or pull
            room.judged[PRESS] = min(room.shares[0, 2], min(room.shares[1, 2], room.shares[2, 2]))
        if least < -ROUND_OFF * total:  # no pressures without a pull were found: it lifts
            room.judged[PRESS] = min(room.judged[PRESS], least)
        if hold == STICKS:  # it does not turn: the resultant passes through the base as one force
            size = math.sqrt(room.shares[0, 0] ** 2 + room.shares[0, 1] ** 2)
            room.judged[CONE] = limit(shape.least_static, total) - size
    if hold == PIVOTS:
        for place in range(n):
            if room.closed[place] == room.mode[PIVOT]:
                room.judged[CONE] = spare(room, place)


@routine
def flat_margin(shape: Shape, room: Room, total: float, along: float, across: float) -> float:
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
        x, z = room.points[k, X], room.points[k, Y]
        dx, dz = room.points[j, X] - x, room.points[j, Y] - z
        inward = dx * (across - total * z) - dz * (along - total * x)
        least = min(least, inward / (math.sqrt(dx * dx + dz * dz) * shape.reach))
    return least
