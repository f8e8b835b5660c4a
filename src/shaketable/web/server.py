"""The page on this machine."""

from __future__ import annotations

import signal

from shaketable.web.app import create_app


def serve(
    host: str = "127.0.0.1", port: int = 8000, workers: int | None = None, root_path: str = ""
) -> None:
    """Serve the page until SIGTERM or Ctrl-C; requests in progress are answered first.

    Args:
        host: address to listen at; others than this machine reach it only at another one.
        port: 0 takes any that is free.
        workers, root_path: as for `create_app`.
    """
    import uvicorn

    for end in (signal.SIGINT, signal.SIGTERM):  # uvicorn repeats them once it has ended cleanly
        signal.signal(end, lambda *_: None)
    uvicorn.run(
        create_app(workers, root_path),
        host=host,
        port=port,
        root_path=root_path,
        log_level="warning",
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=5,
    )
