"""K-NET and KiK-net ASCII files of NIED: 17 header lines and counts, eight a line.

KiK-net records in the borehole (directions 1 to 3, files ...1) and at the surface (4 to 6, ...2).
The counts include the recorder's offset, which NIED leaves in; its "Max. Acc." excludes it.
"""

from __future__ import annotations

import re

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import Component
from shaketable.records.header import Header
from shaketable.records.numbers import free
from shaketable.records.stated import OFFSET_SHARE, require_count, require_peak
from shaketable.records.text import HEADER_WIDTH, RecordText

_SCALE = re.compile(r"(\d+(?:\.\d+)?)\(gal\)/(\d+(?:\.\d+)?)", re.ASCII)
_KEY = 18  # characters
_HEADER_LINES = 17
_COUNT = re.compile(r"-?\d{1,9}", re.ASCII)
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
    head = Header(
        text,
        [
            (n, line[:_KEY].strip(), line[_KEY:HEADER_WIDTH].strip())
            for n, line in text.rows(0, _HEADER_LINES)
        ],
    )
    word, at = head.required("Scale Factor")
    scale = _SCALE.fullmatch(word)
    if scale is None:
        raise text.fault(
            tell(
                "expected a scale factor like 2000(gal)/8388608, found {found}", found=quoted(word)
            ),
            at,
        )
    gal = text.number(scale.group(1), at) / text.number(scale.group(2), at)
    word, at = head.required("Sampling Freq(Hz)")
    frequency = text.number(word.removesuffix("Hz"), at)
    step = text.step_of_rate(frequency, at)
    rows = text.rows(_HEADER_LINES)
    for n, line in rows:
        odd = next((word for word in line.split() if not _COUNT.fullmatch(word)), None)
        if odd is not None:
            raise text.fault(tell("expected a count, found {found}", found=quoted(odd)), n)
    found = free(text, rows)
    seconds = head.number("Duration Time(s)")
    require_count(text, round(seconds * frequency), found.values.size, "counts")
    level = found.values - found.values.mean()
    word, at = head.required("Max. Acc. (gal)")
    require_peak(text, word, at, level, per=1.0 / gal, share=OFFSET_SHARE, what="counts")
    direction, _ = head.required("Dir.")
    code = _KIKNET.get(direction, direction.replace("-", ""))
    return [
        Component(
            acceleration=found.values * (gal * text.factor("gal", "the header")),
            time_step=step,
            code=code,
            uncorrected=True,
            station=head.get("Station Code"),
            event=f"{head.get('Origin Time')} M{head.get('Mag.')}",
            magnitude=head.positive("Mag."),
            location=_PLACE.get(code[-1:], ""),
            lines=found.lines,
        )
    ]
