"""Many runs of one solid under one motion."""

from __future__ import annotations

from shaketable.compiled import driver
from shaketable.solids.room import Floats, Rooms, Shape
from shaketable.solids.run import Ground, Stand, Trace, place, run


@driver
def move_many(
    shape: Shape, rooms: Rooms, ground: Ground, stands: Floats, nothing: Trace, found: Floats
) -> None:
    """Simulate a solid from rest, once for each of the stands.

    Args:
        shape, rooms, ground: the solid, room for its runs, and the motion.
        stands: the numbers of a Stand for each run, (n, 5).
        nothing: a Trace without samples.
        found: room for the numbers of a Found for each run, (n, ...).
    """
    room = rooms[0]
    for k in range(stands.shape[0]):
        row = stands[k]
        stand = Stand(row[0], row[1], row[2], row[3], row[4])
        place(shape, room, stand.orientation)
        run(shape, room, ground, stand, nothing, found[k])
