"""The one way into the compiled solids: every entry of its own would compile them all again."""

from __future__ import annotations

import numpy as np

from shaketable.compiled import driver
from shaketable.physics.space.in_plane import IN_PLANE
from shaketable.physics.space.landing import EDGE
from shaketable.physics.space.run import (
    SUMMARY,
    GroundAcceleration,
    RunSetup,
    SolidTrace,
    place,
    run,
    try_released,
)
from shaketable.physics.space.workspace import STATE, Floats, SolidRecords, Workspaces


@driver
def move_solid(
    shapes: SolidRecords,
    workspaces: Workspaces,
    ground: GroundAcceleration,
    stands: Floats,
    as_is: bool,
    trace: SolidTrace,
    found: Floats,
) -> None:
    """Simulate a solid under one motion, once for each of its stands.

    Args:
        shapes: the solid, and without walls and straps if it has some: see `try_released`.
        workspaces, ground: what its runs write to, and the motion.
        stands: the numbers of a RunSetup for each run, (n, 5).
        as_is: whether it begins in the state that the workspace holds, which may be any above the
            support, rather than at rest on its base.
        trace: array for the history of the last run; may have no samples.
        found: array for the numbers of a RunSummary of each run, (n, ...), and after these, where
            it has surroundings, whether they alone hold it up, then those of straps, an edge and a
            body in the plane.
    """
    shape, work = shapes[0], workspaces[0]
    nothing = trace.impact_times[:0]
    untraced = SolidTrace(np.empty((0, STATE)), trace.rank[:0], trace.hold[:0], nothing)
    still = GroundAcceleration(np.zeros((1, 3)), ground.time_step)
    released = np.zeros(SUMMARY + 1 + EDGE + IN_PLANE)
    for k in range(stands.shape[0]):
        row = stands[k]
        stand = RunSetup(row[0], row[1], row[2], row[3], row[4])
        if not as_is:
            place(shape, work, stand.orientation)
        run(shape, work, ground, stand, trace, found[k])
        if shapes.shape[0] > 1:
            held = try_released(shapes[1], work, still, stand, untraced, found[k, 0], released)
            found[k, SUMMARY] = 1.0 if held else 0.0
