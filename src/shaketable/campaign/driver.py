"""The blocks of a campaign in this process, those that fail, and how a run is stopped."""

from __future__ import annotations

import logging
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass

from shaketable.campaign.blocks import Site, do_timed
from shaketable.campaign.lock import require_held
from shaketable.campaign.notes import FAILED, failed_name
from shaketable.campaign.objects import Objects
from shaketable.engine.pool import at_most, available_cores
from shaketable.errors import InputError, SimulationError, named

log = logging.getLogger(__name__)

MOST_NAMED = 3

#: Why blocks failed, by their numbers.
Failures = dict[int, str]


def run_here(
    site: Site,
    blocks: list[int],
    threads: int | None,
    done: Callable[[int], None],
    tally: BlockTally,
    lost: threading.Event,
) -> Failures:
    """Do blocks on `threads` cores of this process, all if None.

    A finished block is written while the next one runs.
    """
    failures: Failures = {}
    cores = threads or available_cores()
    with ThreadPoolExecutor(1) as writer, stopping() as stopped, at_most(cores):
        pending: Future[None] | None = None
        for number in blocks:
            require_held(lost, site.objects)
            if stopped.is_set():
                break
            try:
                result, seconds = do_timed(site.work, number, done)
            except InputError as error:
                note_failure(number, str(error), failures, tally, site.objects)
                continue
            if pending is not None:
                pending.result()
                tally.done += 1
            pending = writer.submit(site.write, number, result, seconds)
        if pending is not None:
            pending.result()
            tally.done += 1
        if stopped.is_set():
            raise KeyboardInterrupt
    return failures


def note_failure(
    number: int, reason: str, failures: Failures, tally: BlockTally, objects: Objects
) -> None:
    """Keep why a block failed; the others go on."""
    log.warning("block %d failed: %s", number, reason)
    failures[number] = reason
    tally.failed += 1
    objects.put_json(failed_name(number), {"reason": reason})


def require_all_done(failures: Failures, blocks: int, objects: Objects) -> None:
    """SimulationError that names why some of the blocks failed, if any did."""
    if not failures:
        return
    reasons = list(dict.fromkeys(failures.values()))
    raise SimulationError(
        f"{objects.place}: {len(failures)} of {blocks} blocks failed, all "
        f"others are done: {named(reasons, MOST_NAMED)}; remove the cause and run the same command "
        "again, or leave out the bodies that are named and use a new store"
    )


def forget_failures(objects: Objects) -> None:
    """Delete the notes of blocks that failed in earlier runs: they are tried again."""
    objects.remove(FAILED)


@contextmanager
def stopping() -> Iterator[threading.Event]:
    """An event that the first Ctrl-C sets; the second one interrupts at once."""
    stopped = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield stopped
        return

    def on_interrupt(number: int, frame: object) -> None:
        if stopped.is_set():
            raise KeyboardInterrupt
        stopped.set()
        log.warning("stops at the end of this block; Ctrl-C again stops at once")

    before = signal.signal(signal.SIGINT, on_interrupt)
    try:
        yield stopped
    finally:
        signal.signal(signal.SIGINT, before)


@dataclass
class BlockTally:
    """Counts of blocks; it grows while the run goes on."""

    blocks: int
    done: int = 0
    failed: int = 0
    again: int = 0  # tried again, as their worker died or raised something unforeseen

    def __str__(self) -> str:
        faults = ((self.failed, "failed"), (self.again, "tried again"))
        told = [f"{count:,} {word}" for count, word in faults if count]
        return ", ".join([f"{self.done:,}/{self.blocks:,} blocks", *told])
