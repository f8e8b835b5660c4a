"""USGS SMC: 11 text lines, 48 integers, 50 reals, comments with "|", values of 10 characters.

Uncorrected records without a sampling rate hold (time, value) pairs.
https://www.usgs.gov/data-format-smc (Volumes: 1 uncorrected, 2 corrected acceleration, 3 velocity,
4 displacement, 5 and 6 spectra.)
"""

from __future__ import annotations

import re

from shaketable.errors import quoted
from shaketable.records.component import Component
from shaketable.records.numbers import (
    fixed,
    require_count,
    require_peak,
    require_peak_time,
)
from shaketable.records.text import RecordText, match_in
from shaketable.records.uneven import resampled

_TITLE = re.compile(r"^\s*([0-6]) +(?:UN)?(?:CORRECTED|VELOCITY|DISPLACEMENT|RESPONSE|FOURIER)")
_STATION = re.compile(r"^station\s*=\s*(.*?)\s*component\s*=\s*(\S+)", re.IGNORECASE)
_TEXT_LINES, _HEADER_LINES = 11, 27
_COUNT = 16  # index among the integers
_RATE, _EXTREMES = 1, (29, 31)  # indices among the reals; before an extreme stands its time
_NO_REAL = 1e38
_FIELD = 10


def recognise(text: RecordText) -> bool:
    """Whether the first line is a volume's title."""
    return bool(_TITLE.match(text.lines[0])) and len(text.lines) > _HEADER_LINES


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    volume = text.lines[0].split()[0]
    if volume not in "012":
        raise text.no_acceleration(
            f"holds {quoted(text.lines[0].strip().lower())}; an acceleration is needed"
        )
    integers, at = fixed(text, _TEXT_LINES, 48, 10)
    reals, at = fixed(text, at, 50, 15)
    if integers.values.size < 48 or reals.values.size < 50:
        raise text.fault("the header is cut short: 48 integers and 50 reals are expected")
    while at < len(text.lines) and text.lines[at].startswith("|"):
        at += 1
    count, rate = int(integers.values[_COUNT]), float(reals.values[_RATE])
    head = text.lines[:_TEXT_LINES]
    done: tuple[str, ...] = ()
    start = 0.0
    if abs(rate) >= _NO_REAL:
        found, _ = fixed(text, at, 2 * count, _FIELD, last=True, ragged=True)
        require_count(text, count, found.values.size // 2, "pairs")
        time, series = found.values.reshape(-1, 2).T
        lines = found.lines[1::2]
        even = resampled(text, time, series, lines)
        values, step, lines = even.values, even.step, even.lines
        done, start = (even.said,), float(time[0])
    else:
        found, _ = fixed(text, at, count, _FIELD, last=True)
        require_count(text, count, found.values.size)
        values, series, lines = found.values, found.values, found.lines
        step = text.step_of_rate(rate, int(reals.lines[_RATE]))
    extremes = [n for n in _EXTREMES if abs(reals.values[n]) < _NO_REAL]
    if extremes:
        largest = max(extremes, key=lambda n: abs(reals.values[n]))
        line, word = int(reals.lines[largest]), f"{reals.values[largest]:.5e}"
        require_peak(text, word, line, series)
        if not done:
            require_peak_time(text, float(reals.values[largest - 1]), line, series, step)
    station = match_in(_STATION, head)
    code = station.group(2) if station else ""
    return [
        Component(
            acceleration=values * text.factor("cm/s2", "the format"),
            time_step=step,
            code=code,
            start=start,
            uncorrected=volume in "01",
            station=station.group(1).rstrip(", ") if station else "",
            event=" ".join(head[3].split()),
            processing=(head[0].split(maxsplit=1)[1].strip().lower(), *done),
            lines=lines,
        )
    ]
