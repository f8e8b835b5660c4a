"""A campaign's blocks on the workers of a dask.distributed.Client.

Workers read the plan from the store, once in each process, and write their blocks there: nothing
but numbers of blocks passes the scheduler. A worker that dies takes only the blocks that it was at;
they go to others.
"""

from __future__ import annotations

import logging
import threading
from collections import Counter
from collections.abc import Callable
from itertools import islice
from typing import Any, NamedTuple

from shaketable.campaign.driver import Failures, note_failure, stopping
from shaketable.campaign.lock import require_held
from shaketable.campaign.objects import Objects
from shaketable.campaign.tally import Tally
from shaketable.campaign.work import BEGUN
from shaketable.errors import InputError, SimulationError

log = logging.getLogger(__name__)

RETRIES = 3  # of a block that raised something unforeseen
AT_ONCE = 4  # blocks that wait for each thread
TIMEOUT = 30.0  # s for a scheduler, and for a first worker, to answer


class Task(NamedTuple):
    """What workers do; the functions take the store's place and the token of its beginning."""

    prepare: Callable[[str, str], object]  # reads the plan, so that what is wrong is told at once
    do: Callable[[str, str, int], tuple[int, str]]  # how much a block brought, and why it failed


def connect(scheduler: str) -> Any:
    """A client of a scheduler.

    Raises:
        InputError: it does not answer within TIMEOUT, or the extra is not installed.
    """
    client_class = _client()
    try:
        client = client_class(scheduler, timeout=TIMEOUT)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(
            f"--scheduler {scheduler}: no answer within {TIMEOUT:.0f} s ({error})"
        ) from None
    return client


def local(workers: int) -> Any:
    """A client of so many processes on this machine, of one thread each."""
    client_class = _client()
    return client_class(
        n_workers=workers,
        threads_per_worker=1,
        dashboard_address=":0",
        memory_limit=0,
    )


def _client() -> Any:
    try:
        from distributed import Client
    except ImportError as error:
        raise InputError(
            f"clusters need the package {error.name}: pip install 'shaketable[cluster]'"
        ) from None
    logging.getLogger("distributed").setLevel(logging.ERROR)  # it tells every step of every worker
    return Client


def run_on(
    client: Any,
    task: Task,
    blocks: list[int],
    objects: Objects,
    done: Callable[[int], None],
    tally: Tally,
    lost: threading.Event,
) -> Failures:
    """Do blocks on a client's workers.

    Args:
        client: a dask.distributed.Client.
        task: what to do on a worker.
        blocks: their numbers.
        objects: the store.
        done: is told how much each block brought.
        tally: is kept.
        lost: set when the store's lock is lost.

    Raises:
        InputError: there is no worker, or the store cannot be reached from workers.
        SimulationError: a worker has another version of what decides the results.
    """
    from distributed import KilledWorker, as_completed

    failures: Failures = {}
    if not blocks:
        return failures
    if objects.place.startswith("memory://"):
        raise InputError(f"{objects.place}: is in the memory of this process, where no worker is")
    try:
        client.wait_for_workers(1, timeout=TIMEOUT)
    except TimeoutError:
        raise InputError(f"the scheduler has no worker after {TIMEOUT:.0f} s") from None
    begun = (objects.get_json(BEGUN) or {}).get("token", "")
    place = str(objects.folder.resolve()) if objects.folder is not None else objects.place
    # before any work: every worker sees the store, and has the same code and versions
    client.run(task.prepare, place, begun)
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    threads = sum(worker["nthreads"] for worker in workers)
    waiting = iter(blocks)
    retries: Counter[int] = Counter()
    pending: dict[str, tuple[Any, int]] = {}
    running: Any = as_completed([])  # type: ignore[no-untyped-call]

    def add(number: int) -> None:
        future = client.submit(task.do, place, begun, number, pure=False)
        pending[future.key] = (future, number)
        running.add(future)

    def on_event(event: tuple[float, Any]) -> None:
        """A worker that dies leaves the blocks that it was at, or was to do next, to others."""
        told = event[1]
        if isinstance(told, dict) and told.get("action") == "remove-worker":
            left = sum(key in pending for key in told.get("processing-tasks", ()))
            if left:
                tally.again += left
                log.warning("a worker is gone; others take up its %d blocks", left)

    client.subscribe_topic("all", on_event)
    with stopping() as stopped:
        try:
            for number in islice(waiting, (1 + AT_ONCE) * threads):
                add(number)
            for future in running:
                require_held(lost, objects)
                _, number = pending.pop(future.key)
                if future.status == "finished":
                    simulations, reason = future.result()
                    tally.done += not reason
                    done(simulations)
                else:
                    error = future.exception()
                    reason = f"{type(error).__name__}: {error}"
                    if isinstance(error, SimulationError):
                        raise error
                    if retries[number] < RETRIES and not isinstance(error, KilledWorker):
                        retries[number] += 1
                        tally.again += 1
                        log.warning("block %d is tried again: %s", number, reason)
                        add(number)
                        continue
                    if isinstance(error, OSError):
                        raise error
                if reason:
                    note_failure(number, reason, failures, tally, objects)
                if stopped.is_set():
                    raise KeyboardInterrupt
                following = next(waiting, None)
                if following is not None:
                    add(following)
        finally:
            # what waits is not begun; what is at work ends its block and keeps it
            client.cancel([future for future, _ in pending.values()])
            client.unsubscribe_topic("all")
    return failures
