"""BHRC (Iran) V1: three channels that end with "/&", evenly spaced values in g/10."""

from __future__ import annotations

import re

from shaketable.records.component import Component
from shaketable.records.numbers import require_count, require_duration, words
from shaketable.records.text import RecordText, match_in

_UNITS = re.compile(r"^UNITS ARE SECONDS AND (\S+)", re.IGNORECASE)
_COUNT = re.compile(r"NO\. OF POINTS\s*=\s*(\S+)\s+DURATION\s*=\s*(\S+)", re.IGNORECASE)
_COMPONENT = re.compile(r"^COMP\s+(\w+)", re.IGNORECASE)
_PLACE = re.compile(r"^(.*?)\s+Station\b.*Azimuth L\s*(\d{1,3})\s*T\s*(\d{1,3})\b", re.IGNORECASE)
_ORIGIN = re.compile(r"^Origin Time\s*:\s*(\S.*)", re.IGNORECASE)
_INTEGERS, _REALS = 7, 7  # lines of the header's numbers, after the text
_RATE = 6  # index of the sampling rate among the reals
_CHANNELS = 3


def recognise(text: RecordText) -> bool:
    """Whether the text has BHRC's header."""
    return text.lines[0].startswith("* VOL1DS") and bool(match_in(_UNITS, text.lines[:30]))


def read(text: RecordText) -> list[Component]:
    """The longitudinal, vertical and transverse components."""
    components = [_component(text, start, end) for start, end in text.channels()]
    text.expect_components(len(components), _CHANNELS)
    return components


def _component(text: RecordText, start: int, end: int) -> Component:
    units = text.search(_UNITS, start, end)
    if units is None:
        raise text.fault("a channel has no UNITS line", start + 1)
    at = units[1]
    if text.search(_UNITS, at, end):
        raise text.fault("a second series begins within a channel: its end '/&' is damaged", at)
    head = text.lines[start:at]
    stated, word = text.search(_COUNT, start, at), match_in(_COMPONENT, head)
    if stated is None or word is None:
        raise text.fault("a channel has no NO. OF POINTS or no COMP", start + 1)
    (count, line), code, place = stated, word.group(1), match_in(_PLACE, head)
    points, duration = text.whole(count.group(1), line), text.number(count.group(2), line)
    begin = at + (not text.lines[at].strip())
    reals = words(text, _rows(text, begin + _INTEGERS, begin + _INTEGERS + _REALS))
    found = words(text, _rows(text, begin + _INTEGERS + _REALS, end), count=points)
    require_count(text, points, found.values.size, f"values of component {code}")
    step = text.step(duration / points, line)
    rate = float(reals.values[_RATE])
    if rate > 0.0:  # given twice: held against each other
        require_duration(text, duration, line, points, 1.0 / rate, within=0.001)
    azimuths = {"L": place.group(2), "T": place.group(3)} if place else {}
    azimuth = azimuths.get(code[0])
    origin = match_in(_ORIGIN, text.lines[:10])
    return Component(
        acceleration=found.values * text.factor(units[0].group(1), "the header"),
        time_step=step,
        code=code,
        azimuth=None if azimuth is None else float(azimuth),
        uncorrected=True,
        station=f"{text.path.stem.partition('-')[0]} {place.group(1) if place else ''}".strip(),
        event=origin.group(1).strip() if origin else "",
        lines=found.lines,
    )


def _rows(text: RecordText, start: int, stop: int) -> list[tuple[int, str]]:
    return list(enumerate(text.lines[start:stop], start + 1))
