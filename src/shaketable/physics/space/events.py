"""When within a step a contact mode ends: the first zero of its guards.

It is sought on the polynomial of order 4 through the step, where a look costs one evaluation of the
rates (Hairer, Nørsett and Wanner 1993, section II.6), and then by steps that end there, which cost
six.
"""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import axes_at, find_rim, on_rim
from shaketable.physics.space.guards import GAP_FOUND, EventGuard, least_guard, window
from shaketable.physics.space.keeping import hold_point
from shaketable.physics.space.rates import rates
from shaketable.physics.space.step import Pull, pull_at, take_step
from shaketable.physics.space.turning import NOT_ALONE, turning_kind
from shaketable.physics.space.workspace import (
    BETWEEN,
    STATE,
    Floats,
    SolidParameters,
    W,
    Workspace,
    vec,
)

LOOKS = 8  # on the polynomial
CLOSE = 1e-4  # of a step: Newton's method, which squares this, has then come near enough
SEARCHES = 80  # steps on trial for an event
PATIENCE = 6  # of these, after which one halves what is left
SURE = 1e-11  # of an interval: an event is known to this


@routine
def find_event(
    shape: SolidParameters, work: Workspace, pull: Pull, u: float, du: float, end: EventGuard
) -> tuple[float, int]:
    """The part of the interval after u at which the first guard falls through zero, and which.

    `end` is the least guard after du, which is negative. The state just past the zero is left on
    trial. Newton's method on each guard, kept between what is known to be before and past it.
    """
    press, cone = work.judged.press_before, work.judged.cone_before
    middle = look_between(shape, work, pull, u, du, end)
    work.judged.press_before, work.judged.cone_before = press, cone
    low, high, at = 0.0, du, 0.0
    for search in range(SEARCHES):
        if not low < middle < high or search % PATIENCE == PATIENCE - 1:
            middle = 0.5 * (low + high)
        take_step(shape, work, pull, u, middle)
        here = guard_at(shape, work, 6, (middle - at) * pull.length)
        at = middle
        if here.least >= 0.0:
            low = at
        elif here.least >= -window(here.kind):
            return at, here.kind
        else:
            high, end = at, here
        if high - low <= SURE:
            break
        middle = at + here.root / pull.length
    if at != high:
        take_step(shape, work, pull, u, high)
        end = guard_at(shape, work, 6, (high - at) * pull.length)
    return high, end.kind


@kernel
def guard_at(shape: SolidParameters, work: Workspace, row: int, h: float) -> EventGuard:
    """The least guard on trial, whose rates are in a row of the stages, h after the last one."""
    here = least_guard(shape, work, work.trial, work.stages[row], GAP_FOUND, h)
    work.judged.press_before, work.judged.cone_before = work.judged.press, work.judged.cone
    return here


@routine
def look_between(
    shape: SolidParameters, work: Workspace, pull: Pull, u: float, du: float, end: EventGuard
) -> float:
    """About when the first guard falls through zero, by the polynomial through a step of du."""
    work.judged.press_before, work.judged.cone_before = work.judged.press, work.judged.cone
    write_polynomial(work, du * pull.length)
    low, high, at, here = 0.0, du, du, end
    for _ in range(LOOKS):
        middle = at + here.root / pull.length
        if not low < middle < high:
            middle = 0.5 * (low + high)
        moved, at = middle - at, middle
        write_between(work, at / du)
        if turning_kind(shape, work) != NOT_ALONE:
            follow(shape, work, work.trial)
        rates(shape, work, work.trial, pull_at(pull, u + at), True, work.stages[BETWEEN])
        here = guard_at(shape, work, BETWEEN, moved * pull.length)
        if here.least >= 0.0:
            low = at
        else:
            high = at
        if abs(moved) < CLOSE * du:
            break
    return at + here.root / pull.length


@routine
def follow(shape: SolidParameters, work: Workspace, y: Floats) -> None:
    """Write where a body that turns alone is, and how fast that moves."""
    if on_rim(work):
        find_rim(shape, work, axes_at(y).z, vec(y, W))
    hold_point(shape, work, y, work.touches[work.closed[0]].point)


@kernel
def write_polynomial(work: Workspace, h: float) -> None:
    """Write the polynomial of a step of h from the state to the one on trial, from its stages."""
    k, terms = work.stages, work.between
    for j in range(STATE):
        change = work.trial[j] - work.state[j]
        start = h * k[0, j] - change
        terms[0, j] = change
        terms[1, j] = start
        terms[2, j] = change - h * k[6, j] - start
        terms[3, j] = h * (
            -12715105075.0 / 11282082432.0 * k[0, j]
            + 87487479700.0 / 32700410799.0 * k[2, j]
            - 10690763975.0 / 1880347072.0 * k[3, j]
            + 701980252875.0 / 199316789632.0 * k[4, j]
            - 1453857185.0 / 822651844.0 * k[5, j]
            + 69997945.0 / 29380423.0 * k[6, j]
        )


@kernel
def write_between(work: Workspace, part: float) -> None:
    """Write the state after a part of a step to `trial`, by its polynomial."""
    terms, rest = work.between, 1.0 - part
    for j in range(STATE):
        inner = terms[2, j] + rest * terms[3, j]
        work.trial[j] = work.state[j] + part * (terms[0, j] + rest * (terms[1, j] + part * inner))
