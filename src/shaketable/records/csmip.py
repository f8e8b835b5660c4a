"""CSMIP, CESMD and USC volumes 1 and 2 with evenly spaced values; volume 3 is refused.

A channel consists of text lines, integer and real header lines, then
" 3250 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)" and its values in
fields of nine (volume 1) or ten characters, then the same for VELOC and DISPL (volume 2), and
"/&  ----------  END OF DATA FOR CHANNEL  1". Newer files print the fields' format; since 2012
volume 1 has "13200 Accelerogram points at 200 pts/sec in units of g .   Format: (8f9.6)".
A file of USC holds one channel and no end line.
"""

from __future__ import annotations

import logging
import re

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.numbers import Numbers, fixed
from shaketable.records.stated import require_count, require_peak
from shaketable.records.text import HEADER_WIDTH, Match, RecordText
from shaketable.records.volumes import channels, station_of, warn_if_fewer
from shaketable.units import acceleration_factor

log = logging.getLogger(__name__)

_VOLUME = re.compile(r"^(UN)?CORRECTED ACCELEROGRAM\b", re.IGNORECASE)
_SPECTRA = re.compile(r"^RESPONSE AND FOURIER AMPLITUDE SPECTRA", re.IGNORECASE)
#: Count, kind, time step or rate, and unit.
_SERIES = re.compile(
    r"^\s*(?P<count>\d+)\s+(?:"
    r"POINTS OF (?P<of>ACC|VEL|DIS)[A-Z]* DATA EQUALLY SPACED AT\s*(?P<step>\S+)\s*SEC"
    r"[.,]*\s*(?:\(UNITS:|IN UNITS|IN)\s*(?P<unit>[A-Z0-9/]+)"
    r"|(?P<are>ACC|VEL|DIS)[A-Z]*\s+POINTS AT\s*(?P<rate>\S+)\s*PTS/SEC\s+IN UNITS OF\s+"
    r"(?P<in>[A-Z0-9/]+))",
    re.IGNORECASE,
)
_FORMAT = re.compile(r"\(8F(\d+)\.\d+\)", re.IGNORECASE)
_USC = re.compile(r"^STATION USC#", re.IGNORECASE)
_CHANNEL = re.compile(r"\bCHAN\s*(\d+)\s*:\s*(\d+|\w+)(?:\s*DEG)?", re.IGNORECASE)
_COMPONENT = re.compile(r"^COMP\s+(\S+)", re.IGNORECASE)
_STATION = re.compile(r"^STATION (?:NO\.?|USC#)\s*(\S+)", re.IGNORECASE)
_LOCATION = re.compile(r"LOCATION\s*:\s*(\S.*)", re.IGNORECASE)
_FILTER = re.compile(r"^ACCELEROGRAM (BANDPASS FILTERED.*)", re.IGNORECASE)
_INTERVAL = re.compile(r"^AT EQUALLY-SPACED INTERVALS OF\s+(\S+)\s*SEC", re.IGNORECASE)
_RATE = re.compile(r"\bAT\s+(\S+)\s+SAMPLES/SEC", re.IGNORECASE)
_PEAK = re.compile(r"^PEAK ACCELERATION\s*=\s*(\S+)\s*CMS?/SEC/SEC", re.IGNORECASE)
_RAW_PEAK = re.compile(
    r"^UNITS OF UNCOR (?:ACCEL IS|DATA ARE SEC AND) (\w+)\s*\..*\bMAX\s*=\s*(\S+)", re.IGNORECASE
)
_GAP = re.compile(r"\s{2,}")
_PER_LINE = 8
_ROUNDING = 1e-3  # of a step: .005 s stands beside 200 samples a second


def recognise(text: RecordText) -> bool:
    """Whether the text is a volume 3 file, or a volume 1 or 2 file with evenly spaced values."""
    if _SPECTRA.match(text.lines[0]):
        return True
    return _is_volume(text) and text.search(_SERIES, 0, 100) is not None


def _is_volume(text: RecordText) -> bool:
    return _VOLUME.match(text.lines[0]) is not None


def announced(text: RecordText) -> int | None:
    """Index of the line that announces values in a volume of a layout that is not known.

    None in a text that is no volume.
    """
    if not _is_volume(text):
        return None
    found = text.search(re.compile(r"^\s*\d+\s.*\b(points|pts)\b", re.IGNORECASE), 10, 200)
    return found.line - 1 if found else 0


def read(text: RecordText) -> list[Component]:
    """A component for each channel."""
    if _SPECTRA.match(text.lines[0]):
        raise text.no_acceleration(
            tell(
                "holds response and Fourier spectra (volume 3) but no acceleration; give "
                "the volume 1 or 2 file of the same record"
            )
        )
    ended = text.search(_USC, 0, 40) is None
    found = [_channel(text, start, end) for start, end in channels(text, ended=ended)]
    components = [one for one in found if one is not None]
    if not components:
        raise text.no_acceleration(tell("holds no series of acceleration"))
    warn_if_fewer(text, len(found), 0, 40)
    return components


