"""How long a body that stands flat and still stays so.

It rests where the line of the force through its centre of gravity meets the support inside the
base and inside the friction cone: all pressures with that resultant then allow friction in
proportion. Where the points' frictions differ, `grip` says whether they hold. What holds at two
ends of a stretch on which the force is linear holds on all of it where the region of such forces is
convex: of one friction, or of three points, whose pressures are linear in the force. Of more points
some may stop pressing, and a stretch is looked at in CHECKS parts.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.cones import limit
from shaketable.physics.space.contacts import axes_at, standing_margin
from shaketable.physics.space.grip import flat_grip
from shaketable.physics.space.step import NEVER, Pull, pull_at
from shaketable.physics.space.straps import pulls_any
from shaketable.physics.space.touches import add_near, begin_list
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.workspace import WALLED, SolidParameters, Workspace

PAST = 1e-9  # m/s²: a body leaves its rest where it is past the limit by this much
HALVINGS = 60
NOT_HELD = 1.0  # m/s²: the margin of a rest that a strap turns, which has no size
CHECKS = 8  # of an interval, where frictions differ and more than three points may press


@routine
def rest_margin(shape: SolidParameters, work: Workspace, f: Vec) -> float:
    """How sure a body's rest is under a force [m/s²]; negative where it ends."""
    pressure = -f.z
    if pressure <= 0.0:
        return pressure
    size = math.sqrt(f.x * f.x + f.y * f.y)
    pulled = shape.straps > 0 and pulls_any(shape, work)
    if shape.h * size <= pressure * shape.inscribed and not pulled:
        tips = pressure * shape.inscribed / shape.reach - shape.h * size / shape.reach
    else:
        tips = standing_margin(shape, work, axes_at(work.state), f)
    slips = limit(shape.least_static, pressure) - size
    if slips < 0.0 and not shape.uniform and tips >= 0.0 and judge_together(shape, work, f):
        slips = 0.0
    if pulled and slips >= 0.0 and tips >= 0.0 and not judge_together(shape, work, f):
        slips = -NOT_HELD
    return min(tips, slips)


@kernel
def stand_all(shape: SolidParameters, work: Workspace) -> None:
    """List all points: they are on the support."""
    begin_list(work)
    for point in range(shape.contacts):
        add_near(work, point)


@routine
def judge_together(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Judge whether points with frictions of their own hold a body, not beside a wall.

    They are listed anew.
    """
    if work.mode.kind == WALLED:
        return False
    stand_all(shape, work)
    left = flat_grip(shape, work, axes_at(work.state), f, 1)
    return 0.0 <= left <= shape.limits.starting


@kernel
def rests_surely(shape: SolidParameters, f: Vec) -> bool:
    """A quick test that can only say yes where it is so, and all along between two such forces."""
    low = min(shape.inscribed / shape.h, shape.least_static)
    return -f.z > 0.0 and f.x * f.x + f.y * f.y <= low * low * f.z * f.z


@routine
def rest_until(shape: SolidParameters, work: Workspace, pull: Pull, u: float) -> float:
    """The u in the interval at which a resting body leaves its rest, or NEVER."""
    if rest_margin(shape, work, pull_at(pull, u)) < -PAST:
        return u
    checks, low, high = 1 if shape.uniform or shape.contacts < 4 else CHECKS, u, NEVER
    for k in range(checks):
        at = u + (1.0 - u) * (k + 1) / checks
        if rest_margin(shape, work, pull_at(pull, at)) < -PAST:
            high = at
            break
        low = at
    if high == NEVER:
        return NEVER
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if rest_margin(shape, work, pull_at(pull, middle)) < -PAST:
            high = middle
        else:
            low = middle
        if high - low < 1e-14:
            break
    return high
