"""A batch of bodies under one motion: its numbers, and what both models do to a body of it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.engine.body_tables import BLOCK, read_block
from shaketable.engine.endings import OVERTURNED
from shaketable.physics.plane.events import cross_interval
from shaketable.physics.plane.forcing import Interval, Shaking
from shaketable.physics.plane.layout import columns
from shaketable.physics.plane.rocking import AT_REST, Block, Passage, State, least_demand, tipping

STRETCH = 64  # samples whose largest demand is known beforehand
NEVER = -1


class Result(NamedTuple):
    """What a simulation is given, and what it brought, in numbers.

    Only the general model fills in the last four.
    """

    polarity: float
    ending: float
    direction: float  # +1 toward +x, -1, or 0 if it did not overturn
    overturning_time: float  # s, NaN if it did not
    peak: float  # rad
    impacts: float
    slip: float  # m, so far
    farthest_left: float  # m, toward -x, <= 0
    farthest_right: float  # m
    lift: float  # m


class Batch(NamedTuple):
    """Bodies under one motion, a row each.

    The arrays are few, because each costs reference counting at every call.
    """

    blocks: NDArray[np.float64]  # numbers of a Block
    bodies: NDArray[np.float64]  # numbers of a ContactBody, shape (0, 0) for the rocking model
    corners: NDArray[np.float64]  # numbers of StickingCorners, likewise
    results: NDArray[np.float64]  # numbers of a Result, with the polarity filled in


RESULT = columns(Result)


class Entry(NamedTuple):
    """Where a body rocks without slip, so that the short ways through an interval may hold."""

    i: int  # the interval at whose start it does, or NEVER: its run is over
    state: State


OVER = Entry(NEVER, AT_REST)


@driver
def stretch_demands(shaking: Shaking, demands: NDArray[np.float64]) -> None:
    """Write the largest |a_x| / (g + a_y) in each STRETCH of samples to `demands`.

    It is infinite where the floor drops away.
    """
    a_x, g_effective = shaking.a_x, shaking.g_effective
    for stretch in range(demands.size):
        first = stretch * STRETCH
        largest = 0.0
        for j in range(first, min(first + STRETCH, a_x.size)):
            demand = abs(a_x[j]) / g_effective[j] if g_effective[j] > 0.0 else np.inf
            largest = max(largest, demand)
        demands[stretch] = largest


def demands_of(shaking: Shaking) -> NDArray[np.float64]:
    """Largest |a_x| / (g + a_y) in each STRETCH of samples."""
    demands = np.empty((shaking.a_x.size + STRETCH - 1) // STRETCH)
    stretch_demands(shaking, demands)
    return demands


@kernel
def block_of(batch: Batch, row: int) -> Block:
    return read_block(batch.blocks[row], 0, BLOCK)


@kernel
def interval_of(batch: Batch, row: int, shaking: Shaking, i: int) -> Interval:
    """Interval i as one of the bodies meets it."""
    return Interval(i, i * shaking.time_step, batch.results[row, RESULT.polarity])


@routine
def next_tipping(
    block: Block,
    polarity: float,
    shaking: Shaking,
    demands: NDArray[np.float64],
    earliest: int,
) -> int:
    """The first interval from `earliest` on in which a body that rests at its start tips."""
    right, left = block.right, block.left
    a_x, g_effective = shaking.a_x, shaking.g_effective
    # a margin for the round-off of the demands: a stretch may be searched in vain, but not missed
    threshold = least_demand(block) * (1.0 - 1e-12)
    j = earliest
    while j < a_x.size:
        if demands[j // STRETCH] < threshold:
            j = (j // STRETCH + 1) * STRETCH
            continue
        stop = min((j // STRETCH + 1) * STRETCH, a_x.size)
        while j < stop:
            a = polarity * a_x[j]
            if tipping(right, g_effective[j], a) > 0.0 or tipping(left, g_effective[j], a) > 0.0:
                return max(j - 1, earliest)
            j += 1
    return NEVER


@kernel
def note_fall(batch: Batch, row: int, side: float, time: float) -> None:
    """Write down an overturning toward a side, positive for +x."""
    batch.results[row, RESULT.ending] = OVERTURNED
    batch.results[row, RESULT.direction] = 1.0 if side > 0.0 else -1.0
    batch.results[row, RESULT.overturning_time] = time


@kernel
def note_passage(batch: Batch, row: int, passage: Passage, start: float, h: float) -> None:
    """Write down what an interval of rocking brought."""
    batch.results[row, RESULT.peak] = passage.peak
    batch.results[row, RESULT.impacts] = passage.impacts
    if passage.fallen_at >= 0.0:
        note_fall(batch, row, passage.state.side, start + passage.fallen_at * h)


@kernel
def passage_of(batch: Batch, row: int, state: State) -> Passage:
    """What is known of a body when an interval begins."""
    return Passage(
        state, batch.results[row, RESULT.peak], int(batch.results[row, RESULT.impacts]), -1.0
    )


@routine
def rock_through(
    batch: Batch,
    row: int,
    block: Block,
    state: State,
    shaking: Shaking,
    i: int,
    times: NDArray[np.float64],
) -> Passage:
    """Take one body through interval i of rocking event by event, and write down what it brought.

    Times of impacts are written to `times`, as many as fit.
    """
    interval = interval_of(batch, row, shaking, i)
    passage = cross_interval(passage_of(batch, row, state), block, shaking, interval, times)
    note_passage(batch, row, passage, interval.start, shaking.time_step)
    return passage
