"""GeoNet (New Zealand) V1A and V2A: three components in a file, mm/s².

A component consists of 16 text lines, 4 lines of integers, 6 of reals, then ten values a line in
fields of eight characters: accelerations, followed in a V2A file by velocities and displacements.
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText, match_in

_TITLE = re.compile(r"^(Unc|C)orrected accelerogram .* GNS Science", re.IGNORECASE)
_COUNT = re.compile(r"^Number of points\s+(\d+)")
_STEP = re.compile(r"\bat (?:intervals of\s+)?([\d.]+) s(?:ec intervals)?\s*$")
_COMPONENT = re.compile(r"^Component\s+(\S+)")
_SITE = re.compile(r"^Site\s+(\S+)")
_FILTER = re.compile(r"^((?:Band-pass filter|Data is unfiltered).*\S)")
_TEXT_LINES, _HEADER_LINES, _COUNTS_LINE, _FIELD = 16, 26, 19, 8
_SERIES = slice(3, 6)  # of the counts: accelerations, velocities, displacements


def recognise(text: RecordText) -> bool:
    """Whether the first line is GeoNet's."""
    return bool(_TITLE.match(text.lines[0]))


def read(text: RecordText) -> list[Component]:
    """A component for each title line."""
    return [_component(text, n) for n, line in enumerate(text.lines) if _TITLE.match(line)]


def _component(text: RecordText, start: int) -> Component:
    head = text.lines[start : start + _TEXT_LINES]
    count, step = match_in(_COUNT, head), match_in(_STEP, head[8:13])
    if count is None or step is None:
        raise text.fault("the header has no 'Number of points' or no interval", start + 1)
    points = int(count.group(1))
    word = match_in(_COMPONENT, head)
    code = word.group(1) if word else ""
    counts, _ = text.fixed(start + _COUNTS_LINE, 10, _FIELD)
    at = start + _HEADER_LINES
    if len(counts) < 10:
        raise text.fault("cut short within the header", start + 1)
    series = []
    for stated in counts[_SERIES]:
        one, at = text.fixed(at, int(stated), _FIELD)
        if stated:
            text.require_count(int(stated), len(one), f"values of component {code}")
        series.append(one)
    values = series[0]
    text.require_count(points, len(values), f"accelerations of component {code}")
    site, filtered = match_in(_SITE, head), match_in(_FILTER, head)
    return Component(
        acceleration=np.array(values) * text.factor("mm/s2", "the header"),
        time_step=text.step(text.number(step.group(1), start + 11), start + 11),
        code=code,
        uncorrected=head[0].startswith("Unc"),
        station=f"{site.group(1) if site else ''} {head[2].strip()}".strip(),
        event=f"{head[7].split('  ')[0].strip()} {head[6].strip()}",
        processing=(filtered.group(1),) if filtered else (),
    )
