"""A connection that has to say within seconds what it wants, and to take what it is given.

uvicorn waits for headers, and for who does not read, as long as they like.
"""

from __future__ import annotations

import asyncio
from typing import Any, ClassVar

from uvicorn.protocols.http.h11_impl import H11Protocol

from shaketable.web.limits import HEADER_SECONDS, MOST_CONNECTED, READ_SECONDS


class Connection(H11Protocol):
    """A connection; where there are too many, the one goes that has been silent for longest."""

    silent: ClassVar[dict[Connection, None]] = {}  # those without a whole header, the oldest first

    def __init__(self, *args: Any, **kw: Any) -> None:
        super().__init__(*args, **kw)
        self._header: asyncio.TimerHandle | None = None
        self._reads: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._wait()
        if len(self.connections) >= MOST_CONNECTED:
            same = (one for one in self.silent if one.server_state is self.server_state)
            oldest = next(same, self)
            self.silent.pop(oldest, None)
            oldest.transport.abort()

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        if self.transport.is_closing():
            return
        if self.cycle is None or self.cycle.response_complete:
            self._wait()
        else:
            self._heard()

    def on_response_complete(self) -> None:
        super().on_response_complete()
        if not self.transport.is_closing() and self.cycle.response_complete:
            self.silent[self] = None  # it may go, though its time is that of an idle connection

    def _wait(self) -> None:
        """From now on, unless it has been so already, a header has to come."""
        if self._header is None:
            self.silent[self] = None
            self._header = self.loop.call_later(HEADER_SECONDS, self.transport.abort)

    def _heard(self) -> None:
        self.silent.pop(self, None)
        if self._header is not None:
            self._header.cancel()
            self._header = None

    def pause_writing(self) -> None:
        super().pause_writing()
        if self._reads is None:
            self._reads = self.loop.call_later(READ_SECONDS, self.transport.abort)

    def resume_writing(self) -> None:
        super().resume_writing()
        self._taken()

    def _taken(self) -> None:
        if self._reads is not None:
            self._reads.cancel()
            self._reads = None

    def connection_lost(self, exc: Exception | None) -> None:
        self._heard()
        self._taken()
        super().connection_lost(exc)
