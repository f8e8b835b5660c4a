"""PEER NGA AT2 files, in the header layouts of all their years.

New:  NPTS=   5435, DT=   .0100 SEC, ...      Old:     4000    .0050    NPTS, DT
Rotated components ("PEER NGA Rotated Accelerogram") have the old layout and "Accelerations in g".
Velocity and displacement files (.VT2, .DT2) look the same and are refused.
"""

from __future__ import annotations

import logging
import re

from shaketable.inputs import NUMBER
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.numbers import Numbers, free
from shaketable.records.stated import require_count, require_two
from shaketable.records.text import HEADER_WIDTH, RecordText

log = logging.getLogger(__name__)

HEADER_LINES = 12  # at most, blank lines included

_NEW_STEP = re.compile(rf"\bDT\s*=\s*({NUMBER})", re.IGNORECASE)
_NEW_COUNT = re.compile(r"\bNPTS\s*=\s*(\d+)", re.IGNORECASE)
_OLD = re.compile(rf"^\s*(\d+)[\s,]+({NUMBER})\s+NPTS\s*,\s*DT\b", re.IGNORECASE)
_POINTS = re.compile(r"^\s*(\d+)\s+points\b", re.IGNORECASE)
_UNITS = re.compile(
    r"(?:UNITS\s+(?:OF|ARE)|^\s*ACCELERATIONS?\s+IN)\s+\(?\s*([A-Z0-9/^²*]+)",
    re.IGNORECASE,
)
_ROTATED = re.compile(r"^H1 for rotation:\s*(\S.*)", re.IGNORECASE)
_ROTATED_CODE = re.compile(r"^\s*(\w+) component,\s*azimuth\s*=\s*([\d.]+)", re.IGNORECASE)
_OTHER_SERIES = re.compile(r"\b(VELOCITY|DISPLACEMENT)\s+TIME", re.IGNORECASE)


def recognise(text: RecordText) -> bool:
    """Whether the text is an AT2 file, or a VT2 or DT2 file."""
    if text.path.suffix.lower() in (".at2", ".vt2", ".dt2"):
        return True
    return any(_steps(line) for line in text.lines[:HEADER_LINES])


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    header = text.lines[:HEADER_LINES]
    twin = text.word(_OTHER_SERIES, 0, HEADER_LINES).lower()
    if twin or text.path.suffix.lower() in (".vt2", ".dt2"):
        kind = twin or "velocity or displacement"
        raise text.no_acceleration(
            tell("holds a {kind} series; an acceleration (.AT2) is needed", kind=kind)
        )
    at = next((n for n, line in enumerate(header) if _steps(line)), None)
    if at is None:
        raise text.fault(
            tell(
                "no time step (DT=) in the first {lines} lines; is this a PEER AT2 file?",
                lines=HEADER_LINES,
            )
        )
    count, step = _count_and_step(text, at)
    factor = text.factor(text.word(_UNITS, 0, HEADER_LINES) or None, "the header")
    found = _values(text, at + 1, count)
    event, station, code = _title(text.word(_ROTATED, 0, at), header[:at])
    rotated = text.search(_ROTATED_CODE, 0, at)
    return [
        Component(
            acceleration=found.values * factor,
            time_step=step,
            code=rotated.match.group(1) if rotated else code,
            azimuth=text.number(*rotated.word(2)) if rotated else None,
            station=station,
            event=event,
            lines=found.lines,
        )
    ]


def _steps(line: str) -> bool:
    line = line[:HEADER_WIDTH]
    return bool(_NEW_STEP.search(line) or _OLD.search(line))


def _count_and_step(text: RecordText, at: int) -> tuple[int | None, float]:
    """The number of values, None if the header says none, and the time step [s]."""
    line, number = text.lines[at][:HEADER_WIDTH], at + 1
    old = _OLD.search(line)
    if old:
        return text.whole(old.group(1), number), text.step(
            text.number(old.group(2), number), number
        )
    new, stated = _NEW_STEP.search(line), _NEW_COUNT.search(line)
    assert new is not None
    step = text.step(text.number(new.group(1), number), number)
    if stated is not None:
        return text.whole(stated.group(1), number), step
    if "NPTS" in line.upper():
        raise text.fault(tell("expected a count after NPTS, as in NPTS= 5435"), number)
    points = text.search(_POINTS, 0, at)
    return (None if points is None else text.whole(*points.word())), step


def _values(text: RecordText, start: int, count: int | None) -> Numbers:
    """The numbers from line `start` on, up to a closing line of text ("*** End data ***")."""
    rows = text.rows(start)
    while rows and _closes(rows[-1][1], counted=count is not None):
        rows.pop()
    found = free(text, rows, count=count)
    require_two(text, found.values.size)
    if count is None:
        log.warning("%s: the header has no NPTS; %d values read", text.path, found.values.size)
    else:
        require_count(text, count, found.values.size)
    return found


def _closes(line: str, *, counted: bool) -> bool:
    """Whether a line at the end holds no numbers: "*** End data ***", or any words where a count
    tells that none is missing."""
    start = line.strip()[:1]
    return not start or start == "*" or (counted and start.isalpha())


def _title(rotated: str, header: list[str]) -> tuple[str, str, str]:
    """Event, station and component code from the header's title, as far as it gives them."""
    lines = [line.strip() for line in header if line.strip()]
    lines = [line for line in lines if "PEER" not in line.upper() and "UNITS" not in line.upper()]
    if rotated:
        lines = [rotated]
    parts = [part.strip() for part in lines[0].split(",")] if lines else []
    if len(parts) < 4:
        return ", ".join(parts), "", ""
    return f"{parts[0]} {parts[1]}", ", ".join(parts[2:-1]), parts[-1]
