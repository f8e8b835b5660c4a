"""One server for all tests of the page."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import httpx
import pytest


def start_server(*options: str, computes: bool = True) -> tuple[subprocess.Popen[str], str]:
    """`shaketable serve` at a free port, and its address once it answers.

    Args:
        options: words of the command.
        computes: whether it has to be ready to compute by then.
    """
    server = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "shaketable",
            "serve",
            "--port",
            "0",
            "--workers",
            "1",
            *options,
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )
    assert server.stdout is not None
    address = server.stdout.readline().split()[0].rstrip("/")
    with httpx.Client(transport=httpx.HTTPTransport(retries=20)) as client:
        for _ in range(100):
            try:
                if client.get(address, timeout=10.0).status_code == 200:
                    break
            except httpx.TransportError:
                assert server.poll() is None, server.stdout.read()
    if computes:  # the first question waits until the worker has begun
        httpx.get(f"{address}/api/motions", timeout=600.0).raise_for_status()
    return server, address


@pytest.fixture(scope="session")
def address() -> Iterator[str]:
    server, address = start_server()
    yield address
    server.terminate()
    server.communicate(timeout=30)


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """Headless Chromium, the system's own."""
    playwright = pytest.importorskip("playwright.sync_api")
    found = shutil.which("chromium") or shutil.which("chromium-browser")
    if found is None:
        pytest.skip("no chromium is installed: apt-get install chromium")
    with playwright.sync_playwright() as running:
        chromium = running.chromium.launch(
            executable_path=found,
            args=["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
        )
        yield chromium
        chromium.close()
