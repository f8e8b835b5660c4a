"""Plain columns: one value a line, a time and an acceleration a line, or a CSV file with a header.

In a header, units stand in brackets or at the end of a name: "time_s, acceleration_g",
"Time (s), East [cm/s²]". The caller has to give what no header says; nothing is guessed.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from shaketable.records.component import Component
from shaketable.records.text import RecordText
from shaketable.records.uneven import resampled

UNEVEN = 1e-3  # share of a step by which steps may differ, as printed times are rounded

_COMMENT = ("#", "%", "//")
_SPLIT = re.compile(r"[,;\s]+")
_IN_BRACKETS = re.compile(r"[(\[]\s*([^)\]]+?)\s*[)\]]")
_TIME = re.compile(r"t(ime)?\s*(_s|_sec|[(\[]\s*s(ec)?\s*[)\]])?$", re.IGNORECASE)
_SUFFIXES = {"g": "g", "gal": "gal", "m_s2": "m/s2", "cm_s2": "cm/s2", "ms2": "m/s2"}


def recognise(text: RecordText) -> bool:
    """Whether the first two lines, comments aside, could be a header and a row of numbers."""
    rows = [line for _, line in rows_of(text)][:2]
    if not rows or numeric(rows[0]):
        return bool(rows)
    return (
        len(rows) > 1 and numeric(rows[1]) and len(header_of(rows[0])) == len(_SPLIT.split(rows[1]))
    )


def read(text: RecordText) -> list[Component]:
    """A component for each column that is not the time."""
    rows = rows_of(text)
    names = [] if numeric(rows[0][1]) else header_of(rows.pop(0)[1])
    _require_unbroken(text, rows)
    table = table_of(text, rows, len(names) or None)
    columns = table.shape[1]
    if not names:
        if columns > 2:
            raise text.fault(
                f"has {columns} columns and no header; accepted without a header: "
                "one value a line, or a time and an acceleration"
            )
        names = ["time", ""] if columns == 2 else [""]
    timed = bool(_TIME.match(names[0]))
    numbers = [number for number, _ in rows]
    time = table[:, 0] if timed else None
    series = list(range(1, columns) if timed else range(columns))
    if not series:
        raise text.fault("has a time column and no acceleration")
    done: tuple[str, ...] = ()
    if time is not None and not _even(text, time, numbers):
        even = [resampled(text, time, table[:, k], numbers) for k in series]
        values, step, done = [one[0] for one in even], even[0][1], (even[0][2],)
    else:
        values, step = [table[:, k] for k in series], _time_step(text, time)
    codes = [name_of(names[k]) for k in series]
    return [
        Component(
            acceleration=column * _factor(text, names[k]),
            time_step=step,
            code=code,
            start=0.0 if time is None else float(time[0]),
            processing=done,
        )
        for k, code, column in zip(series, codes, values, strict=True)
    ]


def rows_of(text: RecordText) -> list[tuple[int, str]]:
    """(line number, line) of every line that is neither blank nor a comment."""
    stripped = ((n, line.strip().rstrip(",;")) for n, line in enumerate(text.lines, 1))
    return [(n, line) for n, line in stripped if line and not line.startswith(_COMMENT)]


def _require_unbroken(text: RecordText, rows: list[tuple[int, str]]) -> None:
    """Raise an error for a comment among the numbers, or a count before a column of them."""
    between = range(rows[0][0], rows[-1][0]) if rows else range(0)
    for n in between:
        if text.lines[n].strip().startswith(_COMMENT):
            raise text.fault("a comment among the numbers: is a sample missing?", n + 1)
    if len(rows) > 3 and rows[0][1] == str(len(rows) - 1):
        raise text.fault(
            f"begins with {rows[0][1]}, the number of values after it; remove the count", rows[0][0]
        )


def numeric(line: str) -> bool:
    try:
        [float(word) for word in _SPLIT.split(line)]
    except ValueError:
        return False
    return True


def header_of(line: str) -> list[str]:
    for separator in (",", ";", "\t"):
        if separator in line:
            return [name.strip() for name in line.split(separator)]
    return line.split()


def table_of(
    text: RecordText, rows: list[tuple[int, str]], columns: int | None
) -> NDArray[np.float64]:
    if len(rows) < 2:
        raise text.fault(f"holds {len(rows)} rows of numbers; at least 2 are needed")
    table = []
    for number, line in rows:
        words = _SPLIT.split(line)
        columns = columns or len(words)
        if len(words) != columns:
            raise text.fault(f"expected {columns} values, found {len(words)}", number)
        table.append([text.number(word, number) for word in words])
    first, last = (_SPLIT.split(row)[-1] for row in (rows[0][1], rows[-1][1]))
    text.require_last(first, last, rows[-1][0])
    return np.array(table)


def _time_step(text: RecordText, time: NDArray[np.float64] | None) -> float:
    """The step of evenly spaced values [s]."""
    if time is None:
        if text.time_step is None:
            raise text.fault(
                "has no column 'time', 'time_s' or 'time (s)' and no time step was given"
            )
        return text.time_step
    step = float(time[-1] - time[0]) / (time.size - 1)
    if text.time_step is not None and abs(text.time_step - step) > UNEVEN * step:
        raise text.fault(
            f"the time column has steps of {step:g} s; the time step given is {text.time_step:g} s"
        )
    return text.time_step or text.step(step)


def _even(text: RecordText, time: NDArray[np.float64], numbers: list[int]) -> bool:
    """Whether all times are one step apart, as far as their printed digits can tell."""
    step = float(time[-1] - time[0]) / (time.size - 1)
    if step <= 0.0:
        raise text.fault("the time column does not rise")
    steps = np.diff(time)
    unit = 10.0 ** -_decimals(text, numbers)
    printed = np.rint(steps / unit)  # even times, rounded, are n or n + 1 units apart
    rounded = printed.max() - printed.min() <= 1 and printed.max() < 2 * printed.min()
    return bool(rounded or (np.abs(steps - step) <= UNEVEN * step).all())


def _decimals(text: RecordText, numbers: list[int]) -> int:
    """The largest number of decimals with which a time is printed."""
    times = [_SPLIT.split(text.lines[number - 1].strip())[0] for number in numbers[:100]]
    if any("e" in time.lower() for time in times):
        return 9
    return max(len(time.partition(".")[2]) for time in times)


def name_of(name: str) -> str:
    """A column's name without its unit."""
    bare = _IN_BRACKETS.sub("", name).strip()
    ends = [end for end in _SUFFIXES if bare.lower().endswith(f"_{end}")]
    return bare[: -len(max(ends, key=len)) - 1] if ends else bare


def _factor(text: RecordText, name: str) -> float:
    """One unit of the column in m/s²; the header's unit and the one given must agree."""
    return text.factor(unit_of(name), f"column {name!r}" if name else "the file")


def unit_of(name: str) -> str | None:
    """The unit in a column's name, in brackets or at its end; None if there is none."""
    brackets = _IN_BRACKETS.search(name)
    if brackets:
        return brackets.group(1)
    ends = [unit for end, unit in _SUFFIXES.items() if name.lower().endswith(f"_{end}")]
    return ends[0] if ends else None