def _channel(text: RecordText, start: int, end: int) -> Component | None:
    """The component of a channel, None for a channel that records something else."""
    title = start
    while title < end and not text.lines[title].strip():
        title += 1
    if title == end or not _VOLUME.match(text.lines[title]):
        raise text.fault(
            tell(
                "expected a channel's title (CORRECTED ACCELEROGRAM ...), found {found}",
                found=quoted(text.lines[title]),
            ),
            title + 1,
        )
    kinds = [
        (n, (series["of"] or series["are"]).upper())
        for n in range(title, end)
        if (series := _SERIES.match(text.lines[n][:HEADER_WIDTH]))
    ]
    accelerations = [n for n, kind in kinds if kind == "ACC"]
    if len(accelerations) > 1:
        raise text.fault(
            tell(
                "a second series of acceleration within a channel: is the line '/&' "
                "before it damaged?"
            ),
            accelerations[1] + 1,
        )
    if accelerations:
        return _component(text, title, accelerations[0])
    if len(kinds) == 1:  # a sensor of displacement or velocity
        log.warning(
            "%s, line %d: a channel of %s only is left out",
            text.path,
            title + 1,
            {"VEL": "velocity", "DIS": "displacement"}[kinds[0][1]],
        )
        return None
    raise text.fault(tell("a channel has no line '... POINTS OF ACCEL DATA ...'"), title + 1)


def _component(text: RecordText, header: int, at: int) -> Component:
    series = text.search(_SERIES, at, at + 1)
    assert series is not None
    count, rate = text.whole(*series.word("count")), series.match["rate"]
    step = text.number(*series.word("step")) if rate is None else 1 / _rate(text, series)
    _require_step(text, header, at, step)
    stated = text.search(_FORMAT, at, at + 1)
    first = text.lines[at + 1].rstrip() if at + 1 < len(text.lines) else ""
    width = text.whole(*stated.word()) if stated else len(first) // _PER_LINE
    if not 6 <= width <= 20:
        raise text.fault(
            tell(
                "expected a row of {expected} numbers, found {found}",
                expected=_PER_LINE,
                found=quoted(first),
            ),
            at + 2,
        )
    found, _ = fixed(text, at + 1, count, width, final=True)
    require_count(text, count, found.values.size, f"values of the series on line {at + 1}")
    unit = series.match["unit"] or series.match["in"]
    factor = text.factor(unit, tell("line {line}", line=at + 1))
    raw = text.lines[header].upper().startswith("UN")
    _require_peak(text, header, at, found, factor, raw)
    channel, filtered = text.search(_CHANNEL, header, at), text.word(_FILTER, header, at)
    code = channel.match.group(2) if channel else text.word(_COMPONENT, header, at)
    return Component(
        acceleration=found.values * factor,
        time_step=text.step(step, at + 1),
        code=code,
        uncorrected=raw,
        channel=text.whole(*channel.word()) if channel else None,
        station=station_of(text, _STATION, header, at),
        event=_event(text.lines[header:at], raw),
        location=text.word(_LOCATION, header, at),
        processing=(filtered,) if filtered else (),
        lines=found.lines,
    )


def _rate(text: RecordText, series: Match) -> float:
    """Samples a second, as the line that announces them states it."""
    rate = text.number(*series.word("rate"))
    text.step_of_rate(rate, series.line)
    return rate


def _require_step(text: RecordText, header: int, at: int, step: float) -> None:
    """Hold the time step of the series against the one in the header's text."""
    interval, rate = text.search(_INTERVAL, header, at), text.search(_RATE, header, at)
    if interval:
        stated, line = text.number(*interval.word()), interval.line
    elif rate:
        stated, line = 1.0 / text.number(*rate.word()), rate.line
    else:
        return
    if abs(stated - step) > _ROUNDING * step:
        raise text.fault(
            tell(
                "the header says a time step of {stated:g} s, the series on line {line} "
                "one of {step:g} s",
                stated=stated,
                line=at + 1,
                step=step,
            ),
            line,
        )


def _require_peak(
    text: RecordText, header: int, at: int, found: Numbers, factor: float, raw: bool
) -> None:
    """Hold the largest value against the header's, which for a raw record is in other units."""
    stated = text.search(_RAW_PEAK if raw else _PEAK, header, at)
    if stated is None:
        return
    per = acceleration_factor(stated.match.group(1) if raw else "cm/s2") / factor
    word, line = stated.word(2 if raw else 1)
    require_peak(text, word, line, found.values, per=per, what="series")


def _event(head: list[str], raw: bool) -> str:
    """Event name and time: lines 3 and 4 of a volume 2 file, 2 and 3 of a volume 1 file."""
    first = 1 if raw else 2
    lines = [_GAP.split(line.strip())[0] for line in head[first : first + 2]]
    return lines[0] if "RECORD OF" in lines[0].upper() else " ".join(lines)
