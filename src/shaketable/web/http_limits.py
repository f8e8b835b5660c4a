"""What is refused, how failures are told, and the headers that every answer carries."""

from __future__ import annotations

import logging
from collections.abc import Collection
from urllib.parse import urlsplit

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from shaketable.atomic_files import NO_ROOM
from shaketable.errors import InputError, SimulationError
from shaketable.web import bodies
from shaketable.web.budget import LeftError, TooLongError
from shaketable.web.limits import MOST_FAULTS
from shaketable.web.visitor import address_of
from shaketable.web.work_queue import FULL, BusyError, WorkerLostError

log = logging.getLogger(__name__)

HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
        "connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
}


def add_guard(app: FastAPI, hosts: Collection[str]) -> None:
    """Register limits, and handlers of errors that expose nothing of the inside.

    Args:
        app: the application.
        hosts: names by which it may be called; any where there are none.
    """
    app.add_middleware(HttpLimits, hosts=hosts)
    app.exception_handler(RequestValidationError)(_invalid)
    app.exception_handler(InputError)(_refused)
    app.exception_handler(BusyError)(_full)
    for failure in (SimulationError, TooLongError, WorkerLostError, MemoryError):
        app.exception_handler(failure)(_failed)
    app.exception_handler(OSError)(_out_of_room)
    app.exception_handler(Exception)(_broken)


class HttpLimits:
    """Refuses what is too large or from elsewhere, and adds the headers that every answer carries.

    A page of another site may ask a browser to call this machine, by a name of its own that leads
    here (DNS rebinding): a server for this machine alone is called by this machine's names.
    """

    def __init__(self, app: ASGIApp, hosts: Collection[str]) -> None:
        self._app = app
        self._hosts = {host.lower() for host in hosts}
        self._bodies = bodies.Bodies()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return await self._app(scope, receive, send)

        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
                headers["Cache-Control"] = "no-cache"
            await send(message)

        answer = await self._answer(scope, receive, guarded)
        if answer is not None:
            await answer(scope, receive, guarded)
        return None

    async def _answer(self, scope: Scope, receive: Receive, send: Send) -> Response | None:
        """Pass the request to the application, or return a refusal."""
        method, headers = scope["method"], Headers(scope=scope)
        path = scope["path"].removeprefix(scope.get("root_path", ""))
        for name in ("host", "origin"):
            if not self._is_known(headers.get(name)):
                return _told(403, f"{name.title()}: this server is not called by that name")
        refusal = _refusal(method, path, headers)
        if refusal is not None:
            return refusal
        length = int(headers.get("content-length", 0))
        seconds = bodies.seconds_of(method)
        try:
            place = self._bodies.place(address_of(scope), length)
        except BusyError as error:
            return _busy(error)
        with place:
            try:
                body = await bodies.read(receive, seconds) if length else b""
            except TimeoutError:
                return _told(
                    408,
                    f"the request's body did not arrive within {seconds:g} s",
                    Connection="close",
                )
            except LeftError:
                return None
            await self._app(scope, bodies.again(body, receive), send)
        return None

    def _is_known(self, named: str | None) -> bool:
        """Whether a Host or Origin header names this server.

        True if the header is missing, or any host is accepted.
        """
        if not self._hosts or named is None:
            return True
        try:
            host = urlsplit(named if "//" in named else f"//{named}").hostname
        except ValueError:
            return False
        return (host or "").lower() in self._hosts


def _refusal(method: str, path: str, headers: Headers) -> Response | None:
    """What is answered to a request without reading it."""
    most = bodies.most_of(method, path)
    length = headers.get("content-length", "")
    chunked = "transfer-encoding" in headers  # it would count, whatever the length says
    if method in ("POST", "PUT") and (chunked or not length.isdigit()):
        return _told(411, "the request must say how long it is (Content-Length)")
    if length.isdigit() and int(length) > most:
        return _told(413, f"at most {most:,} bytes are taken, got {int(length):,}")
    return None


def _told(status: int, detail: str, **headers: str) -> JSONResponse:
    return JSONResponse({"detail": detail}, status, headers)


async def _invalid(request: Request, error: Exception) -> Response:
    """Return 422 with the fields that are invalid, without their values."""
    assert isinstance(error, RequestValidationError)
    fields = [
        {"field": ".".join(str(part) for part in each["loc"][1:]), "problem": each["msg"]}
        for each in error.errors()[:MOST_FAULTS]
    ]
    said = "; ".join(f"{each['field']}: {each['problem']}" for each in fields)
    return JSONResponse({"detail": said, "fields": fields}, 422)


async def _refused(request: Request, error: Exception) -> Response:
    return _told(422, str(error))


async def _full(request: Request, error: Exception) -> Response:
    assert isinstance(error, BusyError)
    return _busy(error)


def _busy(error: BusyError) -> JSONResponse:
    return _told(429, str(error), **{"Retry-After": str(error.wait)})


async def _failed(request: Request, error: Exception) -> Response:
    return _told(503, str(error) or "the calculation ran out of memory")


async def _out_of_room(request: Request, error: Exception) -> Response:
    if not isinstance(error, OSError) or error.errno not in NO_ROOM:
        raise error  # as any other
    log.error("%s: %s", error.filename or "a file", error.strerror)
    return _told(507, FULL, **HEADERS)


async def _broken(request: Request, error: Exception) -> Response:
    return _told(500, "something went wrong here; it has been logged", **HEADERS)
