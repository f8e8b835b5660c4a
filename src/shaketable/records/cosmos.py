"""COSMOS strong-motion data format v1.20, volumes 1 and 2, several channels in a file.

A channel consists of text lines ("... (Format v01.20 with 13 text lines)"), integer and real
headers that state their own layout, comments, and values under a line
"13400 acceleration pts, ... units=g. (02)Format=(8f9.6)".

COSMOS (2001) Strong motion data format version 1.20.
"""

from __future__ import annotations

import logging
import re
from typing import NamedTuple

from shaketable.errors import quoted
from shaketable.language import tell, translated
from shaketable.records.component import Component
from shaketable.records.numbers import Numbers, fixed
from shaketable.records.stated import require_count, require_duration, require_peak
from shaketable.records.text import HEADER_WIDTH, Match, RecordText
from shaketable.records.volumes import warn_if_fewer
from shaketable.units import acceleration_factor

log = logging.getLogger(__name__)

_TITLE = re.compile(r"Format v\d+\.\d+ with\s+(\d+) text lines", re.IGNORECASE)
_HEADER = re.compile(
    r"^\s*(\d+) (Integer|Real)-header values follow on\s+(\d+) lines?\s*,\s*"
    r"Format\s*=\s*\(\d+[IFE](\d+)",
    re.IGNORECASE,
)
_COMMENTS = re.compile(r"^\s*(\d+) Comment line", re.IGNORECASE)
_SERIES = re.compile(
    r"^\s*(\d+)\s+(\w+) pts,.*\bunits\s*=\s*([^(\s.]+)"
    r".*Format\s*=\s*\(\d+[FE](\d+)",
    re.IGNORECASE,
)
_END = re.compile(r"\bEnd-of-data\b|\bEnd of data\b", re.IGNORECASE)
_CHANNEL = re.compile(r"^Sta Cha\w*:?\s*(\d+):\s*(\w+)", re.IGNORECASE)
_STATION = re.compile(r"^Statn No:\s*(.*?)\s*Code:\s*(\S+)\s+(\S.*)", re.IGNORECASE)
_LOCATION = re.compile(r"Location:\s*(\S.*)", re.IGNORECASE)
_FILTER = re.compile(r"^(Record (?:not )?filtered\b.*)", re.IGNORECASE)
_STEP_MS, _LENGTH, _PEAK = 61, 62, 63  # indices in the real header: step, length, largest value
_UNKNOWN = -999.0
_UNITS = {2: "g", 4: "cm/s2"}  # by their numbers in the integer header
_ROUNDING = 0.01  # s: lengths are printed with two or three decimals
_KINDS = {"acceleration", "accel", "velocity", "veloc", "displacement", "displ"}


class CosmosSeries(NamedTuple):
    """A channel's lines as their format has them; line numbers are counted from 1."""

    head: tuple[int, int]  # indices of the first text line and of the one after the last
    stage: float  # of processing: 0 raw, 1 uncorrected, 2 and more corrected
    unit: int  # COSMOS's number for the unit of the values
    reals: Numbers
    stated: Match  # announces the values
    values: Numbers

    @property
    def kind(self) -> str:
        return self.stated.match.group(2).lower()


def recognise(text: RecordText) -> bool:
    """Whether the first line names the format."""
    return bool(_TITLE.search(text.lines[0][:HEADER_WIDTH]))


def read(text: RecordText) -> list[Component]:
    """A component for each channel of acceleration.

    Raises:
        InputError: lines that are not where the format has them, so that no channel is lost.
    """
    series = []
    at = 0
    while text.after(at) is not None:
        one, at = _series(text, at)
        series.append(one)
    kinds = {one.kind for one in series}
    components = [_component(text, one) for one in series if one.kind.startswith("accel")]
    if not components:
        raise text.no_acceleration(
            tell("holds no acceleration; found {kinds}", kinds=", ".join(sorted(kinds)))
        )
    unknown = sorted(kinds - _KINDS)
    if unknown:
        log.warning("%s: left out, series of %s", text.path, ", ".join(map(quoted, unknown)))
    warn_if_fewer(text, len(series), *series[0].head)
    return components


