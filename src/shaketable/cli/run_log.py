"""What makes a run repeatable: its command, versions, times and messages."""

from __future__ import annotations

import logging
import shlex
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import Any


class RunLog:
    """Starts when a command starts to work, and keeps what is logged."""

    def __init__(self) -> None:
        self._started = _now()
        self._messages = _Messages()
        logging.getLogger("shaketable").addHandler(self._messages)

    def entries(self) -> dict[str, Any]:
        """Command, folder, times, versions and messages so far."""
        from shaketable.report.folder import versions

        return {
            "command": shlex.join(["shaketable", *sys.argv[1:]]),
            "folder": str(Path.cwd()),
            "started": self._started,
            "finished": _now(),
            "versions": versions(),
            "messages": self._messages.lines,
        }


class _Messages(logging.Handler):
    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        line = f"{record.levelname}: {record.getMessage()}"
        if line not in self.lines:
            self.lines.append(line)


def plain(value: object) -> object:
    """An option as the run log keeps it."""
    if isinstance(value, list):
        return [str(each) for each in value]
    return str(value) if isinstance(value, Path) else value


def _now() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M:%S UTC")
