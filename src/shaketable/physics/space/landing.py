"""What is told of a body that has left its support over the edge: when, and how it came down."""

from __future__ import annotations

import math

from shaketable.compiled import routine
from shaketable.physics.space.contacts import axes_at
from shaketable.physics.space.vectors import dot
from shaketable.physics.space.workspace import Floats, P, SolidParameters, V, Workspace, vec

#: Columns of what is found: whether it left over the edge, and when [s]; when it comes down [s],
#: where its centre of gravity is then (x, y) [m], how fast [m/s] and how far turned it is [rad].
OFF, LEFT_AT, LANDING_TIME, LANDING_X, LANDING_Y, LANDING_SPEED, LANDING_TURN, EDGE = range(8)


@routine
def write_edge(
    shape: SolidParameters,
    work: Workspace,
    gone: bool,
    landed: bool,
    time: float,
    found: Floats,
    first: int,
) -> None:
    """Write the columns of the edge from `first` on.

    Args:
        gone: whether it has left its support.
        landed: whether its lowest point has come down by the drop.
        time: now [s].
        found, first: where they are written.
    """
    found[first + OFF] = 1.0 if gone else 0.0
    for j in range(LEFT_AT, EDGE):
        found[first + j] = math.nan
    if gone:
        found[first + LEFT_AT] = work.tally.left_at
    if landed:
        v, axis = vec(work.state, V), axes_at(work.state).z
        found[first + LANDING_TIME] = time
        found[first + LANDING_X], found[first + LANDING_Y] = work.state[P], work.state[P + 1]
        found[first + LANDING_SPEED] = math.sqrt(dot(v, v))
        turned = math.acos(min(1.0, max(-1.0, axis.z)))
        tips = abs(work.tally.tips)
        found[first + LANDING_TURN] = tips if tips > math.pi else turned
