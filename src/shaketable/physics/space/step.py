"""One step of Dormand and Prince's method of order 5.

Dormand J.R., Prince P.J. (1980), J. Comput. Appl. Math. 6, 19-26. The last stage of a step is the
first of the next. Within a step the acceleration of the ground is linear.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.dormand_prince import NODES, error_of, to_stage
from shaketable.physics.space.contacts import axes_at
from shaketable.physics.space.keeping import put_back
from shaketable.physics.space.rates import judge_contact, judge_side, rates, write_rates
from shaketable.physics.space.short_ways import rock, roll
from shaketable.physics.space.straps import pulls_any
from shaketable.physics.space.turning import (
    NOT_ALONE,
    ROLLS,
    TURNS,
    Pivot,
    pivot_of,
    turn_about,
    turn_on_rim,
    turning_kind,
)
from shaketable.physics.space.vectors import Vec, add, times
from shaketable.physics.space.workspace import (
    CORNER,
    STATE,
    WALLED,
    Floats,
    P,
    SolidParameters,
    V,
    Workspace,
)

NEVER = 2.0  # in place of the part of an interval


class Pull(NamedTuple):
    """The body force in one interval of the motion, linear in it."""

    start: Vec  # f [m/s²]
    change: Vec  # until its end
    length: float  # of the interval [s]


@kernel
def pull_at(pull: Pull, u: float) -> Vec:
    return add(pull.start, times(u, pull.change))


@routine
def take_step(shape: SolidParameters, work: Workspace, pull: Pull, u: float, du: float) -> float:
    """Write the state after the part du of the interval to `trial`; return the step's error.

    The first row of the stages has to hold the rates at u, the last one gets those at the end, with
    how sure the contact is there. An error below 1 is accepted.
    """
    h, y, k, out = du * pull.length, work.state, work.stages, work.trial
    pivot, way = pivot_of(shape, work), turning_kind(shape, work)
    if way == TURNS:
        go_through(V, TURNS, shape, work, pull, u, du, pivot)
    elif way == ROLLS:
        go_through(V, ROLLS, shape, work, pull, u, du, pivot)
        to_stage(P, P + 2, 6, h, y, k, out)
    elif depends_on_place(shape, work):
        go_through(STATE, NOT_ALONE, shape, work, pull, u, du, pivot)
    else:
        go_through(P, NOT_ALONE, shape, work, pull, u, du, pivot)
        to_stage(P, STATE, 6, h, y, k, out)
    if way == NOT_ALONE:
        rates(shape, work, out, pull_at(pull, u + du), True, k[6])
        worst = error_of(0, STATE, h, k, out)
        put_back(shape, work, out)
    else:
        put_back(shape, work, out)
        end_turn(shape, work, pull_at(pull, u + du))
        worst = error_of(0, V, h, k, out) * max(1.0, shape.size)
    worst /= shape.tolerance
    return worst if worst == worst else math.inf


@kernel
def depends_on_place(shape: SolidParameters, work: Workspace) -> bool:
    """Whether rates depend on where a body is, and not on how it is turned and moves alone."""
    return bool(work.mode.kind == WALLED or pulls_any(shape, work))


@kernel
def go_through(
    numbers: int,
    way: int,
    shape: SolidParameters,
    work: Workspace,
    pull: Pull,
    u: float,
    du: float,
    pivot: Pivot,
) -> None:
    """Write the rates of all stages but the last, of the first so many numbers, and the end."""
    h, y, k, out = du * pull.length, work.state, work.stages, work.trial
    to_stage(0, numbers, 1, h, y, k, out)
    write_stage(way, shape, work, pivot, out, pull_at(pull, u + NODES[0] * du), k[1])
    to_stage(0, numbers, 2, h, y, k, out)
    write_stage(way, shape, work, pivot, out, pull_at(pull, u + NODES[1] * du), k[2])
    to_stage(0, numbers, 3, h, y, k, out)
    write_stage(way, shape, work, pivot, out, pull_at(pull, u + NODES[2] * du), k[3])
    to_stage(0, numbers, 4, h, y, k, out)
    write_stage(way, shape, work, pivot, out, pull_at(pull, u + NODES[3] * du), k[4])
    to_stage(0, numbers, 5, h, y, k, out)
    write_stage(way, shape, work, pivot, out, pull_at(pull, u + du), k[5])
    to_stage(0, numbers, 6, h, y, k, out)


@kernel
def write_stage(
    way: int, shape: SolidParameters, work: Workspace, pivot: Pivot, y: Floats, f: Vec, dy: Floats
) -> None:
    """Write the rates of a stage."""
    if way == TURNS:
        turn_about(pivot, y, f, dy)
    elif way == ROLLS:
        turn_on_rim(shape, work, y, f, dy)
    else:
        rates(shape, work, y, f, False, dy)


@kernel
def end_turn(shape: SolidParameters, work: Workspace, f: Vec) -> None:
    """Write and judge the last rates of what turns alone: as `rates`, which finds rims anew."""
    q, y = axes_at(work.trial), work.trial
    if work.mode.kind == CORNER:
        linear, turn = roll(shape, work, q, y, f)
        judge_contact(shape, work, q, y)
    else:
        linear, turn = rock(shape, work, q, y, f)
        judge_side(work)
    write_rates(work.stages[6], y, linear, turn)
