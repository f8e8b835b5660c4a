"""Touches that stick may press against one another, and so have friction for what moves a body.

Equal and opposite forces along the line between two of them move nothing: reactions are not unique.
A mode is admissible where some of them are inside all cones. They are sought pair by pair, so that
the one of each two that has less left has as much as can be.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.cones import spare
from shaketable.physics.space.touches import frame_of, lever_of
from shaketable.physics.space.vectors import Vec, add, dot, on_support, subtract, times
from shaketable.physics.space.workspace import PRESSES, Workspace, put, vec

ROUNDS = 3  # through all pairs
LOOKS = 40  # on one pair, by the golden section: 4e-9 of the range is left
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


@kernel
def sticks(work: Workspace, place: int) -> bool:
    """Whether a touch carries and does not slip."""
    touch = work.touches[place]
    return bool(touch.carries == PRESSES and touch.moves == 0)


@routine
def brace(work: Workspace) -> None:
    """Change the shares of touches that stick, by what moves nothing, until all are in their cones.

    Or as near to them as ROUNDS bring.
    """
    n, most = work.mode.touches, 0.0
    for place in range(n):
        share = vec(work.touches[place].share, 0)
        most += math.sqrt(dot(share, share))
    for _ in range(ROUNDS):
        least = 0.0
        for first in range(n):
            if sticks(work, first) and spare(work, first) < 0.0:
                for last in range(n):
                    if last != first and sticks(work, last):
                        brace_two(work, first, last, most)
                least = min(least, spare(work, first))
        if least >= 0.0:
            break


@routine
def brace_two(work: Workspace, first: int, last: int, most: float) -> None:
    """Press two touches against one another, or pull, by no more than `most` [m/s²]."""
    side = subtract(lever_of(work, last), lever_of(work, first))
    length = math.sqrt(dot(side, side))
    if length == 0.0:
        return
    e = times(1.0 / length, side)
    at_first, at_last = on_support(frame_of(work, first), e), on_support(frame_of(work, last), e)
    a, b = vec(work.touches[first].share, 0), vec(work.touches[last].share, 0)
    before = spare_of_two(work, first, last, a, b, at_first, at_last, 0.0)
    low, high = -most, most
    x, z = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_x = spare_of_two(work, first, last, a, b, at_first, at_last, x)
    at_z = spare_of_two(work, first, last, a, b, at_first, at_last, z)
    for _ in range(LOOKS):
        if at_x < at_z:
            low, x, at_x = x, z, at_z
            z = low + GOLDEN * (high - low)
            at_z = spare_of_two(work, first, last, a, b, at_first, at_last, z)
        else:
            high, z, at_z = z, x, at_x
            x = high - GOLDEN * (high - low)
            at_x = spare_of_two(work, first, last, a, b, at_first, at_last, x)
    if spare_of_two(work, first, last, a, b, at_first, at_last, 0.5 * (low + high)) <= before:
        spare_of_two(work, first, last, a, b, at_first, at_last, 0.0)


@routine
def spare_of_two(
    work: Workspace, first: int, last: int, a: Vec, b: Vec, at_first: Vec, at_last: Vec, s: float
) -> float:
    """The friction left at one of two touches that has less, with s along their line added."""
    put(work.touches[first].share, 0, add(a, times(s, at_first)))
    put(work.touches[last].share, 0, add(b, times(-s, at_last)))
    return min(spare(work, first), spare(work, last))
