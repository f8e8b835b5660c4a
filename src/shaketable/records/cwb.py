"""CWB and CWA (Taiwan): "#Key: value" lines, then time and three columns in gal."""

from __future__ import annotations

import re

import numpy as np

from shaketable.records.component import Component
from shaketable.records.text import RecordText, fields_of

_SEQUENCE = re.compile(r"([UNE])\(\+\)")


def recognise(text: RecordText) -> bool:
    """Whether the text has CWB's header."""
    return any(line.startswith("#StationCode:") for line in text.lines[:20])


def read(text: RecordText) -> list[Component]:
    """The components, in the file's order."""
    comments = [(n, line) for n, line in enumerate(text.lines, 1) if line.startswith("#")]
    head = fields_of(line.lstrip("#") for _, line in comments)
    try:
        step = text.step(1.0 / text.number(head["SampleRate(Hz)"], comments[-1][0]))
        seconds = text.number(head["RecordLength(sec)"], comments[-1][0])
        names = _SEQUENCE.findall(head["DataSequence"])
    except KeyError as missing:
        raise text.fault(f"the header has no line #{missing.args[0]}") from None
    except ZeroDivisionError:
        raise text.fault("the header's SampleRate(Hz) is zero") from None
    rows = [(n, line) for n, line in enumerate(text.lines, 1) if line.strip() and line[0] != "#"]
    for n, line in rows:
        if len(line.split()) != 1 + len(names):
            raise text.fault(f"expected {1 + len(names)} values, found {len(line.split())}", n)
    table = np.array(text.words(rows)).reshape(-1, 1 + len(names))
    text.require_count(round(seconds / step), len(table), "rows")
    unit = head.get("AmplitudeUnit", "").split(".")[0].strip() or None
    factor = text.factor(unit, "the header")
    return [
        Component(
            acceleration=table[:, 1 + k] * factor,
            time_step=step,
            code=name,
            station=f"{head.get('StationCode', '')} {head.get('StationName', '')}",
            event=f"{next((v for key, v in head.items() if key.startswith('Origin')), '')} "
            f"M{head.get('Magnitude(Ml)', '')}",
            processing=("offset corrected",) if "corr" in head.get("AmplitudeUnit", "") else (),
        )
        for k, name in enumerate(names)
    ]
