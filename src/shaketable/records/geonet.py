"""GeoNet (New Zealand) V1A and V2A: three components in a file, mm/s².

A component consists of 16 text lines, 4 lines of integers, 6 of reals, then ten values a line in
fields of eight characters: accelerations, followed in a V2A file by velocities and displacements.
"""

from __future__ import annotations

import re

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.numbers import Numbers, fixed
from shaketable.records.stated import require_count, require_duration, require_peak
from shaketable.records.text import HEADER_WIDTH, RecordText

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
_ROUNDING = 0.01  # s: durations are printed with two decimals


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
    while text.after(at) is not None:
        if not _TITLE.match(text.lines[at][:HEADER_WIDTH]):
            raise text.fault(
                tell(
                    "expected a component's title (Corrected accelerogram ...), found {found}",
                    found=quoted(text.lines[at]),
                ),
                at + 1,
            )
        component, at = _component(text, at)
        components.append(component)
    text.warn_if_cut(len(components), _COMPONENTS)
    return components


def _component(text: RecordText, start: int) -> tuple[Component, int]:
    """The component whose title is at index `start`, and the index of the line after it."""
    end = start + _TEXT_LINES
    head = text.lines[start:end]
    stated, interval = text.search(_COUNT, start, end), text.search(_STEP, start + 8, start + 13)
    if stated is None or interval is None:
        raise text.fault(tell("the header has no 'Number of points' or no interval"), start + 1)
    points, code = text.whole(*stated.word()), text.word(_COMPONENT, start, end)
    counts, _ = fixed(text, start + _COUNTS_LINE, 10, _FIELD)
    at = start + _HEADER_LINES
    require_count(text, 10, counts.values.size, "counts")
    series: list[Numbers] = []
    for count in counts.values[_SERIES].astype(int).tolist():
        one, at = fixed(text, at, count, _FIELD)
        if count:
            require_count(text, count, one.values.size, f"values of component {code}")
        series.append(one)
    found = series[0]
    require_count(text, points, found.values.size, f"accelerations of component {code}")
    step = text.step(text.number(*interval.word()), interval.line)
    if stated.match.group(2):
        duration = text.number(*stated.word(2))
        require_duration(text, duration, stated.line, points, step, within=_ROUNDING)
    peak = text.search(_PEAK, start, end)
    if peak:
        require_peak(text, *peak.word(), found.values)
    filtered = text.word(_FILTER, start, end)
    component = Component(
        acceleration=found.values * text.factor("mm/s2", "the header"),
        time_step=step,
        code=code,
        uncorrected=head[0].startswith("Unc"),
        station=f"{text.word(_SITE, start, end)} {head[2].strip()}".strip(),
        event=f"{head[7].split('  ')[0].strip()} {head[6].strip()}",
        processing=(filtered,) if filtered else (),
        lines=found.lines,
    )
    return component, at
