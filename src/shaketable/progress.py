"""How far work is that takes more than a moment, with its rate and the time left.

On a terminal it is a bar, which goes when the work is done. In a log file, as of a job on a
cluster, it is a line each minute.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, Protocol

from shaketable.language import number, tell, translated

Done = Callable[[int], None]


class Watcher(Protocol):
    """Is told how much there is to do, part by part, and how much more of it was done."""

    def expect(self, total: int) -> None: ...
    def done(self, more: int) -> None: ...


#: Whether to tell how far it is, a function that is told how much more was done, or a watcher.
Progress = bool | Done | Watcher

EVERY = 60.0  # s between two lines


class AtMost:
    """Tells of work of which no more is done than was foreseen, and maybe less."""

    def __init__(self, total: int, done: Done) -> None:
        self._left, self._done = total, done

    def __call__(self, more: int) -> None:
        more = min(more, self._left)
        self._left -= more
        if more:
            self._done(more)

    def end(self) -> None:
        """Tell that all is done."""
        self(self._left)


@contextmanager
def meter(
    title: str, total: int, progress: Progress, note: Callable[[], str] = str
) -> Iterator[Done]:
    """Yields a function that is told how much more was done; it tells it on stderr.

    Args:
        title: what is counted.
        total: how much there is to do.
        progress: whether to tell, or who is told instead.
        note: what else there is to say, asked for again and again.
    """
    if callable(progress):
        yield progress
    elif not isinstance(progress, bool):
        progress.expect(total)
        yield progress.done  # what is a part of this tells no total of its own
    elif not progress:
        yield lambda more: None
    else:
        from rich.console import Console

        title = translated(title)
        console = Console(stderr=True)  # knows what may stand in stderr's place
        if console.is_terminal:
            with _bar(console, title, total, note) as done:
                yield done
        else:
            yield _lines(title, total, note)


def _lines(title: str, total: int, note: Callable[[], str]) -> Done:
    """Tells a line every so often."""
    told = time.monotonic()
    count = 0
    first: tuple[int, float] | None = None  # until then code may have been compiled

    def done(more: int) -> None:
        nonlocal count, told, first
        count += more
        now = time.monotonic()
        if first is None and count:
            first = count, now
        elif first is not None and now - told >= EVERY and count > first[0]:
            told = now
            speed = (count - first[0]) / (now - first[1])
            said = note()
            line = tell(
                "{title}: {count:,} of {total:,}, {rate}, {time} left",
                title=title,
                count=count,
                total=max(total, count),
                rate=rate(speed),
                time=duration(max(total - count, 0) / speed),
            )
            line += f"; {said}" if said else ""
            # a log that cannot be written must not end the work
            with suppress(OSError, ValueError, AttributeError):
                sys.stderr.write(line + "\n")
                sys.stderr.flush()

    return done


@contextmanager
def _bar(console: Any, title: str, total: int, note: Callable[[], str]) -> Iterator[Done]:
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        ProgressColumn,
        Task,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    class Rate(ProgressColumn):
        def render(self, task: Task) -> Any:
            return "" if task.speed is None else rate(task.speed)

    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(bar_width=20),
        MofNCompleteColumn(),
        Rate(),
        TimeElapsedColumn(),
        TextColumn(translated("left")),
        TimeRemainingColumn(),
        TextColumn("{task.fields[note]}"),
        console=console,
        transient=True,
    )
    with bar:
        task = bar.add_task(title, total=total, note=note())
        count = 0

        def done(more: int) -> None:
            nonlocal count
            count += more
            bar.update(task, completed=count, total=max(total, count), note=note())

        yield done


def rate(speed: float) -> str:
    """So many a second, to three digits where they are few."""
    return f"{number(speed, ',.0f' if speed >= 100.0 else '.3g')}/s"


def size(count: float) -> str:
    """A number of bytes to three digits, in a unit that people use."""
    units = (("GB", 1e9), ("MB", 1e6), ("kB", 1e3), ("bytes", 1.0))
    unit, each = next((one for one in units if count >= one[1]), units[-1])
    return f"{count / each:.3g} {unit}"


def duration(seconds: float) -> str:
    """A time to two digits, in a unit that people use."""
    units = (("days", 86400.0), ("h", 3600.0), ("min", 60.0), ("s", 1.0))
    unit, size = next((each for each in units if seconds >= 2.0 * each[1]), units[-1])
    count = seconds / size
    return f"{number(count, '.0f' if count >= 10.0 else '.2g')} {translated(unit)}"
