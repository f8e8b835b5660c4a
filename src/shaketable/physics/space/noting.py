"""The end of a step taken over, and what is noted of it."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import axes_at, begin_rim, find_rim, foot_of, turned_since
from shaketable.physics.space.edge import (
    PAST,
    clearance,
    hangs_over,
    has_edge,
    look_behind,
    past_line,
)
from shaketable.physics.space.guards import peak_between
from shaketable.physics.space.in_plane import keep_in_plane, note_slips_in_plane
from shaketable.physics.space.straps import note_forces
from shaketable.physics.space.touches import is_closed, note_slips
from shaketable.physics.space.workspace import (
    FLIGHT,
    STATE,
    STICKS,
    Q,
    SolidParameters,
    W,
    Workspace,
    vec,
)


@kernel
def copy(source, target) -> None:  # type: ignore[no-untyped-def]
    for j in range(STATE):
        target[j] = source[j]


@kernel
def is_finite(y) -> bool:  # type: ignore[no-untyped-def]
    total = 0.0
    for j in range(STATE):
        total += y[j]
    return math.isfinite(total)


@routine
def look_at(shape: SolidParameters, work: Workspace) -> None:
    """Store reactions, where a rim is, and slip directions at the start of a step."""
    if shape.radius > 0.0:
        begin_rim(work)
        find_rim(shape, work, axes_at(work.state).z, vec(work.state, W))
    look_on(shape, work)


@routine
def look_on(shape: SolidParameters, work: Workspace) -> None:
    """Likewise where the step before has found the rim."""
    work.judged.press_before, work.judged.cone_before = work.judged.press, work.judged.cone
    if shape.radius > 0.0:
        begin_rim(work)
    if work.mode.grip != STICKS:
        note_slips(shape, work, axes_at(work.state))


@routine
def accept(shape: SolidParameters, work: Workspace, h: float) -> None:
    """Accept the trial state after h [s]; update peak, lift, yaw and how far it came."""
    tally = work.tally
    if shape.straps > 0:
        note_forces(shape, work, h)
    tally.peak = max(tally.peak, peak_between(work.state, work.trial, h))
    copy(work.trial, work.state)
    q = axes_at(work.state)
    if work.mode.kind == FLIGHT and not hangs_over(shape, work):
        tally.lift = max(tally.lift, clearance(shape, work, q, work.state))
    if has_edge(shape):
        look_behind(shape, work)
        if shape.radius > 0.0:
            note_rolling_past(shape, work)
        note_tipping(shape, work)
    if shape.planar:
        keep_in_plane(work.state)
        note_slips_in_plane(shape, work)
    foot = foot_of(shape, work)
    x, y = foot.x - tally.start_x, foot.y - tally.start_y
    tally.farthest = max(tally.farthest, x * x + y * y)
    tally.yaw += turned_since(work.state, tally.yaw_w, tally.yaw_z)
    tally.yaw_w, tally.yaw_z = work.state[Q], work.state[Q + 3]


@routine
def note_rolling_past(shape: SolidParameters, work: Workspace) -> None:
    """Note which points of a circle are past the edge; of those that touch their guards decide."""
    q = axes_at(work.state)
    for point in range(shape.contacts + 1):
        if not is_closed(work, 0, point):
            off = past_line(shape, work, q, work.state, point)
            work.past[point] = 1 if off > PAST else 0


@kernel
def note_tipping(shape: SolidParameters, work: Workspace) -> None:
    """Note how far the axis has turned toward the edge, turn by turn."""
    q = axes_at(work.state)
    angle = math.atan2(shape.edge_x * q.x.z + shape.edge_y * q.y.z, q.z.z)
    change = angle - work.tally.tips
    work.tally.tips += change - 2.0 * math.pi * math.floor((change + math.pi) / (2.0 * math.pi))
