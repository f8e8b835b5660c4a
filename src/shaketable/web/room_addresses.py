"""The interface under `/api/room`: how a room reads, its film, and its assessment."""

from __future__ import annotations

from pathlib import Path

from fastapi import FastAPI, Request

from shaketable.web import rooms
from shaketable.web.answers import Started
from shaketable.web.limits import LIST_SECONDS, MANY_SECONDS
from shaketable.web.list_addresses import jobs_of
from shaketable.web.room_answers import AssessRoom, RoomFilm, RoomRead, ShakeRoom
from shaketable.web.snippets import described
from shaketable.web.visitor import (
    FILE,
    FileName,
    Visitor,
    answer_of,
    asker_of,
    language_of,
)


def add_room_addresses(app: FastAPI) -> None:
    """What is asked about a room; its assessment is watched as that of a list."""

    @app.put("/api/room", description=described("room"), openapi_extra=FILE)
    async def understand(request: Request, name: FileName, visitor: Visitor = None) -> RoomRead:
        given = (Path(name).name, await request.body(), language_of(request))
        return await answer_of(request, visitor, LIST_SECONDS, rooms.understand, *given)

    @app.post("/api/room/simulate", description=described("room/simulate"))
    async def simulate(asked: ShakeRoom, request: Request, visitor: Visitor = None) -> RoomFilm:
        return await answer_of(request, visitor, MANY_SECONDS, rooms.shake, asked)

    @app.post("/api/room/assess", description=described("room/assess"), status_code=202)
    async def begin(asked: AssessRoom, request: Request, visitor: Visitor = None) -> Started:
        who = asker_of(request, visitor)
        job = jobs_of(request).begin(who, rooms.assess_room, asked, language_of(request))
        return Started(id=job)
