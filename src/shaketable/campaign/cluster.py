"""A campaign's blocks on the workers of a dask.distributed.Client.

Workers read the plan from the store, once in each process, and write their blocks there: nothing
but numbers of blocks passes the scheduler. A worker that dies takes only the blocks that it had at
hand; they go to others. Where several workers died of them, they are tried once more in the end,
one by one, for Dask cannot tell which of them it was.
"""

from __future__ import annotations

import logging
import signal
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any

from shaketable.campaign import blocks as one
from shaketable.campaign.driver import BlockTally, Failures, note_failure, stopping
from shaketable.campaign.lock import require_held
from shaketable.campaign.objects import Objects
from shaketable.errors import InputError, SimulationError
from shaketable.extras import require

log = logging.getLogger(__name__)

RETRIES = 3  # of a block that raised something unforeseen
ASKED_EVERY = 5.0  # s: whether workers died
AT_ONCE = 4  # blocks that wait for each thread
TIMEOUT = 30.0  # s for a scheduler, and for a first worker, to answer


def connect(scheduler: str) -> Any:
    """A client of a scheduler, to be used in a `with` statement.

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


@contextmanager
def local(workers: int) -> Iterator[Any]:
    """A client of so many processes on this machine, of one thread each, that end with it.

    Raises:
        InputError: the extra is not installed.
        SimulationError: they do not start.
    """
    client_class = _client()
    from distributed import LocalCluster

    with ExitStack() as begun:
        try:
            with _without_ctrl_c():
                cluster: Any = LocalCluster(  # type: ignore[no-untyped-call]
                    n_workers=workers, threads_per_worker=1, dashboard_address=":0", memory_limit=0
                )
                begun.enter_context(_closed(cluster))
                client = begun.enter_context(_closed(client_class(cluster)))
        except (OSError, RuntimeError) as error:  # their waiting goes by the time of day
            raise SimulationError(
                f"--workers {workers}: the processes did not start ({error}); "
                "the same command goes on"
            ) from None
        yield client


@contextmanager
def _closed(begun: Any) -> Iterator[Any]:
    """What Dask began, ended whatever happens; a Ctrl-C meanwhile has nothing left to stop."""
    try:
        yield begun
    finally:
        with _without_ctrl_c():
            begun.close()


@contextmanager
def _without_ctrl_c() -> Iterator[None]:
    """What begins within never hears Ctrl-C, which a terminal sends to all; nor do we meanwhile.

    While its processes start and end Dask can neither be stopped by it nor tell of it.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _client() -> Any:
    require("cluster", "a cluster")
    from distributed import Client

    logging.getLogger("distributed").setLevel(logging.ERROR)  # it tells every step of every worker
    return Client


def run_on(
    client: Any,
    blocks: list[int],
    objects: Objects,
    done: Callable[[int], None],
    tally: BlockTally,
    lost: threading.Event,
) -> Failures:
    """Do blocks on a client's workers.

    Args:
        client: a dask.distributed.Client.
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
    begun = (objects.get_json(one.BEGUN) or {}).get("token", "")
    place = str(objects.folder.resolve()) if objects.folder is not None else objects.place
    # before any work: every worker sees the store, and has the same code and versions
    client.run(one.prepare, place, begun)
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    threads = sum(worker["nthreads"] for worker in workers)
    waiting = iter(blocks)
    retries: Counter[int] = Counter()
    aside: list[int] = []  # their workers died, of them or of others
    alone: set[int] = set()  # those of them that were tried again with nothing beside them
    pending: dict[str, tuple[Any, int]] = {}
    deaths = Deaths(client, tally)
    running: Any = as_completed([], loop=client.loop)  # type: ignore[no-untyped-call]

    def add(number: int) -> None:
        future = client.submit(one.do_block, place, begun, number, pure=False)
        pending[future.key] = (future, number)
        deaths.watch(future.key)
        running.add(future)

    def follow() -> None:
        number = next(waiting, None)
        if number is not None:
            add(number)
        elif not pending and aside:
            alone.add(aside[0])
            add(aside.pop(0))

    with stopping() as stopped:
        try:
            for _ in range((1 + AT_ONCE) * threads):
                follow()
            for future in running:
                require_held(lost, objects)
                deaths.ask()
                _, number = pending.pop(future.key)
                count, reason, error = _result_of(future, objects)
                if isinstance(error, KilledWorker) and number not in alone:
                    aside.append(number)
                elif error is not None and retries[number] < RETRIES and number not in alone:
                    retries[number] += 1
                    tally.again += 1
                    log.warning("block %d is tried again: %s", number, reason)
                    if not stopped.is_set():
                        add(number)
                        continue
                elif isinstance(error, OSError):
                    raise error
                elif reason:
                    note_failure(number, reason, failures, tally, objects)
                else:
                    tally.done += 1
                    done(count)
                if stopped.is_set():
                    raise KeyboardInterrupt
                follow()
            deaths.ask(at_once=True)
        finally:
            # what waits is not begun; what is at work ends its block and keeps it
            client.cancel([future for future, _ in pending.values()])
    return failures


def _result_of(future: Any, objects: Objects) -> tuple[int, str, BaseException | None]:
    """How much a block brought, why it failed, and what was raised if that was unforeseen.

    Raises:
        SimulationError: the worker may not work on this store, or the scheduler is gone.
    """
    if future.cancelled():
        raise SimulationError(f"{objects.place}: the scheduler is gone; the same command goes on")
    error = future.exception()  # waits, where the worker that held the result has died since
    if error is None:
        count, reason = future.result()
        return count, reason, None
    if isinstance(error, SimulationError):
        raise error
    return 0, f"{type(error).__name__}: {error}", error


class Deaths:
    """Tells and counts the blocks that dying workers had at hand; Dask gives them to others."""

    def __init__(self, client: Any, tally: BlockTally) -> None:
        """What happens on a client's workers from now on."""
        self._client = client
        self._tally = tally
        self._ours: set[str] = set()
        self._asked = time.monotonic()
        self._known = len(self._events())

    def watch(self, key: str) -> None:
        """Count a block, by the key of its future."""
        self._ours.add(key)

    def ask(self, at_once: bool = False) -> None:
        """Ask the scheduler, unless it was asked a moment ago."""
        now = time.monotonic()
        if now - self._asked < ASKED_EVERY and not at_once:
            return
        self._asked = now
        try:
            events = self._events()
        except OSError:  # the scheduler is gone, which the blocks will tell
            return
        new, self._known = events[self._known :], len(events)
        for _, told in new:
            if isinstance(told, dict) and told.get("action") == "remove-worker":
                left = sum(key in self._ours for key in told.get("processing-tasks", ()))
                if left:
                    self._tally.again += left
                    log.warning("a worker is gone; blocks that it had at hand: %d", left)

    def _events(self) -> Sequence[Any]:
        return self._client.get_events("all") or ()
