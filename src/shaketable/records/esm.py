"""ESM and ITACA: a DYNA header of 64 "KEY: value" lines, then one value a line; and the older
layout of 10 header lines, then numbers of 14 characters without gaps, five a line.

Luzi et al. (2020) Engineering Strong-Motion Database (ESM) flatfile; https://esm-db.eu
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText, fields_of

_HEADER_LINES = 64
_OLD_UNITS = re.compile(r"^Acc\w+ time series in (\S+)", re.IGNORECASE)
_OLD_FIELD = 14


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
    head = fields_of(text.lines[:_HEADER_LINES])
    kind = head.get("DATA_TYPE", "ACCELERATION")
    if kind != "ACCELERATION":
        raise text.no_acceleration(f"holds a {kind.lower()} series; an acceleration is needed")
    step = text.step(_number(text, head, "SAMPLING_INTERVAL_S"))
    count = int(_number(text, head, "NDATA"))
    values = text.words(list(enumerate(text.lines, 1))[_HEADER_LINES:])
    text.require_count(count, len(values))
    code = head.get("STREAM", "")
    done = [head.get(key, "") for key in ("BASELINE_CORRECTION", "FILTER_TYPE", "PROCESSING")]
    band = f"{head.get('LOW_CUT_FREQUENCY_HZ', '')}-{head.get('HIGH_CUT_FREQUENCY_HZ', '')} Hz"
    return Component(
        acceleration=np.array(values) * text.factor(head.get("UNITS"), "the header"),
        time_step=step,
        code=code,
        uncorrected="REMOVED" not in done[0],
        station=f"{head.get('NETWORK', '')}.{head.get('STATION_CODE', '')} "
        + head.get("STATION_NAME", ""),
        event=f"{head.get('EVENT_NAME', '')} {head.get('EVENT_DATE_YYYYMMDD', '')}",
        location=head.get("LOCATION", ""),
        processing=tuple(f"{word} {band}" if word == done[1] else word for word in done if word),
    )


def _read_old(text: RecordText) -> Component:
    at = next((n for n, line in enumerate(text.lines[:20]) if _OLD_UNITS.match(line)), None)
    if at is None:
        raise text.fault("no line 'Acceleration time series in m/s/s' in the header")
    units = _OLD_UNITS.match(text.lines[at])
    head = fields_of(text.lines[:at])
    step = text.step(_number(text, head, "Time Increment (s)"))
    count = int(_number(text, head, "Number of Data"))
    values, _ = text.fixed(at + 1, count, _OLD_FIELD, last=True)
    text.require_count(count, len(values))
    code = head.get("Orientation", "")
    band = head.get("Filter Cut-off Frequency (Hz)", "")
    return Component(
        acceleration=np.array(values) * text.factor(units and units.group(1), "the header"),
        time_step=step,
        code=code,
        station=head.get("Station Code / Name", ""),
        event=head.get("Event Date & Time", ""),
        processing=(f"{head.get('Processing Info', '')} {band} Hz".strip(),),
    )


def _number(text: RecordText, head: dict[str, str], key: str) -> float:
    if not head.get(key):
        raise text.fault(f"the header has no value for {key!r}")
    line = next(n for n, row in enumerate(text.lines, 1) if row.startswith(key))
    return text.number(head[key], line)
