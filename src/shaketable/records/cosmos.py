"""COSMOS strong-motion data format v1.20, volumes 1 and 2, several channels in a file.

A channel consists of text lines ("... (Format v01.20 with 13 text lines)"), integer and real
headers that state their own layout, comments, and values under a line
"13400 acceleration pts, ... units=g. (02)Format=(8f9.6)".

COSMOS (2001) Strong motion data format version 1.20.
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText, match_in

_TITLE = re.compile(r"Format v\d+\.\d+ with\s+(\d+) text lines", re.IGNORECASE)
_HEADER = re.compile(
    r"^\s*(\d+) (?:Integer|Real)-header values follow on\s+(\d+) lines?,\s*"
    r"Format=\s*\(\d+[IF](\d+)",
    re.IGNORECASE,
)
_SERIES = re.compile(
    r"^\s*(\d+)\s+(\w+) pts,.*\bunits\s*=\s*([^(\s.]+).*Format\s*=\s*\(\d+F(\d+)", re.IGNORECASE
)
_CHANNEL = re.compile(r"^Sta Cha\w*:?\s*(\d+):\s*(\w+)", re.IGNORECASE)
_STATION = re.compile(r"^Statn No:\s*(.*?)\s*Code:\s*(\S+)\s+(.*\S)", re.IGNORECASE)
_LOCATION = re.compile(r"Location:\s*(.*\S)", re.IGNORECASE)
_FILTER = re.compile(r"^(Record (?:not )?filtered.*\S)", re.IGNORECASE)
_STEP_MS = 61  # index of the real header's time step


def recognise(text: RecordText) -> bool:
    """Whether the first line names the format."""
    return bool(_TITLE.search(text.lines[0]))


def read(text: RecordText) -> list[Component]:
    """A component for each channel of acceleration."""
    components = []
    kinds = set()
    head: list[str] = []
    for at, line in enumerate(text.lines):
        if _TITLE.search(line):
            head = text.lines[at : at + 40]
            start = at
        series = _SERIES.match(line)
        if not series:
            continue
        kinds.add(series.group(2).lower())
        if series.group(2).lower().startswith("accel"):
            components.append(_component(text, head, start, at, series))
    if not components:
        found = ", ".join(sorted(kinds)) or "no series"
        raise text.no_acceleration(f"holds no acceleration; found {found}")
    return components


def _component(
    text: RecordText, head: list[str], start: int, at: int, series: re.Match[str]
) -> Component:
    count, width = int(series.group(1)), int(series.group(4))
    values, _ = text.fixed(at + 1, count, width, last=True)
    channel = match_in(_CHANNEL, head)
    code = channel.group(2) if channel else ""
    text.require_count(count, len(values), f"values of channel {code}")
    station, location = match_in(_STATION, head), match_in(_LOCATION, head)
    filtered = match_in(_FILTER, head)
    return Component(
        acceleration=np.array(values) * text.factor(series.group(3), f"line {at + 1}"),
        time_step=text.step(_time_step(text, start, at)),
        code=code,
        uncorrected=head[0].upper().startswith(("UNCORRECTED", "RAW")),
        channel=int(channel.group(1)) if channel else None,
        station=f"{station.group(2)} {station.group(3)}" if station else "",
        event=" ".join(line[:40].strip() for line in head[1:2]),
        location=location.group(1) if location else "",
        processing=(filtered.group(1),) if filtered else (),
    )


def _time_step(text: RecordText, start: int, at: int) -> float:
    """The time step [s], from the second of the two headers, which holds reals."""
    headers = [(n, found) for n in range(start, at) if (found := _HEADER.match(text.lines[n]))]
    if len(headers) < 2:
        raise text.fault("no real-header values before the series", at + 1)
    n, found = headers[1]
    count, _, width = (int(group) for group in found.groups())
    values, _ = text.fixed(n + 1, count, width)
    text.require_count(count, len(values), "real-header values")
    return values[_STEP_MS] * 1e-3
