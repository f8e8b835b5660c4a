"""One value a line, below a line with a divisor (980.665 or 1) and a line with the time step.

The divisor has been applied already. Scripts around OpenSees write this layout for records of
instrumented buildings. It does not say the unit.
"""

from __future__ import annotations

from shaketable.records.component import Component
from shaketable.records.numbers import free, table
from shaketable.records.stated import require_two
from shaketable.records.text import RecordText

_DIVISORS = {"980.665", "9.80665", "981", "1"}
_STEPS = (0.001, 0.05)


def recognise(text: RecordText) -> bool:
    """Whether the first line is a divisor and the second a time step."""
    rows = [line.split() for line in text.lines[:3]]
    if len(rows) < 3 or any(len(row) != 1 for row in rows):
        return False
    try:
        divisor, step = (float(row[0]) for row in rows[:2])
    except ValueError:
        return False
    return f"{divisor:g}" in _DIVISORS and _STEPS[0] <= step <= _STEPS[1]


def read(text: RecordText) -> list[Component]:
    """The file's only component."""
    step = text.step(text.number(text.lines[1].strip(), 2), 2)
    found = free(text, text.rows(2))
    values, lines = table(text, found, 1)
    require_two(text, len(values))
    factor = text.factor(None, "the file")
    return [Component(acceleration=values[:, 0] * factor, time_step=step, lines=lines)]
