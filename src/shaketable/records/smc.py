"""USGS SMC: 11 text lines, 48 integers, 50 reals, comments with "|", values of 10 characters.

Uncorrected records without a sampling rate hold (time, value) pairs.
https://www.usgs.gov/data-format-smc (Volumes: 1 uncorrected, 2 corrected acceleration, 3 velocity,
4 displacement, 5 and 6 spectra.)
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText, match_in
from shaketable.records.uneven import resampled

_TITLE = re.compile(r"^\s*([0-6]) +(?:UN)?(?:CORRECTED|VELOCITY|DISPLACEMENT|RESPONSE|FOURIER)")
_STATION = re.compile(r"^station\s*=\s*(.*?)\s*component\s*=\s*(\S+)", re.IGNORECASE)
_SAID = re.compile(r"^\|\s*(.*\S)")
_TEXT_LINES, _HEADER_LINES = 11, 27
_COUNT, _COMMENTS, _NO_INTEGER = 16, 15, -32768
_RATE, _NO_REAL = 1, 1e38
_FIELD = 10


def recognise(text: RecordText) -> bool:
    """Whether the first line is a volume's title."""
    return bool(_TITLE.match(text.lines[0])) and len(text.lines) > _HEADER_LINES


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    volume = text.lines[0].split()[0]
    if volume not in "012":
        raise text.no_acceleration(
            f"holds {text.lines[0].strip().lower()!r}; an acceleration is needed"
        )
    integers, at = text.fixed(_TEXT_LINES, 48, 10)
    reals, at = text.fixed(at, 50, 15)
    if len(integers) < 48 or len(reals) < 50:
        raise text.fault("the header is cut short: 48 integers and 50 reals are expected")
    while at < len(text.lines) and text.lines[at].startswith("|"):
        at += 1
    count = int(integers[_COUNT])
    head = text.lines[:_TEXT_LINES]
    done: tuple[str, ...] = ()
    start = 0.0
    if abs(reals[_RATE]) >= _NO_REAL:
        values, _ = text.fixed(at, 2 * count, _FIELD, last=True)
        text.require_count(count, len(values) // 2, "pairs")
        time, series = np.array(values).reshape(-1, 2).T
        lines = [at + 1 + n // 4 for n in range(count)]
        series, step, said = resampled(text, time, series, lines)
        done, start = (said,), float(time[0])
    else:
        values, _ = text.fixed(at, count, _FIELD, last=True)
        text.require_count(count, len(values))
        series, step = np.array(values), text.step(1.0 / reals[_RATE] if reals[_RATE] else 0.0)
    station = match_in(_STATION, head)
    code = station.group(2) if station else ""
    return [
        Component(
            acceleration=series * text.factor("cm/s2", "the format"),
            time_step=step,
            code=code,
            start=start,
            uncorrected=volume in "01",
            station=station.group(1).rstrip(", ") if station else "",
            event=" ".join(head[3].split()),
            processing=(head[0].split(maxsplit=1)[1].strip().lower(), *done),
        )
    ]
