"""Bodies in motion, side by side, so that one vector loop takes them through an interval.

LANES bodies to a group, field after field: the loop over a group has constant distances in
memory. A slot is a body's place in the row of all groups.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.kernels.compiled import kernel
from shaketable.kernels.rocking import Block, Push, State, bounce, seen_from, side_of, step

LANES = 8  # two AVX2 vectors; 16 leave more of a group idle and gain nothing
HEIGHT, RATE, SINE, COSINE, SIDE, K, PEAK, POLARITY, EVENTFUL = range(9)
FIELDS = 9

# A batch of bodies that seem to bounce: the fields above, then what the other side needs.
KEEP, K_OTHER, SINE_OTHER, COSINE_OTHER = range(9, 13)
BATCH_FIELDS = 13


@kernel
def place(slot: int) -> int:
    """Where a slot's fields begin."""
    return (slot // LANES) * FIELDS * LANES + slot % LANES


@kernel
def occupy(
    field: NDArray[np.float64],
    slot: int,
    state: State,
    block: Block,
    peak: float,
    polarity: float,
) -> None:
    at = place(slot)
    field[at + HEIGHT * LANES] = state.height
    field[at + RATE * LANES] = state.rate
    field[at + SINE * LANES] = state.sine
    field[at + COSINE * LANES] = state.cosine
    field[at + SIDE * LANES] = state.side
    field[at + K * LANES] = side_of(block, state.side).k
    field[at + PEAK * LANES] = peak
    field[at + POLARITY * LANES] = polarity
    field[at + EVENTFUL * LANES] = 0.0


@kernel
def state_in(field: NDArray[np.float64], at: int) -> State:
    return State(
        field[at + SIDE * LANES],
        field[at + HEIGHT * LANES],
        field[at + RATE * LANES],
        field[at + SINE * LANES],
        field[at + COSINE * LANES],
    )


@kernel
def vacate(field: NDArray[np.float64], slot: int, last: int) -> None:
    """Fill a slot with the last one in use."""
    to = place(slot)
    source = place(last)
    for k in range(FIELDS):
        field[to + k * LANES] = field[source + k * LANES]


@kernel
def step_group(field: NDArray[np.float64], base: int, h: float, force: Push) -> None:
    """One interval for the LANES bodies of a group; a body with an event keeps its state."""
    for lane in range(LANES):
        at = base + lane
        height, rate = field[at + HEIGHT * LANES], field[at + RATE * LANES]
        sine, cosine = field[at + SINE * LANES], field[at + COSINE * LANES]
        peak = field[at + PEAK * LANES]
        own = seen_from(force, field[at + SIDE * LANES] * field[at + POLARITY * LANES])
        new_height, new_rate, new_sine, new_cosine, eventful = step(
            height, rate, sine, cosine, field[at + K * LANES], peak, h, own
        )
        field[at + HEIGHT * LANES] = height if eventful else new_height
        field[at + RATE * LANES] = rate if eventful else new_rate
        field[at + SINE * LANES] = sine if eventful else new_sine
        field[at + COSINE * LANES] = cosine if eventful else new_cosine
        field[at + PEAK * LANES] = new_height if (not eventful) & (new_height > peak) else peak
        field[at + EVENTFUL * LANES] = 1.0 if eventful else 0.0


@kernel
def enter(
    batch: NDArray[np.float64], b: int, field: NDArray[np.float64], at: int, block: Block
) -> None:
    """Copy a body into place b of the batch, with what it would land on."""
    for k in range(FIELDS):
        batch[b + k * LANES] = field[at + k * LANES]
    sign = field[at + SIDE * LANES]
    other = side_of(block, -sign)
    batch[b + KEEP * LANES] = side_of(block, sign).keep
    batch[b + K_OTHER * LANES] = other.k
    batch[b + SINE_OTHER * LANES] = other.sine
    batch[b + COSINE_OTHER * LANES] = other.cosine


@kernel
def leave(batch: NDArray[np.float64], b: int, field: NDArray[np.float64], at: int) -> None:
    """Copy a body from place b of the batch back to its own."""
    for k in range(FIELDS):
        field[at + k * LANES] = batch[b + k * LANES]


@kernel
def bounce_group(batch: NDArray[np.float64], h: float, force: Push) -> None:
    """One interval with one impact for a batch; EVENTFUL where it is not that simple."""
    for at in range(LANES):
        side = batch[at + SIDE * LANES]
        height, rate, sine, cosine, _, clean = bounce(
            batch[at + HEIGHT * LANES],
            batch[at + RATE * LANES],
            batch[at + SINE * LANES],
            batch[at + COSINE * LANES],
            batch[at + K * LANES],
            batch[at + KEEP * LANES],
            batch[at + K_OTHER * LANES],
            batch[at + SINE_OTHER * LANES],
            batch[at + COSINE_OTHER * LANES],
            batch[at + PEAK * LANES],
            h,
            seen_from(force, side * batch[at + POLARITY * LANES]),
        )
        batch[at + HEIGHT * LANES] = height
        batch[at + RATE * LANES] = rate
        batch[at + SINE * LANES] = sine
        batch[at + COSINE * LANES] = cosine
        batch[at + SIDE * LANES] = -side
        batch[at + K * LANES] = batch[at + K_OTHER * LANES]
        batch[at + EVENTFUL * LANES] = 0.0 if clean else 1.0
