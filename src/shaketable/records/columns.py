"""Plain columns: one value a line, a time and an acceleration a line, or a CSV file with a header.

In a header, units stand in brackets or at the end of a name: "time_s, acceleration_g",
"Time (s), East [cm/s²]". Lines of a title may stand above it. The caller has to give what no
header says; nothing is guessed. Columns that their names or units call velocities, displacements
or magnitudes of a vector are left out with a warning. Numbers may have decimal commas where
something else separates cells, and Fortran's exponents, 1.5D-3.
"""

from __future__ import annotations

import logging
import re

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.component import (
    Component,
    names_horizontal,
    names_vertical,
)
from shaketable.records.gravity import without_gravity
from shaketable.records.numbers import free, table
from shaketable.records.stated import require_two
from shaketable.records.text import NO_TIME_STEP, RecordText
from shaketable.records.uneven import resampled

log = logging.getLogger(__name__)

FEWEST = 20  # values, below which no column is told to be a time
UNEVEN = 1e-3  # share of a step by which steps may differ, as printed times are rounded

_COMMENT = ("#", "%", "//")
_SEPARATORS = str.maketrans(",;", "  ")
_EMPTY = re.compile(r"(?:^|[,;])\s*[,;]")
_DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")
#: Where commas are decimal signs: cells with other separators, or one cell with a leading zero.
_CELLS_APART = re.compile(r"[;\t]|\d\s+[-+\d]")
_ONE_CELL = re.compile(r"[-+]?\d+,0\d+")
_FORTRAN = re.compile(r"(?<=[\d.])[Dd](?=[-+]?\d)")
TITLES = 20  # lines above a header
_SPLIT = re.compile(r"[,;\s]+")
_IN_BRACKETS = re.compile(r"[(\[]([^()\[\]]+)[)\]]")
_TIME = re.compile(r"t(ime)?\s*(_s|_sec|[(\[]\s*s(ec(onds)?)?\s*[)\]])?$", re.IGNORECASE)
_SUFFIXES = {"g": "g", "gal": "gal", "m_s2": "m/s2", "cm_s2": "cm/s2", "ms2": "m/s2"}
_SLASHED = re.compile(r"[\s_]([a-z]+/[a-z0-9²^*/]+)$", re.IGNORECASE)
#: Units and names of what is no acceleration.
_OTHER_UNITS = {
    "m/s", "cm/s", "mm/s", "m/sec", "cm/sec", "mm/sec", "m", "cm", "mm", "in", "in/s", "ft", "ft/s",
}  # fmt: skip
_OTHER_NAMES = re.compile(r"^(vel|velocity|disp|displ|displacement)(?![a-z])", re.IGNORECASE)
#: Lengths of a vector; in a building "absolute" and "total" may also be against the relative.
_LENGTHS = re.compile(
    r"(?<![a-z])(abs|absolute?|total|magnitude|resultant|norm|betrag)(?![a-z])", re.IGNORECASE
)
_QUOTED = re.compile(r'"([^"]*)"')
_WORDS = re.compile(r"[^\s(\[]+(?:\s*[(\[][^()\[\]]*[)\]])?")  # with their units: "acc (g)"
_NAME = re.compile(r"[\"'(\[ ]*[^\W\d_]{2}")


def recognise(text: RecordText) -> bool:
    """Whether the first two lines, comments aside, could be a header and a row of numbers."""
    rows = [line for _, line in _below_titles(rows_of(text, TITLES + 2))[:2]]
    if not rows or numeric(rows[0]):
        return bool(rows)
    return (
        len(rows) > 1 and numeric(rows[1]) and len(header_of(rows[0])) == len(_SPLIT.split(rows[1]))
    )


def read(text: RecordText) -> list[Component]:
    """A component for each column that is neither the time nor another quantity."""
    every = rows_of(text)
    rows = _below_titles(every)
    if len(rows) < len(every):
        log.warning(
            "%s: left out, as a title: %s",
            text.path,
            quoted(" ".join(line for _, line in every[: len(every) - len(rows)])),
        )
    names = [] if numeric(rows[0][1]) else _names(text, *rows.pop(0))
    _require_unbroken(text, rows)
    table, lines = table_of(text, rows, len(names) or None)
    columns = table.shape[1]
    if not names:
        if columns > 2:
            raise text.fault(
                tell(
                    "has {columns} columns and no header; accepted without a header: one "
                    "value a line, or a time and an acceleration",
                    columns=columns,
                )
            )
        names = ["time", ""] if columns == 2 else [""]
    timed = bool(_TIME.match(names[0]))
    time = table[:, 0] if timed else None
    series = list(range(1, columns) if timed else range(columns))
    if not series:
        raise text.fault(tell("has a time column and no acceleration"))
    series = _accelerations(text, names, series, table)
    done: tuple[str, ...] = ()
    if time is not None and not _even(text, time, lines):
        even = [resampled(text, time, table[:, k], lines, len(series)) for k in series]
        values, step, done = [one.values for one in even], even[0].step, (even[0].said,)
        lines = even[0].lines
    else:
        values, step = (
            [table[:, k] for k in series],
            _time_step(text, time, unit_of(names[series[0]]) is not None),
        )
    codes = [name_of(names[k]) for k in series]
    for k in [] if timed else series:
        _require_no_time(text, names[k], table[:, k])
    return [
        without_gravity(
            text,
            Component(
                acceleration=column * _factor(text, names[k]),
                time_step=step,
                code=code,
                start=0.0 if time is None else float(time[0]),
                processing=done,
                lines=lines,
            ),
        )
        for k, code, column in zip(series, codes, values, strict=True)
    ]


