"""A solid that leaves its support over an edge.

The support ends at the line e·p = d of its plane, e the direction of the edge, and what lies beyond
bears nothing. A base that lies flat tips over the line where its centre of pressure is past it: at
rest p + h f_t/|f_n|, as it slides p + h μ_k û, û the direction of its slip. What stands on corners
or sides alone has left once all of them are beyond. From there its centre of gravity falls
freely, under gravity alone, until it has come down by the drop; how it tips over the line meanwhile
is not followed.
"""

from __future__ import annotations

import math

from shaketable.compiled import routine
from shaketable.physics.space.contacts import arm, axes_at
from shaketable.physics.space.vectors import Vec, dot, on_support
from shaketable.physics.space.workspace import (
    CLOSED,
    CONTACT_KIND,
    FLAT,
    FRICTION_STATE,
    KINETIC,
    STICKS,
    Floats,
    P,
    SolidParameters,
    V,
    W,
    Workspace,
    vec,
)

#: Columns of what is found: whether it left over the edge, and when [s]; when it comes down [s],
#: where its centre of gravity is then (x, y) [m], how fast [m/s] and how far turned it is [rad].
OFF, LEFT_AT, LANDING_TIME, LANDING_X, LANDING_Y, LANDING_SPEED, LANDING_TURN, EDGE = range(8)
MOVES = 1e-6  # m/s: a flat base that is slower does not slide


@routine
def leaves_support(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Whether nothing of the support is left under a solid, the body force given [m/s²]."""
    p, out = vec(work.state, P), Vec(shape.edge_x, shape.edge_y, 0.0)
    if work.mode[CONTACT_KIND] == FLAT:
        v = vec(work.state, V)
        speed = math.sqrt(v.x * v.x + v.y * v.y)
        if work.mode[FRICTION_STATE] != STICKS and speed > MOVES:
            ahead = shape.h * work.points[0, KINETIC] * dot(out, v) / speed
        else:
            ahead = shape.h * dot(out, f) / -f.z if f.z < 0.0 else 0.0
        return bool(dot(out, p) + ahead > shape.edge_at)
    q, beyond = axes_at(work.state), work.mode[CLOSED] > 0
    for place in range(work.mode[CLOSED]):
        r = on_support(q, arm(shape, work, work.closed[place]))
        beyond = beyond and dot(out, p) + dot(out, r) > shape.edge_at
    return bool(beyond)


@routine
def write_edge(
    shape: SolidParameters,
    work: Workspace,
    left: bool,
    time: float,
    gravity: Vec,
    found: Floats,
    first: int,
) -> None:
    """Write the columns of the edge from `first` on.

    Args:
        left: whether the solid has just left its support.
        time: now [s].
        gravity: in the support's frame [m/s²].
        found, first: where they are written.
    """
    found[first + OFF] = 1.0 if left else 0.0
    for j in range(LEFT_AT, EDGE):
        found[first + j] = math.nan
    if not left:
        return
    p, v, w = vec(work.state, P), vec(work.state, V), vec(work.state, W)
    root = math.sqrt(v.z * v.z - 2.0 * gravity.z * shape.drop)
    lasts = (v.z + root) / -gravity.z
    found[first + LEFT_AT] = time
    found[first + LANDING_TIME] = time + lasts
    found[first + LANDING_X] = p.x + lasts * (v.x + 0.5 * gravity.x * lasts)
    found[first + LANDING_Y] = p.y + lasts * (v.y + 0.5 * gravity.y * lasts)
    at_x, at_y = v.x + gravity.x * lasts, v.y + gravity.y * lasts
    found[first + LANDING_SPEED] = math.sqrt(at_x * at_x + at_y * at_y + root * root)
    axis = axes_at(work.state)
    turned = math.acos(min(1.0, max(-1.0, axis.z.z)))
    found[first + LANDING_TURN] = turned + lasts * math.sqrt(w.x * w.x + w.y * w.y)
