"""K-NET and KiK-net ASCII files of NIED: 17 header lines and counts, eight a line.

KiK-net records in the borehole (directions 1 to 3, files ...1) and at the surface (4 to 6, ...2).
The counts include the recorder's offset, which NIED leaves in; its "Max. Acc." excludes it.
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText

_SCALE = re.compile(r"([\d.]+)\(gal\)/([\d.]+)")
_KEYED = re.compile(r"^(.{18})(.*)$")
_HEADER_LINES = 17
_KIKNET = {"1": "NS1", "2": "EW1", "3": "UD1", "4": "NS2", "5": "EW2", "6": "UD2"}
_PLACE = {"1": "borehole", "2": "surface"}


def recognise(text: RecordText) -> bool:
    """Whether the text has NIED's header."""
    head = text.lines[:_HEADER_LINES]
    return text.lines[0].startswith("Origin Time") and any(
        line.startswith("Scale Factor") for line in head
    )


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    head = {}
    for line in text.lines[:_HEADER_LINES]:
        keyed = _KEYED.match(line)
        if keyed:
            head[keyed.group(1).strip()] = keyed.group(2).strip()
    try:
        scale = _SCALE.match(head["Scale Factor"])
        frequency = text.number(head["Sampling Freq(Hz)"].removesuffix("Hz"), 11)
        seconds = text.number(head["Duration Time(s)"], 12)
        direction = head["Dir."]
    except KeyError as missing:
        raise text.fault(f"the header has no line {missing}") from None
    if scale is None:
        raise text.fault(
            f"expected a scale factor like 2000(gal)/8388608, found {head['Scale Factor']!r}", 14
        )
    step = text.step(1.0 / frequency if frequency > 0.0 else 0.0, 11)
    rows = list(enumerate(text.lines[_HEADER_LINES:], _HEADER_LINES + 1))
    for n, line in rows:
        odd = next((word for word in line.split() if not word.lstrip("-").isdigit()), None)
        if odd is not None:
            raise text.fault(f"expected a count, found {odd!r}", n)
    counts = text.words(rows)
    text.require_count(round(seconds * frequency), len(counts), "counts")
    gal = float(scale.group(1)) / float(scale.group(2))
    code = _KIKNET.get(direction, direction.replace("-", ""))
    return [
        Component(
            acceleration=np.array(counts) * (gal * text.factor("gal", "the header")),
            time_step=step,
            code=code,
            uncorrected=True,
            station=head.get("Station Code", ""),
            event=f"{head.get('Origin Time', '')} M{head.get('Mag.', '')}",
            location=_PLACE.get(code[-1:], ""),
        )
    ]
