"""The application: pages, the interface under `/api`, and what every answer carries."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, TypeVar

from fastapi import FastAPI, Header, HTTPException, Query, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, JSONResponse, StreamingResponse
from fastapi.staticfiles import StaticFiles
from starlette.datastructures import Headers, MutableHeaders
from starlette.middleware.gzip import GZipMiddleware
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from shaketable.engine.pool import available_cores
from shaketable.errors import InputError, SimulationError
from shaketable.language import LANGUAGES, Language
from shaketable.web import lists, shaking, space, work
from shaketable.web.answers import (
    Assessed,
    Listed,
    Read,
    Shaken,
    ShakenInSpace,
    Shares,
    SharesInSpace,
    Spectrum,
    Started,
    Understood,
)
from shaketable.web.desk import BusyError, Desk, TooLongError, WorkerLostError
from shaketable.web.jobs import FILES, Jobs
from shaketable.web.limits import (
    LIST_SECONDS,
    MANY_SECONDS,
    MOST_ASKED,
    MOST_BYTES,
    MOST_FAULTS,
    MOST_NAME,
    SHAKE_SECONDS,
    UPLOAD_SECONDS,
)
from shaketable.web.questions import Assess, Many, ManyInSpace, Shake, ShakeInSpace, Trace, Units
from shaketable.web.snippets import described

A = TypeVar("A")

LOOKS = 0.5  # s between two looks whether a visitor is still there
FILE = {  # the body of a request that is a file
    "requestBody": {
        "required": True,
        "content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}},
    }
}

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
#: Of a report: its own style, no script, and no origin that it could ask.
REPORT_POLICY = (
    "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'"
)
Visitor = Annotated[
    str | None,
    Header(alias="X-Visitor", max_length=64, description="any word; each has a queue of its own"),
]
FileName = Annotated[
    str, Query(max_length=MOST_NAME, description="of the file; its ending tells the format")
]


def create_app(workers: int | None = None) -> FastAPI:
    """The application, with worker processes that start and end with it.

    Args:
        workers: how many processes; all cores by default.
    """
    from shaketable import __version__

    @asynccontextmanager
    async def life(app: FastAPI) -> AsyncIterator[None]:
        most = workers or available_cores()
        app.state.desk = Desk(most)
        # lists keep a worker for long: their own leave the others to who shakes one thing
        of_lists = Desk(max(1, most // 2), ends_abandoned=True)
        app.state.jobs = Jobs(of_lists)
        try:
            yield
        finally:
            await app.state.jobs.close()
            of_lists.close()
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
    )
    app.add_middleware(GZipMiddleware, minimum_size=2000)
    app.add_middleware(Guard)
    app.exception_handler(RequestValidationError)(_invalid)
    app.exception_handler(InputError)(_refused)
    app.exception_handler(BusyError)(_full)
    for failure in (SimulationError, TooLongError, WorkerLostError, MemoryError):
        app.exception_handler(failure)(_failed)
    app.exception_handler(Exception)(_broken)
    _add_interface(app)
    _add_lists(app)
    _add_pages(app)
    return app


def _add_interface(app: FastAPI) -> None:
    @app.post("/api/simulate", description=described("simulate"))
    async def simulate(asked: Shake, request: Request, visitor: Visitor = None) -> Shaken:
        return await _ask(request, visitor, SHAKE_SECONDS, work.shake, asked)

    @app.post("/api/many", description=described("many"))
    async def many(asked: Many, request: Request, visitor: Visitor = None) -> Shares:
        return await _ask(request, visitor, MANY_SECONDS, work.many, asked)

    @app.post("/api/space/simulate", description=described("space/simulate"))
    async def simulate_in_space(
        asked: ShakeInSpace, request: Request, visitor: Visitor = None
    ) -> ShakenInSpace:
        return await _ask(request, visitor, SHAKE_SECONDS, space.shake, asked)

    @app.post("/api/space/many", description=described("space/many"))
    async def many_in_space(
        asked: ManyInSpace, request: Request, visitor: Visitor = None
    ) -> SharesInSpace:
        return await _ask(request, visitor, MANY_SECONDS, space.many, asked)

    @app.post("/api/motion", description=described("motion"))
    async def motion(asked: Trace, request: Request, visitor: Visitor = None) -> Spectrum:
        return await _ask(request, visitor, SHAKE_SECONDS, shaking.look, asked)

    @app.get("/api/motions", description=described("motions"))
    async def motions(request: Request, visitor: Visitor = None) -> list[Listed]:
        return await _ask(request, visitor, SHAKE_SECONDS, shaking.motions)

    @app.put("/api/record", description=described("record"), openapi_extra=FILE)
    async def record(
        request: Request,
        name: FileName,
        visitor: Visitor = None,
        units: Annotated[
            Units | None, Query(description="where the file does not say them")
        ] = None,
        time_step_s: Annotated[
            float | None, Query(gt=0, le=1, description="[s], where the file does not say it")
        ] = None,
        component: Annotated[
            str | None, Query(max_length=40, description="which one, where the file holds several")
        ] = None,
    ) -> Read:
        async with _upload(request, visitor) as data:
            given = (Path(name).name, data, units, time_step_s, component)
            return await _ask(request, visitor, SHAKE_SECONDS, shaking.read, *given)


def _add_lists(app: FastAPI) -> None:
    @app.put("/api/list", description=described("list"), openapi_extra=FILE)
    async def understand(
        request: Request,
        name: FileName,
        visitor: Visitor = None,
        accept_sizes: Annotated[
            bool, Query(description="take sizes that furniture does not have")
        ] = False,
    ) -> Understood:
        async with _upload(request, visitor) as data:
            given = (Path(name).name, data, accept_sizes, _language(request))
            return await _ask(request, visitor, LIST_SECONDS, lists.understand, *given)

    @app.post("/api/assess", description=described("assess"), status_code=202)
    async def begin(asked: Assess, request: Request, visitor: Visitor = None) -> Started:
        visitor = _visitor(request, visitor)
        return Started(id=_jobs(request).begin(visitor, asked, _language(request)))

    @app.get("/api/assess/{job}/events", description=described("events"))
    async def events(job: str, request: Request) -> StreamingResponse:
        _known(request, job)
        return StreamingResponse(_jobs(request).events(job), media_type="text/event-stream")

    @app.get("/api/assess/{job}", description=described("result"))
    async def result(job: str, request: Request) -> Assessed:
        path = _jobs(request).result(_known(request, job), _language(request))
        if path is None:
            raise HTTPException(404, "the assessment has no result, or none yet")
        return Assessed.model_validate_json(path.read_bytes())

    @app.delete("/api/assess/{job}", description=described("stop"), status_code=204)
    async def stop(job: str, request: Request) -> None:
        found = _jobs(request).get(_known(request, job))
        if found:
            found.task.cancel()

    @app.get("/api/assess/{job}/{file}", description=described("file"))
    async def download(job: str, file: str, request: Request) -> FileResponse:
        path = _jobs(request).file(_known(request, job), file)
        if path is None:
            raise HTTPException(404, f"no such file, or not yet; there are {', '.join(FILES)}")
        shown = "inline" if file == "report.html" else "attachment"
        answer = FileResponse(
            path, media_type=FILES[file], filename=file, content_disposition_type=shown
        )
        answer.headers["Content-Security-Policy"] = REPORT_POLICY
        return answer


def _known(request: Request, job: str) -> str:
    if _jobs(request).get(job) is None:
        raise HTTPException(404, "there is no such assessment; it may be too old")
    return job


def _jobs(request: Request) -> Jobs:
    found: Jobs = request.app.state.jobs
    return found


def _language(request: Request) -> Language:
    """The first of a visitor's languages that is spoken here, by Accept-Language."""
    for wanted in request.headers.get("accept-language", "").split(","):
        for language in LANGUAGES:
            if wanted.strip().lower().startswith(language):
                return language
    return "en"


