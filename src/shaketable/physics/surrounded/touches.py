"""Where a body may touch its surroundings: gap, normal and lever of each contact.

A vertex of the body meets a plane: the support, a wall, the face of a lip. And the edge of the
support (the lip's upper end) meets a side of the body, whose normal turns with it; there only
within that side's length. A contact that cannot be, such as that of a corner beyond the edge, has
an infinite gap. Below its edge the support is a thin board: what hangs from the edge may swing
under it.

The accelerations of a contact along n and t are linear in those of the body, but for what its
turning adds: -ω² n·q and -ω² t·q for a vertex on a plane; for the edge at a side, which slides
along it, 2ω(t·v) + ω² n·q, and likewise along t (v is the velocity of the centre of gravity).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.surrounded.scene import (
    A_SLIP,
    A_STICK,
    AT_LIP,
    AT_SIDES,
    B_SLIP,
    B_STICK,
    BASE,
    BEND_N,
    BEND_T,
    LEFT_SIDE,
    MOST_TOUCHES,
    N_X,
    N_Y,
    OFFSET,
    ON_WALLS,
    Q_X,
    Q_Y,
    RIGHT_SIDE,
    SPIN,
    TOP,
    TURN,
    U_N,
    U_T,
    V_X,
    V_Y,
    WALL_A,
    WALL_B,
    WALL_E,
    WALL_X,
    WALL_Y,
    WHICH,
    E,
    Floats,
    Scene,
    Workspace,
    X,
    Y,
)

CLOSED = 1e-9  # m: what is nearer touches
LEAVING = 1e-10  # m/s: what leaves faster does not
# m: how near to its ends an upright side, or a lip's face, can be touched: there the corner of a
# body that stands flat, or slides over, meets the edge itself; and how far beyond them the base can
INSIDE, ENDS = 1e-9, 1e-13
BEHIND = 1e-6  # m: what is deeper in a surface as a step begins is on its other side


class Place(NamedTuple):
    """A contact in a state."""

    gap: float
    n_x: float
    n_y: float
    q_x: float
    q_y: float


@kernel
def contact_count(scene: Scene) -> int:
    """How many contacts there may be: those from the lip on follow the walls', see `number_of`."""
    return 2 + 4 * scene.walls + (6 if scene.edge != 0.0 else 0)


@kernel
def number_of(scene: Scene, k: int) -> int:
    """The number of the k-th of `contact_count` contacts."""
    walls = 2 + 4 * scene.walls
    return k if k < walls else AT_LIP + k - walls


@kernel
def vertex(scene: Scene, v: int) -> tuple[float, float]:
    """ξ, η of a vertex: base right and left, top right and left."""
    return (scene.right if v % 2 == 0 else -scene.left), (-scene.h if v < 2 else scene.over)


