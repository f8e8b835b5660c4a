"""The page on this machine."""

from __future__ import annotations

import signal
from collections.abc import Collection

from shaketable.web.app import create_app
from shaketable.web.limits import MOST_CONNECTED

HERE = ("127.0.0.1", "localhost", "::1")  # names of this machine that no other reaches


def serve(
    host: str = "127.0.0.1",
    port: int = 8000,
    workers: int | None = None,
    root_path: str = "",
    names: Collection[str] = (),
) -> None:
    """Serve the page until SIGTERM or Ctrl-C; requests in progress have five seconds.

    Args:
        host: address to listen at; others than this machine reach it only at another one.
        port: 0 takes any that is free.
        workers: as for `create_app`.
        root_path: under which a proxy serves it, which takes that from the path.
        names: by which others call it, through a proxy, where it listens at this machine alone.
    """
    import uvicorn

    from shaketable.web.connection import Connection

    _allow_files(2 * MOST_CONNECTED)
    # uvicorn repeats the signals that end it once it has ended cleanly
    before = {end: signal.signal(end, lambda *_: None) for end in (signal.SIGINT, signal.SIGTERM)}
    try:
        uvicorn.run(
            create_app(workers, (*HERE, *names) if host in HERE else ()),
            host=host,
            port=port,
            root_path=root_path,
            log_level="warning",
            access_log=False,
            server_header=False,
            http=Connection,
            ws="none",
            limit_concurrency=2 * MOST_CONNECTED,  # a Connection looks before
            timeout_graceful_shutdown=5,
        )
    finally:
        for end, handler in before.items():
            signal.signal(end, handler)


def _allow_files(count: int) -> None:
    """Let the process have so many files and connections open, as far as it may."""
    try:
        import resource
    except ImportError:  # Windows has no such limit
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if hard != resource.RLIM_INFINITY:
        count = min(count, hard)
    if soft != resource.RLIM_INFINITY and soft < count:
        resource.setrlimit(resource.RLIMIT_NOFILE, (count, hard))
