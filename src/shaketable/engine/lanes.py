"""Bodies in motion, side by side, so that one vector loop takes them through an interval.

A group holds LANES bodies, number after number, so that the loop over it has constant strides in
memory. A slot is a body's place in the row of all groups.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import kernel
from shaketable.engine.tables import (
    read_cone,
    read_side,
    read_state,
    write_cone,
    write_side,
    write_state,
)
from shaketable.kernels.forcing import Forcing, rest_of, seen_from
from shaketable.kernels.layout import columns, length
from shaketable.kernels.rocking import Block, Impact, Side, State, bounce, side_of, step
from shaketable.kernels.sticking import (
    Cone,
    StickingCorner,
    StickingCorners,
    corner_of,
    holds,
    margin,
    sag,
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
    keep: float  # of the impact
    sine: float  # of ψ at q = 0 on the side it comes from
    cosine: float
    there: Side  # the side it lands on
    here_cone: Cone
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

    With STICKING_FIELDS a corner that may slip in the interval is an event. (All of a body is in
    one array: with two, compilers do not see that they may vectorise.)
    """
    for lane in range(LANES):
        at = group * fields * LANES + lane
        state = read_state(field, at, SLOT.state)
        peak = field[at + SLOT.peak]
        own = seen_from(force, state.side * field[at + SLOT.polarity])
        k = field[at + SLOT.k]
        new, eventful = step(state, k, peak, h, own)
        if fields == STICKING_FIELDS:
            cone = read_cone(field, at, CONE)
            last = rest_of(own, 1.0)
            held = holds(
                margin(cone, k, state.rate, state.sine, state.cosine, own.gravity, own.push),
                margin(cone, k, new.rate, new.sine, new.cosine, last.gravity, last.push),
                sag(cone.radius, k, state.rate, h, own),
            )
            eventful = eventful | (not held)
        field[at + SLOT.state.height] = state.height if eventful else new.height
        field[at + SLOT.state.rate] = state.rate if eventful else new.rate
        field[at + SLOT.state.sine] = state.sine if eventful else new.sine
        field[at + SLOT.state.cosine] = state.cosine if eventful else new.cosine
        field[at + SLOT.peak] = new.height if (not eventful) & (new.height > peak) else peak
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
    bouncing[b + BOUNCING.keep] = here.keep
    bouncing[b + BOUNCING.sine] = here.sine
    bouncing[b + BOUNCING.cosine] = here.cosine
    write_side(bouncing, b, BOUNCING.there, side_of(block, -sign))


@kernel
def enter_corners(bouncing: NDArray[np.float64], b: int, corners: StickingCorners) -> None:
    """Add the friction at both corners, and the e of the general model's own impact."""
    sign = bouncing[b + SLOT.state.side]
    here = corner_of(corners, sign)
    bouncing[b + BOUNCING.keep] = here.keep
    write_cone(bouncing, b, BOUNCING.here_cone, here.cone)
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
def held_through(
    bouncing: NDArray[np.float64], at: int, h: float, own: Forcing, impact: Impact, after: State
) -> bool:
    """Whether both corners stick in an interval with an impact that leads to the state `after`."""
    here = read_cone(bouncing, at, BOUNCING.here_cone)
    there = read_cone(bouncing, at, BOUNCING.there_cone)
    before = read_state(bouncing, at, SLOT.state)
    other = read_side(bouncing, at, BOUNCING.there)
    k = bouncing[at + SLOT.k]
    fall = -impact.speed / bouncing[at + BOUNCING.keep]
    hit = rest_of(own, impact.u)
    back = seen_from(hit, -1.0)
    last = rest_of(back, 1.0)
    drop = sag(here.radius, k, before.rate, h, own)
    drop_after = sag(there.radius, other.k, impact.speed, h, seen_from(own, -1.0))
    # ψ at q = 0 on this side: the line from its corner to the centre of gravity
    sine, cosine = bouncing[at + BOUNCING.sine], bouncing[at + BOUNCING.cosine]
    return holds(
        margin(here, k, before.rate, before.sine, before.cosine, own.gravity, own.push),
        margin(here, k, fall, sine, cosine, hit.gravity, hit.push),
        drop,
    ) & holds(
        margin(there, other.k, impact.speed, other.sine, other.cosine, back.gravity, back.push),
        margin(there, other.k, after.rate, after.sine, after.cosine, last.gravity, last.push),
        drop_after,
    )


@kernel
def bounce_group(bouncing: NDArray[np.float64], h: float, force: Forcing, fields: int) -> None:
    """One interval with one impact for LANES bodies; `eventful` marks where it is not so."""
    for at in range(LANES):
        state = read_state(bouncing, at, SLOT.state)
        other = read_side(bouncing, at, BOUNCING.there)
        own = seen_from(force, state.side * bouncing[at + SLOT.polarity])
        k, keep = bouncing[at + SLOT.k], bouncing[at + BOUNCING.keep]
        after, impact, clean = bounce(state, k, keep, other, bouncing[at + SLOT.peak], h, own)
        if fields == STICKING_FIELDS:
            clean = clean & held_through(bouncing, at, h, own, impact, after)
        write_state(bouncing, at, SLOT.state, after)
        bouncing[at + SLOT.k] = other.k
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
