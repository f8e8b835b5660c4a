"""Questions that wait in a fair queue until a worker process is free.

Simulations never block the event loop. Addresses take turns; within one address, visitors (by the
header X-Visitor) take turns: somebody who asks a hundred times, under a hundred names, does not
keep the others waiting. With two or more workers, one is kept for short questions. A question whose
worker dies is asked once more. A question that exceeds its processor time raises TooLongError; one
for which nobody waits any longer is stopped. A worker that does not stop by itself is ended.
"""

from __future__ import annotations

import asyncio
import logging
import os
import shutil
import tempfile
from collections import deque
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, CancelledError, Future
from dataclasses import dataclass
from functools import partial
from itertools import count
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple, ParamSpec, TypeVar

from pebble import ProcessExpired, ProcessPool

from shaketable.web.budget import TooLongError, answer
from shaketable.web.limits import (
    MOST_ADDRESS,
    MOST_EACH,
    MOST_WAITING,
    SHAKE_SECONDS,
)
from shaketable.web.workers import READY, warm

log = logging.getLogger(__name__)

P = ParamSpec("P")
R = TypeVar("R")

TRIES = 2  # of a question whose worker dies
FULL = "the disk of the server is full; try again later"
LONGEST_WAIT = 30  # s, that a visitor is asked to wait
FIRST_ANSWER = 0.3  # s: how long a question takes, until one has been answered
#: Limit of a question on the clock, as a multiple of its limit of processor time.
PATIENCE = 3.0
#: All workers are replaced if one has not ended so long after its limit [s], or if all are ready
#: and a question has not been started within this time.
OVERDUE = 10.0


class Asker(NamedTuple):
    """Who asks: an address, and a word of the visitor's own."""

    address: str
    word: str = ""


class BusyError(Exception):
    """No more questions are taken just now.

    Attributes:
        wait: seconds after which to ask again.
    """

    def __init__(self, wait: int) -> None:
        super().__init__(f"too many questions wait; ask again in {wait} s")
        self.wait = wait


class WorkerLostError(Exception):
    """The worker of a question died, and so did the one that was asked after it."""


@dataclass(eq=False)
class _Turn:
    """A question that waits, or is being answered."""

    ask: Callable[[], Future[Any]]
    answer: asyncio.Future[Any]
    seconds: float  # of a processor that it may take
    left: Path  # a file that is there once nobody waits
    work: Future[Any] | None = None  # once it is given to the workers
    overdue: asyncio.TimerHandle | None = None
    lost: bool = False  # its worker was replaced

    @property
    def is_long(self) -> bool:
        return self.seconds > SHAKE_SECONDS


