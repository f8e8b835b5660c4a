"""GeoNet (New Zealand) V1A and V2A: three components in a file, mm/s².

A component consists of 16 text lines, 4 lines of integers, 6 of reals, then ten values a line in
fields of eight characters: accelerations, followed in a V2A file by velocities and displacements.
"""

from __future__ import annotations

import re

from shaketable.errors import quoted
from shaketable.records.component import Component
from shaketable.records.numbers import (
    Numbers,
    fixed,
    require_count,
    require_duration,
    require_peak,
)
from shaketable.records.text import HEADER_WIDTH, RecordText, match_in

_TITLE = re.compile(r"^(Unc|C)orrected accelerogram .* GNS Science", re.IGNORECASE)
_COUNT = re.compile(r"^Number of points\s+(\S+)(?:\s+Duration\s+(\S+)\s+s)?")
_STEP = re.compile(r"\bat (?:intervals of\s+)?(\S+) s(?:ec intervals)?\s*$")
_PEAK = re.compile(r"^Acceleration:\s+peak\s+(\S+)\s+mm/s/s", re.IGNORECASE)
_COMPONENT = re.compile(r"^Component\s+(\S+)")
_SITE = re.compile(r"^Site\s+(\S+)")
_FILTER = re.compile(r"^((?:Band-pass filter|Data is unfiltered).*)")
_TEXT_LINES, _HEADER_LINES, _COUNTS_LINE, _FIELD = 16, 26, 19, 8
_SERIES = slice(3, 6)  # of the counts: accelerations, velocities, displacements
_COMPONENTS = 3


def recognise(text: RecordText) -> bool:
    """Whether the first line is GeoNet's."""
    return bool(_TITLE.match(text.lines[0][:HEADER_WIDTH]))


def read(text: RecordText) -> list[Component]:
    """The file's components, each under a title line.

    Raises:
        InputError: lines that are not where the format has them, so that no component is lost.
    """
    components = []
    at = 0
    while any(line.strip("\x1a\0 ") for line in text.lines[at:]):
        if not _TITLE.match(text.lines[at][:HEADER_WIDTH]):
            raise text.fault(
                f"expected a component's title (Corrected accelerogram ...), found "
                f"{quoted(text.lines[at])}",
                at + 1,
            )
        component, at = _component(text, at)
        components.append(component)
    text.expect_components(len(components), _COMPONENTS)
    return components


def _component(text: RecordText, start: int) -> tuple[Component, int]:
    """The component whose title is at index `start`, and the index of the line after it."""
    head = text.lines[start : start + _TEXT_LINES]
    said = text.search(_COUNT, start, start + _TEXT_LINES)
    stepped = text.search(_STEP, start + 8, start + 13)
    if said is None or stepped is None:
        raise text.fault("the header has no 'Number of points' or no interval", start + 1)
    points = text.whole(said[0].group(1), said[1])
    word = match_in(_COMPONENT, head)
    code = word.group(1) if word else ""
    counts, _ = fixed(text, start + _COUNTS_LINE, 10, _FIELD)
    at = start + _HEADER_LINES
    if counts.values.size < 10:
        raise text.fault("cut short within the header", start + 1)
    series: list[Numbers] = []
    for stated in counts.values[_SERIES]:
        one, at = fixed(text, at, int(stated), _FIELD)
        if stated:
            require_count(text, int(stated), one.values.size, f"values of component {code}")
        series.append(one)
    found = series[0]
    require_count(text, points, found.values.size, f"accelerations of component {code}")
    step = text.step(text.number(stepped[0].group(1), stepped[1]), stepped[1])
    if said[0].group(2):
        duration = text.number(said[0].group(2), said[1])
        require_duration(text, duration, said[1], points, step, within=0.01)
    peak = text.search(_PEAK, start, start + _TEXT_LINES)
    if peak:
        require_peak(text, peak[0].group(1), peak[1], found.values)
    site, filtered = match_in(_SITE, head), match_in(_FILTER, head)
    component = Component(
        acceleration=found.values * text.factor("mm/s2", "the header"),
        time_step=step,
        code=code,
        uncorrected=head[0].startswith("Unc"),
        station=f"{site.group(1) if site else ''} {head[2].strip()}".strip(),
        event=f"{head[7].split('  ')[0].strip()} {head[6].strip()}",
        processing=(filtered.group(1).strip(),) if filtered else (),
        lines=found.lines,
    )
    return component, at
