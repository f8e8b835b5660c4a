"""The assessments that a server keeps."""

from __future__ import annotations

import asyncio
import errno
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from shaketable.errors import InputError
from shaketable.web import jobs as rooms
from shaketable.web.http_limits import add_guard
from shaketable.web.jobs import Jobs
from shaketable.web.lists import assess_list
from shaketable.web.questions import Assess
from shaketable.web.work_queue import Asker, BusyError
from tests.web.test_work_queue import run

LIST = Assess(text="name")


class Instant:
    """A queue that answers at once: fails for Mallory, and takes a minute for some."""

    full = False

    def require_room(self, asker: Asker) -> None:
        if self.full:
            raise BusyError(3)

    async def ask(self, asker: Asker, *_: Any) -> None:
        if asker.address == "slow":
            await asyncio.sleep(60.0)
        if asker.address == "full":
            raise OSError(errno.ENOSPC, "No space left on device")
        if asker.address == "mallory":
            raise InputError("no")


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Jobs:
    monkeypatch.setattr(rooms, "MOST_LISTS", 5)
    monkeypatch.setattr(rooms, "MOST_LISTS_EACH", 2)
    return Jobs(Instant())  # type: ignore[arg-type]


def test_what_found_nothing_goes_first(made: Jobs) -> None:
    """However many wrong lists somebody sends, the results of others stay."""

    async def ask() -> None:
        kept = made.begin(Asker("alice"), assess_list, LIST)
        await asyncio.sleep(0.01)
        for _ in range(30):
            made.begin(Asker("mallory"), assess_list, LIST)
            await asyncio.sleep(0)
        assert made.get(kept) is not None
        await made.close()

    run(ask())


def test_each_visitor_keeps_the_latest(made: Jobs) -> None:
    async def ask() -> None:
        kept = made.begin(Asker("alice"), assess_list, LIST)
        own = []
        for _ in range(4):
            own.append(made.begin(Asker("bob"), assess_list, LIST))
            await asyncio.sleep(0.01)
        assert [made.get(each) is not None for each in own] == [False, False, True, True]
        assert made.get(kept) is not None
        await made.close()

    run(ask())


def test_a_full_queue_takes_no_list(made: Jobs) -> None:
    async def ask() -> None:
        made._queue.full = True  # type: ignore[attr-defined]
        with pytest.raises(BusyError):
            made.begin(Asker("alice"), assess_list, LIST)
        await made.close()

    run(ask())


def test_a_result_that_is_looked_at_stays(made: Jobs) -> None:
    """However many lists others send, with however many words; and they are told to wait."""

    async def ask() -> None:
        kept = made.begin(Asker("alice"), assess_list, LIST)
        await asyncio.sleep(0.01)
        for k in range(4):  # five are kept, all of them new
            made.begin(Asker(f"address {k}", str(k)), assess_list, LIST)
            await asyncio.sleep(0.001)
        for k in range(4, 20):
            with pytest.raises(BusyError, match="ask again in 60 s"):
                made.begin(Asker(f"address {k}", str(k)), assess_list, LIST)
        assert made.get(kept) is not None
        for job in made._jobs.values():
            job.seen -= rooms.LOOKED_AT + 1.0
        assert made.get(kept) is not None  # looked at just now
        for k in range(4):
            made.begin(Asker(f"later {k}"), assess_list, LIST)
            await asyncio.sleep(0.001)
        assert made.get(kept) is not None
        await made.close()

    run(ask())


def test_an_address_keeps_and_begins_so_many(made: Jobs, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever words it takes."""
    monkeypatch.setattr(rooms, "MOST_LISTS", 20)
    monkeypatch.setattr(rooms, "MOST_LISTS_ADDRESS", 3)
    monkeypatch.setattr(rooms, "MOST_LISTS_AT_WORK", 2)

    async def ask() -> None:
        kept = made.begin(Asker("alice"), assess_list, LIST)
        own = []
        for k in range(6):
            own.append(made.begin(Asker("bob", str(k)), assess_list, LIST))
            await asyncio.sleep(0.001)
        assert [made.get(each) is not None for each in own] == [False] * 3 + [True] * 3
        assert made.get(kept) is not None
        for k in range(2):
            made.begin(Asker("slow", str(k)), assess_list, LIST)
        with pytest.raises(BusyError):
            made.begin(Asker("slow", "another"), assess_list, LIST)
        await made.close()

    run(ask())


def test_what_nobody_watches_is_dropped(made: Jobs) -> None:
    async def ask() -> None:
        left = made.begin(Asker("slow", "left"), assess_list, LIST)
        watched = made.begin(Asker("slow", "watched"), assess_list, LIST)
        await asyncio.sleep(0.01)
        for job in made._jobs.values():
            job.seen -= rooms.UNWATCHED + 1.0
        async for told in made.events(watched):
            assert "waiting" in told
            break
        await asyncio.sleep(0.01)
        assert made._jobs[left].told == {"state": "stopped"}
        assert made._jobs[watched].told == {"state": "waiting"}
        await made.close()

    run(ask())


def test_a_full_disk_is_told_as_that(made: Jobs) -> None:
    async def ask() -> None:
        job = made.begin(Asker("full"), assess_list, LIST)
        await asyncio.sleep(0.01)
        told = made._jobs[job].told
        assert told == {
            "state": "failed",
            "detail": "the disk of the server is full; try again later",
        }
        await made.close()

    run(ask())


def test_a_full_disk_answers_507() -> None:
    app = FastAPI()
    add_guard(app, ())

    @app.get("/full")
    async def full() -> None:
        raise OSError(errno.ENOSPC, "No space left on device", "/somewhere/secret")

    @app.get("/broken")
    async def broken() -> None:
        raise OSError(errno.EACCES, "Permission denied", "/somewhere/secret")

    async def ask() -> None:
        transport = httpx.ASGITransport(app, raise_app_exceptions=False)
        async with httpx.AsyncClient(transport=transport, base_url="http://here") as client:
            for path, code in (("/full", 507), ("/broken", 500)):
                answer = await client.get(path)
                assert answer.status_code == code
                assert "secret" not in answer.text

    run(ask())


def test_a_file_that_an_assessment_has_not_is_none(made: Jobs) -> None:
    """That of a room has no report: its address answers 404."""

    async def ask() -> None:
        job = made.begin(Asker("alice"), assess_list, LIST)
        await asyncio.sleep(0.01)
        assert made.file(job, "report.html") is None
        found = made.get(job)
        assert found is not None
        (found.folder / "report").mkdir(parents=True, exist_ok=True)
        (found.folder / "report" / "report.html").write_text("found")
        assert made.file(job, "report.html") == found.folder / "report" / "report.html"
        assert made.file(job, "report.es.html") is None
        await made.close()

    run(ask())
