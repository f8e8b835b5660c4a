"""The interface under `/api`: lists, and the assessments, also of rooms, that run for a while."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from fastapi import FastAPI, HTTPException, Query, Request
from fastapi.responses import FileResponse, StreamingResponse
from pydantic import TypeAdapter

from shaketable.web import list_reading, lists, site
from shaketable.web.answers import Assessed, SiteLevels, Started, Understood
from shaketable.web.jobs import FILES, Jobs
from shaketable.web.limits import LIST_SECONDS
from shaketable.web.questions import (
    COLUMNS_SAID,
    MOST_COLUMNS_SAID,
    MOST_ROWS_SAID,
    OF_CATALOGUE,
    ROWS,
    ROWS_SAID,
    Assess,
)
from shaketable.web.room_answers import RoomAssessed
from shaketable.web.snippets import described
from shaketable.web.visitor import (
    FILE,
    FileName,
    Visitor,
    answer_of,
    asker_of,
    language_of,
)

#: Of a report: its own style, no script, and no origin that it could ask.
REPORT_POLICY = (
    "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'"
)
FOUND: TypeAdapter[Assessed | RoomAssessed] = TypeAdapter(Assessed | RoomAssessed)


def add_list_addresses(app: FastAPI) -> None:
    """What is asked about a list: how it reads, its assessment, and the files of that."""

    @app.put("/api/list", description=described("list"), openapi_extra=FILE)
    async def understand(
        request: Request,
        name: FileName,
        visitor: Visitor = None,
        accept_sizes: Annotated[
            bool, Query(description="take sizes that furniture does not have")
        ] = False,
        catalogue: Annotated[bool, Query(description=OF_CATALOGUE)] = False,
        sheet: Annotated[
            str | None, Query(max_length=100, description="to read, where a workbook has several")
        ] = None,
        columns: Annotated[str, Query(max_length=MOST_COLUMNS_SAID, description=COLUMNS_SAID)] = "",
        rows: Annotated[
            str, Query(max_length=MOST_ROWS_SAID, pattern=ROWS, description=ROWS_SAID)
        ] = "",
    ) -> Understood:
        given = (Path(name).name, await request.body(), accept_sizes, language_of(request))
        return await answer_of(
            request,
            visitor,
            LIST_SECONDS,
            list_reading.understand,
            *given,
            sheet,
            columns,
            catalogue,
            rows,
        )

    @app.put("/api/hazard", description=described("hazard"), openapi_extra=FILE)
    async def hazard(request: Request, name: FileName, visitor: Visitor = None) -> SiteLevels:
        given = (Path(name).name, await request.body(), language_of(request))
        return await answer_of(request, visitor, LIST_SECONDS, site.levels_of_site, *given)

    @app.post("/api/assess", description=described("assess"), status_code=202)
    async def begin(asked: Assess, request: Request, visitor: Visitor = None) -> Started:
        who = asker_of(request, visitor)
        return Started(
            id=jobs_of(request).begin(who, lists.assess_list, asked, language_of(request))
        )

    @app.get("/api/assess/{job}/events", description=described("events"))
    async def events(job: str, request: Request) -> StreamingResponse:
        _known(request, job)
        return StreamingResponse(jobs_of(request).events(job), media_type="text/event-stream")

    @app.get("/api/assess/{job}", description=described("result"))
    async def result(job: str, request: Request) -> Assessed | RoomAssessed:
        path = jobs_of(request).result(_known(request, job), language_of(request))
        if path is None:
            raise HTTPException(404, "the assessment has no result, or none yet")
        return FOUND.validate_json(path.read_bytes())

    @app.delete("/api/assess/{job}", description=described("stop"), status_code=204)
    async def stop(job: str, request: Request) -> None:
        found = jobs_of(request).get(_known(request, job))
        if found:
            found.task.cancel()

    @app.get("/api/assess/{job}/{file}", description=described("file"))
    async def download(job: str, file: str, request: Request) -> FileResponse:
        path = jobs_of(request).file(_known(request, job), file)
        if path is None:
            raise HTTPException(404, f"no such file, or not yet; there are {', '.join(FILES)}")
        shown = "inline" if file.endswith(".html") else "attachment"
        answer = FileResponse(
            path, media_type=FILES[file], filename=file, content_disposition_type=shown
        )
        answer.headers["Content-Security-Policy"] = REPORT_POLICY
        return answer


def _known(request: Request, job: str) -> str:
    if jobs_of(request).get(job) is None:
        raise HTTPException(404, "there is no such assessment; it may be too old")
    return job


def jobs_of(request: Request) -> Jobs:
    """Those of the server."""
    found: Jobs = request.app.state.jobs
    return found
