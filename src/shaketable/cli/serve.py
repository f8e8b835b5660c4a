"""`shaketable serve`: the web page on this machine."""

from __future__ import annotations

import socket
from typing import Annotated

import typer

from shaketable.cli.console import say
from shaketable.errors import InputError
from shaketable.extras import require


def serve(
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="Port to listen at; 0 takes any free port.")
    ] = 8000,
    host: Annotated[
        str,
        typer.Option(
            help="Address to listen at; 0.0.0.0 lets other machines in, without a password."
        ),
    ] = "127.0.0.1",
    workers: Annotated[
        int | None, typer.Option(min=1, max=256, help="Processes that compute. [all cores]")
    ] = None,
    root_path: Annotated[
        str, typer.Option(help="Path under which a proxy serves the page, such as /shaketable.")
    ] = "",
    name: Annotated[
        list[str] | None,
        typer.Option(
            help="Name by which others reach it through a proxy on this machine; repeatable."
        ),
    ] = None,
) -> None:
    """Serve the page on this machine, or to others by --host; Ctrl-C ends it.

    It ends with Ctrl-C.
    """
    require("web", "serve")
    from shaketable.compile_ahead import compile_ahead
    from shaketable.web.server import HERE
    from shaketable.web.server import serve as run

    if root_path and not root_path.startswith("/"):
        raise InputError(f"--root-path: must begin with a /, got {root_path!r}")
    port = port or free_port(host)
    _require_free(host, port)
    here = "127.0.0.1" if host in ("0.0.0.0", *HERE) else host  # noqa: S104
    compile_ahead()
    say(f"http://{here}:{port}/  (Ctrl-C ends it)")
    if host not in HERE:
        say("Whoever reaches this machine can use the page.")
    run(host, port, workers, root_path, name or ())


def free_port(host: str) -> int:
    """A port at an address where nobody listens."""
    with _socket(host) as listens:
        listens.bind((host, 0))
        return int(listens.getsockname()[1])


def _require_free(host: str, port: int) -> None:
    try:
        with _socket(host) as listens:
            listens.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listens.bind((host, port))
    except OSError as error:
        raise InputError(
            f"--host {host} --port {port}: cannot listen there: {error.strerror or error}"
        ) from None


def _socket(host: str) -> socket.socket:
    return socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET)