class WorkQueue:
    """Workers and the questions that wait for them.

    Args:
        workers: how many processes.
    """

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self._scratch = tempfile.TemporaryDirectory(prefix="shaketable-")
        self._marks = tempfile.TemporaryDirectory(prefix="shaketable-left-")
        self._numbers = count()
        self._at_work: set[_Turn] = set()
        self._pool = self._started()
        self._queues: dict[str, dict[str, deque[_Turn]]] = {}  # by address and word
        self._takes = FIRST_ANSWER

    async def ask(
        self, asker: Asker, seconds: float, question: Callable[P, R], *args: P.args, **kw: P.kwargs
    ) -> R:
        """The answer of a worker to question(*args, **kw).

        Args:
            asker: whose queue it joins.
            seconds: of a processor that it may take; on the wall PATIENCE times as many.

        Raises:
            BusyError: too many questions wait.
            TooLongError: it took longer.
            WorkerLostError: its workers died.
            Exception: what the question raises.
        """
        for _ in range(TRIES):
            try:
                return await self._once(asker, seconds, question, args, kw)
            except (ProcessExpired, BrokenExecutor):
                log.warning("a worker died and was replaced")
                self._tidy()
            except TimeoutError:
                self._tidy()
                raise TooLongError(
                    f"the answer took longer than {PATIENCE * seconds:g} s"
                ) from None
        raise WorkerLostError("the process that worked on this died, twice")

    def require_room(self, asker: Asker) -> None:
        """BusyError unless one more question of somebody can wait."""
        own = self._queues.get(asker.address, {})
        of_address = sum(map(len, own.values()))
        waiting = sum(len(queue) for words in self._queues.values() for queue in words.values())
        if (
            waiting >= MOST_WAITING
            or of_address >= MOST_ADDRESS
            or len(own.get(asker.word, ())) >= MOST_EACH
        ):
            wait = round(self._takes * (waiting + 1) / self.workers)
            raise BusyError(min(max(1, wait), LONGEST_WAIT))

    def _started(self) -> ProcessPool:
        """A pool whose workers start at once, and work in folders of their own."""
        pool = ProcessPool(
            max_workers=self.workers,
            initializer=warm,
            initargs=(self._scratch.name,),
            context=get_context("spawn"),
        )
        pool.schedule(os.getpid)  # so that the first visitor does not wait for all of it
        return pool

    def _tidy(self) -> None:
        """Remove what dead workers have left in their folders."""
        for folder in Path(self._scratch.name).iterdir():
            if not _lives(int(folder.name)):
                shutil.rmtree(folder, ignore_errors=True)

    async def _once(
        self,
        asker: Asker,
        seconds: float,
        question: Callable[..., R],
        args: Any,
        kw: Any,
    ) -> R:
        self.require_room(asker)
        own = self._queues.setdefault(asker.address, {}).setdefault(asker.word, deque())
        loop = asyncio.get_running_loop()
        left = Path(self._marks.name) / str(next(self._numbers))

        def start() -> Future[Any]:
            asked, limit = (question, args, kw, seconds, left), PATIENCE * seconds
            try:
                return self._pool.schedule(answer, args=asked, timeout=limit)
            except RuntimeError:  # the pool gives up where an idle worker dies
                log.warning("the workers died and were replaced")
                self._pool = self._started()
                return self._pool.schedule(answer, args=asked, timeout=limit)

        turn = _Turn(start, loop.create_future(), seconds, left)
        own.append(turn)
        self._serve()
        try:
            found: R = await turn.answer
            return found
        except asyncio.CancelledError:
            self._forget(asker, turn)
            raise

    def _forget(self, asker: Asker, turn: _Turn) -> None:
        """Remove an abandoned question from the queue, or tell its worker to stop."""
        if turn.work is not None and not turn.work.done():
            turn.left.touch()
        if turn in self._queues.get(asker.address, {}).get(asker.word, ()):
            self._take(asker, turn)

    def _serve(self) -> None:
        """Give free workers the next questions, one of each address in turn."""
        loop = asyncio.get_running_loop()
        while len(self._at_work) < self.workers and (turn := self._next()) is not None:
            self._at_work.add(turn)
            try:
                turn.work = turn.ask()
            except Exception as error:
                self._at_work.discard(turn)
                turn.answer.set_exception(error)
                continue
            turn.overdue = loop.call_later(OVERDUE, self._look, turn, loop.time())
            done = asyncio.wrap_future(turn.work, loop=loop)
            done.add_done_callback(partial(self._done, turn, loop.time()))

    def _next(self) -> _Turn | None:
        """The next question in turn, without long ones while all workers but one do such."""
        long = sum(turn.is_long for turn in self._at_work)
        full = long >= max(1, self.workers - 1)
        for address, words in self._queues.items():
            for word, queue in words.items():
                for turn in queue:
                    if not (turn.is_long and full):
                        self._take(Asker(address, word), turn)
                        return turn
        return None

    def _take(self, asker: Asker, turn: _Turn) -> None:
        """Remove a question, and move its address and visitor to the end of the rotation."""
        words = self._queues.pop(asker.address)
        queue = words.pop(asker.word)
        queue.remove(turn)
        if queue:
            words[asker.word] = queue
        if words:
            self._queues[asker.address] = words

    def _look(self, turn: _Turn, begun: float) -> None:
        """Check that a worker has begun a question, and ends within its time."""
        loop, work = asyncio.get_running_loop(), turn.work
        assert work is not None
        late = loop.time() - begun > PATIENCE * turn.seconds + OVERDUE
        if late if work.running() else self._ready() >= self.workers:
            self._replace_all()
        else:
            turn.overdue = loop.call_later(OVERDUE, self._look, turn, begun)

    def _ready(self) -> int:
        """How many workers have been prepared."""
        return sum(_lives(int(mark.parent.name)) for mark in self._ready_marks())

    def _ready_marks(self) -> list[Path]:
        return list(Path(self._scratch.name).glob(f"*/{READY}"))

    def _replace_all(self) -> None:
        """Replace all workers, because one does not respond: it may be suspended.

        The questions at work are asked once more.
        """
        log.warning("a worker does not answer; all are replaced")
        for mark in self._ready_marks():
            mark.unlink()
        before, self._pool = self._pool, self._started()
        for turn in self._at_work:
            turn.lost = True
            if turn.work is not None:
                turn.work.cancel()
        before.stop()  # type: ignore[no-untyped-call]
        asyncio.get_running_loop().run_in_executor(None, before.join)

    def _done(self, turn: _Turn, begun: float, done: asyncio.Future[Any]) -> None:
        if turn.overdue is not None:
            turn.overdue.cancel()
        turn.left.unlink(missing_ok=True)
        self._at_work.discard(turn)
        self._takes += 0.1 * (asyncio.get_running_loop().time() - begun - self._takes)
        if not turn.answer.done():
            if done.cancelled():
                lost = BrokenExecutor() if turn.lost else WorkerLostError("the server is closing")
                turn.answer.set_exception(lost)
            elif (error := done.exception()) is not None:
                turn.answer.set_exception(error)
            else:
                turn.answer.set_result(done.result())
        elif not done.cancelled():
            done.exception()  # seen: nobody waits for it any more
        self._serve()

    def close(self) -> None:
        """End all workers."""
        self._pool.stop()  # type: ignore[no-untyped-call]
        try:
            self._pool.join(timeout=5.0)
        except (TimeoutError, CancelledError):
            log.warning("a worker did not end")
        self._scratch.cleanup()
        self._marks.cleanup()


def _lives(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True
