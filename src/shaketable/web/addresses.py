"""The interface under `/api`: one object, its shakings and records."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from fastapi import FastAPI, Query, Request

from shaketable.web import shaking, space, work
from shaketable.web.answers import (
    Listed,
    MotionSpectrum,
    ShakenInSpace,
    ShakenThing,
    Shares,
    SharesInSpace,
    UploadedRecord,
)
from shaketable.web.limits import MANY_SECONDS, SHAKE_SECONDS
from shaketable.web.questions import LookAtMotion, Many, ManyInSpace, Shake, ShakeInSpace, Units
from shaketable.web.snippets import described
from shaketable.web.visitor import FILE, FileName, Visitor, answer_of


def add_addresses(app: FastAPI) -> None:
    """What is asked about one object, and about motions."""

    @app.post("/api/simulate", description=described("simulate"))
    async def simulate(asked: Shake, request: Request, visitor: Visitor = None) -> ShakenThing:
        return await answer_of(request, visitor, SHAKE_SECONDS, work.shake, asked)

    @app.post("/api/many", description=described("many"))
    async def many(asked: Many, request: Request, visitor: Visitor = None) -> Shares:
        return await answer_of(request, visitor, MANY_SECONDS, work.many, asked)

    @app.post("/api/space/simulate", description=described("space/simulate"))
    async def simulate_in_space(
        asked: ShakeInSpace, request: Request, visitor: Visitor = None
    ) -> ShakenInSpace:
        return await answer_of(request, visitor, SHAKE_SECONDS, space.shake, asked)

    @app.post("/api/space/many", description=described("space/many"))
    async def many_in_space(
        asked: ManyInSpace, request: Request, visitor: Visitor = None
    ) -> SharesInSpace:
        return await answer_of(request, visitor, MANY_SECONDS, space.many, asked)

    @app.post("/api/motion", description=described("motion"))
    async def motion(
        asked: LookAtMotion, request: Request, visitor: Visitor = None
    ) -> MotionSpectrum:
        return await answer_of(request, visitor, SHAKE_SECONDS, shaking.look, asked)

    @app.get("/api/motions", description=described("motions"))
    async def motions(request: Request, visitor: Visitor = None) -> list[Listed]:
        return await answer_of(request, visitor, SHAKE_SECONDS, shaking.motions)

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
    ) -> UploadedRecord:
        given = (Path(name).name, await request.body(), units, time_step_s, component)
        return await answer_of(request, visitor, SHAKE_SECONDS, shaking.read, *given)
