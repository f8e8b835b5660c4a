"""One body of the rocking model, with its history."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel, routine
from shaketable.engine.body_tables import BLOCK, read_block
from shaketable.engine.endings import OVERTURNED, STANDING, STILL_ROCKING
from shaketable.engine.one_loop import (
    GOING_ON,
    MOST_IMPACTS,
    PlanarSummary,
    Run,
    no_push,
    shake_free,
    shake_one,
    write_summary,
)
from shaketable.physics.plane.events import cross_interval
from shaketable.physics.plane.forcing import Interval, Shaking, forcing_at
from shaketable.physics.plane.rocking import (
    Block,
    Passage,
    bounce,
    released,
    rocking_frequency,
    side_of,
    step,
)


class History(NamedTuple):
    """Where one body's run is written, as much of it as fits."""

    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    impact_times: NDArray[np.float64]


@kernel
def write(history: History, sample: int, time: float, block: Block, passage: Passage) -> None:
    if sample < history.time.size:
        state = passage.state
        history.time[sample] = time
        history.rotation[sample] = state.side * state.rotation
        history.angular_velocity[sample] = state.side * state.rate


@kernel
def short_ways(
    passage: Passage,
    block: Block,
    shaking: Shaking,
    interval: Interval,
    impact_times: NDArray[np.float64],
) -> tuple[Passage, bool]:
    """Cross an interval without an event or with one plain impact; also return if it was so."""
    state, peak, impacts, _ = passage
    if state.side == 0.0:
        return passage, False
    here = side_of(block, state.side)
    there = side_of(block, here.onward * state.side)
    force = forcing_at(shaking, interval.i, state.side * interval.polarity)
    h = shaking.time_step
    moved, eventful = step(state, here.k, peak, h, force)
    if not eventful:
        return Passage(moved, max(peak, moved.rotation), impacts, -1.0), True
    moved, impact, clean = bounce(
        state, here.k, here.velocity_ratio, here.onward, there, peak, h, force
    )
    if not clean:
        return passage, False
    if impacts < impact_times.size:
        impact_times[impacts] = interval.start + impact.u * h
    return Passage(moved, peak, impacts + 1, -1.0), True


@routine
def cross(
    passage: Passage, block: Block, shaking: Shaking, interval: Interval, history: History
) -> tuple[Passage, int]:
    """Take a body through one interval, trying the short ways first."""
    moved, done = short_ways(passage, block, shaking, interval, history.impact_times)
    if done:
        return moved, GOING_ON
    passage = cross_interval(passage, block, shaking, interval, history.impact_times)
    if passage.fallen_at >= 0.0:
        return passage, OVERTURNED
    if passage.impacts > MOST_IMPACTS and no_push(shaking, interval.i):
        return passage, STILL_ROCKING
    return passage, GOING_ON


@kernel
def settle(
    passage: Passage, block: Block, shaking: Shaking, interval: Interval, history: History
) -> tuple[Passage, int]:
    """A body at rest stays so under gravity alone, because it can stand on its tilt."""
    return passage, STANDING if passage.state.side == 0.0 else GOING_ON


@routine
def rock_free(passage: Passage, block: Block, shaking: Shaking, history: History) -> Run:
    """Go on from the motion's end until rest, overturning or FREE_LIMIT."""
    frequency = rocking_frequency(block)
    return shake_free(passage, block, shaking, history, frequency, write, cross, settle)


@driver
def rock_one(
    shaking: Shaking,
    row: NDArray[np.float64],
    initial_rotation: float,
    history: History,
    summary: NDArray[np.float64],
) -> None:
    """Simulate one body let go at a rotation; write its history and its Summary.

    Args:
        shaking: the motion.
        row: the numbers of a Block.
        initial_rotation: θ [rad].
        history, summary: arrays that are written.
    """
    block = read_block(row, 0, BLOCK)
    state = released(block, initial_rotation)
    passage, frequency = Passage(state, state.rotation, 0, -1.0), rocking_frequency(block)
    run = shake_one(passage, block, shaking, history, frequency, write, cross, settle)
    passage, ending = run.passage, run.ending
    direction, time = 0.0, np.nan
    if ending == OVERTURNED:
        direction = 1.0 if passage.state.side > 0.0 else -1.0
        time = run.start + passage.fallen_at * run.h
    elif ending == GOING_ON:
        ending = STILL_ROCKING
    found = PlanarSummary(
        float(ending), direction, time, passage.peak, float(passage.impacts), float(run.samples),
        0.0, 0.0, 0.0, 0.0, 0.0,
    )  # fmt: skip
    write_summary(summary, found)
