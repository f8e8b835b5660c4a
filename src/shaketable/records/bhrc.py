"""BHRC (Iran) V1: three channels that end with "/&", evenly spaced values in g/10."""

from __future__ import annotations

import re

from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.numbers import free
from shaketable.records.stated import require_count, require_duration
from shaketable.records.text import RecordText
from shaketable.records.volumes import channels

_UNITS = re.compile(r"^UNITS ARE SECONDS AND (\S+)", re.IGNORECASE)
_COUNT = re.compile(r"NO\. OF POINTS\s*=\s*(\S+)\s+DURATION\s*=\s*(\S+)", re.IGNORECASE)
_COMPONENT = re.compile(r"^COMP\s+([LTV]\w*)", re.IGNORECASE)
_PLACE = re.compile(r"^(.*?)\s+Station\b.*Azimuth L\s*(\d{1,3})\s*T\s*(\d{1,3})\b", re.IGNORECASE)
_ORIGIN = re.compile(r"^Origin Time\s*:\s*(\S.*)", re.IGNORECASE)
_INTEGERS, _REALS = 7, 7  # lines of the header's numbers, after the text
_RATE = 6  # index of the sampling rate among the reals
_CHANNELS = 3
_ROUNDING = 0.001  # s: durations are printed with three decimals


def recognise(text: RecordText) -> bool:
    """Whether the text has BHRC's header."""
    return text.lines[0].startswith("* VOL1DS") and text.search(_UNITS, 0, 30) is not None


def read(text: RecordText) -> list[Component]:
    """The longitudinal, vertical and transverse components."""
    components = [_component(text, start, end) for start, end in channels(text)]
    text.warn_if_cut(len(components), _CHANNELS)
    return components


def _component(text: RecordText, start: int, end: int) -> Component:
    units = text.search(_UNITS, start, end)
    if units is None:
        raise text.fault(tell("a channel has no UNITS line"), start + 1)
    at = units.line
    if text.search(_UNITS, at, end):
        raise text.fault(
            tell("a second series begins within a channel: its end '/&' is damaged"), at
        )
    stated, code = text.search(_COUNT, start, at), text.word(_COMPONENT, start, at)
    if stated is None or not code:
        raise text.fault(tell("a channel has no NO. OF POINTS or no COMP"), start + 1)
    points, duration = text.whole(*stated.word(1)), text.number(*stated.word(2))
    begin = at + (not text.lines[at].strip())
    reals = free(text, text.rows(begin + _INTEGERS, begin + _INTEGERS + _REALS))
    found = free(text, text.rows(begin + _INTEGERS + _REALS, end), count=points)
    require_count(text, points, found.values.size, f"values of component {code}")
    step = text.step(duration / points, stated.line)
    rate = float(reals.values[_RATE])
    if rate > 0.0:  # given twice: held against each other
        require_duration(text, duration, stated.line, points, 1.0 / rate, within=_ROUNDING)
    place = text.search(_PLACE, start, at)
    azimuths = {"L": place.match.group(2), "T": place.match.group(3)} if place else {}
    azimuth = azimuths.get(code[0])
    return Component(
        acceleration=found.values * text.factor(units.match.group(1), "the header"),
        time_step=step,
        code=code,
        azimuth=None if azimuth is None else float(azimuth),
        uncorrected=True,
        station=f"{text.path.stem.partition('-')[0]} {text.word(_PLACE, start, at)}".strip(),
        event=text.word(_ORIGIN, 0, 10),
        lines=found.lines,
    )
