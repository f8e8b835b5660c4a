"""NSMN of AFAD (Turkey): a header of "KEY : value" lines and three columns in gal."""

from __future__ import annotations

import re

from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.header import Header, keyed
from shaketable.records.numbers import free, table
from shaketable.records.stated import OFFSET_SHARE, require_count, require_peak
from shaketable.records.text import RecordText

_TITLE = "STRONG GROUND MOTION RECORDS OF TURKIYE"
_CODES = ("N-S", "E-W", "U-D")
_PEAKS = re.compile(r"\((N-S|E-W|U-D)\)\s*(\S+)")
_NAMES = re.compile(r"^\s*N-S\s+E-W\s+U-D\s*$")


def recognise(text: RecordText) -> bool:
    """Whether the first line is NSMN's."""
    return text.lines[0].strip().startswith(_TITLE)


def read(text: RecordText) -> list[Component]:
    """The north, east and up components."""
    names = text.search(_NAMES, 0, 40)
    if names is None:
        raise text.fault(
            tell("no line with the columns' names (N-S E-W U-D) in the first 40 lines")
        )
    head = Header(text, keyed(text.rows(0, names.line - 1)))
    step = head.step("SAMPLING INTERVAL (sec)")
    values, lines = table(text, free(text, text.rows(names.line)), len(_CODES))
    require_count(text, head.whole("NUMBER OF DATA"), len(values), "rows")
    if head.get("RAW PGA VALUES (gal)"):
        stated, line = head.required("RAW PGA VALUES (gal)")
        for code, word in _PEAKS.findall(stated):
            series = values[:, _CODES.index(code)]
            require_peak(text, word, line, series, share=OFFSET_SHARE, what=f"component {code}")
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
            magnitude=head.positive("EARTHQUAKE MAGNITUDE"),
            lines=lines,
        )
        for code, column in zip(_CODES, values.T, strict=True)
    ]
