"""The assessments that a server keeps."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from shaketable.errors import InputError
from shaketable.web import jobs as rooms
from shaketable.web.desk import BusyError
from shaketable.web.jobs import Jobs
from shaketable.web.questions import Assess
from tests.web.test_desk import run

LIST = Assess(text="name")


class Instant:
    """A desk that answers at once: fails for Mallory."""

    full = False

    def require_room(self, visitor: str) -> None:
        if self.full:
            raise BusyError(3)

    async def ask(self, visitor: str, *_: Any) -> None:
        if visitor == "mallory":
            raise InputError("no")


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Jobs:
    monkeypatch.setattr(rooms, "MOST_LISTS", 5)
    monkeypatch.setattr(rooms, "MOST_LISTS_EACH", 2)
    return Jobs(Instant())  # type: ignore[arg-type]


def test_what_found_nothing_goes_first(made: Jobs) -> None:
    """However many wrong lists somebody sends, the results of others stay."""

    async def ask() -> None:
        kept = made.begin("alice", LIST)
        await asyncio.sleep(0.01)
        for _ in range(30):
            made.begin("mallory", LIST)
            await asyncio.sleep(0)
        assert made.get(kept) is not None
        await made.close()

    run(ask())


def test_each_visitor_keeps_the_latest(made: Jobs) -> None:
    async def ask() -> None:
        kept = made.begin("alice", LIST)
        own = []
        for _ in range(4):
            own.append(made.begin("bob", LIST))
            await asyncio.sleep(0.01)
        assert [made.get(each) is not None for each in own] == [False, False, True, True]
        assert made.get(kept) is not None
        await made.close()

    run(ask())


def test_a_full_desk_takes_no_list(made: Jobs) -> None:
    async def ask() -> None:
        made._desk.full = True  # type: ignore[attr-defined]
        with pytest.raises(BusyError):
            made.begin("alice", LIST)
        await made.close()

    run(ask())
