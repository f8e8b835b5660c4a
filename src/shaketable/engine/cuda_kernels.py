"""Kernels of a GPU; only `engine.cuda` imports them, once it knows that there is one.

Fast mathematics is off: it would take shortcuts where a body is about to fall.
"""

from __future__ import annotations

from typing import Any

from numba import cuda

from shaketable.engine.lane_loop import Batch
from shaketable.engine.rocking_lane import rock_lane
from shaketable.kernels.forcing import Shaking


def rock_member(
    push: Any, gravity: Any, demands: Any, samples: Any, stretches: Any, time_steps: Any,
    blocks: Any, body: Any, motion: Any, results: Any, nothing: Any, no_times: Any,
) -> None:  # fmt: skip
    """Simulate the member whose number is this thread's; arguments as in `rock_on_gpu`."""
    n = cuda.grid(1)
    if n >= results.shape[0]:
        return
    m, b = motion[n], body[n]
    first, end = samples[m], samples[m + 1]
    shaking = Shaking(push[first:end], gravity[first:end], time_steps[m])
    batch = Batch(blocks[b : b + 1], nothing, nothing, results[n : n + 1])
    rock_lane(batch, 0, shaking, demands[stretches[m] : stretches[m + 1]], no_times)


rock_members = cuda.jit(fastmath=False)(rock_member)
