"""PEER NGA AT2 files, in the header layouts of all their years.

New:  NPTS=   5435, DT=   .0100 SEC, ...      Old:     4000    .0050    NPTS, DT
Velocity and displacement files (.VT2, .DT2) look the same and are refused.
"""

from __future__ import annotations

import logging
import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText

log = logging.getLogger(__name__)

HEADER_LINES = 12  # at most, blank lines included
ROW = 8  # values in the longest row: a header's count may be off by this with no data lost

_NUMBER = r"([-+]?\d*\.?\d+(?:[EeDd][-+]?\d+)?)"
_NEW_STEP = re.compile(rf"\bDT\s*=\s*{_NUMBER}", re.IGNORECASE)
_NEW_COUNT = re.compile(r"\bNPTS\s*=\s*(\d+)", re.IGNORECASE)
_OLD = re.compile(rf"^\s*(\d+)\s+{_NUMBER}\s+NPTS\s*,\s*DT\b", re.IGNORECASE)
_UNITS = re.compile(r"UNITS\s+(?:OF|ARE)\s+\(?\s*([A-Z0-9/^²*]+)", re.IGNORECASE)
_OTHER_SERIES = re.compile(r"\b(VELOCITY|DISPLACEMENT)\s+TIME", re.IGNORECASE)


def recognise(text: RecordText) -> bool:
    """Whether the text is an AT2 file, or a VT2 or DT2 file."""
    if text.path.suffix.lower() in (".at2", ".vt2", ".dt2"):
        return True
    return any(_steps(line) for line in text.lines[:HEADER_LINES])


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    header = text.lines[:HEADER_LINES]
    joined = "\n".join(header)
    twin = _OTHER_SERIES.search(joined)
    if twin or text.path.suffix.lower() in (".vt2", ".dt2"):
        kind = twin.group(1).lower() if twin else "velocity or displacement"
        raise text.no_acceleration(f"holds a {kind} series; an acceleration (.AT2) is needed")
    at = next((n for n, line in enumerate(header) if _steps(line)), None)
    if at is None:
        raise text.fault(
            f"no time step (DT=) in the first {HEADER_LINES} lines; is this a PEER AT2 file?"
        )
    count, step = _count_and_step(text, header[at], at + 1)
    units = _UNITS.search(joined)
    factor = text.factor(units.group(1) if units else None, "the header")
    values = _values(text, at + 1, count)
    _check_count(text, count, len(values))
    event, station, code = _title(header[:at])
    return [
        Component(
            acceleration=np.array(values) * factor,
            time_step=step,
            code=code,
            station=station,
            event=event,
        )
    ]


def _steps(line: str) -> bool:
    return bool(_NEW_STEP.search(line) or _OLD.search(line))


def _count_and_step(text: RecordText, line: str, number: int) -> tuple[int | None, float]:
    old = _OLD.search(line)
    count: int | None
    if old:
        count, step = int(old.group(1)), text.number(old.group(2), number)
    else:
        new = _NEW_STEP.search(line)
        stated = _NEW_COUNT.search(line)
        count = int(stated.group(1)) if stated else None
        step = text.number(new.group(1), number) if new else 0.0
    return count, text.step(step, number)


def _values(text: RecordText, start: int, count: int | None) -> list[float]:
    """The numbers from line `start` on, up to a closing line of text ("*** End data ***")."""
    values: list[float] = []
    first, last = "", ("", 0)
    for number, line in enumerate(text.lines[start:], start + 1):
        if line.startswith("*") or (len(values) == count and not line[:1].isspace()):
            break
        words = line.split()
        values.extend(text.number(word, number) for word in words)
        if words:
            first, last = first or words[0], (words[-1], number)
    if values:
        text.require_last(first, *last)
    return values


def _check_count(text: RecordText, stated: int | None, found: int) -> None:
    if found < 2:
        raise text.fault(f"holds {found} values; at least 2 are needed")
    if stated is None:
        log.warning("%s: the header has no NPTS; %d values read", text.path, found)
    elif found < stated - ROW:
        raise text.fault(f"cut short: the header says NPTS = {stated}, found {found} values")
    elif found != stated:
        log.warning("%s: the header says NPTS = %d, %d values read", text.path, stated, found)


def _title(header: list[str]) -> tuple[str, str, str]:
    """Event, station and component code from the header's title, as far as it gives them."""
    lines = [line.strip() for line in header if line.strip()]
    lines = [line for line in lines if "PEER" not in line.upper() and "UNITS" not in line.upper()]
    parts = [part.strip() for part in lines[0].split(",")] if lines else []
    if len(parts) < 4:
        return ", ".join(parts), "", ""
    return f"{parts[0]} {parts[1]}", ", ".join(parts[2:-1]), parts[-1]
