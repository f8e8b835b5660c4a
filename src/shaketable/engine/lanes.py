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
    read_corner,
    read_side,
    read_state,
    write_cone,
    write_corner,
    write_side,
    write_state,
)
from shaketable.kernels.flight import fly
from shaketable.kernels.forcing import Forcing, rest_of, seen_from
from shaketable.kernels.layout import columns, length
from shaketable.kernels.rocking import Block, Side, State, side_of, step
from shaketable.kernels.sticking import (
    Cone,
    StickingCorner,
    StickingCorners,
    corner_of,
    fly_sticking,
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


class Flying(NamedTuple):
    """A body with an event, in the interval in which it has it."""

    state: State
    here: Side  # the side that it rocks on
    there: Side  # the side that it may land on
    peak: float  # rad, the largest rotation so far
    polarity: float
    elapsed: float  # fraction of the interval
    impacts: float  # in it
    ending: float  # of its flight: ARRIVED, LANDED or UNCLEAR


class StickingFlying(NamedTuple):
    """A body of the general model with an event, with the friction of both corners."""

    flying: Flying
    here_corner: StickingCorner
    there_corner: StickingCorner


ARRIVED, LANDED, UNCLEAR = 0.0, 1.0, 2.0  # at the interval's end; on its other side; not plain

# Numbers of one body lie LANES apart.
SLOT = columns(Slot, step=LANES)
CONE = columns(StickingSlot, step=LANES).cone
FLYING = columns(Flying, step=LANES)
CORNER = columns(StickingFlying, step=LANES)
ROCKING_FIELDS = length(Slot)
STICKING_FIELDS = length(StickingSlot)
FLYING_FIELDS = length(Flying)
STICKING_FLYING_FIELDS = length(StickingFlying)


@kernel
def place(slot: int, fields: int) -> int:
    """Where a slot's numbers begin; `fields` per body."""
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
        field[at + SLOT.state.height] = state.height if eventful else new.height
        field[at + SLOT.state.rate] = state.rate if eventful else new.rate
        field[at + SLOT.state.sine] = state.sine if eventful else new.sine
        field[at + SLOT.state.cosine] = state.cosine if eventful else new.cosine
        field[at + SLOT.peak] = new.height if (not eventful) & (new.height > peak) else peak
        field[at + SLOT.eventful] = 1.0 if eventful else 0.0


@kernel
def take_off(
    flying: NDArray[np.float64], at: int, field: NDArray[np.float64], source: int, block: Block
) -> None:
    """Copy a body with an event from its slot among those that fly."""
    state = read_state(field, source, SLOT.state)
    write_state(flying, at, FLYING.state, state)
    write_side(flying, at, FLYING.here, side_of(block, state.side))
    write_side(flying, at, FLYING.there, side_of(block, -state.side))
    flying[at + FLYING.peak] = field[source + SLOT.peak]
    flying[at + FLYING.polarity] = field[source + SLOT.polarity]
    flying[at + FLYING.elapsed] = 0.0
    flying[at + FLYING.impacts] = 0.0


@kernel
def take_corners(
    flying: NDArray[np.float64], at: int, corners: StickingCorners, side: float
) -> None:
    """Add the friction at both corners, and the e of the general model's own impacts."""
    write_corner(flying, at, CORNER.here_corner, corner_of(corners, side))
    write_corner(flying, at, CORNER.there_corner, corner_of(corners, -side))


@kernel
def turn_over(flying: NDArray[np.float64], to: int, source: int, fields: int) -> None:
    """Move a body that has landed to an earlier place, as it is seen from its other side."""
    here = read_side(flying, source, FLYING.here)
    there = read_side(flying, source, FLYING.there)
    if fields == STICKING_FLYING_FIELDS:
        corner = read_corner(flying, source, CORNER.here_corner)
        other = read_corner(flying, source, CORNER.there_corner)
        write_corner(flying, to, CORNER.here_corner, other)
        write_corner(flying, to, CORNER.there_corner, corner)
    write_state(flying, to, FLYING.state, read_state(flying, source, FLYING.state))
    write_side(flying, to, FLYING.here, there)
    write_side(flying, to, FLYING.there, here)
    flying[to + FLYING.peak] = flying[source + FLYING.peak]
    flying[to + FLYING.polarity] = flying[source + FLYING.polarity]
    flying[to + FLYING.elapsed] = flying[source + FLYING.elapsed]
    flying[to + FLYING.impacts] = flying[source + FLYING.impacts]


@kernel
def come_back(
    field: NDArray[np.float64], to: int, flying: NDArray[np.float64], at: int, fields: int
) -> None:
    """Copy a body that has arrived at the interval's end back to its slot."""
    write_state(field, to, SLOT.state, read_state(flying, at, FLYING.state))
    field[to + SLOT.k] = flying[at + FLYING.here.k]
    field[to + SLOT.peak] = flying[at + FLYING.peak]
    field[to + SLOT.eventful] = 0.0
    if fields == STICKING_FLYING_FIELDS:
        write_cone(field, to, CONE, read_corner(flying, at, CORNER.here_corner).cone)


@kernel
def fly_group(
    flying: NDArray[np.float64], group: int, h: float, force: Forcing, fields: int
) -> None:
    """One flight of LANES bodies."""
    for lane in range(LANES):
        at = group * fields * LANES + lane
        state = read_state(flying, at, FLYING.state)
        here = read_side(flying, at, FLYING.here)
        there = read_side(flying, at, FLYING.there)
        peak, elapsed = flying[at + FLYING.peak], flying[at + FLYING.elapsed]
        own = seen_from(rest_of(force, elapsed), state.side * flying[at + FLYING.polarity])
        left = 1.0 - elapsed
        if fields == STICKING_FLYING_FIELDS:
            corner = read_corner(flying, at, CORNER.here_corner)
            flight = fly_sticking(state, here, there, corner, peak, left * h, own)
        else:
            flight = fly(state, here, there, here.keep, peak, left * h, own)
        write_state(flying, at, FLYING.state, flight.state)
        flying[at + FLYING.peak] = flight.peak
        flying[at + FLYING.elapsed] = elapsed + flight.until * left
        flying[at + FLYING.impacts] += 1.0 if flight.landed else 0.0
        ending = LANDED if flight.landed else ARRIVED
        flying[at + FLYING.ending] = ending if flight.plain else UNCLEAR


@kernel
def eventful_slots(
    field: NDArray[np.float64], moving: int, fields: int, slots: NDArray[np.int64]
) -> int:
    """Write the slots of the bodies that have an event to `slots`; return how many."""
    count = 0
    for first in range(0, moving, LANES):
        at = place(first, fields) + SLOT.eventful
        some = 0
        for lane in range(LANES):  # most groups have none; an unused slot may have what it had
            some += 1 if field[at + lane] != 0.0 else 0
        if some > 0:
            for lane in range(min(LANES, moving - first)):
                if field[at + lane] != 0.0:
                    slots[count] = first + lane
                    count += 1
    return count
