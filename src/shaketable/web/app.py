"""The application: pages, the interface under `/api`, and what every answer carries."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, TypeVar

from fastapi import FastAPI, Header, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, JSONResponse
from fastapi.staticfiles import StaticFiles
from starlette.middleware.gzip import GZipMiddleware

from shaketable.engine.pool import available_cores
from shaketable.errors import InputError, SimulationError
from shaketable.web import work
from shaketable.web.answers import Listed, Read, Shaken, Shares, Spectrum
from shaketable.web.desk import BusyError, Desk, TooLongError, WorkerLostError
from shaketable.web.limits import (
    MANY_SECONDS,
    MOST_ASKED,
    MOST_BYTES,
    MOST_NAME,
    SHAKE_SECONDS,
)
from shaketable.web.questions import Many, Shake, Trace
from shaketable.web.snippets import described

A = TypeVar("A")

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
Visitor = Annotated[
    str | None,
    Header(alias="X-Visitor", max_length=64, description="any word; each has a queue of its own"),
]


def create_app(workers: int | None = None, root_path: str = "") -> FastAPI:
    """The application, with worker processes that start and end with it.

    Args:
        workers: how many processes; all cores by default.
        root_path: under which a proxy serves it.
    """
    from shaketable import __version__

    @asynccontextmanager
    async def life(app: FastAPI) -> AsyncIterator[None]:
        app.state.desk = Desk(workers or available_cores())
        try:
            yield
        finally:
            app.state.desk.close()

    app = FastAPI(
        title="shaketable",
        version=__version__,
        summary="A virtual shake table for things that are not bolted down",
        description="Lengths are metres, angles degrees and times seconds, as the names say. "
        "Nothing about visitors is kept. Where too many questions wait, the answer is 429, with "
        "the seconds to wait in Retry-After.",
        lifespan=life,
        docs_url=None,
        redoc_url=None,
        root_path=root_path,
    )
    app.add_middleware(GZipMiddleware, minimum_size=2000)
    app.middleware("http")(_guarded)
    app.exception_handler(RequestValidationError)(_invalid)
    app.exception_handler(InputError)(_refused)
    app.exception_handler(BusyError)(_full)
    for failure in (SimulationError, TooLongError, WorkerLostError, MemoryError):
        app.exception_handler(failure)(_failed)
    app.exception_handler(Exception)(_broken)
    _add_interface(app)
    _add_pages(app)
    return app


def _add_interface(app: FastAPI) -> None:
    async def ask(
        request: Request,
        visitor: str | None,
        seconds: float,
        question: Callable[..., A],
        *args: Any,
    ) -> A:
        host = request.client.host if request.client else ""
        desk: Desk = request.app.state.desk
        return await desk.ask(f"{host} {visitor or ''}", seconds, question, *args)

    @app.post("/api/simulate", description=described("simulate"))
    async def simulate(asked: Shake, request: Request, visitor: Visitor = None) -> Shaken:
        return await ask(request, visitor, SHAKE_SECONDS, work.shake, asked)

    @app.post("/api/many", description=described("many"))
    async def many(asked: Many, request: Request, visitor: Visitor = None) -> Shares:
        return await ask(request, visitor, MANY_SECONDS, work.many, asked)

    @app.post("/api/motion", description=described("motion"))
    async def motion(asked: Trace, request: Request, visitor: Visitor = None) -> Spectrum:
        return await ask(request, visitor, SHAKE_SECONDS, work.look, asked)

    @app.get("/api/motions", description=described("motions"))
    async def motions(request: Request, visitor: Visitor = None) -> list[Listed]:
        return await ask(request, visitor, SHAKE_SECONDS, work.motions)

    @app.put("/api/record", description=described("record"))
    async def record(request: Request, name: str, visitor: Visitor = None) -> Read:
        data = await request.body()
        return await ask(
            request, visitor, SHAKE_SECONDS, work.read, Path(name[:MOST_NAME]).name, data
        )


def _add_pages(app: FastAPI) -> None:
    static = Path(str(resources.files("shaketable.web") / "static"))
    texts = Path(str(resources.files("shaketable.web") / "texts"))

    @app.get("/", include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(static / "index.html")

    @app.get("/docs", include_in_schema=False)
    async def docs() -> FileResponse:
        return FileResponse(static / "docs.html")

    app.mount("/static", StaticFiles(directory=static), name="static")
    app.mount("/texts", StaticFiles(directory=texts), name="texts")


async def _guarded(request: Request, answer: Callable[[Request], Awaitable[Response]]) -> Response:
    """Refuse what is too large, and add the headers that every answer carries."""
    most = MOST_BYTES if request.url.path.endswith("/api/record") else MOST_ASKED
    length = request.headers.get("content-length")
    if request.method in ("POST", "PUT") and not (length or "").isdigit():
        found: Response = _told(411, "the request must say how long it is (Content-Length)")
    elif length and int(length) > most:
        found = _told(413, f"at most {most:,} bytes are taken, got {int(length):,}")
    else:
        found = await answer(request)
    found.headers.update(HEADERS)
    if request.url.path.endswith(("/", ".html")) or "/api/" in request.url.path:
        found.headers["Cache-Control"] = "no-cache"
    return found


def _told(status: int, detail: str, **headers: str) -> JSONResponse:
    return JSONResponse({"detail": detail}, status, headers)


async def _invalid(request: Request, error: Exception) -> Response:
    """What is wrong with the fields, without what was sent."""
    assert isinstance(error, RequestValidationError)
    fields = [
        {"field": ".".join(str(part) for part in each["loc"][1:]), "problem": each["msg"]}
        for each in error.errors()
    ]
    said = "; ".join(f"{each['field']}: {each['problem']}" for each in fields)
    return JSONResponse({"detail": said, "fields": fields}, 422)


async def _refused(request: Request, error: Exception) -> Response:
    return _told(422, str(error))


async def _full(request: Request, error: Exception) -> Response:
    assert isinstance(error, BusyError)
    return _told(429, str(error), **{"Retry-After": str(error.wait)})


async def _failed(request: Request, error: Exception) -> Response:
    return _told(503, str(error) or "it took too much memory")


async def _broken(request: Request, error: Exception) -> Response:
    return _told(500, "something went wrong here; it has been logged")
