"""CWB and CWA (Taiwan): "#Key: value" lines, then time and three columns in gal."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.header import Header, keyed
from shaketable.records.numbers import free, table
from shaketable.records.stated import require_count, require_peak
from shaketable.records.text import HEADER_WIDTH, RecordText

_PEAKS = re.compile(r"^#AmplitudeMAX\.\s*(\w):\s*(\S+?)~\s*(\S+)")
_SEQUENCE = re.compile(r"([UNE])\(\+\)")


def recognise(text: RecordText) -> bool:
    """Whether the text has CWB's header."""
    return any(line.startswith("#StationCode:") for line in text.lines[:20])


def read(text: RecordText) -> list[Component]:
    """The components, in the file's order."""
    rows = text.rows()
    comments = [(n, line) for n, line in rows if line.startswith("#")]
    head = Header(text, keyed((n, line.lstrip("#")) for n, line in comments))
    step = text.step_of_rate(head.number("SampleRate(Hz)"), head.required("SampleRate(Hz)")[1])
    seconds = head.number("RecordLength(sec)")
    sequence, at = head.required("DataSequence")
    names = _SEQUENCE.findall(sequence)
    if not names:
        raise text.fault(
            tell("names no components like U(+), found {found}", found=quoted(sequence)), at
        )
    found = free(text, [(n, line) for n, line in rows if not line.startswith("#")])
    values, lines = table(text, found, 1 + len(names))
    require_count(text, round(seconds / step), len(values), "rows")
    _require_even(text, values[:, 0], step, lines)
    stated: set[str] = set()
    for n, line in comments:
        peaks = _PEAKS.match(line[:HEADER_WIDTH])
        if peaks and peaks.group(1) in names:
            name = peaks.group(1)
            if name in stated:
                raise text.fault(tell("a second maximum of component {name}", name=name), n)
            stated.add(name)
            word = max(peaks.group(2), peaks.group(3), key=lambda one: abs(text.number(one, n)))
            require_peak(text, word, n, values[:, 1 + names.index(name)], what=f"component {name}")
    unit, at = head.required("AmplitudeUnit")
    if not unit.lower().startswith("gal"):
        raise text.fault(tell("expected amplitudes in gal, found {found}", found=quoted(unit)), at)
    factor = text.factor("gal", "the header")
    return [
        Component(
            acceleration=values[:, 1 + k] * factor,
            time_step=step,
            code=name,
            station=f"{head.get('StationCode')} {head.get('StationName')}",
            event=f"{head.starting('Origin')} M{head.get('Magnitude(Ml)')}",
            magnitude=head.positive("Magnitude(Ml)"),
            processing=("offset corrected",) if "corr" in head.get("AmplitudeUnit") else (),
            lines=lines,
        )
        for k, name in enumerate(names)
    ]


def _require_even(
    text: RecordText, time: NDArray[np.float64], step: float, lines: NDArray[np.int32]
) -> None:
    """Raise an error unless row n is at the time n steps."""
    off = np.flatnonzero(np.abs(time - time[0] - step * np.arange(time.size)) > 0.5 * step)
    if off.size:
        raise text.fault(
            tell(
                "the time is {time:g} s where {due:g} s is due: rows are missing or damaged",
                time=time[off[0]],
                due=time[0] + step * off[0],
            ),
            int(lines[off[0]]),
        )
