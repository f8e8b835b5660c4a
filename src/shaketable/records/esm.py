"""ESM and ITACA: a DYNA header of 64 "KEY: value" lines, then one value a line; and the older
layout of 10 header lines, then numbers of 14 characters without gaps, five a line.

Luzi et al. (2020) Engineering Strong-Motion Database (ESM) flatfile; https://esm-db.eu
"""

from __future__ import annotations

import re

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.header import Header, keyed
from shaketable.records.numbers import fixed, free
from shaketable.records.stated import require_count, require_duration, require_peak
from shaketable.records.text import RecordText
from shaketable.units import CM

_HEADER_LINES = 64
_OLD_UNITS = re.compile(r"^Acc\w+ time series in (\S+)", re.IGNORECASE)
_OLD_FIELD = 14
_ROUNDING = 0.0006  # s: durations are printed with three decimals


def recognise(text: RecordText) -> bool:
    """Whether the text has one of the two headers."""
    return _is_new(text) or _is_old(text)


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    return [_read_new(text) if _is_new(text) else _read_old(text)]


def _is_new(text: RecordText) -> bool:
    return text.lines[0].startswith("EVENT_NAME:")


def _is_old(text: RecordText) -> bool:
    return text.lines[0].startswith("Event Date & Time")


def _read_new(text: RecordText) -> Component:
    head = Header(text, keyed(text.rows(0, _HEADER_LINES)))
    kind = head.get("DATA_TYPE", "ACCELERATION")
    if kind != "ACCELERATION":
        raise text.no_acceleration(
            tell("holds a series of {found}; an acceleration is needed", found=quoted(kind))
        )
    step = head.step("SAMPLING_INTERVAL_S")
    count = head.whole("NDATA")
    found = free(text, text.rows(_HEADER_LINES), count=count)
    require_count(text, count, found.values.size)
    units = head.get("UNITS") or None
    if head.get("DURATION_S"):
        at = head.required("DURATION_S")[1]
        require_duration(text, head.number("DURATION_S"), at, count, step, within=_ROUNDING)
    factor = text.factor(units, "the header")
    if head.get("PGA_CM/S^2"):
        require_peak(text, *head.required("PGA_CM/S^2"), found.values, per=CM / factor)
    code = head.get("STREAM")
    done = [head.get(key) for key in ("BASELINE_CORRECTION", "FILTER_TYPE", "PROCESSING")]
    band = f"{head.get('LOW_CUT_FREQUENCY_HZ')}-{head.get('HIGH_CUT_FREQUENCY_HZ')} Hz"
    return Component(
        acceleration=found.values * factor,
        time_step=step,
        code=code,
        uncorrected="REMOVED" not in done[0],
        station=f"{head.get('NETWORK')}.{head.get('STATION_CODE')} {head.get('STATION_NAME')}",
        event=f"{head.get('EVENT_NAME')} {head.get('EVENT_DATE_YYYYMMDD')}",
        magnitude=head.positive("MAGNITUDE_W", "MAGNITUDE_L"),
        location=head.get("LOCATION"),
        processing=tuple(f"{word} {band}" if word == done[1] else word for word in done if word),
        lines=found.lines,
    )


def _read_old(text: RecordText) -> Component:
    series = text.search(_OLD_UNITS, 0, 20)
    if series is None:
        raise text.fault(tell("no line 'Acceleration time series in m/s/s' in the header"))
    head = Header(text, keyed(text.rows(0, series.line - 1)))
    step = head.step("Time Increment (s)")
    count = head.whole("Number of Data")
    found, _ = fixed(text, series.line, count, _OLD_FIELD, final=True)
    require_count(text, count, found.values.size)
    factor = text.factor(series.match.group(1), "the header")
    if head.get("PGA (m/s/s)"):
        require_peak(text, *head.required("PGA (m/s/s)"), found.values, per=1.0 / factor)
    band = head.get("Filter Cut-off Frequency (Hz)")
    return Component(
        acceleration=found.values * factor,
        time_step=step,
        code=head.get("Orientation"),
        station=head.get("Station Code / Name"),
        event=head.get("Event Date & Time"),
        processing=(f"{head.get('Processing Info')} {band} Hz".strip(),),
        lines=found.lines,
    )
