"""`shaketable open`, and `shaketable` without words: the page, in this machine's browser."""

from __future__ import annotations

import threading
import time
import urllib.request
import webbrowser
from typing import Annotated

import typer

from shaketable.cli.console import say

HERE = "127.0.0.1"
PATIENCE = 60.0  # s for which the page may take to answer
EVERY = 0.1  # s between two tries


def open(  # noqa: A001  # the name of the command
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="Port to listen at; 0 takes any free port.")
    ] = 0,
) -> None:
    """Open the page in the browser: one thing, a list or a room. Nothing leaves this machine.

    It ends with Ctrl-C, or when this window is closed.
    """
    from shaketable.cli.serve import free_port, serve
    from shaketable.extras import require

    require("web", "the page in the browser")
    port = port or free_port(HERE)
    threading.Thread(target=_show, args=(f"http://{HERE}:{port}/",), daemon=True).start()
    serve(port=port)


def _show(address: str) -> None:
    """Open an address in the browser as soon as it answers."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            with urllib.request.urlopen(address, timeout=5):  # noqa: S310  # our own
                break
        except OSError:
            time.sleep(EVERY)
    if not webbrowser.open(address):
        say(f"No browser was found here: open {address} in one.", err=True)
