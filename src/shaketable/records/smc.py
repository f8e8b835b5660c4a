"""USGS SMC: 11 text lines, 48 integers, 50 reals, comments with "|", values of 10 characters.

Uncorrected records without a sampling rate hold (time, value) pairs.
https://www.usgs.gov/data-format-smc (Volumes: 1 uncorrected, 2 corrected acceleration, 3 velocity,
4 displacement, 5 and 6 spectra.)
"""

from __future__ import annotations

import logging
import math
import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.numbers import Numbers, fixed
from shaketable.records.stated import PEAK_SHARE, require_count, require_peak
from shaketable.records.text import RecordText
from shaketable.records.uneven import resampled

log = logging.getLogger(__name__)

_TITLE = re.compile(r"^\s*([0-6]) +(?:UN)?(?:CORRECTED|VELOCITY|DISPLACEMENT|RESPONSE|FOURIER)")
_STATION = re.compile(r"^station\s*=\s*(.*?)\s*component\s*=\s*(\S+)", re.IGNORECASE)
_TEXT_LINES, _HEADER_LINES = 11, 27
_COUNT = 16  # index among the integers
_RATE, _EXTREMES = 1, (29, 31)  # indices among the reals; before an extreme stands its time
_NO_REAL = 1e38
_FIELD = 10
_PER_LINE = 8
_BETWEEN = 0.01  # steps: a time that is stated to seven digits is nearer to a value's time


class _Series(NamedTuple):
    """Values at even steps.

    Attributes:
        values: shape (n,).
        as_read: those in the file, shape (m,).
        step: [s].
        lines: the line of each, (n,).
        start: time of the first [s].
        done: what was done to those in the file, in words.
    """

    values: NDArray[np.float64]
    as_read: NDArray[np.float64]
    step: float
    lines: NDArray[np.int32]
    start: float = 0.0
    done: tuple[str, ...] = ()


def recognise(text: RecordText) -> bool:
    """Whether the first line is a volume's title."""
    return bool(_TITLE.match(text.lines[0])) and len(text.lines) > _HEADER_LINES


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    volume = text.lines[0].split()[0]
    if volume not in "012":
        raise text.no_acceleration(
            tell(
                "holds {found}; an acceleration is needed",
                found=quoted(text.lines[0].strip().lower()),
            )
        )
    integers, at = fixed(text, _TEXT_LINES, 48, 10)
    require_count(text, 48, integers.values.size, "whole numbers of the header")
    reals, at = fixed(text, at, 50, 15)
    require_count(text, 50, reals.values.size, "reals of the header")
    while at < len(text.lines) and text.lines[at].startswith("|"):
        at += 1
    count = int(integers.values[_COUNT])
    uneven = abs(reals.values[_RATE]) >= _NO_REAL
    series = _uneven(text, at, count) if uneven else _even(text, at, count, reals)
    _require_extreme(text, reals, series, timed=not uneven)
    station = text.search(_STATION, 0, _TEXT_LINES)
    return [
        Component(
            acceleration=series.values * text.factor("cm/s2", "the format"),
            time_step=series.step,
            code=station.match.group(2) if station else "",
            start=series.start,
            uncorrected=volume in "01",
            station=station.match.group(1).rstrip(", ") if station else "",
            event=" ".join(text.lines[3].split()),
            processing=(text.lines[0].split(maxsplit=1)[1].strip().lower(), *series.done),
            lines=series.lines,
        )
    ]


def _even(text: RecordText, at: int, count: int, reals: Numbers) -> _Series:
    """Values at a sampling rate, from index `at` on."""
    found, _ = fixed(text, at, count, _FIELD, final=True)
    require_count(text, count, found.values.size)
    step = text.step_of_rate(float(reals.values[_RATE]), int(reals.lines[_RATE]))
    return _Series(found.values, found.values, step, found.lines)


def _uneven(text: RecordText, at: int, count: int) -> _Series:
    """(time, value) pairs, from index `at` on.

    The header counts pairs, or their numbers; then numbers that fill the last line may follow.
    """
    found, _ = fixed(text, at, 2 * count, _FIELD, final=True, ragged=True)
    pairs = found.values.size // 2
    if count % 2 == 0 and _are_numbers(found.values, count):
        log.warning(
            "%s: the header's count of %d is taken as one of numbers: %d pairs",
            text.path,
            count,
            count // 2,
        )
        pairs = count // 2
    else:
        require_count(text, count, pairs, "pairs")
    time, values = found.values[: 2 * pairs].reshape(-1, 2).T
    even = resampled(text, time, values, found.lines[1 : 2 * pairs : 2])
    return _Series(even.values, values, even.step, even.lines, float(time[0]), (even.said,))


def _are_numbers(found: NDArray[np.float64], count: int) -> bool:
    """Whether a count is one of numbers: time goes on up to it and, in what fills a line, not."""
    fill = found[count:]
    if not 0 <= fill.size <= _PER_LINE or found.size < count:
        return False
    return fill.size == 0 or float(fill[0]) <= float(found[count - 2])


def _require_extreme(text: RecordText, reals: Numbers, series: _Series, *, timed: bool) -> None:
    """Hold the larger of the two extremes that the header states, and its time, against values."""
    stated = [n for n in _EXTREMES if abs(reals.values[n]) < _NO_REAL]
    if not stated:
        return
    largest = max(stated, key=lambda n: abs(reals.values[n]))
    line = int(reals.lines[largest])
    require_peak(text, f"{reals.values[largest]:.5e}", line, series.as_read)
    time = float(reals.values[largest - 1])
    if timed and 0.0 <= time < _NO_REAL:
        _require_peak_time(text, time, line, series.as_read, series.step)


def _require_peak_time(
    text: RecordText, stated: float, line: int, values: NDArray[np.float64], step: float
) -> None:
    """Raise an error if the largest value is not at the time [s] that the header states.

    A time between two values is warned of: the step may be a little wrong, or the time rounded.
    """
    size = np.abs(values)
    at = stated / step
    near = size[max(0, math.floor(at) - 1) : math.ceil(at) + 2]
    if near.size == 0 or near.max() < (1.0 - PEAK_SHARE) * size.max():
        raise text.fault(
            tell(
                "the header says a peak at {stated:g} s; with a time step of {step:g} s "
                "the largest value is at {at:g} s",
                stated=stated,
                step=step,
                at=np.argmax(size) * step,
            ),
            line,
        )
    if abs(at - round(at)) > _BETWEEN:
        log.warning(
            "%s, line %d: the header says a peak at %g s, which is no multiple of the time step of "
            "%g s; is one of the two damaged?",
            text.path,
            line,
            stated,
            step,
        )
