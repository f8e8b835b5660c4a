"""The queue before the workers."""

from __future__ import annotations

import asyncio
import os
import signal
import time
from collections.abc import Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from shaketable.web import work_queue
from shaketable.web.budget import TooLongError, check
from shaketable.web.work_queue import Asker, BusyError, WorkerLostError, WorkQueue
from shaketable.web.workers import READY


@pytest.fixture
def queue(monkeypatch: pytest.MonkeyPatch) -> Iterator[WorkQueue]:
    """One worker that needs no warming."""
    monkeypatch.setattr(work_queue, "warm", keep_house)
    made = WorkQueue(1)
    yield made
    made.close()


def run(asked: Coroutine[Any, Any, None]) -> None:
    """In a thread of its own: a browser's driver may have left a loop in this one."""
    with ThreadPoolExecutor(1) as thread:
        thread.submit(asyncio.run, asked).result()


def keep_house(scratch: str) -> None:
    """The folder of a worker, as `warm` makes it."""
    own = Path(scratch) / str(os.getpid())
    own.mkdir()
    (own / READY).touch()


def process() -> int:
    return os.getpid()


def leave_a_file(scratch: str) -> None:
    (Path(scratch) / str(os.getpid()) / "left").touch()
    time.sleep(60.0)


def double(number: int) -> int:
    return 2 * number


def refuse() -> None:
    raise ValueError("no")


