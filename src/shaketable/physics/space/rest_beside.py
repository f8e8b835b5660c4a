"""How long a body rests that presses against a wall.

It rests as long as some reactions inside the friction cones of all that it touches hold it. Those
of a few independent rows (`walled`) are tried first, as it is soon known whether they do.
"""

from __future__ import annotations

from shaketable.compiled import routine
from shaketable.physics.space.beside import is_small, try_holding
from shaketable.physics.space.contacts import axes_at
from shaketable.physics.space.rates import rates
from shaketable.physics.space.step import NEVER, Pull, pull_at
from shaketable.physics.space.tries import SLACK
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.workspace import SolidParameters, Workspace

PAST = 4.0  # times SLACK: rows that hold a body at rest hold it no longer
# Of an interval, to where a rest ends: by its rows, and by all touches together.
REST_HALVINGS, HELD_HALVINGS = 30, 8


@routine
def judge_rest_beside(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Judge whether some reactions of the touches hold a body at rest under a force."""
    return judge_rows(shape, work, f) or judge_all_touches(shape, work, f)


@routine
def judge_rows(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Judge whether those of the rows that are kept do."""
    rates(shape, work, work.state, f, True, work.stages[0])
    margin = min(work.judged.press, work.judged.cone)
    return margin >= -PAST * SLACK and is_small(shape, work.stages[0])


@routine
def judge_all_touches(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Judge whether those of all touches do."""
    return try_holding(shape, work, axes_at(work.state), f)


@routine
def rest_beside_until(shape: SolidParameters, work: Workspace, pull: Pull, u: float) -> float:
    """The u in the interval at which a body may leave its rest beside a wall, or NEVER.

    There the rows that hold it do so no longer, and others may. The forces that reactions in cones
    withstand are a convex set, and the pull is linear.
    """
    rows = judge_rows(shape, work, pull_at(pull, u))
    if judge_rest_until(shape, work, pull_at(pull, 1.0), rows):
        return NEVER
    low, high = u, 1.0
    for _ in range(REST_HALVINGS if rows else HELD_HALVINGS):
        middle = 0.5 * (low + high)
        if judge_rest_until(shape, work, pull_at(pull, middle), rows):
            low = middle
        else:
            high = middle
    return high


@routine
def judge_rest_until(shape: SolidParameters, work: Workspace, f: Vec, rows: bool) -> bool:
    """Judge whether a body rests, by its rows or by all touches."""
    return judge_rows(shape, work, f) if rows else judge_all_touches(shape, work, f)
