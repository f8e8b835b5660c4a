"""The blocks of a campaign in this process, those that fail, and how a run is stopped."""

from __future__ import annotations

import logging
import signal
import threading
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

from shaketable.campaign import arrays
from shaketable.campaign.fingerprint import key_of
from shaketable.campaign.lock import require_held
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import Plan
from shaketable.campaign.tally import BlockTally
from shaketable.campaign.work import (
    FAILED,
    Result,
    failed_name,
    simulate_block,
    write_block,
)
from shaketable.errors import InputError, SimulationError, named

log = logging.getLogger(__name__)

MOST_NAMED = 3

#: Why blocks failed, by their numbers.
Failures = dict[int, str]


def run_here(
    plan: Plan,
    made: Mapping[str, Any],
    blocks: list[int],
    objects: Objects,
    threads: int | None,
    done: Callable[[int], None],
    tally: BlockTally,
    lost: threading.Event,
) -> Failures:
    """Do blocks in this process, on all cores; one is written while the next is simulated."""
    failures: Failures = {}
    kept = arrays.opened(plan, objects)

    def write(result: Result) -> None:
        write_block(plan, result, key_of(result.block, made), kept, objects)

    with ThreadPoolExecutor(1) as writer, stopping() as stopped:
        pending: Future[None] | None = None
        for number in blocks:
            require_held(lost, objects)
            if stopped.is_set():
                break
            try:
                result = simulate_block(plan, plan.block(number), threads, done)
            except InputError as error:
                note_failure(number, str(error), failures, tally, objects)
                continue
            if pending is not None:
                pending.result()
                tally.done += 1
            pending = writer.submit(write, result)
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
        f"others are done: {named(reasons, MOST_NAMED)}; the same command tries them again, which "
        "helps only if the reason is gone: else leave out what they name, with a new store"
    )


def forget_failures(objects: Objects) -> None:
    """Failures of earlier runs: what is missing is tried again."""
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
