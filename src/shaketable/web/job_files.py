"""The files by which a job that runs for a while tells how far it is, and what it has found."""

from __future__ import annotations

import os
import time
from pathlib import Path

from shaketable.language import LANGUAGES
from shaketable.web.budget import check

TELLS = 0.25  # s between two reports of progress
PROGRESS = "progress"
RESULTS = {language: f"result.{language}.json" for language in LANGUAGES}
REPORT = "report"  # folder of the files that can be downloaded


class Watch:
    """Writes how much was done, of how much, to a file that is whole at any time."""

    def __init__(self, place: Path) -> None:
        self._place, self._count, self._total, self._told = place, 0, 0, 0.0

    def expect(self, total: int) -> None:
        self._total += total
        self._write()

    def done(self, more: int) -> None:
        check(more)
        self._count += more
        if time.monotonic() - self._told >= TELLS:
            self._write()

    def _write(self) -> None:
        self._told = time.monotonic()
        fresh = self._place / f"{PROGRESS}.new"
        fresh.write_text(f"{self._count} {max(self._count, self._total)}", encoding="ascii")
        os.replace(fresh, self._place / PROGRESS)  # noqa: PTH105  the older is replaced at once
