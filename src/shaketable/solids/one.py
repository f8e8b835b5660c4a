"""One solid, with its history."""

from __future__ import annotations

from shaketable.compiled import driver
from shaketable.solids.room import Floats, Rooms, Shape
from shaketable.solids.run import Ground, Stand, Trace, place, run


@driver
def move_one(
    shape: Shape, rooms: Rooms, ground: Ground, stand: Stand, trace: Trace, found: Floats
) -> None:
    """Simulate one solid from rest; write its history to `trace` and a Found to `found`."""
    room = rooms[0]
    place(shape, room, stand.orientation)
    run(shape, room, ground, stand, trace, found)


@driver
def move_from(
    shape: Shape, rooms: Rooms, ground: Ground, stand: Stand, trace: Trace, found: Floats
) -> None:
    """The same from the state that the room holds, which may be any above the support."""
    run(shape, rooms[0], ground, stand, trace, found)
