"""The desk: questions wait in a fair queue until a worker process is free.

Simulations never block the event loop. Each visitor has a queue of his own and the queues take
turns, so that somebody who asks a hundred times does not keep the others waiting. A worker that
dies takes its question with it, which is asked once more; one that thinks for too long is ended.
"""

from __future__ import annotations

import asyncio
import logging
import os
import shutil
import tempfile
from collections import Counter, deque
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from pebble import ProcessExpired, ProcessPool

from shaketable.web.limits import MOST_EACH, MOST_UPLOADS, MOST_UPLOADS_EACH, MOST_WAITING
from shaketable.web.workers import warm

log = logging.getLogger(__name__)

P = ParamSpec("P")
R = TypeVar("R")

TRIES = 2  # of a question whose worker dies
LONGEST_WAIT = 30  # s, that a visitor is asked to wait
FIRST_ANSWER = 0.3  # s: how long a question takes, until one has been answered


class BusyError(Exception):
    """No more questions are taken just now.

    Attributes:
        wait: seconds after which to ask again.
    """

    def __init__(self, wait: int) -> None:
        super().__init__(f"too many questions wait; ask again in {wait} s")
        self.wait = wait


class TooLongError(Exception):
    """A question took a worker longer than it may."""


class WorkerLostError(Exception):
    """The worker of a question died, and so did the one that was asked after it."""


@dataclass(eq=False)
class _Turn:
    """A question that waits, or is being answered."""

    ask: Callable[[], asyncio.Future[Any]]
    answer: asyncio.Future[Any]
    work: asyncio.Future[Any] | None = None  # once a worker has it


class Desk:
    """Workers and the questions that wait for them.

    Args:
        workers: how many processes.
        ends_abandoned: end a worker whose question nobody waits for any more; it takes seconds to
            replace, so that this is for long questions.
    """

    def __init__(self, workers: int, ends_abandoned: bool = False) -> None:
        self.workers = workers
        self.ends_abandoned = ends_abandoned
        self._scratch = tempfile.TemporaryDirectory(prefix="shaketable-")
        self._pool = self._started()
        self._queues: dict[str, deque[_Turn]] = {}
        self._files: Counter[str] = Counter()  # that are in memory, by visitor
        self._busy = 0
        self._takes = FIRST_ANSWER

    async def ask(
        self, visitor: str, seconds: float, question: Callable[P, R], *args: P.args, **kw: P.kwargs
    ) -> R:
        """The answer of a worker to question(*args, **kw).

        Args:
            visitor: whose queue it joins.
            seconds: that it may take a worker.

        Raises:
            BusyError: too many questions wait.
            TooLongError: it took longer.
            WorkerLostError: its workers died.
            Exception: what the question raises.
        """
        for _ in range(TRIES):
            try:
                return await self._once(visitor, seconds, question, args, kw)
            except (ProcessExpired, BrokenExecutor):
                log.warning("a worker died and was replaced")
                self._tidy()
            except TimeoutError:
                self._tidy()
                raise TooLongError(f"the answer took longer than {seconds:g} s") from None
        raise WorkerLostError("the process that worked on this died, twice")

    @contextmanager
    def place(self, visitor: str) -> Iterator[None]:
        """Room for the file of a visitor, from before it is read until it is answered.

        Raises:
            BusyError: too many files are read, or too many questions wait.
        """
        self.require_room(visitor)
        if self._files.total() >= MOST_UPLOADS or self._files[visitor] >= MOST_UPLOADS_EACH:
            raise BusyError(1)
        self._files[visitor] += 1
        try:
            yield
        finally:
            self._files[visitor] -= 1
            self._files += Counter()  # drops those at zero

    def require_room(self, visitor: str) -> None:
        """BusyError unless one more question of a visitor can wait."""
        waiting = sum(len(queue) for queue in self._queues.values())
        if waiting >= MOST_WAITING or len(self._queues.get(visitor, ())) >= MOST_EACH:
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
        visitor: str,
        seconds: float,
        question: Callable[..., R],
        args: Any,
        kw: Any,
    ) -> R:
        self.require_room(visitor)
        own = self._queues.setdefault(visitor, deque())
        loop = asyncio.get_running_loop()

        def start() -> asyncio.Future[Any]:
            try:
                future = self._pool.schedule(question, args=args, kwargs=kw, timeout=seconds)
            except RuntimeError:  # the pool gives up where an idle worker dies
                log.warning("the workers died and were replaced")
                self._pool = self._started()
                future = self._pool.schedule(question, args=args, kwargs=kw, timeout=seconds)
            return asyncio.wrap_future(future, loop=loop)

        turn = _Turn(start, loop.create_future())
        own.append(turn)
        self._serve()
        try:
            found: R = await turn.answer
            return found
        except asyncio.CancelledError:
            self._forget(visitor, turn)
            raise

    def _forget(self, visitor: str, turn: _Turn) -> None:
        """Drop the question of a visitor who left: from his queue, or with its worker."""
        if turn.work is not None and self.ends_abandoned:
            turn.work.cancel()
        queue = self._queues.get(visitor)
        if queue and turn in queue:
            queue.remove(turn)
            if not queue:
                del self._queues[visitor]

    def _serve(self) -> None:
        """Give free workers the next questions, one of each visitor in turn."""
        while self._busy < self.workers and self._queues:
            visitor = next(iter(self._queues))
            queue = self._queues.pop(visitor)
            if not queue:
                continue
            turn = queue.popleft()
            if queue:  # to the end of the round
                self._queues[visitor] = queue
            if turn.answer.done():
                continue
            self._busy += 1
            begun = asyncio.get_running_loop().time()
            try:
                turn.work = turn.ask()
            except Exception as error:
                self._busy -= 1
                turn.answer.set_exception(error)
                continue
            turn.work.add_done_callback(partial(self._done, turn, begun))

    def _done(self, turn: _Turn, begun: float, done: asyncio.Future[Any]) -> None:
        self._busy -= 1
        self._takes += 0.1 * (asyncio.get_running_loop().time() - begun - self._takes)
        if not turn.answer.done():
            if done.cancelled():
                turn.answer.set_exception(WorkerLostError("the server is closing"))
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


def _lives(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True
