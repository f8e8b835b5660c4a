"""The command line as a user meets it, without a process of its own for every call."""

from __future__ import annotations

import io
import logging
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from unittest.mock import patch

from matplotlib.figure import Figure

from shaketable.cli import main


def shaketable(*arguments: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Runs a command: exit code, stdout and stderr."""
    words = ["shaketable", *map(str, arguments)]
    out, err = io.StringIO(), io.StringIO()
    with (
        chdir(cwd or Path.cwd()),
        patch.object(sys, "argv", words),
        patch.dict(os.environ, {"COLUMNS": "100"}),
        redirect_stdout(out),
        redirect_stderr(err),
        fresh_logging(),
    ):
        try:
            main()
            code = 0
        except SystemExit as ended:
            code = ended.code if isinstance(ended.code, int) else int(ended.code is not None)
    return subprocess.CompletedProcess(words, code, out.getvalue(), err.getvalue())


def refused(*arguments: object, cwd: Path | None = None) -> str:
    """What is said of a user's mistake, in one line."""
    run = shaketable(*arguments, cwd=cwd)
    assert run.returncode == 2, run.stderr
    return re.sub(r"\s+", " ", run.stderr)


@contextmanager
def fresh_logging() -> Iterator[None]:
    """No handlers, as in a new process; those that were there come back."""
    loggers = [logging.getLogger(), logging.getLogger("shaketable")]
    before = [(logger.handlers[:], logger.level) for logger in loggers]
    for logger in loggers:
        logger.handlers.clear()
    try:
        yield
    finally:
        for logger, (handlers, level) in zip(loggers, before, strict=True):
            logger.handlers[:] = handlers
            logger.setLevel(level)


def undrawn(figure: Figure, place: Path | io.StringIO, **_: object) -> None:
    """In place of `Figure.savefig`: most of a call's time goes into pictures."""
    if isinstance(place, Path):
        place.touch()
