"""What ends a mode: quantities that fall through zero.

The gap of a contact that is open; pressure, friction cone and slip of those of the mode, and the
end of the surface that they touch; a strap that becomes taut, relaxed or loose, or breaks; the
fall; the landing of what has left its support. The first zero of the least of them is the event.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.hermite import top_of
from shaketable.physics.surrounded.modes import mode_size
from shaketable.physics.surrounded.scene import (
    AT_LIP,
    AT_SIDES,
    BASE,
    LOOSE,
    ON_WALLS,
    PAST,
    RELAXED,
    STICK,
    STRENGTH,
    TAUT,
    TOP,
    TURN,
    Floats,
    Scene,
    Workspace,
    X,
    Y,
)
from shaketable.physics.surrounded.straps import stretch_of
from shaketable.physics.surrounded.touches import (
    INSIDE,
    closing,
    contact_count,
    friction_of,
    number_of,
    place_of,
    slipping,
    vertex,
)

NO_GUARD, GAP, FORCE, STRAP, FALL, LANDING = range(6)
# How guards are numbered: those of contacts by these, three for each of a mode and of each strap.
OF_END, OF_GAPS, OF_MODE, OF_STRAPS = 1, 100, 200, 300
GAP_SEEN = 2e-13  # m: how deep a contact closes: lifting it out again must feed no bounces
SLIP_SEEN = 1.5e-10  # m/s: half of what counts as no slip when a mode is chosen
STRETCH_SEEN, PULL_SEEN = 1e-13, 1e-11  # m, m/s²


class Guard(NamedTuple):
    """The least of all guards, and what it is; and the value of one that is asked for."""

    least: float
    kind: int
    which: int
    of_one: float


@kernel
def lower(guard: Guard, value: float, kind: int, which: int, one: int) -> Guard:
    of_one = value if which == one else guard.of_one
    if value < guard.least:
        return Guard(value, kind, which, of_one)
    return Guard(guard.least, guard.kind, guard.which, of_one)


@kernel
def in_mode(work: Workspace, number: int) -> bool:
    found = False
    for e in range(mode_size(work)):
        found = found or work.mode[1 + e, 0] == number
    return found


@kernel
def is_off(scene: Scene, y: Floats) -> bool:
    """Whether the centre of gravity is past the edge of the support."""
    return scene.edge != 0.0 and scene.edge * y[X] > scene.edge_at


@routine
def lowest_vertex(scene: Scene, y: Floats) -> float:
    """Height of the lowest one over the support [m]."""
    sine, cosine = math.sin(y[TURN]), math.cos(y[TURN])
    least = math.inf
    for v in range(4):
        xi, eta = vertex(scene, v)
        least = min(least, y[Y] + eta * cosine - xi * sine)
    return least


@routine
def left_of_surface(scene: Scene, y: Floats, number: int) -> float:
    """How much is left of the surface that a contact is on [m]; infinite for the endless."""
    if scene.edge == 0.0 or ON_WALLS <= number < AT_LIP:
        return math.inf
    sine, cosine = math.sin(y[TURN]), math.cos(y[TURN])
    if number < AT_SIDES:
        xi, eta = vertex(scene, number if number < ON_WALLS else number - AT_LIP)
        if number < ON_WALLS:
            return float(scene.edge_at - scene.edge * (y[X] + xi * cosine + eta * sine))
        return float(scene.lip - INSIDE - (y[Y] + eta * cosine - xi * sine))
    q_x, q_y = scene.edge * scene.edge_at - y[X], scene.lip - y[Y]
    xi, eta = q_x * cosine - q_y * sine, q_x * sine + q_y * cosine
    if number - AT_SIDES in (BASE, TOP):
        return float(min(scene.right - xi, xi + scene.left))
    return float(min(scene.over - eta, eta + scene.h) - INSIDE)


@routine
def least_guard(scene: Scene, work: Workspace, y: Floats, one: int) -> Guard:
    """Of a state whose forces are in `work.reaction`.

    Args:
        y: the state.
        one: which guard's value is told as well; NO_GUARD for none.
    """
    guard = Guard(math.inf, NO_GUARD, NO_GUARD, math.inf)
    for k in range(contact_count(scene)):
        number = number_of(scene, k)
        if not in_mode(work, number) and work.behind[number] == 0:
            gap = place_of(scene, y, number).gap + GAP_SEEN
            guard = lower(guard, gap, GAP, OF_GAPS + number, one)
    at, past, which = 0, work.tally[PAST], OF_MODE
    for e in range(mode_size(work)):
        number, kind = work.mode[1 + e, 0], work.mode[1 + e, 1]
        guard = lower(guard, work.reaction[at] + past, FORCE, which, one)
        if kind == STICK:
            a, b, _, _, _ = friction_of(scene, number)
            cone = a * work.reaction[at] - b * abs(work.reaction[at + 1])
            guard = lower(guard, cone + past, FORCE, which + 1, one)
            at += 1
        else:
            slip = kind * slipping(y, place_of(scene, y, number))
            guard = lower(guard, slip + SLIP_SEEN, FORCE, which + 1, one)
        at += 1
        left = left_of_surface(scene, y, number) + GAP_SEEN
        guard = lower(guard, left, FORCE, which + 2, one)
        which += 3
    which = OF_STRAPS
    for k in range(scene.straps):
        held, s = work.held[k], stretch_of(work, y, k)
        if held == LOOSE:
            guard = lower(guard, STRETCH_SEEN - s.delta, STRAP, which, one)
        elif held == TAUT:
            guard = lower(guard, s.force + PULL_SEEN, STRAP, which, one)
            guard = lower(guard, s.delta + STRETCH_SEEN, STRAP, which + 1, one)
            guard = lower(guard, work.strap[k, STRENGTH] - s.force, STRAP, which + 2, one)
        elif held == RELAXED:
            guard = lower(guard, s.delta + STRETCH_SEEN, STRAP, which, one)
            guard = lower(guard, PULL_SEEN - s.force, STRAP, which + 1, one)
        which += 3
    if is_off(scene, y):
        return lower(guard, lowest_vertex(scene, y) + scene.drop, LANDING, OF_END, one)
    return lower(guard, 0.5 * math.pi - abs(y[TURN]), FALL, OF_END, one)


@routine
def dips(scene: Scene, work: Workspace, h: float) -> bool:
    """Whether a contact closes inside a step of h [s] that ends on trial, though not at its end."""
    for k in range(contact_count(scene)):
        number = number_of(scene, k)
        if in_mode(work, number) or work.behind[number] == 1:
            continue
        a, b = place_of(scene, work.state, number), place_of(scene, work.trial, number)
        if a.gap == math.inf or b.gap == math.inf:
            continue
        down, up = h * closing(work.state, a), h * closing(work.trial, b)
        if down < 0.0 < up and -top_of(-a.gap, -b.gap, -down, -up) < -2.0 * GAP_SEEN:
            return True
    return False
