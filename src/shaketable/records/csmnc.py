"""CSMNC (China): 16 lines of text and one component, in cm/s², as many values a line as fit."""

from __future__ import annotations

import re

from shaketable.language import tell
from shaketable.records.columns import numeric
from shaketable.records.component import Component
from shaketable.records.numbers import free
from shaketable.records.stated import OFFSET_SHARE, require_count, require_peak
from shaketable.records.text import RecordText

_COUNT = re.compile(
    r"^NO\. OF POINTS:\s*(\S+)\s+EQUALLY SPACED INTERVALS OF:\s*(\S+)\s*SEC", re.IGNORECASE
)
_UNIT = re.compile(r"^(UN)?CORRECTED ACCELERATION\s+UNIT:\s*(\S+)", re.IGNORECASE)
_PEAK = re.compile(r"^PEAK VALUE:\s*(\S+)", re.IGNORECASE)
_COMPONENT = re.compile(r"^COMP\.?\s*(\S+)", re.IGNORECASE)
_STATION = re.compile(r"^STATION:\s*(\S+)", re.IGNORECASE)
_MAGNITUDE = re.compile(r"^MAGNITUDE\s+(\d\S*?)\(", re.IGNORECASE)
_HEADER_LINES = 30


def recognise(text: RecordText) -> bool:
    """Whether the header announces values as CSMNC does."""
    return text.search(_COUNT, 0, _HEADER_LINES) is not None


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    stated = text.search(_COUNT, 0, _HEADER_LINES)
    unit = text.search(_UNIT, 0, _HEADER_LINES)
    if stated is None or unit is None:
        raise text.fault(tell("the header has no line '… ACCELERATION  UNIT: …'"))
    count, step = text.whole(*stated.word()), text.step(text.number(*stated.word(2)), stated.line)
    start = next(
        (n for n, line in text.rows(stated.line) if line.strip() and numeric(line.strip())),
        len(text.lines) + 1,
    )
    found = free(text, text.rows(start - 1), count=count)
    require_count(text, count, found.values.size)
    peak = text.search(_PEAK, 0, _HEADER_LINES)
    if peak:
        require_peak(text, *peak.word(), found.values, share=OFFSET_SHARE)
    magnitude = text.search(_MAGNITUDE, 0, _HEADER_LINES)
    return [
        Component(
            acceleration=found.values * text.factor(unit.match[2], tell("the header")),
            time_step=step,
            code=text.word(_COMPONENT, 0, _HEADER_LINES),
            uncorrected=unit.match[1] is not None,
            station=text.word(_STATION, 0, _HEADER_LINES),
            event=" ".join(text.lines[2].split()),
            magnitude=text.number(*magnitude.word()) if magnitude else None,
            lines=found.lines,
        )
    ]
