"""NSMN of AFAD (Turkey): a header of "KEY : value" lines and three columns in gal."""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText, fields_of

_TITLE = "STRONG GROUND MOTION RECORDS OF TURKIYE"
_NAMES = re.compile(r"^\s*N-S\s+E-W\s+U-D\s*$")


def recognise(text: RecordText) -> bool:
    """Whether the first line is NSMN's."""
    return text.lines[0].strip().startswith(_TITLE)


def read(text: RecordText) -> list[Component]:
    """The north, east and up components."""
    at = next((n for n, line in enumerate(text.lines[:40]) if _NAMES.match(line)), None)
    if at is None:
        raise text.fault("no line with the columns' names (N-S E-W U-D) in the first 40 lines")
    head = fields_of(text.lines[:at])
    try:
        count = int(text.number(head["NUMBER OF DATA"], at))
        step = text.step(text.number(head["SAMPLING INTERVAL (sec)"], at))
    except KeyError as missing:
        raise text.fault(f"the header has no line {missing}") from None
    rows = [(n, line) for n, line in enumerate(text.lines, 1) if n > at + 1 and line.strip()]
    for n, line in rows:
        if len(line.split()) != 3:
            raise text.fault(f"expected 3 values, found {len(line.split())}", n)
    table = np.array(text.words(rows)).reshape(-1, 3) * text.factor("gal", "the format")
    text.require_count(count, len(table), "rows")
    # the text was decoded as Latin-1, but the place is written in code page 1254
    place = head.get("PLACE", "").encode("latin-1", "replace").decode("cp1254", "replace")
    return [
        Component(
            acceleration=column,
            time_step=step,
            code=code,
            uncorrected=True,
            station=f"{head.get('STATION ID', '')} {place}",
            event=f"{head.get('EARTHQUAKE DATE', '')} M{head.get('EARTHQUAKE MAGNITUDE', '')}",
        )
        for code, column in zip(("NS", "EW", "UD"), table.T, strict=True)
    ]
