"""How far work is: a bar on a terminal, a line each minute elsewhere."""

from __future__ import annotations

import io
import sys
from types import SimpleNamespace

import pytest

from shaketable import progress
from shaketable.progress import AtMost, duration, meter, rate


def test_in_a_log_it_is_a_line_each_minute(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The speed counts from the first report on: before it code may have been compiled."""
    now = [0.0]
    monkeypatch.setattr(progress, "time", SimpleNamespace(monotonic=lambda: now[0]))
    with meter("simulations", 4000, True, lambda: "3 of 9 blocks done") as done:
        for now[0] in (30.0, 61.0, 100.0, 122.0):
            done(500)
    assert capsys.readouterr().err.splitlines() == [
        "simulations: 1,000 of 4,000, 16.1/s, 3.1 min left; 3 of 9 blocks done",
        "simulations: 2,000 of 4,000, 16.3/s, 2 min left; 3 of 9 blocks done",
    ]


def test_on_a_terminal_it_is_a_bar_with_rate_and_note(monkeypatch: pytest.MonkeyPatch) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "200")
    notes = iter(["none yet", "one block failed"] + 9 * ["two blocks failed"])
    with meter("simulations", 1000, True, lambda: next(notes)) as done:
        done(400)
        done(100)
    drawn = terminal.getvalue()
    assert "500/1000" in drawn
    assert "/s" in drawn
    assert "two blocks failed" in drawn


@pytest.mark.parametrize("stream", [None, object(), io.StringIO()])
def test_without_a_place_to_tell_it_the_work_goes_on(
    stream: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As of a service without stderr, or a log that was closed."""
    if isinstance(stream, io.StringIO):
        stream.close()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "EVERY", 0.0)
    with meter("simulations", 10, True) as done:
        done(10)


def test_whoever_asks_is_told_instead() -> None:
    told: list[int] = []
    with meter("simulations", 10, told.append) as done:
        done(3)
        done(7)
    assert told == [3, 7]


@pytest.mark.parametrize(
    ("seconds", "said"),
    [(0.5, "0.5 s"), (119.0, "119 s"), (121.0, "2 min"), (7200.0, "2 h"), (9e5, "10 days")],
)
def test_durations(seconds: float, said: str) -> None:
    assert duration(seconds) == said


def test_rates() -> None:
    assert [rate(speed) for speed in (0.0123, 7.126, 99.4, 174_321.0)] == [
        "0.0123/s", "7.13/s", "99.4/s", "174,321/s",
    ]  # fmt: skip


def test_a_watcher_is_told_how_much_there_is() -> None:
    """Once: what runs as a part of the work tells no total of its own."""
    told: list[tuple[str, int]] = []

    class Watch:
        def expect(self, total: int) -> None:
            told.append(("expect", total))

        def done(self, more: int) -> None:
            told.append(("done", more))

    with meter("all", 10, Watch()) as done, meter("a part", 4, done) as part:
        part(4)
    assert told == [("expect", 10), ("done", 4)]


def test_no_more_is_told_than_was_foreseen_and_all_of_it_in_the_end() -> None:
    told: list[int] = []
    short, long = AtMost(10, told.append), AtMost(7, told.append)
    for more in (3, 4):
        short(more)
    short.end()
    assert told == [3, 4, 3]
    for more in (5, 6, 2):
        long(more)
    long.end()
    assert told[3:] == [5, 2]
