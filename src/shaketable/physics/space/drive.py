"""The one way into the compiled solids: every entry of its own would compile them all again."""

from __future__ import annotations

import numpy as np

from shaketable.compiled import driver
from shaketable.physics.space.found import FoundRecords, SolidTrace
from shaketable.physics.space.ground import GroundAcceleration, RunSetup
from shaketable.physics.space.run import place, run, try_released
from shaketable.physics.space.telling import tell
from shaketable.physics.space.workspace import STATE, Floats, SolidRecords, Workspaces


@driver
def move_solid(
    shapes: SolidRecords,
    workspaces: Workspaces,
    ground: GroundAcceleration,
    stands: Floats,
    as_is: bool,
    trace: SolidTrace,
    found: FoundRecords,
) -> None:
    """Simulate a solid under one motion, once for each of its stands.

    Args:
        shapes: the solid, and without walls and straps if it has some: see `try_released`.
        workspaces, ground: what its runs write to, and the motion.
        stands: the numbers of a RunSetup for each run, (n, 5).
        as_is: whether it begins in the state that the workspace holds, which may be any above the
            support, rather than at rest on its base.
        trace: array for the history of the last run; may have no samples.
        found: what is told of each run, (n,): see `make_found`.
    """
    shape, work = shapes[0], workspaces[0]
    nothing = trace.impact_times[:0]
    untraced = SolidTrace(np.empty((0, STATE)), trace.rank[:0], trace.hold[:0], nothing)
    still = GroundAcceleration(np.zeros((1, 3)), ground.time_step)
    for k in range(stands.shape[0]):
        row = stands[k]
        stand = RunSetup(row[0], row[1], row[2], row[3], row[4])
        if not as_is:
            place(shape, work, stand.orientation)
        run(shape, work, ground, stand, trace)
        tell(shape, work, found[k])
        if shapes.shape[0] > 1:
            held = try_released(shapes[1], work, still, stand, untraced, found[k].ending)
            found[k].held_up = 1 if held else 0
