"""The desk: questions wait in a fair queue until a worker process is free.

Simulations never block the event loop. Each visitor has a queue of his own and the queues take
turns, so that somebody who asks a hundred times does not keep the others waiting. A worker that
dies takes its question with it, which is asked once more; one that thinks for too long is ended.
"""

from __future__ import annotations

import asyncio
import logging
from collections import deque
from collections.abc import Callable
from concurrent.futures import CancelledError
from functools import partial
from multiprocessing import get_context
from typing import Any, NamedTuple, ParamSpec, TypeVar

from pebble import ProcessExpired, ProcessPool

from shaketable.web.limits import MOST_EACH, MOST_WAITING
from shaketable.web.work import warm

log = logging.getLogger(__name__)

P = ParamSpec("P")
R = TypeVar("R")

TRIES = 2  # of a question whose worker dies
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


class _Turn(NamedTuple):
    """A question that waits."""

    ask: Callable[[], asyncio.Future[Any]]
    answer: asyncio.Future[Any]


class Desk:
    """Workers and the questions that wait for them.

    Args:
        workers: how many processes.
    """

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self._pool = ProcessPool(
            max_workers=workers, initializer=warm, context=get_context("spawn")
        )
        self._queues: dict[str, deque[_Turn]] = {}
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
            except ProcessExpired:
                log.warning("a worker died and was replaced")
            except TimeoutError:
                raise TooLongError(f"the answer took longer than {seconds:g} s") from None
        raise WorkerLostError("the process that worked on this died, twice")

    async def _once(
        self,
        visitor: str,
        seconds: float,
        question: Callable[..., R],
        args: Any,
        kw: Any,
    ) -> R:
        waiting = sum(len(queue) for queue in self._queues.values())
        own = self._queues.setdefault(visitor, deque())
        if waiting >= MOST_WAITING or len(own) >= MOST_EACH:
            raise BusyError(max(1, round(self._takes * (waiting + 1) / self.workers)))
        loop = asyncio.get_running_loop()

        def start() -> asyncio.Future[Any]:
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
        """Take the question of a visitor who left out of his queue."""
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
            turn.ask().add_done_callback(partial(self._done, turn, begun))

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
