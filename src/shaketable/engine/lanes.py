"""Bodies in motion, side by side, so that one vector loop takes them through an interval.

A group holds LANES bodies, number after number, so that the loop over it has constant strides in
memory. A slot is a body's place in the row of all groups.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import kernel
from shaketable.engine.body_tables import (
    read_cone,
    read_corner,
    read_side,
    read_state,
    write_cone,
    write_side,
    write_state,
)
from shaketable.physics.plane.forcing import Forcing, seen_from
from shaketable.physics.plane.layout import columns, length
from shaketable.physics.plane.rocking import Block, Side, State, bounce, side_of, step
from shaketable.physics.plane.sticking import (
    Cone,
    StickingCorner,
    StickingCorners,
    bounce_sticking,
    corner_of,
    step_sticking,
)

LANES = 8  # two AVX2 vectors; 16 leave more of a group idle and gain nothing


class Slot(NamedTuple):
    """A body in motion."""

    state: State
    k: float  # of the side it rocks on
    peak: float  # rad, the largest rotation so far
    polarity: float
    eventful: float  # 1 if something may happen in the interval: the body then keeps its state


class StickingSlot(NamedTuple):
    """A body of the general model, with the friction of the corner that it rocks on."""

    slot: Slot
    cone: Cone


class BouncingSlot(NamedTuple):
    """A body that seems to bounce, with what the impact needs."""

    slot: Slot
    here: Side  # the side it comes from
    there: Side  # the side it lands on
    here_corner: StickingCorner
    there_cone: Cone


# Numbers of one body lie LANES apart.
SLOT = columns(Slot, step=LANES)
CONE = columns(StickingSlot, step=LANES).cone
BOUNCING = columns(BouncingSlot, step=LANES)
ROCKING_FIELDS = length(Slot)
STICKING_FIELDS = length(StickingSlot)
BOUNCING_FIELDS = length(BouncingSlot)


@kernel
def place(slot: int, fields: int) -> int:
    """Where a slot's numbers begin; `fields` per body, ROCKING_FIELDS or STICKING_FIELDS."""
    return (slot // LANES) * fields * LANES + slot % LANES


@kernel
def occupy(
    field: NDArray[np.float64], at: int, state: State, block: Block, peak: float, polarity: float
) -> None:
    """Write a body into the slot that begins at `at`."""
    write_state(field, at, SLOT.state, state)
    field[at + SLOT.k] = side_of(block, state.side).k
    field[at + SLOT.peak] = peak
    field[at + SLOT.polarity] = polarity
    field[at + SLOT.eventful] = 0.0


@kernel
def put_cone(field: NDArray[np.float64], at: int, corner: StickingCorner) -> None:
    """Give the body of a StickingSlot the friction of the corner that it rocks on."""
    write_cone(field, at, CONE, corner.cone)


@kernel
def vacate(field: NDArray[np.float64], slot: int, last: int, fields: int) -> None:
    """Fill a slot with the last one in use."""
    to = place(slot, fields)
    source = place(last, fields)
    for k in range(fields):
        field[to + k * LANES] = field[source + k * LANES]


@kernel
def step_group(
    field: NDArray[np.float64], group: int, h: float, force: Forcing, fields: int
) -> None:
    """One interval for the LANES bodies of a group; a body with an event keeps its state.

    All of a body is in one array: with two, compilers do not see that they may vectorise.
    """
    for lane in range(LANES):
        at = group * fields * LANES + lane
        state = read_state(field, at, SLOT.state)
        peak = field[at + SLOT.peak]
        own = seen_from(force, state.side * field[at + SLOT.polarity])
        k = field[at + SLOT.k]
        if fields == STICKING_FIELDS:
            cone = read_cone(field, at, CONE)
            new, eventful = step_sticking(state, k, cone, peak, h, own)
        else:
            new, eventful = step(state, k, peak, h, own)
        field[at + SLOT.state.rotation] = state.rotation if eventful else new.rotation
        field[at + SLOT.state.rate] = state.rate if eventful else new.rate
        field[at + SLOT.state.sine] = state.sine if eventful else new.sine
        field[at + SLOT.state.cosine] = state.cosine if eventful else new.cosine
        field[at + SLOT.peak] = new.rotation if (not eventful) & (new.rotation > peak) else peak
        field[at + SLOT.eventful] = 1.0 if eventful else 0.0


@kernel
def enter(
    bouncing: NDArray[np.float64], b: int, field: NDArray[np.float64], at: int, block: Block
) -> None:
    """Copy a body into place b among those that seem to bounce, with the side it would land on."""
    for k in range(ROCKING_FIELDS):
        bouncing[b + k * LANES] = field[at + k * LANES]
    sign = field[at + SLOT.state.side]
    here = side_of(block, sign)
    write_side(bouncing, b, BOUNCING.here, here)
    write_side(bouncing, b, BOUNCING.there, side_of(block, here.onward * sign))


@kernel
def enter_corners(bouncing: NDArray[np.float64], b: int, corners: StickingCorners) -> None:
    """Add the friction at both corners, and the e of the general model's own impact."""
    sign = bouncing[b + SLOT.state.side]
    here = corner_of(corners, sign)
    bouncing[b + BOUNCING.here_corner.velocity_ratio] = here.velocity_ratio
    write_cone(bouncing, b, BOUNCING.here_corner.cone, here.cone)
    write_cone(bouncing, b, BOUNCING.there_cone, corner_of(corners, -sign).cone)


@kernel
def leave(
    bouncing: NDArray[np.float64], b: int, field: NDArray[np.float64], at: int, fields: int
) -> None:
    """Copy a body that has bounced back to its slot."""
    for k in range(ROCKING_FIELDS):
        field[at + k * LANES] = bouncing[b + k * LANES]
    if fields == STICKING_FIELDS:
        write_cone(field, at, CONE, read_cone(bouncing, b, BOUNCING.there_cone))


@kernel
def bounce_group(bouncing: NDArray[np.float64], h: float, force: Forcing, fields: int) -> None:
    """One interval with one impact for LANES bodies; `eventful` marks where it is not so."""
    for at in range(LANES):
        state = read_state(bouncing, at, SLOT.state)
        here = read_side(bouncing, at, BOUNCING.here)
        there = read_side(bouncing, at, BOUNCING.there)
        own = seen_from(force, state.side * bouncing[at + SLOT.polarity])
        peak = bouncing[at + SLOT.peak]
        if fields == STICKING_FIELDS:
            corner = read_corner(bouncing, at, BOUNCING.here_corner)
            cone = read_cone(bouncing, at, BOUNCING.there_cone)
            after, _, clean = bounce_sticking(state, here, corner, there, cone, peak, h, own)
        else:
            after, _, clean = bounce(
                state, here.k, here.velocity_ratio, here.onward, there, peak, h, own
            )
        write_state(bouncing, at, SLOT.state, after)
        bouncing[at + SLOT.k] = there.k
        bouncing[at + SLOT.eventful] = 0.0 if clean else 1.0


@kernel
def eventful_slots(
    field: NDArray[np.float64], moving: int, fields: int, slots: NDArray[np.int64]
) -> int:
    """Write the slots of the bodies that have an event to `slots`; return how many."""
    count = 0
    for slot in range(moving):
        if field[place(slot, fields) + SLOT.eventful] != 0.0:
            slots[count] = slot
            count += 1
    return count
