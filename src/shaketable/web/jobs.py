"""Assessments that run for a while: begun, watched, stopped, and their results kept."""

from __future__ import annotations

import asyncio
import json
import secrets
import shutil
import tempfile
import time
from collections.abc import AsyncIterator, Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from shaketable.atomic_files import NO_ROOM
from shaketable.errors import InputError
from shaketable.language import Language
from shaketable.web.budget import TooLongError
from shaketable.web.job_files import PROGRESS, REPORT, RESULTS
from shaketable.web.limits import (
    ASSESS_SECONDS,
    LOOKED_AT,
    MOST_LISTS,
    MOST_LISTS_ADDRESS,
    MOST_LISTS_AT_WORK,
    MOST_LISTS_EACH,
    UNWATCHED,
)
from shaketable.web.lists import REMARKS, REPORTS
from shaketable.web.questions import Question
from shaketable.web.work_queue import (
    FULL,
    LONGEST_WAIT,
    Asker,
    BusyError,
    WorkerLostError,
    WorkQueue,
)

#: What a job does: its question, its folder, and the language of its errors.
Work = Callable[[Any, str, Language], None]
LOOKS = 0.3  # s between two looks at how far a job is
FILES = {
    **dict.fromkeys(REPORTS.values(), "text/html; charset=utf-8"),
    **dict.fromkeys(REMARKS.values(), "text/csv; charset=utf-8"),
    "results.csv": "text/csv; charset=utf-8",
    "results.parquet": "application/octet-stream",
}


@dataclass(eq=False)
class Job:
    """An assessment, who asked for it, and when somebody last asked how it is."""

    asker: Asker
    folder: Path
    task: asyncio.Task[None]
    seen: float = field(default_factory=time.monotonic)

    @property
    def told(self) -> dict[str, object]:
        """How it is: waiting, running with a count, done, stopped, or failed with a reason."""
        if not self.task.done():
            try:
                count, total = map(int, (self.folder / PROGRESS).read_text("ascii").split())
            except (OSError, ValueError):
                return {"state": "waiting"}
            return {"state": "running", "simulations": count, "of": total}
        if self.task.cancelled():
            return {"state": "stopped"}
        error = self.task.exception()
        if error is None:
            return {"state": "done"}
        if isinstance(error, OSError) and error.errno in NO_ROOM:
            return {"state": "failed", "detail": FULL}
        kinds = (InputError, BusyError, TooLongError, WorkerLostError)
        reason = str(error) if isinstance(error, kinds) else "something went wrong here"
        return {"state": "failed", "detail": reason}

    @property
    def unseen(self) -> float:
        """Seconds since somebody asked for it."""
        return time.monotonic() - self.seen


class Jobs:
    """The assessments of a server, in a folder that goes with it.

    The results of the latest MOST_LISTS are kept, of one address of the latest MOST_LISTS_ADDRESS,
    and of one visitor of the latest MOST_LISTS_EACH; what others have looked at lately stays.
    """

    def __init__(self, queue: WorkQueue) -> None:
        self._queue = queue
        self._root = Path(tempfile.mkdtemp(prefix="shaketable-lists-"))
        self._jobs: dict[str, Job] = {}

    def begin(self, asker: Asker, work: Work, asked: Question, language: Language = "en") -> str:
        """Begin an assessment, whose errors are told in a language; its id.

        Raises:
            BusyError: too many are waiting or running, or are still looked at.
        """
        self._drop_unwatched()
        self._queue.require_room(asker)
        at_work = [job for job in self._jobs.values() if not job.task.done()]
        if sum(job.asker.address == asker.address for job in at_work) >= MOST_LISTS_AT_WORK:
            raise BusyError(LONGEST_WAIT)
        self._make_room(asker)
        name = secrets.token_urlsafe(16)
        folder = self._root / name
        folder.mkdir()
        answer = self._queue.ask(asker, ASSESS_SECONDS, work, asked, str(folder), language)
        self._jobs[name] = Job(asker, folder, asyncio.ensure_future(answer))
        return name

    def _drop_unwatched(self) -> None:
        """Stop what nobody has asked for in a while."""
        for job in self._jobs.values():
            if not job.task.done() and job.unseen > UNWATCHED:
                job.task.cancel()

    def _make_room(self, asker: Asker) -> None:
        """Forget results of the same visitor or address, or such as nobody looks at any more.

        What found nothing goes first, then the oldest.

        Raises:
            BusyError: all that is kept is still looked at.
        """
        ended = {name: job for name, job in self._jobs.items() if job.task.done()}
        useless = [name for name, job in ended.items() if job.told["state"] != "done"]
        order = dict.fromkeys([*useless, *ended])
        near = [name for name in order if ended[name].asker.address == asker.address]
        own = [name for name in near if ended[name].asker == asker]
        old = sorted(ended, key=lambda name: -ended[name].unseen)
        old = [name for name in old if ended[name].unseen > LOOKED_AT]
        jobs = self._jobs.values
        self._forget(own, sum(job.asker == asker for job in jobs()) - MOST_LISTS_EACH + 1)
        of_address = sum(job.asker.address == asker.address for job in jobs())
        self._forget(near, of_address - MOST_LISTS_ADDRESS + 1)
        self._forget([*useless, *near, *old], len(self._jobs) - MOST_LISTS + 1)
        if len(self._jobs) >= MOST_LISTS:
            raise BusyError(60)

    def _forget(self, names: Iterable[str], count: int) -> None:
        """Remove the first so many of those that are still there."""
        there = [name for name in dict.fromkeys(names) if name in self._jobs]
        for name in there[: max(0, count)]:
            shutil.rmtree(self._jobs.pop(name).folder, ignore_errors=True)

    def get(self, name: str) -> Job | None:
        """A job, which somebody has now asked for."""
        job = self._jobs.get(name)
        if job is not None:
            job.seen = time.monotonic()
        return job

    def file(self, name: str, wanted: str) -> Path | None:
        """A file of the results of a job that is done; None where it has none of that name."""
        job = self.get(name)
        if job is None or wanted not in FILES or job.told["state"] != "done":
            return None
        path = job.folder / REPORT / wanted
        return path if path.is_file() else None  # an assessment of a room has no report

    def result(self, name: str, language: Language = "en") -> Path | None:
        """What was found, told in a language."""
        job = self.get(name)
        return job.folder / RESULTS[language] if job and job.told["state"] == "done" else None

    async def events(self, name: str) -> AsyncIterator[str]:
        """How a job is, whenever that changes, as server-sent events, until it has ended."""
        before = None
        while (job := self.get(name)) is not None:
            self._drop_unwatched()
            told = job.told
            if told != before:
                yield f"data: {json.dumps(told)}\n\n"
                before = told
            if job.task.done():
                return
            await asyncio.sleep(LOOKS)

    async def close(self) -> None:
        """Stop what runs and remove all results."""
        tasks = [job.task for job in self._jobs.values()]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        shutil.rmtree(self._root, ignore_errors=True)
