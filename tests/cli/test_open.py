"""`shaketable open`, and `shaketable` without words: the page opens in the browser."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest

from tests.cli.test_serve import free_port
from tests.support.command import shaketable

pytest.importorskip("pebble", reason="the extra web is not installed: pip install '.[web]'")
PATIENCE = 60.0  # s for which a start may take on a busy machine


@pytest.mark.skipif(sys.platform == "win32", reason="pretends a browser by a shell script")
@pytest.mark.parametrize("words", [(), ("open", "--port")], ids=["no words", "open"])
def test_the_page_opens_once_it_answers(tmp_path: Path, words: tuple[str, ...]) -> None:
    """The browser is a script that writes down what it is to open."""
    opened = tmp_path / "opened"
    browser = tmp_path / "browser.sh"
    browser.write_text(f'#!/bin/sh\necho "$1" > {opened}\n')
    browser.chmod(0o700)
    port = [str(free_port())] if words else []
    run = subprocess.Popen(
        [sys.executable, "-m", "shaketable", *words, *port],
        env={**os.environ, "BROWSER": f"{browser} %s"},
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        end = time.monotonic() + PATIENCE
        while not (opened.exists() and opened.read_text()) and time.monotonic() < end:
            assert run.poll() is None
            time.sleep(0.1)
        address = opened.read_text().strip()
        assert not port or address == f"http://127.0.0.1:{port[0]}/"
        with urllib.request.urlopen(address, timeout=10) as page:
            assert b"shaketable" in page.read()
    finally:
        run.send_signal(signal.SIGINT)
        said, _ = run.communicate(timeout=PATIENCE)
    assert address in said
    assert run.returncode == 0


def test_without_a_browser_the_address_is_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from shaketable.cli import open as command

    monkeypatch.setattr(command.webbrowser, "open", lambda address: False)
    monkeypatch.setattr(command, "PATIENCE", 0.2)
    address = f"http://127.0.0.1:{free_port()}/"
    command._show(address)
    assert f"open {address} in one" in capsys.readouterr().err


def test_without_the_pages_packages_there_is_the_help(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shaketable.cli.missing", lambda extra: "fastapi")
    run = shaketable()
    assert run.returncode == 0
    assert "Commands:" in run.stdout
    assert "pip install 'shaketable[web]'" in run.stdout
