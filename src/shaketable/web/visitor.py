"""A visitor's request: who asks, in which language, and how it waits for an answer."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from ipaddress import IPv6Network, ip_address
from typing import Annotated, Any, TypeVar

from fastapi import Header, HTTPException, Query, Request
from starlette.types import Scope

from shaketable.language import LANGUAGES, Language
from shaketable.web.limits import MOST_NAME
from shaketable.web.work_queue import Asker, WorkQueue

A = TypeVar("A")

LOOKS = 0.5  # s between two looks whether a visitor is still there
FILE = {  # the body of a request that is a file
    "requestBody": {
        "required": True,
        "content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}},
    }
}

Visitor = Annotated[
    str | None,
    Header(
        alias="X-Visitor",
        max_length=64,
        description="any text that identifies the visitor; each has its own queue",
    ),
]
FileName = Annotated[
    str, Query(max_length=MOST_NAME, description="of the file; its ending tells the format")
]


def language_of(request: Request) -> Language:
    """The first of a visitor's languages that is spoken here, by Accept-Language."""
    for wanted in request.headers.get("accept-language", "").split(","):
        for language in LANGUAGES:
            if wanted.strip().lower().startswith(language):
                return language
    return "en"


def asker_of(request: Request, visitor: str | None) -> Asker:
    """Who asks."""
    return Asker(address_of(request.scope), visitor or "")


def address_of(scope: Scope) -> str:
    """The client's IPv4 address, or its IPv6 /64 network, of which it can use all addresses."""
    host = str((scope.get("client") or ("",))[0])
    try:
        address = ip_address(host)
    except ValueError:  # a proxy's word, or none
        return host
    return host if address.version == 4 else str(IPv6Network((int(address) >> 64 << 64, 64)))


async def answer_of(
    request: Request, visitor: str | None, seconds: float, question: Callable[..., A], *args: Any
) -> A:
    """The result of a worker, which stops if the client disconnects.

    Raises:
        HTTPException: the client has disconnected (499).
    """
    queue: WorkQueue = request.app.state.queue
    work = asyncio.ensure_future(queue.ask(asker_of(request, visitor), seconds, question, *args))
    while not work.done():
        await asyncio.wait({work}, timeout=LOOKS)
        if not work.done() and await request.is_disconnected():
            work.cancel()
            raise HTTPException(499, "the visitor has left")
    return work.result()
