"""Bodies in motion, side by side, so that one vector loop takes them through an interval.

LANES bodies to a group, field after field: the loop over a group has constant distances in
memory. A slot is a body's place in the row of all groups.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.kernels.compiled import kernel
from shaketable.kernels.holding import Grip, holds, margin, sag
from shaketable.kernels.rocking import (
    Block,
    Push,
    State,
    bounce,
    rest_of,
    seen_from,
    side_of,
    step,
)

LANES = 8  # two AVX2 vectors; 16 leave more of a group idle and gain nothing
HEIGHT, RATE, SINE, COSINE, SIDE, K, PEAK, POLARITY, EVENTFUL = range(9)
FIELDS = 9
# A body of the general model has its pivot's grip as well.
GRIP = FIELDS
GRIP_FIELDS = len(Grip._fields) - 1  # all but what it keeps at an impact
GRIPPED = FIELDS + GRIP_FIELDS

# A batch of bodies that seem to bounce: the first fields, what an impact needs, and both grips.
KEEP, K_OTHER, SINE_OTHER, COSINE_OTHER, SINE_HERE, COSINE_HERE = range(FIELDS, FIELDS + 6)
GRIP_HERE = FIELDS + 6
GRIP_THERE = GRIP_HERE + GRIP_FIELDS
BATCH_FIELDS = GRIP_THERE + GRIP_FIELDS


@kernel
def place(slot: int, fields: int) -> int:
    """Where a slot's fields begin: FIELDS or GRIPPED of them in a group."""
    return (slot // LANES) * fields * LANES + slot % LANES


@kernel
def occupy(
    field: NDArray[np.float64],
    at: int,
    state: State,
    block: Block,
    peak: float,
    polarity: float,
) -> None:
    """Put a body where a slot begins."""
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
def vacate(field: NDArray[np.float64], slot: int, last: int, fields: int) -> None:
    """Fill a slot with the last one in use."""
    to = place(slot, fields)
    source = place(last, fields)
    for k in range(fields):
        field[to + k * LANES] = field[source + k * LANES]


@kernel
def grip_in(field: NDArray[np.float64], at: int) -> Grip:
    """The grip whose fields begin there; what it keeps at an impact is not among them."""
    return Grip(
        field[at],
        field[at + LANES],
        field[at + 2 * LANES],
        field[at + 3 * LANES],
        field[at + 4 * LANES],
        0.0,
    )


@kernel
def put_grip(field: NDArray[np.float64], at: int, grip: Grip) -> None:
    for k in range(GRIP_FIELDS):
        field[at + k * LANES] = grip[k]


@kernel
def step_group(field: NDArray[np.float64], group: int, h: float, force: Push, fields: int) -> None:
    """One interval for the LANES bodies of a group; a body with an event keeps its state.

    With GRIPPED fields a corner that may slip in the interval is an event. (All of a body is in
    one array: with two, compilers do not see that they may vectorise.)
    """
    for lane in range(LANES):
        at = group * fields * LANES + lane
        height, rate = field[at + HEIGHT * LANES], field[at + RATE * LANES]
        sine, cosine = field[at + SINE * LANES], field[at + COSINE * LANES]
        peak = field[at + PEAK * LANES]
        own = seen_from(force, field[at + SIDE * LANES] * field[at + POLARITY * LANES])
        k = field[at + K * LANES]
        new_height, new_rate, new_sine, new_cosine, eventful = step(
            height, rate, sine, cosine, k, peak, h, own
        )
        if fields == GRIPPED:
            grip = grip_in(field, at + GRIP * LANES)
            last = rest_of(own, 1.0)
            held = holds(
                margin(grip, k, rate, sine, cosine, own.gravity, own.push),
                margin(grip, k, new_rate, new_sine, new_cosine, last.gravity, last.push),
                sag(grip.radius, k, rate, h, own),
            )
            eventful = eventful | (not held)
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
    here = side_of(block, sign)
    batch[b + KEEP * LANES] = here.keep
    batch[b + SINE_HERE * LANES] = here.sine
    batch[b + COSINE_HERE * LANES] = here.cosine
    batch[b + K_OTHER * LANES] = other.k
    batch[b + SINE_OTHER * LANES] = other.sine
    batch[b + COSINE_OTHER * LANES] = other.cosine


@kernel
def leave(batch: NDArray[np.float64], b: int, field: NDArray[np.float64], at: int) -> None:
    """Copy a body from place b of the batch back to its own."""
    for k in range(FIELDS):
        field[at + k * LANES] = batch[b + k * LANES]


@kernel
def held_through(
    batch: NDArray[np.float64],
    at: int,
    h: float,
    own: Push,
    u: float,
    speed: float,
    rate: float,
    sine: float,
    cosine: float,
) -> bool:
    """Whether both corners stick in an interval with an impact at u, which leaves `speed`."""
    here, there = grip_in(batch, at + GRIP_HERE * LANES), grip_in(batch, at + GRIP_THERE * LANES)
    k, k_other = batch[at + K * LANES], batch[at + K_OTHER * LANES]
    sine_other, cosine_other = batch[at + SINE_OTHER * LANES], batch[at + COSINE_OTHER * LANES]
    fall = -speed / batch[at + KEEP * LANES]
    # ψ at q = 0 on this side, from the other one: the same line from the corners to the centre
    landing = batch[at + SINE_HERE * LANES], batch[at + COSINE_HERE * LANES]
    hit = rest_of(own, u)
    after = seen_from(hit, -1.0)
    last = rest_of(after, 1.0)
    start_rate = batch[at + RATE * LANES]
    drop = sag(here.radius, k, start_rate, h, own)
    drop_after = sag(there.radius, k_other, speed, h, seen_from(own, -1.0))
    return holds(
        margin(
            here, k, start_rate, batch[at + SINE * LANES], batch[at + COSINE * LANES],
            own.gravity, own.push,
        ),
        margin(here, k, fall, landing[0], landing[1], hit.gravity, hit.push),
        drop,
    ) & holds(
        margin(
            there, k_other, speed, sine_other, cosine_other, after.gravity, after.push
        ),
        margin(there, k_other, rate, sine, cosine, last.gravity, last.push),
        drop_after,
    )  # fmt: skip


@kernel
def bounce_group(batch: NDArray[np.float64], h: float, force: Push, fields: int) -> None:
    """One interval with one impact for a batch; EVENTFUL where it is not that simple."""
    for at in range(LANES):
        side = batch[at + SIDE * LANES]
        own = seen_from(force, side * batch[at + POLARITY * LANES])
        height, rate, sine, cosine, u, speed, clean = bounce(
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
            own,
        )
        if fields == GRIPPED:
            clean = clean & held_through(batch, at, h, own, u, speed, rate, sine, cosine)
        batch[at + HEIGHT * LANES] = height
        batch[at + RATE * LANES] = rate
        batch[at + SINE * LANES] = sine
        batch[at + COSINE * LANES] = cosine
        batch[at + SIDE * LANES] = -side
        batch[at + K * LANES] = batch[at + K_OTHER * LANES]
        batch[at + EVENTFUL * LANES] = 0.0 if clean else 1.0


@kernel
def eventful_slots(
    field: NDArray[np.float64], moving: int, fields: int, slots: NDArray[np.int64]
) -> int:
    """Write the slots of the bodies that have an event to `slots`; returns how many."""
    count = 0
    for slot in range(moving):
        if field[place(slot, fields) + EVENTFUL * LANES] != 0.0:
            slots[count] = slot
            count += 1
    return count
