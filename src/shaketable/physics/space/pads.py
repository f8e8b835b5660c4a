"""Feet that are glued down, as by museum wax: they hold until they let go, and then none does.

A body on glued feet rests. They pull it down as a pressure more, of the sum of their pull-off
strengths, in their middle: it rests as without glue where the line of the force through its centre
of gravity, with that, meets the support inside the base and inside the friction cone. Some sharing
of the pressure then asks of no foot more than its strength; feet that share it otherwise, stiff and
brittle ones, may hold less. Such forces are a convex region: one that moves along a line leaves it
once.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.cones import limit
from shaketable.physics.space.contacts import axes_at, flat_margin
from shaketable.physics.space.step import NEVER, Pull, pull_at
from shaketable.physics.space.straps import pulls_any, with_straps
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.workspace import SolidParameters, Workspace

HALVINGS = 60


@kernel
def judge_pads(shape: SolidParameters, work: Workspace, force: Vec) -> bool:
    """Judge whether glued feet hold a body at rest under a force, without that of its straps."""
    f = with_straps(shape, work, force)
    q = axes_at(work.state)
    pressure = shape.glue - f.z
    along = shape.h * (q.x.x * f.x + q.y.x * f.y) + shape.glue * shape.glue_x
    across = shape.h * (q.x.y * f.x + q.y.y * f.y) + shape.glue * shape.glue_y
    if shape.straps > 0 and pulls_any(shape, work):
        along += work.torque[1]
        across -= work.torque[0]
    size = math.sqrt(f.x * f.x + f.y * f.y)
    tips = flat_margin(shape, work, pressure, along, across)
    return bool(pressure > 0.0 and tips >= 0.0 and size <= limit(shape.least_static, pressure))


@routine
def glued_until(shape: SolidParameters, work: Workspace, pull: Pull) -> float:
    """The part of an interval after which glued feet let go, or NEVER."""
    if judge_pads(shape, work, pull_at(pull, 1.0)):
        return NEVER
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if judge_pads(shape, work, pull_at(pull, middle)):
            low = middle
        else:
            high = middle
    return low