def _series(text: RecordText, start: int) -> tuple[CosmosSeries, int]:
    """The channel whose title is at index `start`, and the index of the line after it."""
    while not text.lines[start].strip():
        start += 1
    title = _expected(
        text, start, _TITLE, "a channel's title (... Format v01.20 with 13 text lines)"
    )
    head = start, start + text.whole(*title.word())
    at = head[1]
    integers, at = _numbers(text, at, "Integer")
    reals, at = _numbers(text, at, "Real")
    comments = _expected(text, at, _COMMENTS, "the comments' number")
    at += 1 + text.whole(*comments.word())
    stated = _expected(text, at, _SERIES, "a series (... acceleration pts, ...)")
    count, width = text.whole(*stated.word(1)), text.whole(*stated.word(4))
    values, end = fixed(text, at + 1, count, width, final=True)
    require_count(text, count, values.values.size, f"values of the series on line {at + 1}")
    _expected(text, end, _END, "the end of the series' data")
    stage, _, unit = integers.values[:3]
    return CosmosSeries(head, float(stage), int(unit), reals, stated, values), end + 1


def _expected(text: RecordText, at: int, pattern: re.Pattern[str], what: str) -> Match:
    """The pattern's match in the line of index `at`, where the format has it."""
    if at >= len(text.lines):
        raise text.fault(tell("cut short: expected {what}", what=translated(what)), len(text.lines))
    found = text.search(pattern, at, at + 1)
    if found is None:
        raise text.fault(
            tell(
                "expected {what}, found {found}",
                what=translated(what),
                found=quoted(text.lines[at]),
            ),
            at + 1,
        )
    return found


def _numbers(text: RecordText, at: int, kind: str) -> tuple[Numbers, int]:
    """A header's values, whose announcement is at index `at`, and the index after them."""
    stated = _expected(text, at, _HEADER, f"{kind}-header values")
    other = stated.match.group(2)
    if other.lower() != kind.lower():
        raise text.fault(
            tell(
                "expected {kind}-header values, found {other}-header ones", kind=kind, other=other
            ),
            at + 1,
        )
    count, rows, width = (text.whole(*stated.word(k)) for k in (1, 3, 4))
    found, end = fixed(text, at + 1, count, width)
    require_count(text, count, found.values.size, f"{kind}-header values")
    if end != at + 1 + rows:
        raise text.fault(
            tell("says {rows} lines, found {found}", rows=rows, found=end - at - 1), at + 1
        )
    return found, end


def _component(text: RecordText, series: CosmosSeries) -> Component:
    head, found = series.head, series.values
    line = int(series.reals.lines[_STEP_MS])
    step = text.step(float(series.reals.values[_STEP_MS]) * 1e-3, line)
    lasts = float(series.reals.values[_LENGTH])
    if lasts != _UNKNOWN:
        at = int(series.reals.lines[_LENGTH])
        require_duration(text, lasts, at, found.values.size, step, within=_ROUNDING)
    peak = float(series.reals.values[_PEAK])
    if peak != _UNKNOWN:
        line = int(series.reals.lines[_PEAK])
        require_peak(text, f"{peak:.6f}", line, found.values, what="series")
    channel, station = text.search(_CHANNEL, *head), text.search(_STATION, *head)
    filtered = text.word(_FILTER, *head)
    unit, line = series.stated.word(3)
    factor = text.factor(unit, tell("line {line}", line=line))
    other = _UNITS.get(series.unit)
    if other and factor != acceleration_factor(other):
        raise text.fault(
            tell(
                "the header's units are {other}, those of the series {unit}", other=other, unit=unit
            ),
            line,
        )
    return Component(
        acceleration=found.values * factor,
        time_step=step,
        code=channel.match.group(2) if channel else "",
        uncorrected=series.stage in (0.0, 1.0),
        channel=text.whole(*channel.word()) if channel else None,
        station=f"{station.match.group(2)} {station.match.group(3).strip()}" if station else "",
        event=text.lines[head[0] + 1][:40].strip(),
        location=text.word(_LOCATION, *head),
        processing=(filtered,) if filtered else (),
        lines=found.lines,
    )
