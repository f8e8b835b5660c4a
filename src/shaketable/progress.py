"""A progress bar with the time left, for work that takes more than a moment."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

#: Whether to draw a bar, or a function that is told how much more was done.
Progress = bool | Callable[[int], None]


@contextmanager
def meter(title: str, total: int, progress: Progress) -> Iterator[Callable[[int], None]]:
    """Yields a function that is told how much more was done. A bar on stderr goes when done."""
    if not isinstance(progress, bool):
        yield progress
        return
    if not progress:
        yield lambda more: None
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    console = Console(stderr=True)
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,  # no bar in a log file, nor the line it leaves
    )
    with bar:
        task = bar.add_task(title, total=total)
        yield lambda more: bar.advance(task, more)