def _visitor(request: Request, visitor: str | None) -> str:
    host = request.client.host if request.client else ""
    return f"{host} {visitor or ''}"


async def _ask(
    request: Request, visitor: str | None, seconds: float, question: Callable[..., A], *args: Any
) -> A:
    """The answer of a worker; a visitor who has left waits for none."""
    desk: Desk = request.app.state.desk
    work = asyncio.ensure_future(desk.ask(_visitor(request, visitor), seconds, question, *args))
    while not work.done():
        await asyncio.wait({work}, timeout=LOOKS)
        if not work.done() and await request.is_disconnected():
            work.cancel()
            raise HTTPException(499, "the visitor has left")
    return work.result()


@asynccontextmanager
async def _upload(request: Request, visitor: str | None) -> AsyncIterator[bytes]:
    """What was sent, read only where its question can wait; it keeps its place until answered."""
    desk: Desk = request.app.state.desk
    with desk.place(_visitor(request, visitor)):
        try:
            yield await asyncio.wait_for(request.body(), UPLOAD_SECONDS)
        except TimeoutError:
            raise HTTPException(408, f"it took longer than {UPLOAD_SECONDS:g} s") from None


def _add_pages(app: FastAPI) -> None:
    static = Path(str(resources.files("shaketable.web") / "static"))
    texts = Path(str(resources.files("shaketable.web") / "texts"))

    @app.api_route("/", methods=["GET", "HEAD"], include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(static / "index.html")

    @app.api_route("/list", methods=["GET", "HEAD"], include_in_schema=False)
    async def list_page() -> FileResponse:
        return FileResponse(static / "list.html")

    @app.api_route("/docs", methods=["GET", "HEAD"], include_in_schema=False)
    async def docs() -> FileResponse:
        return FileResponse(static / "docs.html")

    app.mount("/static", StaticFiles(directory=static), name="static")
    app.mount("/texts", StaticFiles(directory=texts), name="texts")


class Guard:
    """Refuses what is too large, and adds the headers that every answer carries."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

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

        refusal = _refusal(scope["method"], Headers(scope=scope))
        await (refusal or self._app)(scope, receive, guarded)
        return None


def _refusal(method: str, headers: Headers) -> Response | None:
    """What is answered to a request without reading it."""
    most = MOST_BYTES if method == "PUT" else MOST_ASKED
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
    """What is wrong with the fields, without what was sent."""
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
    return _told(429, str(error), **{"Retry-After": str(error.wait)})


async def _failed(request: Request, error: Exception) -> Response:
    return _told(503, str(error) or "it took too much memory")


async def _broken(request: Request, error: Exception) -> Response:
    return _told(500, "something went wrong here; it has been logged", **HEADERS)
