"""The application: its workers, its pages, and what it is put together from."""

from __future__ import annotations

from collections.abc import AsyncIterator, Collection
from contextlib import asynccontextmanager
from importlib import resources
from pathlib import Path

from fastapi import FastAPI
from fastapi.responses import FileResponse
from fastapi.staticfiles import StaticFiles
from starlette.middleware.gzip import GZipMiddleware

from shaketable.engine.pool import available_cores
from shaketable.web.addresses import add_addresses
from shaketable.web.http_limits import add_guard
from shaketable.web.jobs import Jobs
from shaketable.web.list_addresses import add_list_addresses
from shaketable.web.room_addresses import add_room_addresses
from shaketable.web.work_queue import WorkQueue


def create_app(workers: int | None = None, hosts: Collection[str] = ()) -> FastAPI:
    """The application, with worker processes that start and end with it.

    Args:
        workers: how many processes; all cores by default.
        hosts: names by which it may be called (Host, Origin); any where there are none.
    """
    from shaketable import __version__

    @asynccontextmanager
    async def life(app: FastAPI) -> AsyncIterator[None]:
        most = workers or available_cores()
        app.state.queue = WorkQueue(most)
        # lists keep a worker for long: their own leave the others to who shakes one thing
        of_lists = WorkQueue(max(1, most // 2))
        app.state.jobs = Jobs(of_lists)
        try:
            yield
        finally:
            await app.state.jobs.close()
            of_lists.close()
            app.state.queue.close()

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
    add_guard(app, hosts)
    add_addresses(app)
    add_list_addresses(app)
    add_room_addresses(app)
    _add_pages(app)
    return app


def _add_pages(app: FastAPI) -> None:
    static = Path(str(resources.files("shaketable.web") / "static"))
    texts = Path(str(resources.files("shaketable.web") / "texts"))

    @app.api_route("/", methods=["GET", "HEAD"], include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(static / "index.html")

    @app.api_route("/list", methods=["GET", "HEAD"], include_in_schema=False)
    async def list_page() -> FileResponse:
        return FileResponse(static / "list.html")

    @app.api_route("/room", methods=["GET", "HEAD"], include_in_schema=False)
    async def room_page() -> FileResponse:
        return FileResponse(static / "room.html")

    @app.api_route("/docs", methods=["GET", "HEAD"], include_in_schema=False)
    async def docs() -> FileResponse:
        return FileResponse(static / "docs.html")

    app.mount("/static", StaticFiles(directory=static), name="static")
    app.mount("/texts", StaticFiles(directory=texts), name="texts")
