"""Kernels of a GPU; only `engine.cuda` imports them, once it knows that there is one."""

from __future__ import annotations

from typing import Any

from numba import cuda, float64

from shaketable.compiled.gpu import gpu_kernel
from shaketable.engine.batch import Batch
from shaketable.engine.general_lane import move_lane
from shaketable.engine.general_many import no_scratch
from shaketable.engine.rocking_lane import rock_lane
from shaketable.physics.plane.forcing import Shaking
from shaketable.physics.plane.phase_series import ROWS, TERMS


def rock_member(
    a_x: Any, g_effective: Any, demands: Any, samples: Any, stretches: Any, time_steps: Any,
    blocks: Any, bodies: Any, corners: Any, body: Any, motion: Any, results: Any, no_times: Any,
    no_codes: Any,
) -> None:  # fmt: skip
    """Simulate the member whose number is this thread's; arguments as in `run_on_gpu`."""
    n = cuda.grid(1)
    if n >= results.shape[0]:
        return
    m, b = motion[n], body[n]
    first, end = samples[m], samples[m + 1]
    shaking = Shaking(a_x[first:end], g_effective[first:end], time_steps[m])
    batch = Batch(blocks[b : b + 1], bodies, corners, results[n : n + 1])
    rock_lane(batch, 0, shaking, demands[stretches[m] : stretches[m + 1]], no_times)


def move_member(
    a_x: Any, g_effective: Any, demands: Any, samples: Any, stretches: Any, time_steps: Any,
    blocks: Any, bodies: Any, corners: Any, body: Any, motion: Any, results: Any, no_times: Any,
    no_codes: Any,
) -> None:  # fmt: skip
    """The same with the general model; the series of its phases lie in the thread's own memory."""
    table = cuda.local.array((ROWS, TERMS), float64)
    n = cuda.grid(1)
    if n >= results.shape[0]:
        return
    m, b = motion[n], body[n]
    first, end = samples[m], samples[m + 1]
    shaking = Shaking(a_x[first:end], g_effective[first:end], time_steps[m])
    batch = Batch(
        blocks[b : b + 1], bodies[b : b + 1], corners[b : b + 1], results[n : n + 1]
    )  # fmt: skip
    scratch = no_scratch(no_times, no_codes, table)
    move_lane(batch, 0, shaking, demands[stretches[m] : stretches[m + 1]], scratch)


rock_members = gpu_kernel(rock_member)
move_members = gpu_kernel(move_member)
