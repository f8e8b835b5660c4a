"""Simulations on a GPU: one thread a body, with the functions that the CPU runs.

Members of one motion lie side by side, so that the threads of a warp read the same samples. Nothing
here needs a GPU or its packages until a simulation is asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.batch import RESULT, Result, demands_of
from shaketable.errors import InputError
from shaketable.extras import require
from shaketable.physics.plane.forcing import Shaking
from shaketable.physics.plane.layout import length

THREADS = 128  # of a block


class PackedMotions(NamedTuple):
    """Motions one after another, arrays of numbers that a kernel can take."""

    a_x: NDArray[np.float64]
    g_effective: NDArray[np.float64]
    demands: NDArray[np.float64]
    samples: NDArray[np.int64]  # first sample of each motion, and the end of the last one
    stretches: NDArray[np.int64]  # likewise of its demands
    time_steps: NDArray[np.float64]


def ground_of(shakings: Sequence[Shaking]) -> PackedMotions:
    """The motions as a kernel takes them."""
    demands = [demands_of(shaking) for shaking in shakings]
    return PackedMotions(
        a_x=np.concatenate([shaking.a_x for shaking in shakings]),
        g_effective=np.concatenate([shaking.g_effective for shaking in shakings]),
        demands=np.concatenate(demands),
        samples=np.cumsum([0, *(shaking.a_x.size for shaking in shakings)]),
        stretches=np.cumsum([0, *(each.size for each in demands)]),
        time_steps=np.array([shaking.time_step for shaking in shakings]),
    )


def require_gpu() -> Any:
    """Numba's CUDA.

    Raises:
        InputError: its packages or the device are not there.
    """
    require("gpu", "device='cuda' (CUDA 13; for CUDA 12 pip install 'numba-cuda[cu12]')")
    from numba import cuda

    if not cuda.is_available():
        raise InputError(
            "device='cuda': no GPU is to be had; it takes one by NVIDIA and its driver, which "
            "nvidia-smi shows; without one leave the device out"
        )
    return cuda


def run_on_gpu(
    kernel: str,
    shakings: Sequence[Shaking],
    table: Sequence[NDArray[np.float64]],
    body: NDArray[np.int64],
    motion: NDArray[np.int64],
    polarity: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Simulate members, each from rest.

    Args:
        kernel: of `cuda_kernels`, by its name.
        shakings: the motions.
        table: blocks, bodies and corners of a Batch.
        body, motion: of each member, (member,); those of one motion best side by side.
        polarity: of each member.

    Returns:
        The numbers of a Result of each member.
    """
    cuda = require_gpu()
    from shaketable.engine import cuda_kernels

    results = np.zeros((body.size, length(Result)))
    results[:, RESULT.polarity] = polarity
    results[:, RESULT.overturning_time] = np.nan
    there = cuda.to_device(results)
    grid = (body.size + THREADS - 1) // THREADS
    getattr(cuda_kernels, kernel)[grid, THREADS](
        *(cuda.to_device(each) for each in ground_of(shakings)),
        *(cuda.to_device(_rows(each)) for each in table),
        cuda.to_device(body),
        cuda.to_device(motion),
        there,
        cuda.to_device(np.zeros(1))[:0],
        cuda.to_device(np.zeros(1, np.int8))[:0],
    )
    there.copy_to_host(results)
    return results


def _rows(part: NDArray[np.float64]) -> NDArray[np.float64]:
    """A part of a table as a kernel takes it; a device has no arrays of nothing."""
    return np.ascontiguousarray(part) if part.size else np.zeros((1, 1))
