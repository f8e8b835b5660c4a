"""CSMIP and CESMD volumes 1 and 2 with evenly spaced values; volume 3 is refused.

A channel consists of text lines, integer and real header lines, then
" 3250 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)" and its values in
fields of nine (volume 1) or ten characters, then the same for VELOC and DISPL (volume 2), and
"/&  ----------  END OF DATA FOR CHANNEL  1". Newer files print the fields' format.
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText, match_in

_VOLUME = re.compile(r"^(UN)?CORRECTED ACCELEROGRAM\b", re.IGNORECASE)
_SPECTRA = re.compile(r"^RESPONSE AND FOURIER AMPLITUDE SPECTRA", re.IGNORECASE)
_SERIES = re.compile(
    r"^\s*(\d+)\s+POINTS OF (ACCEL|VELOC|DISPL) DATA EQUALLY SPACED AT\s*([\d.]+)\s*SEC"
    r"[.,]*\s*(?:\(UNITS:|IN)\s*([A-Z0-9/]+)",
    re.IGNORECASE,
)
_FORMAT = re.compile(r"\(8F(\d+)\.\d+\)", re.IGNORECASE)
_CHANNEL = re.compile(r"\bCHAN\s*(\d+)\s*:\s*(\d+|\w+)(?:\s*DEG)?", re.IGNORECASE)
_STATION = re.compile(r"^STATION NO\.?\s*(\S+)", re.IGNORECASE)
_LOCATION = re.compile(r"LOCATION\s*:\s*(.*\S)", re.IGNORECASE)
_FILTER = re.compile(r"^ACCELEROGRAM (BANDPASS FILTERED.*\S)", re.IGNORECASE)
_GAP = re.compile(r"\s{2,}")
_PER_LINE = 8


def recognise(text: RecordText) -> bool:
    """Whether the text is a volume 3 file, or a volume 1 or 2 file with evenly spaced values."""
    if _SPECTRA.match(text.lines[0]):
        return True
    return bool(_VOLUME.match(text.lines[0]) and match_in(_SERIES, text.lines[:100]))


def read(text: RecordText) -> list[Component]:
    """A component for each channel."""
    if _SPECTRA.match(text.lines[0]):
        raise text.no_acceleration(
            "holds response and Fourier spectra (volume 3) but no acceleration; give the volume "
            "1 or 2 file of the same record"
        )
    components = []
    for start, end in text.channels():
        at = next((n for n in range(start, end) if _is_acceleration(text.lines[n])), None)
        if at is not None:
            components.append(_component(text, start, at))
    if not components:
        raise text.no_acceleration("holds no series of acceleration")
    return components


def _is_acceleration(line: str) -> bool:
    series = _SERIES.match(line)
    return bool(series and series.group(2).upper() == "ACCEL")


def _component(text: RecordText, header: int, at: int) -> Component:
    head = text.lines[header:at]
    series = _SERIES.match(text.lines[at])
    assert series is not None
    count, step = int(series.group(1)), text.number(series.group(3), at + 1)
    stated = _FORMAT.search(text.lines[at])
    first = text.lines[at + 1].rstrip() if at + 1 < len(text.lines) else ""
    width = int(stated.group(1)) if stated else len(first) // _PER_LINE
    if not 6 <= width <= 20:
        raise text.fault(f"expected a row of {_PER_LINE} numbers, found {first[:60]!r}", at + 2)
    values, _ = text.fixed(at + 1, count, width, last=True)
    channel = match_in(_CHANNEL, head)
    code = channel.group(2) if channel else ""
    text.require_count(count, len(values), f"values of channel {code or len(head)}")
    raw = bool(_VOLUME.match(head[0]) and head[0].upper().startswith("UN"))
    location, filtered = match_in(_LOCATION, head), match_in(_FILTER, head)
    return Component(
        acceleration=np.array(values) * text.factor(series.group(4), f"line {at + 1}"),
        time_step=text.step(step, at + 1),
        code=code,
        uncorrected=raw,
        channel=int(channel.group(1)) if channel else None,
        station=_station(head),
        event=_event(head, raw),
        location=location.group(1) if location else "",
        processing=(filtered.group(1).strip(),) if filtered else (),
    )


def _station(head: list[str]) -> str:
    """Station number and name; the name is on the line after the number."""
    for n, line in enumerate(head[:-1]):
        found = _STATION.match(line)
        if found:
            return f"{found.group(1)} {head[n + 1][:40].strip()}"
    return ""


def _event(head: list[str], raw: bool) -> str:
    """Event name and time: lines 3 and 4 of a volume 2 file, 2 and 3 of a volume 1 file."""
    first = 1 if raw else 2
    lines = [_GAP.split(line.strip())[0] for line in head[first : first + 2]]
    return lines[0] if "RECORD OF" in lines[0].upper() else " ".join(lines)
