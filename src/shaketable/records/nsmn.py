"""NSMN of AFAD (Turkey): a header of "KEY : value" lines and three columns in gal."""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.header import Header, keyed
from shaketable.records.numbers import require_count, require_peak, words
from shaketable.records.text import RecordText

_TITLE = "STRONG GROUND MOTION RECORDS OF TURKIYE"
_CODES = ("N-S", "E-W", "U-D")
_PEAKS = re.compile(r"\((N-S|E-W|U-D)\)\s*(\S+)")
_OFFSET = 0.02  # share of the stated maximum by which ours may differ: an offset may be in it
_NAMES = re.compile(r"^\s*N-S\s+E-W\s+U-D\s*$")


def recognise(text: RecordText) -> bool:
    """Whether the first line is NSMN's."""
    return text.lines[0].strip().startswith(_TITLE)


def read(text: RecordText) -> list[Component]:
    """The north, east and up components."""
    names = text.search(_NAMES, 0, 40)
    if names is None:
        raise text.fault("no line with the columns' names (N-S E-W U-D) in the first 40 lines")
    at = names[1]
    head = Header(text, keyed(text.lines[: at - 1]))
    count = head.whole("NUMBER OF DATA")
    word, line = head.required("SAMPLING INTERVAL (sec)")
    step = text.step(text.number(word, line), line)
    found = words(text, list(enumerate(text.lines[at:], at + 1)))
    odd = np.flatnonzero(found.per_line != 3)
    if odd.size:
        first = int(odd[0])
        raise text.fault(
            f"expected 3 values, found {found.per_line[first]}", int(found.lines[3 * first])
        )
    table = found.values.reshape(-1, 3)
    require_count(text, count, len(table), "rows")
    if head.get("RAW PGA VALUES (gal)"):
        said, line = head.required("RAW PGA VALUES (gal)")
        for code, word in _PEAKS.findall(said):
            series = table[:, _CODES.index(code)]
            require_peak(text, word, line, series, share=_OFFSET, what=f"component {code}")
    # the text was decoded as Latin-1, but the place is written in code page 1254
    place = head.get("PLACE").encode("latin-1", "replace").decode("cp1254", "replace")
    return [
        Component(
            acceleration=column * text.factor("gal", "the format"),
            time_step=step,
            code=code.replace("-", ""),
            uncorrected=True,
            station=f"{head.get('STATION ID')} {place}",
            event=f"{head.get('EARTHQUAKE DATE')} M{head.get('EARTHQUAKE MAGNITUDE')}",
            lines=found.lines[::3],
        )
        for code, column in zip(_CODES, table.T, strict=True)
    ]
