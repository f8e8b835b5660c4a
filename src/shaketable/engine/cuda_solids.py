"""Solids on a GPU: one thread a simulation, with the functions that the CPU runs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.cuda import require_gpu
from shaketable.physics.space.run import GroundAcceleration, RunSummary
from shaketable.physics.space.workspace import STATE, SolidRecords, Workspaces

#: Of a block: a warp, so that one which has ended makes room for the next; runs last so differently
#: that blocks of four take a tenth to a third longer on an H100.
THREADS = 32


def run_solids_on_gpu(
    solids: Sequence[tuple[SolidRecords, Workspaces]],
    grounds: Sequence[GroundAcceleration],
    solid: NDArray[np.int64],
    motion: NDArray[np.int64],
    stands: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Simulate members, each from rest on its base.

    Args:
        solids: their numbers, and the workspace that holds their points.
        grounds: the motions.
        solid, motion: of each member, (member,); alike ones best side by side.
        stands: the numbers of a RunSetup for each, (member, 5).

    Returns:
        The numbers of a RunSummary for each member.

    Raises:
        InputError: there is no GPU.
    """
    cuda = require_gpu()
    from shaketable.physics.space import cuda_kernel

    found = np.zeros((solid.size, len(RunSummary._fields)))
    there = cuda.to_device(found)
    grid = (solid.size + THREADS - 1) // THREADS
    cuda_kernel.move_solid_members[grid, THREADS](
        cuda.to_device(np.concatenate([shapes for shapes, _ in solids])),
        cuda.to_device(np.array([workspaces[0]["points"] for _, workspaces in solids])),
        cuda.to_device(np.concatenate([ground.acceleration for ground in grounds])),
        cuda.to_device(np.cumsum([0, *(len(ground.acceleration) for ground in grounds)])),
        cuda.to_device(np.array([ground.time_step for ground in grounds])),
        cuda.to_device(solid),
        cuda.to_device(motion),
        cuda.to_device(stands),
        cuda.to_device(np.zeros((1, STATE)))[:0],
        cuda.to_device(np.zeros(1, np.int8))[:0],
        there,
    )
    there.copy_to_host(found)
    return found
