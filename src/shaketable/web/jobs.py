"""Assessments that run for a while: begun, watched, stopped, and their results kept."""

from __future__ import annotations

import asyncio
import json
import secrets
import shutil
import tempfile
from collections.abc import AsyncIterator
from dataclasses import dataclass
from pathlib import Path

from shaketable.errors import InputError
from shaketable.language import Language
from shaketable.web.budget import TooLongError
from shaketable.web.desk import BusyError, Desk, WorkerLostError
from shaketable.web.limits import ASSESS_SECONDS, MOST_LISTS, MOST_LISTS_EACH
from shaketable.web.lists import PROGRESS, REMARKS, REPORT, RESULTS, assess_list
from shaketable.web.questions import Assess

LOOKS = 0.3  # s between two looks at how far a job is
FILES = {
    "report.html": "text/html; charset=utf-8",
    **dict.fromkeys(REMARKS.values(), "text/csv; charset=utf-8"),
    "results.csv": "text/csv; charset=utf-8",
    "results.parquet": "application/octet-stream",
}


@dataclass(frozen=True)
class Job:
    """An assessment, and who asked for it."""

    visitor: str
    folder: Path
    task: asyncio.Task[None]

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
        kinds = (InputError, BusyError, TooLongError, WorkerLostError)
        reason = str(error) if isinstance(error, kinds) else "something went wrong here"
        return {"state": "failed", "detail": reason}


class Jobs:
    """The assessments of a server, in a folder that goes with it.

    The results of the latest MOST_LISTS are kept, and of one visitor of the latest MOST_LISTS_EACH.
    """

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self._root = Path(tempfile.mkdtemp(prefix="shaketable-lists-"))
        self._jobs: dict[str, Job] = {}

    def begin(self, visitor: str, asked: Assess, language: Language = "en") -> str:
        """Begin an assessment, whose errors are told in a language; its id.

        Raises:
            BusyError: too many are waiting or running.
        """
        self._desk.require_room(visitor)
        self._make_room(visitor)
        name = secrets.token_urlsafe(16)
        folder = self._root / name
        folder.mkdir()
        work = self._desk.ask(visitor, ASSESS_SECONDS, assess_list, asked, str(folder), language)
        self._jobs[name] = Job(visitor, folder, asyncio.ensure_future(work))
        return name

    def _make_room(self, visitor: str) -> None:
        """Forget what found nothing, then the visitor's own oldest, then the oldest of all."""
        ended = {name: job for name, job in self._jobs.items() if job.task.done()}
        own = [name for name, job in self._jobs.items() if job.visitor == visitor]
        useless = [name for name, job in ended.items() if job.told["state"] != "done"]
        for name in dict.fromkeys([*useless, *(each for each in own if each in ended), *ended]):
            mine = sum(job.visitor == visitor for job in self._jobs.values())
            full = len(self._jobs) >= MOST_LISTS
            if not (full or (mine >= MOST_LISTS_EACH and name in own)):
                continue
            shutil.rmtree(self._jobs.pop(name).folder, ignore_errors=True)
        if len(self._jobs) >= MOST_LISTS:
            raise BusyError(60)

    def get(self, name: str) -> Job | None:
        return self._jobs.get(name)

    def file(self, name: str, wanted: str) -> Path | None:
        """A file of the results of a job that is done."""
        job = self._jobs.get(name)
        if job is None or wanted not in FILES or job.told["state"] != "done":
            return None
        return job.folder / REPORT / wanted

    def result(self, name: str, language: Language = "en") -> Path | None:
        """What was found, told in a language."""
        job = self._jobs.get(name)
        return job.folder / RESULTS[language] if job and job.told["state"] == "done" else None

    async def events(self, name: str) -> AsyncIterator[str]:
        """How a job is, whenever that changes, as server-sent events, until it has ended."""
        before = None
        while (job := self._jobs.get(name)) is not None:
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