def rows_of(text: RecordText, most: int | None = None) -> list[tuple[int, str]]:
    """(line number, line) of every line, or the first few, that is neither blank nor a comment.

    Decimal commas are points in them, and Fortran's exponents E.
    """
    rows = []
    comma = False
    for n, line in enumerate(text.lines, 1):
        row = line.strip().rstrip(",;")
        if '"' in row:  # as R and spreadsheets quote names and cells
            row = _QUOTED.sub(r"\1", row)
        if row and not row.startswith(_COMMENT):
            comma = comma or _has_decimal_commas(row)
            row = _DECIMAL_COMMA.sub(".", row) if comma else row
            if _FORTRAN.search(row) and numeric(row, fortran=True):
                row = _FORTRAN.sub("E", row)
            rows.append((n, row))
            if len(rows) == most:
                break
    return rows


def _has_decimal_commas(row: str) -> bool:
    """Whether a row of numbers has commas within them: 0,01;0,5 and 0,01 0,5 and 0,000002."""
    if "." in row or "," not in row:
        return False
    apart = _CELLS_APART.search(row) is not None and not re.search(r",\s|\s,|,,", row)
    return (apart and numeric(_DECIMAL_COMMA.sub(".", row))) or _ONE_CELL.fullmatch(row) is not None


def _below_titles(rows: list[tuple[int, str]]) -> list[tuple[int, str]]:
    """Rows from the header on, where it names a time or a unit and lines of a title are above it.

    All rows if they begin with the header, or with numbers.
    """
    at = next((k for k, (_, row) in enumerate(rows[: TITLES + 2]) if numeric(row)), 0)
    if at < 2:
        return rows
    names = header_of(rows[at - 1][1])
    named = any(_TIME.match(name) or unit_of(name) for name in names)
    fits = len(names) == len(_SPLIT.split(rows[at][1]))
    return rows[at - 1 :] if named and fits else rows


def _names(text: RecordText, line: int, row: str) -> list[str]:
    """The names of a header's columns.

    Raises:
        InputError: a name that looks like a damaged number, which would be lost as a header.
    """
    names = header_of(row)
    units = [name for name in names if _TIME.match(name) or unit_of(name)]
    named = units or any(
        name.isalpha()
        or _NAME.match(name)
        or (not name.isdigit() and (names_vertical(name) or names_horizontal(name)))
        for name in names
    )
    odd = next((name for name in names if _damaged(name) or not named), None)
    if odd is not None:
        raise text.fault(
            tell("expected numbers, or a header of names, found {found}", found=quoted(odd)), line
        )
    if not units:
        log.warning("%s, line %d: read as the columns' header: %s", text.path, line, quoted(row))
    return names


def _damaged(name: str) -> bool:
    """Whether a name is a number but for one character."""
    return "." in name and any(numeric(name[:k] + name[k + 1 :]) for k in range(len(name[:40])))


def _accelerations(
    text: RecordText, names: list[str], series: list[int], table: NDArray[np.float64]
) -> list[int]:
    """The columns that are no other quantity.

    Raises:
        InputError: all of them are.
    """
    lengths = {names[k] for k in series if _LENGTHS.search(names[k]) and table[:, k].min() >= 0.0}
    others = [names[k] for k in series if _is_other(names[k]) or names[k] in lengths]
    if len(others) == len(series):
        raise text.no_acceleration(
            tell("holds {others} but no acceleration", others=", ".join(map(quoted, others)))
        )
    if others:
        log.warning("%s: left out, no accelerations: %s", text.path, ", ".join(map(quoted, others)))
    return [k for k in series if names[k] not in others]


def _require_no_time(text: RecordText, name: str, values: NDArray[np.float64]) -> None:
    """Raise an error for a column that rises evenly, as a time does and no shaking."""
    steps = np.diff(values)
    if values.size > FEWEST and steps.min() > 0.0 and np.ptp(steps) < 0.5 * steps.mean():
        raise text.fault(
            tell(
                "column {column} rises evenly: is it the time? Name it 'time_s'",
                column=quoted(name) if name else 1,
            )
        )


