"""What a question may cost a worker: so much processor time, and none once nobody waits for it.

A worker answers one question at a time; what it simulates tells `check` after every few runs.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

R = TypeVar("R")


class TooLongError(Exception):
    """A question took a worker longer than it may."""


class LeftError(Exception):
    """Nobody waits for the answer any more."""


class _Asked:
    """The question at hand."""

    seconds = math.inf
    until = math.inf  # on the clock of the processor's time
    left: Path | None = None  # is there once nobody waits


def answer(question: Callable[..., R], args: Any, kw: Any, seconds: float, left: Path | None) -> R:
    """The answer to question(*args, **kw), within some seconds of the processor.

    Raises:
        TooLongError: it took more.
        LeftError: there is a file at `left`.
    """
    _Asked.seconds, _Asked.left = seconds, left
    _Asked.until = time.process_time() + seconds
    try:
        return question(*args, **kw)
    finally:
        _Asked.until, _Asked.left = math.inf, None


def check(more: int = 0) -> None:
    """End the question at hand where it has cost too much, or nobody waits for it.

    Args:
        more: simulations that were done since, as every `progress=` is told.
    """
    if time.process_time() > _Asked.until:
        raise TooLongError(
            f"the answer took more than {_Asked.seconds:g} s of computing: something that slides, "
            "rolls, wobbles or swings for long; take more friction, a weaker motion, or fewer "
            "shakings"
        )
    if _Asked.left is not None and _Asked.left.exists():
        raise LeftError
