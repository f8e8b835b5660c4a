"""The bodies of requests: how large each may be, how many are in memory, and how long they take.

All are read here, before anything of them is looked at.
"""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager

from starlette.types import Message, Receive

from shaketable.web.budget import LeftError
from shaketable.web.limits import (
    BODY_SECONDS,
    MOST_ASKED,
    MOST_BYTES,
    MOST_HELD,
    MOST_HELD_ADDRESS,
    MOST_LIST,
    MOST_ROOM_BYTES,
    MOST_SHAKING,
    UPLOAD_SECONDS,
)
from shaketable.web.work_queue import BusyError

#: Bytes of what has more to say than some numbers.
LARGER = {
    ("PUT", "/api/record"): MOST_BYTES,
    ("PUT", "/api/list"): MOST_BYTES,
    ("POST", "/api/assess"): MOST_LIST,
    ("POST", "/api/simulate"): MOST_SHAKING,
    ("POST", "/api/space/simulate"): MOST_SHAKING,
    ("POST", "/api/motion"): MOST_SHAKING,
    ("PUT", "/api/room"): MOST_ROOM_BYTES,
    ("POST", "/api/room/assess"): MOST_ROOM_BYTES,
    ("POST", "/api/room/simulate"): MOST_SHAKING,
}


class Bodies:
    """Those that are in memory, from before they come until they are answered."""

    def __init__(self) -> None:
        self._held: Counter[str] = Counter()  # bytes, by address

    def place(self, address: str, size: int) -> AbstractContextManager[None]:
        """Room for one of so many bytes.

        Raises:
            BusyError: there is none just now.
        """
        if self._held.total() + size > MOST_HELD or self._held[address] + size > MOST_HELD_ADDRESS:
            raise BusyError(1)
        self._held[address] += size
        return self._until_answered(address, size)

    @contextmanager
    def _until_answered(self, address: str, size: int) -> Iterator[None]:
        try:
            yield
        finally:
            self._held[address] -= size
            self._held += Counter()  # drops those at zero


def most_of(method: str, path: str) -> int:
    """How many bytes a request may have."""
    return LARGER.get((method, path), MOST_ASKED)


def seconds_of(method: str) -> float:
    """Within which a request has to come."""
    return UPLOAD_SECONDS if method == "PUT" else BODY_SECONDS


async def read(receive: Receive, seconds: float) -> bytes:
    """A body, to its end.

    Raises:
        TimeoutError: it has not come within the seconds.
        LeftError: nobody sends it any more.
    """
    found = bytearray()
    async with asyncio.timeout(seconds):
        while True:
            message = await receive()
            if message["type"] != "http.request":
                raise LeftError
            found += message.get("body", b"")
            if not message.get("more_body", False):
                return bytes(found)


def again(body: bytes, receive: Receive) -> Receive:
    """What is received of a request whose body has been read: that, then whatever comes."""
    given = False

    async def received() -> Message:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": body, "more_body": False}

    return received