def sleep_for(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def wait_for(mark: str) -> str:
    while not Path(mark).exists():
        time.sleep(0.02)
    return mark


def die_once(mark: str) -> str:
    """The worker dies at the first call, and answers at the second."""
    path = Path(mark)
    if not path.exists():
        path.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return "alive"


def die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def test_answers_and_errors_come_back(queue: WorkQueue) -> None:
    async def ask() -> None:
        assert await queue.ask(Asker("one"), 10.0, double, 4) == 8
        with pytest.raises(ValueError, match="no"):
            await queue.ask(Asker("one"), 10.0, refuse)
        assert await queue.ask(Asker("one"), 10.0, double, 5) == 10

    run(ask())


def test_visitors_take_turns(queue: WorkQueue) -> None:
    """Somebody who asks once does not wait for all that another has asked before."""
    order: list[str] = []

    async def told(visitor: str) -> None:
        await queue.ask(Asker(visitor), 10.0, sleep_for, 0.02)
        order.append(visitor)

    async def ask() -> None:
        many = [asyncio.create_task(told("many")) for _ in range(6)]
        await asyncio.sleep(0)
        await asyncio.gather(told("once"), *many)

    run(ask())
    assert order.index("once") <= 2


def test_words_of_one_address_share_its_turns(
    queue: WorkQueue, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program that takes a new word for each question waits like one with one word."""
    order: list[str] = []

    async def told(asker: Asker) -> None:
        await queue.ask(asker, 10.0, sleep_for, 0.02)
        order.append(asker.address)

    async def ask() -> None:
        many = [asyncio.create_task(told(Asker("many", str(k)))) for k in range(12)]
        await asyncio.sleep(0)
        await asyncio.gather(told(Asker("once")), *many)

    run(ask())
    assert order.index("once") <= 2
    monkeypatch.setattr(work_queue, "MOST_ADDRESS", 3)

    async def fill() -> None:
        asked = [
            asyncio.create_task(queue.ask(Asker("many", str(k)), 10.0, double, k)) for k in range(4)
        ]
        await asyncio.sleep(0)
        with pytest.raises(BusyError):
            await queue.ask(Asker("many", "new"), 10.0, double, 9)
        assert await queue.ask(Asker("once"), 10.0, double, 7) == 14
        assert await asyncio.gather(*asked) == [0, 2, 4, 6]

    run(fill())


def test_a_full_queue_says_when_to_come_again(
    queue: WorkQueue, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(work_queue, "MOST_EACH", 2)

    async def ask() -> None:
        asked = [asyncio.create_task(queue.ask(Asker("one"), 10.0, double, k)) for k in range(3)]
        await asyncio.sleep(0)
        with pytest.raises(BusyError, match="ask again in") as told:
            await queue.ask(Asker("one"), 10.0, double, 9)
        assert told.value.wait >= 1
        assert await queue.ask(Asker("other"), 10.0, double, 7) == 14
        assert await asyncio.gather(*asked) == [0, 2, 4]

    run(ask())


def test_what_takes_too_long_is_ended_and_the_next_is_answered(queue: WorkQueue) -> None:
    async def ask() -> None:
        with pytest.raises(TooLongError, match=r"longer than 0\.9 s"):
            await queue.ask(Asker("one"), 0.3, sleep_for, 60.0)
        assert await queue.ask(Asker("one"), 10.0, double, 1) == 2

    run(ask())


def test_a_worker_that_dies_is_replaced(queue: WorkQueue, tmp_path: Path) -> None:
    async def ask() -> None:
        assert await queue.ask(Asker("one"), 20.0, die_once, str(tmp_path / "mark")) == "alive"
        with pytest.raises(WorkerLostError, match="twice"):
            await queue.ask(Asker("one"), 20.0, die)
        assert await queue.ask(Asker("one"), 20.0, double, 3) == 6

    run(ask())


def test_an_idle_worker_that_dies_is_replaced(queue: WorkQueue) -> None:
    async def ask() -> None:
        os.kill(await queue.ask(Asker("one"), 10.0, process), signal.SIGKILL)
        await asyncio.sleep(1.0)
        assert await queue.ask(Asker("one"), 10.0, double, 3) == 6
        assert await queue.ask(Asker("two"), 10.0, double, 4) == 8

    run(ask())


def test_what_an_ended_worker_has_written_is_removed(queue: WorkQueue) -> None:
    async def ask() -> None:
        with pytest.raises(TooLongError):
            await queue.ask(Asker("one"), 0.5, leave_a_file, queue._scratch.name)

    run(ask())
    assert not list(Path(queue._scratch.name).rglob("left"))


def test_who_leaves_is_not_served(queue: WorkQueue) -> None:
    async def ask() -> None:
        first = asyncio.create_task(queue.ask(Asker("one"), 10.0, sleep_for, 0.2))
        await asyncio.sleep(0)
        gone = asyncio.create_task(queue.ask(Asker("two"), 10.0, sleep_for, 60.0))
        await asyncio.sleep(0)
        gone.cancel()
        assert await first == 0.2
        assert await queue.ask(Asker("three"), 10.0, double, 2) == 4

    run(ask())


def compute(seconds: float) -> float:
    """Seconds of the processor, told every few milliseconds as simulations are."""
    begun = time.process_time()
    while (spent := time.process_time() - begun) < seconds:
        check()
    return spent


def test_a_question_ends_with_a_word_after_its_seconds(queue: WorkQueue) -> None:
    """The worker lives on, and is free at once."""

    async def ask() -> None:
        worker = await queue.ask(Asker("one"), 10.0, process)
        begun = time.monotonic()
        with pytest.raises(TooLongError, match=r"more than 0\.2 s of computing"):
            await queue.ask(Asker("one"), 0.2, compute, 60.0)
        assert time.monotonic() - begun < 0.2 * work_queue.PATIENCE + 5.0  # far below a minute
        assert await queue.ask(Asker("one"), 0.2, compute, 0.1) >= 0.1  # each has its own
        assert await queue.ask(Asker("one"), 10.0, process) == worker

    run(ask())


def test_what_nobody_waits_for_ends(queue: WorkQueue) -> None:
    """Within seconds, though it would compute for a minute, and without a new worker."""

    async def ask() -> None:
        worker = await queue.ask(Asker("one"), 10.0, process)
        gone = asyncio.create_task(queue.ask(Asker("one"), 60.0, compute, 60.0))
        await asyncio.sleep(0.3)
        gone.cancel()
        begun = time.monotonic()
        assert await queue.ask(Asker("two"), 10.0, process) == worker
        assert time.monotonic() - begun < 10.0  # a shared machine may be slow; not a minute
        assert not list(Path(queue._marks.name).iterdir())

    run(ask())


def test_long_questions_leave_a_worker_to_short_ones(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Were both workers given to the long ones, the short ones would not be answered in time."""
    monkeypatch.setattr(work_queue, "warm", keep_house)
    queue = WorkQueue(2)
    long = 2.0 * work_queue.SHAKE_SECONDS
    mark = tmp_path / "short ones are answered"

    async def ask() -> None:
        slow = [
            asyncio.create_task(queue.ask(Asker(f"v{k}"), long, wait_for, str(mark)))
            for k in range(4)
        ]
        await asyncio.sleep(0)
        short = [queue.ask(Asker("short"), 10.0, double, k) for k in range(5)]
        assert await asyncio.wait_for(asyncio.gather(*short), 60.0) == [0, 2, 4, 6, 8]
        assert not any(each.done() for each in slow)
        mark.touch()
        assert await asyncio.gather(*slow) == [str(mark)] * 4

    try:
        run(ask())
    finally:
        queue.close()


def begin_and_sleep(mark: str) -> None:
    Path(mark).touch()
    time.sleep(60.0)


def test_a_stopped_worker_holds_no_question(
    queue: WorkQueue, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is replaced, whether it had begun to answer or not; SIGTERM cannot end it."""
    monkeypatch.setattr(work_queue, "OVERDUE", 3.0)

    async def ask() -> None:
        worker = await queue.ask(Asker("one"), 10.0, process)
        os.kill(worker, signal.SIGSTOP)
        fresh = await queue.ask(Asker("one"), 10.0, process)
        assert fresh != worker
        asked = asyncio.create_task(
            queue.ask(Asker("one"), 1.0, begin_and_sleep, str(tmp_path / "mark"))
        )
        while not (tmp_path / "mark").exists():
            await asyncio.sleep(0.05)
        os.kill(fresh, signal.SIGSTOP)
        with pytest.raises(TooLongError):  # it had begun: that is not asked again
            await asked
        assert await queue.ask(Asker("one"), 10.0, double, 3) == 6

    run(ask())
