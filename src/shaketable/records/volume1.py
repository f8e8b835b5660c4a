"""Volume 1 files of (time, value) pairs in s and g/10: RENADIC, USC, and early CDMG.

A channel is a text header with "UNITS ... ARE SEC AND G/10", 100 integers, 50 reals and then ten
numbers a line in fields of seven characters that may touch: time, value, time, value ...
RENADIC and CDMG end a channel with "/&"; USC has one channel a file.
"""

from __future__ import annotations

import logging
import re

import numpy as np

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.numbers import Numbers, fixed
from shaketable.records.stated import require_count, require_peak
from shaketable.records.text import RecordText
from shaketable.records.uneven import resampled
from shaketable.records.volumes import channels, station_of, warn_if_fewer

log = logging.getLogger(__name__)

_UNITS = re.compile(r"UNITS\b.*\bSEC AND G/10", re.IGNORECASE)
_COUNT = re.compile(r"NO\. OF POINTS\s*=\s*(\S+)", re.IGNORECASE)
_LENGTH = re.compile(r"(?:RECORD LENGTH|DURATION)\s*=\s*(\S+)\s*SEC", re.IGNORECASE)
_PEAK = re.compile(r"UNITS\b.*\bMAX\s*=\s*(\S+)\s*G\b", re.IGNORECASE)
_CHANNEL = re.compile(r"^(?:CHAN\s*(\d+):|COMP)\s+(\S+)", re.IGNORECASE)
_NAME = re.compile(r"^STATION (?:USC#|NO\.)\s*(\d+(?!\S))?", re.IGNORECASE)
_PART = re.compile(r"part[e]?\s*_?(\d)", re.IGNORECASE)
_NUMERIC_LINE = re.compile(r"^[\s\d.+-]+$")
_FIELD = 7
_ROUNDING = 0.05  # s: of a header's record length
_EVEN = 1e-6  # s: times are printed with three decimals
_HEADER_LINES = 40
#: The recorder's clock is a channel, too.
_CLOCK = "INTC"


def recognise(text: RecordText) -> bool:
    """Whether the header says that pairs in s and g/10 follow."""
    return text.search(_UNITS, 0, _HEADER_LINES) is not None


def read(text: RecordText) -> list[Component]:
    """A component for each channel that is not the recorder's clock."""
    part = _PART.search(text.path.stem)
    if part:
        log.warning(
            "%s: part %s of a record; the motion may go on in another", text.path, part.group(1)
        )
    found = [_component(text, start, end) for start, end in channels(text, ended=False)]
    warn_if_fewer(text, len(found), 0, _HEADER_LINES)
    return [one for one in found if one.code != _CLOCK]


def _component(text: RecordText, start: int, end: int) -> Component:
    # a title may be a number, too
    units = text.search(_UNITS, start, end)
    titled = units.line if units else start
    stop = next((n for n in range(titled, end) if _NUMERIC_LINE.match(text.lines[n])), end)
    stated = text.search(_COUNT, start, stop)
    if stated is None:
        raise text.fault(tell("the header has no NO. OF POINTS"), start + 1)
    pairs = text.whole(*stated.word())
    data = _data_line(text, stop, end)
    margin = len(text.lines[data].rstrip()) % _FIELD
    found, after = fixed(text, data, 2 * pairs, _FIELD, margin, final=True)
    require_count(text, pairs, found.values.size // 2, "pairs")
    beyond = text.after(after, end)
    if beyond is not None:
        raise text.fault(
            tell(
                "expected the channel's end '/&', found {found}", found=quoted(text.lines[beyond])
            ),
            beyond + 1,
        )
    _require_stated(text, start, stop, found)
    time, series = found.values[: 2 * pairs].reshape(-1, 2).T
    lines = found.lines[1 : 2 * pairs : 2]
    done: tuple[str, ...] = ()
    steps = np.diff(time)
    if np.ptp(steps) < _EVEN:
        step = text.step(float(time[-1] - time[0]) / (pairs - 1))
    else:
        even = resampled(text, time, series, lines, spliced=True)
        series, step, lines, done = even.values, even.step, even.lines, (even.said,)
    channel = text.search(_CHANNEL, start, stop)
    numbered = channel is not None and channel.match.group(1)
    return Component(
        acceleration=series * text.factor("g/10", "the header"),
        time_step=step,
        code=channel.match.group(2) if channel else "",
        start=float(time[0]),
        uncorrected=True,
        channel=text.whole(*channel.word()) if channel and numbered else None,
        station=station_of(text, _NAME, start, stop),
        event=" ".join(line[:40].strip() for line in text.lines[start + 1 : start + 3]),
        processing=done,
        lines=lines,
    )


def _require_stated(text: RecordText, start: int, stop: int, found: Numbers) -> None:
    """Hold the length and the largest value, where the header states them, against the pairs."""
    time, series = found.values[::2], found.values[1::2]
    length = text.search(_LENGTH, start, stop)
    if length:
        stated = text.number(*length.word())
        lasts = float(time[-1] - time[0])
        if abs(lasts - stated) > _ROUNDING + float(np.diff(time).max()):
            raise text.fault(
                tell(
                    "the header says a length of {stated:g} s, the times cover {lasts:g} s",
                    stated=stated,
                    lasts=lasts,
                ),
                length.line,
            )
    peak = text.search(_PEAK, start, stop)
    if peak:
        require_peak(text, *peak.word(), series, per=10.0, what="pairs")


def _data_line(text: RecordText, start: int, end: int) -> int:
    """The index of the first line of pairs, after 100 integers and 50 reals."""
    integers = reals = 0
    for n in range(start, end):
        line = text.lines[n].rstrip()
        if integers < 100:
            integers += -(-len(line) // 5)
        elif reals < 50:
            reals += -(-len(line) // 10)
        else:
            return n
    raise text.fault(tell("the header ends without values"), min(start, len(text.lines) - 1) + 1)