@routine
def place_of(scene: Scene, y: Floats, number: int) -> Place:
    """A contact in a state."""
    sine, cosine = math.sin(y[TURN]), math.cos(y[TURN])
    if number >= AT_SIDES:
        return _edge_at_side(scene, y, number - AT_SIDES, sine, cosine)
    v = number if number < ON_WALLS else (number - ON_WALLS) % 4
    if number >= AT_LIP:
        v = number - AT_LIP
    xi, eta = vertex(scene, v)
    q_x, q_y = xi * cosine + eta * sine, eta * cosine - xi * sine
    p_x, p_y = y[X] + q_x, y[Y] + q_y
    if number < ON_WALLS:
        off = scene.edge != 0.0 and scene.edge * p_x > scene.edge_at
        return Place(math.inf if off else p_y, 0.0, 1.0, q_x, q_y)
    if number < AT_LIP:
        wall = scene.wall[(number - ON_WALLS) // 4]
        gap = wall[WALL_X] * p_x + wall[WALL_Y] * p_y - wall[OFFSET]
        return Place(gap, wall[WALL_X], wall[WALL_Y], q_x, q_y)
    gap = scene.edge_at - scene.edge * p_x
    if p_y >= scene.lip - INSIDE or scene.lip == 0.0:
        gap = math.inf
    return Place(gap, -scene.edge, 0.0, q_x, q_y)


@kernel
def _edge_at_side(scene: Scene, y: Floats, side: int, sine: float, cosine: float) -> Place:
    q_x, q_y = scene.edge * scene.edge_at - y[X], scene.lip - y[Y]
    xi, eta = q_x * cosine - q_y * sine, q_x * sine + q_y * cosine
    if side in (BASE, TOP):
        m_x, m_y = 0.0, 1.0 if side == BASE else -1.0
        gap = -scene.h - eta if side == BASE else eta - scene.over
        # where the edge is level with the support, its corner is met before the base can be
        on_side = -scene.left - ENDS <= xi <= scene.right + ENDS
    else:
        m_x, m_y = -1.0 if side == RIGHT_SIDE else 1.0, 0.0
        gap = xi - scene.right if side == RIGHT_SIDE else -scene.left - xi
        on_side = -scene.h + INSIDE < eta < scene.over - INSIDE
    if not on_side:
        gap = math.inf
    return Place(gap, m_x * cosine + m_y * sine, m_y * cosine - m_x * sine, q_x, q_y)


@kernel
def speed_along(y: Floats, place: Place, d_x: float, d_y: float) -> float:
    """Velocity of the body at a contact along a direction."""
    return float((y[V_X] + y[SPIN] * place.q_y) * d_x + (y[V_Y] - y[SPIN] * place.q_x) * d_y)


@kernel
def closing(y: Floats, place: Place) -> float:
    """ġ [m/s]."""
    return speed_along(y, place, place.n_x, place.n_y)


@kernel
def slipping(y: Floats, place: Place) -> float:
    """v [m/s]."""
    return speed_along(y, place, place.n_y, -place.n_x)


@kernel
def bends(y: Floats, place: Place, number: int) -> tuple[float, float]:
    """What turning adds to the accelerations of a contact along n and t [m/s²]."""
    spin, n_x, n_y = y[SPIN], place.n_x, place.n_y
    along_n = n_x * place.q_x + n_y * place.q_y
    along_t = n_y * place.q_x - n_x * place.q_y
    if number < AT_SIDES:
        return -spin * spin * along_n, -spin * spin * along_t
    v_t, v_n = n_y * y[V_X] - n_x * y[V_Y], n_x * y[V_X] + n_y * y[V_Y]
    return 2.0 * spin * v_t + spin * spin * along_n, -2.0 * spin * v_n + spin * spin * along_t


@routine
def friction_of(scene: Scene, number: int) -> tuple[float, float, float, float, float]:
    """a and b at rest and as it slips, and the restitution of a contact."""
    if number < ON_WALLS:
        return scene.a_stick, scene.b_stick, scene.a_slip, scene.b_slip, scene.restitution
    if number < AT_LIP:
        wall = scene.wall[(number - ON_WALLS) // 4]
        return wall[WALL_A], wall[WALL_B], wall[WALL_A], wall[WALL_B], wall[WALL_E]
    return scene.edge_a, scene.edge_b, scene.edge_a, scene.edge_b, scene.edge_e


@routine
def look_behind(scene: Scene, work: Workspace) -> None:
    """Note which surfaces of an edge the body is behind in the present state: they are not met.

    A surface is met from its front. What hangs over the edge is under the support, and outside of
    its lip; without an edge nothing can be behind anything.
    """
    if scene.edge == 0.0:
        return
    y = work.state
    sine, cosine = math.sin(y[TURN]), math.cos(y[TURN])
    q_x, q_y = scene.edge * scene.edge_at - y[X], scene.lip - y[Y]
    xi, eta = q_x * cosine - q_y * sine, q_x * sine + q_y * cosine
    for v in range(2):
        side, up = vertex(scene, v)
        p_x, p_y = y[X] + side * cosine + up * sine, y[Y] + up * cosine - side * sine
        work.behind[v] = 1 if p_y < -BEHIND else 0
        work.behind[AT_LIP + v] = 1 if scene.edge_at - scene.edge * p_x < -BEHIND else 0
    work.behind[AT_SIDES + BASE] = 1 if -scene.h - eta < -BEHIND else 0
    work.behind[AT_SIDES + TOP] = 1 if eta - scene.over < -BEHIND else 0
    work.behind[AT_SIDES + RIGHT_SIDE] = 1 if xi - scene.right < -BEHIND else 0
    work.behind[AT_SIDES + LEFT_SIDE] = 1 if -scene.left - xi < -BEHIND else 0


@kernel
def fill_touch(scene: Scene, y: Floats, touch: Floats, number: int, place: Place) -> None:
    """Write a contact in a state."""
    touch[WHICH] = number
    touch[N_X], touch[N_Y], touch[Q_X], touch[Q_Y] = place.n_x, place.n_y, place.q_x, place.q_y
    a_stick, b_stick, a_slip, b_slip, e = friction_of(scene, number)
    touch[A_STICK], touch[B_STICK], touch[A_SLIP], touch[B_SLIP] = a_stick, b_stick, a_slip, b_slip
    touch[E] = e
    bend_n, bend_t = bends(y, place, number)
    touch[BEND_N], touch[BEND_T] = bend_n, bend_t
    touch[U_N], touch[U_T] = closing(y, place), slipping(y, place)


@routine
def gather(scene: Scene, work: Workspace, near: float, leaving: float, ahead: float) -> int:
    """Write the contacts that are closed; how many.

    Args:
        near: that are nearer [m],
        leaving: that leave more slowly [m/s],
        ahead: or will be so, after so long [s].
    """
    y, count = work.state, 0
    for k in range(contact_count(scene)):
        number = number_of(scene, k)
        if work.behind[number] == 1 or count == MOST_TOUCHES:
            continue
        place = place_of(scene, y, number)
        rate = closing(y, place)
        if place.gap + ahead * rate <= near and rate <= leaving:
            fill_touch(scene, y, work.touch[count], number, place)
            count += 1
    return count
