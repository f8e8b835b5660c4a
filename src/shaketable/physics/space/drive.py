"""The one way into the compiled solids: every entry of its own would compile them all again."""

from __future__ import annotations

from shaketable.compiled import driver
from shaketable.physics.space.run import GroundAcceleration, RunSetup, SolidTrace, place, run
from shaketable.physics.space.workspace import Floats, SolidRecords, Workspaces


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
        shapes, workspaces, ground: the solid, what its runs write to, and the motion.
        stands: the numbers of a RunSetup for each run, (n, 5).
        as_is: whether it begins in the state that the workspace holds, which may be any above the
            support, rather than at rest on its base.
        trace: array for the history of the last run; may have no samples.
        found: array for the numbers of a RunSummary of each run, (n, ...).
    """
    shape, work = shapes[0], workspaces[0]
    for k in range(stands.shape[0]):
        row = stands[k]
        stand = RunSetup(row[0], row[1], row[2], row[3], row[4])
        if not as_is:
            place(shape, work, stand.orientation)
        run(shape, work, ground, stand, trace, found[k])
