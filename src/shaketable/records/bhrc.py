"""BHRC (Iran) V1: three channels that end with "/&", evenly spaced values in g/10."""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText, match_in

_UNITS = re.compile(r"^UNITS ARE SECONDS AND (\S+)", re.IGNORECASE)
_COUNT = re.compile(r"NO\. OF POINTS\s*=\s*(\d+)\s+DURATION\s*=\s*([\d.]+)", re.IGNORECASE)
_COMPONENT = re.compile(r"^COMP\s+(\w+)", re.IGNORECASE)
_PLACE = re.compile(r"^(.*?)\s+Station\b.*Azimuth L\s*(\d+)\s*T\s*(\d+)", re.IGNORECASE)
_ORIGIN = re.compile(r"^Origin Time\s*:\s*(.*\S)", re.IGNORECASE)
_HEADER_NUMBERS = 14  # lines of integers and reals after the text


def recognise(text: RecordText) -> bool:
    """Whether the text has BHRC's header."""
    return text.lines[0].startswith("* VOL1DS") and bool(match_in(_UNITS, text.lines[:30]))


def read(text: RecordText) -> list[Component]:
    """The longitudinal, vertical and transverse components."""
    return [_component(text, start, end) for start, end in text.channels()]


def _component(text: RecordText, start: int, end: int) -> Component:
    at = next((n for n in range(start, end) if _UNITS.match(text.lines[n])), None)
    if at is None:
        raise text.fault("a channel has no UNITS line", start + 1)
    head = text.lines[start:at]
    count, word, place = match_in(_COUNT, head), match_in(_COMPONENT, head), match_in(_PLACE, head)
    if count is None or word is None:
        raise text.fault("a channel has no NO. OF POINTS or no COMP", start + 1)
    points = int(count.group(1))
    units = _UNITS.match(text.lines[at])
    begin = at + 1 + _HEADER_NUMBERS + (not text.lines[at + 1].strip())
    values = text.words((n + 1, text.lines[n]) for n in range(begin, end))
    code = word.group(1)
    text.require_count(points, len(values), f"values of component {code}")
    azimuths = {"L": place.group(2), "T": place.group(3)} if place else {}
    azimuth = azimuths.get(code[0])
    origin = match_in(_ORIGIN, text.lines[:10])
    return Component(
        acceleration=np.array(values) * text.factor(units and units.group(1), "the header"),
        time_step=text.step(float(count.group(2)) / points),
        code=code,
        azimuth=None if azimuth is None else float(azimuth),
        uncorrected=True,
        station=f"{text.path.stem.partition('-')[0]} {place.group(1) if place else ''}".strip(),
        event=origin.group(1) if origin else "",
    )
