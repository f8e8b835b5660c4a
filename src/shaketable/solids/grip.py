"""How points of different friction hold a base that lies flat, castors beside locked feet.

The pressures are those of least ΣN², as where the base slides, so that rest ends where sliding
begins. With them given, who slips is a convex question: friction in the disc of each point that
leaves the least acceleration in the plane. It is answered point after point until nothing changes;
the pressures follow from the total friction, and both are found in turn.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.solids.constraints import ROUND_OFF, react
from shaketable.solids.contacts import arm
from shaketable.solids.modes import arrange
from shaketable.solids.rates import flat_margin, limit
from shaketable.solids.room import (
    CLOSED,
    FLAT,
    KINETIC,
    NEAR,
    RANK,
    STATIC,
    STICKS,
    Room,
    Shape,
    W,
    X,
    Y,
)
from shaketable.solids.vectors import Axes, Vec, on_support

TURNS = 20  # of pressures and friction, where points slip; of rest the first one tells
SWEEPS, FEWER_SWEEPS = 2000, 100  # of a first turn and of others, which go on from where it ended
SETTLED = 1e-12  # of the pressure: friction that changes by less is found
EDGE_OF_BASE = 1e-13  # of the pressure: a resultant that is outside by less is on the edge
STARTS = 1e-7  # m/s²: a point that accelerates by less stays; well above what has converged
AT_LIMIT = 1.0 - 1e-6  # of what a point can hold: one with more friction than this slips


@kernel
def pressed(shape: Shape, room: Room, total: float) -> bool:
    """Whether the pressures that are written have their resultant inside the base."""
    along, across, found = 0.0, 0.0, 0.0
    for place in range(room.mode[CLOSED]):
        share = room.shares[place, 2]
        found += share
        along += share * room.points[room.closed[place], X]
        across += share * room.points[room.closed[place], Y]
    inside = flat_margin(shape, room, found, along, across) >= -EDGE_OF_BASE * total
    return inside and abs(found - total) <= ROUND_OFF * total


@routine
def flat_grip(shape: Shape, room: Room, q: Axes, f: Vec, turns: int) -> float:
    """Find the friction of all points of a flat base, which slip on as they do; -1 if it lifts.

    It is written to `free`, (x, y) of each closed place beside its pressure. The first of the turns
    takes the pressures of rest; where there is none, the others follow.

    Returns: the largest acceleration that is left to a point that does not slip yet [m/s²]; none
        is where two points hold the base that could hold more.
    """
    n = room.mode[NEAR]
    for place in range(n):
        room.closed[place] = room.near[place]
    room.mode[CLOSED] = n
    arrange(shape, room, STICKS, 0)
    if room.mode[RANK] != FLAT or f.z >= 0.0:
        return -1.0
    pull_x, pull_y, left = -f.x, -f.y, 0.0
    for turn in range(turns):
        react(shape, room, q, room.state, Vec(-pull_x, -pull_y, f.z))
        if not pressed(shape, room, -f.z):
            return -1.0
        if turn == 0:  # in proportion to the pressures, which turns nothing
            for place in range(n):
                part = room.shares[place, 2] / f.z
                room.free[place, 0], room.free[place, 1] = part * f.x, part * f.y
        left = share_friction(shape, room, q, f, SWEEPS if turn == 0 else FEWER_SWEEPS)
        before_x, before_y = pull_x, pull_y
        pull_x, pull_y = 0.0, 0.0
        for place in range(n):
            pull_x += room.free[place, 0]
            pull_y += room.free[place, 1]
        if abs(pull_x - before_x) + abs(pull_y - before_y) <= ROUND_OFF * -f.z:
            break
    holding = 0
    for place in range(n):
        if holds(room, place):
            holding += 1
    return 0.0 if holding >= 2 else left


@kernel
def most(room: Room, place: int) -> float:
    """The friction that a closed place can hold."""
    return limit(room.points[room.closed[place], STATIC], max(room.shares[place, 2], 0.0))


@kernel
def holds(room: Room, place: int) -> bool:
    """Whether a closed place does not slip, and could hold more than it does."""
    x, y = room.free[place, 0], room.free[place, 1]
    within = math.sqrt(x * x + y * y) < AT_LIMIT * most(room, place)
    return within and not room.moving[room.closed[place]]


@routine
def share_friction(shape: Shape, room: Room, q: Axes, f: Vec, sweeps: int) -> float:
    """Find the friction under given pressures; return the largest acceleration that is left."""
    n, spin, inertia = room.mode[CLOSED], room.state[W + 2], shape.inertia.zz
    a_x, a_y, turn = f.x, f.y, 0.0
    for place in range(n):
        point = room.closed[place]
        if room.moving[point]:
            size = room.points[point, KINETIC] * max(room.shares[place, 2], 0.0)
            room.free[place, 0] = -size * room.slip[point, 0]
            room.free[place, 1] = -size * room.slip[point, 1]
        r = on_support(q, arm(shape, room, point))
        a_x += room.free[place, 0]
        a_y += room.free[place, 1]
        turn += (r.x * room.free[place, 1] - r.y * room.free[place, 0]) / inertia
    left = 0.0
    for _ in range(sweeps):
        change, left = 0.0, 0.0
        for place in range(n):
            if room.moving[room.closed[place]]:
                continue
            r = on_support(q, arm(shape, room, room.closed[place]))
            own_x = a_x - turn * r.y - spin * spin * r.x
            own_y = a_y + turn * r.x - spin * spin * r.y
            # the force that ends it, by the inverse of 1 + w wᵀ / inertia with w = (-r.y, r.x)
            along = (r.x * own_y - r.y * own_x) / (inertia + r.x * r.x + r.y * r.y)
            x = room.free[place, 0] - own_x - along * r.y
            y = room.free[place, 1] - own_y + along * r.x
            size, limited = math.sqrt(x * x + y * y), most(room, place)
            if size > limited:  # a step that is short enough to go on to the disc's nearest point
                per = 1.0 + (r.x * r.x + r.y * r.y) / inertia
                x, y = room.free[place, 0] - own_x / per, room.free[place, 1] - own_y / per
                size = math.sqrt(x * x + y * y)
                if size > limited:
                    x, y = x * limited / size, y * limited / size
            left = max(left, abs(own_x), abs(own_y))
            by_x, by_y = x - room.free[place, 0], y - room.free[place, 1]
            room.free[place, 0], room.free[place, 1] = x, y
            a_x += by_x
            a_y += by_y
            turn += (r.x * by_y - r.y * by_x) / inertia
            change = max(change, abs(by_x), abs(by_y))
        if change <= SETTLED * abs(f.z):
            break
    return left


@routine
def slip_with_grip(shape: Shape, room: Room) -> None:
    """Let the points slip that hold all they can."""
    for place in range(room.mode[CLOSED]):
        point = room.closed[place]
        x, y = room.free[place, 0], room.free[place, 1]
        size = math.sqrt(x * x + y * y)
        if not room.moving[point] and not holds(room, place) and size > 0.0:
            room.moving[point] = 1
            room.slip[point, 0], room.slip[point, 1] = -x / size, -y / size
