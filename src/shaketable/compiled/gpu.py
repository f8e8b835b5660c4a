"""How the kernels of a GPU are compiled; only what holds such kernels imports it."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Callable
from typing import Any

from numba import cuda

log = logging.getLogger(__name__)

device_cache_of: Any
try:
    from shaketable.compiled.gpu_cache import device_cache_of
except ImportError as error:
    log.info("%s: each process compiles the kernels of a GPU anew", error)
    device_cache_of = None

# Who simulates a few bodies knows that they leave most of a device idle.
warnings.filterwarnings("ignore", ".*Grid size .* GPU under-utilization")


def gpu_kernel(function: Callable[..., None]) -> Any:
    """A kernel that is launched on a device, its machine code kept on disk.

    Fast mathematics is off: it would take shortcuts where a body is about to fall. Multiplications
    and additions are still fused, which rounds once where a CPU rounds twice: last digits differ.
    """
    compiled: Any = cuda.jit(fastmath=False)(function)
    if device_cache_of is not None:
        compiled._cache = device_cache_of(function) or compiled._cache
    return compiled
