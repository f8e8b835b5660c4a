"""The one way into the compiled solids: every entry of its own would compile them all again."""

from __future__ import annotations

from shaketable.compiled import driver
from shaketable.solids.room import Floats, Rooms, Shapes
from shaketable.solids.run import Ground, Stand, Trace, place, run


@driver
def move_solid(
    shapes: Shapes,
    rooms: Rooms,
    ground: Ground,
    stands: Floats,
    as_is: bool,
    trace: Trace,
    found: Floats,
) -> None:
    """Simulate a solid under one motion, once for each of its stands.

    Args:
        shapes, rooms, ground: the solid, room for its runs, and the motion.
        stands: the numbers of a Stand for each run, (n, 5).
        as_is: whether it begins in the state that the room holds, which may be any above the
            support, rather than at rest on its base.
        trace: room for the history of the last run, which may have no samples.
        found: room for the numbers of a Found for each run, (n, ...).
    """
    shape, room = shapes[0], rooms[0]
    for k in range(stands.shape[0]):
        row = stands[k]
        stand = Stand(row[0], row[1], row[2], row[3], row[4])
        if not as_is:
            place(shape, room, stand.orientation)
        run(shape, room, ground, stand, trace, found[k])
