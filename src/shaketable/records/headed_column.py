"""One value a line, below a line with a divisor (980.665 or 1) and a line with the time step.

The divisor has been applied already. Scripts around OpenSees write this layout for records of
instrumented buildings. It does not say the unit.
"""

from __future__ import annotations

import numpy as np

from shaketable.records.component import Component
from shaketable.records.numbers import words
from shaketable.records.text import RecordText

_DIVISORS = {"980.665", "9.80665", "981", "1"}
_STEPS = (0.001, 0.05)


def recognise(text: RecordText) -> bool:
    """Whether the first line is a divisor and the second a time step."""
    words = [line.split() for line in text.lines[:3]]
    if len(words) < 3 or any(len(row) != 1 for row in words):
        return False
    try:
        divisor, step = (float(row[0]) for row in words[:2])
    except ValueError:
        return False
    return f"{divisor:g}" in _DIVISORS and _STEPS[0] <= step <= _STEPS[1]


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    step = text.step(text.number(text.lines[1].strip(), 2), 2)
    found = words(text, list(enumerate(text.lines, 1))[2:])
    if found.values.size < 2:
        raise text.fault(f"holds {found.values.size} values; at least 2 are needed")
    several = np.flatnonzero(found.per_line > 1)
    if several.size:
        line = int(found.lines[several[0]])  # one value on each line before it
        raise text.fault(f"expected 1 value, found {found.per_line[several[0]]}", line)
    factor = text.factor(None, "the file")
    return [Component(acceleration=found.values * factor, time_step=step, lines=found.lines)]