def _is_other(name: str) -> bool:
    unit = unit_of(name)
    return bool(_OTHER_NAMES.match(name)) or (
        unit is not None and unit.lower().replace(" ", "") in _OTHER_UNITS
    )


def _require_unbroken(text: RecordText, rows: list[tuple[int, str]]) -> None:
    """Raise an error for a gap among the numbers, or a count before a column of them."""
    between = range(rows[0][0], rows[-1][0]) if rows else range(0)
    for n in between:
        line = text.lines[n].strip()
        if not line or line.startswith(_COMMENT):
            what = "a comment" if line else "a blank line"
            raise text.fault(
                tell("{what} among the numbers: is a sample missing?", what=what), n + 1
            )
    if len(rows) > 3 and rows[0][1] == str(len(rows) - 1):
        raise text.fault(
            tell(
                "begins with {count}, the number of values after it; remove the count",
                count=rows[0][1],
            ),
            rows[0][0],
        )


def numeric(line: str, *, fortran: bool = False) -> bool:
    """Whether all words of a line are numbers, if wanted with Fortran's exponents D."""
    try:
        [float(word) for word in _SPLIT.split(_FORTRAN.sub("E", line) if fortran else line)]
    except ValueError:
        return False
    return True


def header_of(line: str) -> list[str]:
    for separator in (",", ";", "\t"):
        if separator in line:
            return [name.strip() for name in line.split(separator)]
    return _WORDS.findall(line)


def table_of(
    text: RecordText, rows: list[tuple[int, str]], columns: int | None
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """The numbers of rows, shape (row, column), and the line of each row, (row,)."""
    require_two(text, len(rows), "rows of numbers")
    numbers = free(text, ((n, row.translate(_SEPARATORS)) for n, row in rows))
    columns = columns or int(numbers.per_line[0])
    empty = next((n for n, row in rows if _EMPTY.search(row)), None) if columns > 1 else None
    if empty is not None:
        raise text.fault(tell("expected a number, found an empty cell"), empty)
    return table(text, numbers, columns)


def _time_step(text: RecordText, time: NDArray[np.float64] | None, named: bool) -> float:
    """The step of evenly spaced values [s]; `named` says whether the file names their unit."""
    if time is None:
        if text.time_step is None:
            unit = "" if text.units or named else ", and --units with that of acceleration (units=)"
            raise text.unsaid(
                NO_TIME_STEP,
                "has no column 'time', 'time_s' or 'time (s)'",
                f"give --time-step-s with the time step [s] (in Python time_step=){unit}",
            )
        return text.time_step
    step = float(time[-1] - time[0]) / (time.size - 1)
    if text.time_step is not None and abs(text.time_step - step) > UNEVEN * step:
        raise text.fault(
            tell(
                "the time column has steps of {step:g} s; the time step given is {time_step:g} s",
                step=step,
                time_step=text.time_step,
            )
        )
    return text.time_step or text.step(step)


def _even(text: RecordText, time: NDArray[np.float64], lines: NDArray[np.int32]) -> bool:
    """Whether all times are one step apart, as far as their printed digits can tell."""
    step = float(time[-1] - time[0]) / (time.size - 1)
    if not step > 0.0:
        raise text.fault(tell("the time column does not rise"))
    steps = np.diff(time)
    unit = 10.0 ** -_decimals(text, lines)
    printed = np.rint(steps / unit)  # even times, rounded, are n or n + 1 units apart
    rounded = printed.max() - printed.min() <= 1 and printed.max() < 2 * printed.min()
    return bool(rounded or (np.abs(steps - step) <= UNEVEN * step).all())


def _decimals(text: RecordText, lines: NDArray[np.int32]) -> int:
    """The largest number of decimals with which a time is printed, at most 15."""
    times = [_SPLIT.split(text.lines[n - 1].strip())[0] for n in lines[:100]]
    if any("e" in time.lower() for time in times):
        return 9
    return min(15, max(len(time.partition(".")[2]) for time in times))


def name_of(name: str) -> str:
    """A column's name without its unit."""
    bare = _SLASHED.sub("", _IN_BRACKETS.sub("", name).strip())
    ends = [end for end in _SUFFIXES if bare.lower().endswith(f"_{end}")]
    return bare[: -len(max(ends, key=len)) - 1] if ends else bare


def _factor(text: RecordText, name: str) -> float:
    """One unit of the column in m/s²."""
    return text.factor(unit_of(name), f"column {quoted(name)}" if name else "the file")


def unit_of(name: str) -> str | None:
    """The unit in a column's name, in brackets or at its end; None if there is none."""
    brackets = _IN_BRACKETS.search(name)
    if brackets:
        return brackets.group(1).strip()
    slashed = _SLASHED.search(name)
    if slashed:
        return slashed.group(1)
    ends = [unit for end, unit in _SUFFIXES.items() if name.lower().endswith(f"_{end}")]
    return ends[0] if ends else None
