"""Visitors who mean no good: the page stays there for the others."""

from __future__ import annotations

import asyncio
import json
import resource
import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest
from starlette.types import Message

from shaketable.web import bodies, limits
from shaketable.web.bodies import Bodies
from shaketable.web.budget import LeftError
from shaketable.web.work_queue import BusyError
from tests.web.conftest import start_server
from tests.web.test_work_queue import run

pytestmark = pytest.mark.web


@pytest.fixture(scope="module")
def attacked() -> Iterator[tuple[int, str]]:
    """A server of its own, and its process."""
    server, address = start_server()
    yield server.pid, address
    server.terminate()
    server.communicate(timeout=30)


@contextmanager
def connections(address: str, count: int, sent: bytes) -> Iterator[list[socket.socket]]:
    """Many connections that have sent something, all at once."""
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    soft = 2 * count + 200
    resource.setrlimit(resource.RLIMIT_NOFILE, (soft if hard < 0 else min(soft, hard), hard))
    place = urlsplit(address)
    with ExitStack() as stack:
        found = []
        for _ in range(count):
            one = socket.create_connection((place.hostname, place.port), timeout=10.0)
            stack.enter_context(one)
            one.sendall(sent)
            found.append(one)
        yield found


def memory_of(process: int) -> int:
    """Bytes that a process has in memory."""
    place = Path(f"/proc/{process}/statm")
    if not place.exists():
        pytest.skip("no /proc here")
    return int(place.read_text().split()[1]) * resource.getpagesize()


def answers(address: str) -> float:
    """Seconds until the page and a shaking are there."""
    begun = time.monotonic()
    with httpx.Client(base_url=address, timeout=30.0) as client:
        client.get("/").raise_for_status()
        client.get("/api/motions").raise_for_status()
    return time.monotonic() - begun


def test_half_sent_headers_hold_nobody_out(attacked: tuple[int, str]) -> None:
    """1,100 of them did, for as long as they liked."""
    _, address = attacked
    half = b"POST /api/simulate HTTP/1.1\r\nHost: localhost\r\nContent-"
    with connections(address, limits.MOST_CONNECTED + 100, half) as held:
        assert answers(address) < 20.0  # on a slow machine; it is a fraction of a second
        held[-1].settimeout(limits.HEADER_SECONDS + 20.0)
        assert held[-1].recv(100) == b""  # closed in the end, though it has kept still
    assert answers(address) < 20.0


def test_unfinished_questions_take_no_memory(attacked: tuple[int, str]) -> None:
    """400 of 2.4 MB took 1.1 GB: only so many bytes of an address are read at a time."""
    process, address = attacked
    before = memory_of(process)
    length = limits.MOST_LIST - 100
    start = f"POST /api/assess HTTP/1.1\r\nHost: localhost\r\nContent-Length: {length}\r\n\r\n"
    with connections(address, 200, start.encode()) as held:
        answered = 0
        for one in held:
            one.settimeout(0.05)
            try:
                one.sendall(b" " * (length - 1))
                answered += b"429" in one.recv(20)
            except OSError:  # nobody reads it, or it was refused and closed
                answered += 1
        assert answered >= len(held) - limits.MOST_HELD_ADDRESS // length - 5
        assert answers(address) < 30.0
        grown = memory_of(process) - before
    assert grown < 3 * limits.MOST_HELD_ADDRESS


@pytest.mark.parametrize(
    ("path", "most"),
    [("/api/many", limits.MOST_ASKED), ("/api/space/simulate", limits.MOST_SHAKING)],
)
def test_questions_have_their_sizes(attacked: tuple[int, str], path: str, most: int) -> None:
    _, address = attacked
    content = json.dumps({"thing": "x" * most})
    answer = httpx.post(f"{address}{path}", content=content)
    assert answer.status_code == 413
    assert f"at most {most:,} bytes" in answer.json()["detail"]


def test_bodies_have_room_and_time() -> None:
    held = Bodies()
    size = limits.MOST_HELD_ADDRESS // 2
    with held.place("one", size), held.place("one", size):
        with pytest.raises(BusyError):
            held.place("one", size)
        with held.place("two", size):
            pass
    with held.place("one", size):
        pass
    assert not held._held

    async def ask() -> None:
        parts: list[Message] = [
            {"type": "http.request", "body": b"a", "more_body": True},
            {"type": "http.request", "body": b"b"},
            {"type": "http.disconnect"},
        ]

        async def receive() -> Message:
            return parts.pop(0)

        async def never() -> Message:
            await asyncio.sleep(60.0)
            raise AssertionError

        body = await bodies.read(receive, 1.0)
        assert body == b"ab"
        again = bodies.again(body, receive)
        assert (await again())["body"] == b"ab"
        assert (await again())["type"] == "http.disconnect"
        parts.append({"type": "http.disconnect"})
        with pytest.raises(LeftError):
            await bodies.read(receive, 1.0)
        with pytest.raises(TimeoutError):
            await bodies.read(never, 0.05)

    run(ask())
