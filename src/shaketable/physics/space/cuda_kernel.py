"""The kernel that runs solids on a GPU; only `engine.cuda_solids` imports it.

It has a file of its own, as it compiles for minutes.
"""

from __future__ import annotations

from typing import Any

from numba import cuda, from_dtype

from shaketable.compiled.gpu import gpu_kernel
from shaketable.physics.space.run import GroundAcceleration, RunSetup, SolidTrace, place, run
from shaketable.physics.space.workspace import MOST, POINT, WORKSPACE

ROOM_TYPE = from_dtype(WORKSPACE)


def move_solid_member(
    shapes: Any, points: Any, acceleration: Any, samples: Any, time_steps: Any, solid: Any,
    motion: Any, stands: Any, no_states: Any, no_codes: Any, found: Any,
) -> None:  # fmt: skip
    """Simulate the member whose number is this thread's; arguments as in `run_solids_on_gpu`.

    Its workspace lies in the thread's own memory, which a device lays out so that the same number
    of all threads of a warp is read at once.
    """
    workspaces = cuda.local.array(1, ROOM_TYPE)
    n = cuda.grid(1)
    if n >= found.shape[0]:
        return
    shape, work = shapes[solid[n]], workspaces[0]
    for k in range(MOST):
        for j in range(POINT):
            work.points[k, j] = points[solid[n], k, j]
    first, end = samples[motion[n]], samples[motion[n] + 1]
    ground = GroundAcceleration(acceleration[first:end], time_steps[motion[n]])
    row = stands[n]
    stand = RunSetup(row[0], row[1], row[2], row[3], row[4])
    place(shape, work, stand.orientation)
    run(shape, work, ground, stand, SolidTrace(no_states, no_codes, no_codes), found[n])


move_solid_members = gpu_kernel(move_solid_member)
