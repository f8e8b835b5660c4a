"""What makes a run repeatable: its command, versions, times and messages."""

from __future__ import annotations

import hashlib
import logging
import platform
import shlex
import sys
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from shaketable.errors import ADDS_UP, Fault
from shaketable.language import message_of, tell, translated

PACKAGES = (
    "shaketable",
    "matplotlib",
    "numba",
    "numpy",
    "openpyxl",
    "pandas",
    "python-calamine",
    "scipy",
    "xarray",
)


class RunLog:
    """Starts when a command starts to work, and keeps what is logged; as a context, until its end.

    Args:
        command: that repeats the run; by default the one of this process.
        shown: how a fault of a file that is logged is to be told.
    """

    def __init__(
        self,
        command: Sequence[str] | None = None,
        shown: Callable[[Fault], Fault] = lambda fault: fault,
    ) -> None:
        self._command = command or ["shaketable", *sys.argv[1:]]
        self._started = _now()
        self._messages = _Messages(shown)
        logging.getLogger("shaketable").addHandler(self._messages)

    def __enter__(self) -> RunLog:
        return self

    def __exit__(self, *_: object) -> None:
        logging.getLogger("shaketable").removeHandler(self._messages)

    @property
    def messages(self) -> list[str]:
        """What was warned of so far, each once."""
        return self._messages.lines

    def entries(self) -> dict[str, Any]:
        """Command, folder, times, versions and messages so far."""
        return {
            "command": shlex.join(self._command),
            "folder": str(Path.cwd()),
            "started": self._started,
            "finished": _now(),
            "versions": versions(),
            "messages": self._messages.lines,
        }


class _Messages(logging.Handler):
    def __init__(self, shown: Callable[[Fault], Fault]) -> None:
        super().__init__(logging.WARNING)
        self._shown = shown
        self._lines: list[str] = []
        self._counts: dict[tuple[str, str, str], list[tuple[int, ...]]] = {}

    @property
    def lines(self) -> list[str]:
        """Each message once; those that count the same thing as one, with the sum."""
        summed = []
        for (level, template, what), counts in self._counts.items():
            numbers = [sum(each) for each in zip(*counts, strict=True)]
            line = f"{level}: {_filled(template, *numbers, what)}"
            if len(counts) > 1:
                line += tell(" (in {count} sets of simulations)", count=len(counts))
            summed.append(line)
        return [*self._lines, *summed]

    def emit(self, record: logging.LogRecord) -> None:
        told = record.msg
        if hasattr(record, ADDS_UP) and isinstance(record.args, tuple):
            *numbers, what = record.args
            key = (translated(record.levelname), str(told), str(what))
            self._counts.setdefault(key, []).append(tuple(int(str(each)) for each in numbers))
            return
        said = self._shown(told) if isinstance(told, Fault) else message_of(record)
        line = f"{translated(record.levelname)}: {said}"
        if line not in self._lines:
            self._lines.append(line)


def _filled(template: str, *values: object) -> str:
    """A template of what is logged, in the language that is spoken."""
    return message_of(logging.LogRecord("", logging.WARNING, "", 0, template, values, None))


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def versions() -> dict[str, str]:
    """The versions on which the results depend."""
    return {"python": platform.python_version(), **{name: _installed(name) for name in PACKAGES}}


@cache
def _installed(name: str) -> str:
    return version(name)


def plain(value: object) -> object:
    """An option as the run log keeps it."""
    if isinstance(value, list):
        return [str(each) for each in value]
    return str(value) if isinstance(value, Path) else value


def _now() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M:%S UTC")
