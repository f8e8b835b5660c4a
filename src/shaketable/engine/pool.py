"""Independent pieces of work on all cores, with progress and a clean stop on Ctrl-C."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar
from itertools import islice
from typing import TypeVar

WAITING = 2  # pieces that wait for each thread: however many there are, few lie in memory

T = TypeVar("T")


_most: ContextVar[int | None] = ContextVar("most cores", default=None)


@contextmanager
def at_most(cores: int) -> Iterator[None]:
    """Limit the default number of threads of calls that are made inside this context."""
    before = _most.set(cores)
    try:
        yield
    finally:
        _most.reset(before)


def available_cores() -> int:
    """Cores that this process may use, or that `at_most` leaves."""
    most = _most.get()
    if most is not None:
        return most
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run_all(
    work: Iterable[Callable[[], T]], threads: int | None, done: Callable[[T], object]
) -> None:
    """Call everything in `work`, in order, on `threads` threads; compiled code releases the GIL.

    Give the longest pieces first. `done` is told what each call returned, in this thread. On an
    exception, KeyboardInterrupt included, calls not yet begun are dropped, running ones awaited.
    """
    threads = threads or available_cores()
    pieces = iter(work)
    with ThreadPoolExecutor(threads) as executor:
        pending = {executor.submit(piece) for piece in islice(pieces, (1 + WAITING) * threads)}
        try:
            while pending:
                finished, pending = wait(pending, return_when=FIRST_COMPLETED)
                pending |= {executor.submit(piece) for piece in islice(pieces, len(finished))}
                for future in finished:
                    done(future.result())
        except BaseException:
            executor.shutdown(wait=True, cancel_futures=True)
            raise
