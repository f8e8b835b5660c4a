"""Independent pieces of work on all cores, with progress and a clean stop on Ctrl-C."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait


def available_cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run_all(
    work: Sequence[Callable[[], int]], threads: int | None, done: Callable[[int], None]
) -> None:
    """Call everything in `work`, in order, on `threads` threads; compiled code releases the GIL.

    Give the longest pieces first. `done` is told what each call returned, in this thread. On an
    exception, KeyboardInterrupt included, calls not yet begun are dropped, running ones awaited.
    """
    with ThreadPoolExecutor(threads or available_cores()) as executor:
        pending = {executor.submit(piece) for piece in work}
        try:
            while pending:
                finished, pending = wait(pending, return_when=FIRST_COMPLETED)
                for future in finished:
                    done(future.result())
        except BaseException:
            executor.shutdown(wait=True, cancel_futures=True)
            raise
