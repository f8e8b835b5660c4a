"""The numbers of a record: how they are read, counted and held against what its header states."""

from __future__ import annotations

import logging
import math
import re
from array import array
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import quoted
from shaketable.records.text import RecordText

log = logging.getLogger(__name__)

MOST_VALUES = 10_000_000  # in one file
BETWEEN = 0.01  # steps: a time that is stated to seven digits is nearer to a value's time
PEAK_SHARE = 0.01  # by which the largest value may differ from the one that the header states

_NO_TIME = 1e6  # s

_EXPONENT = re.compile(r"(?<=\d)[EeDd][+-]?\d*$|(?<=\.)[EeDd][+-]?\d*$")
_PLAIN = re.compile(r"[-+.0-9eE \t\n]*")
_BLOCK = 1000  # lines
_NUMBERS = re.compile(r"\s*[-+.\d][-+.\dEeDd\s]*")
_DECIMALS = re.compile(r"\.(\d*)(?:[EeDd]([-+]?\d{1,3}))?")


class Numbers(NamedTuple):
    """Numbers as they stand in a file.

    Attributes:
        values: shape (n,).
        lines: the line on which each stands, counted from 1, (n,).
        per_line: how many stand on each line that holds any, in order.
    """

    values: NDArray[np.float64]
    lines: NDArray[np.int32]
    per_line: NDArray[np.int32]


class _Collected:
    """Numbers as they are read, line by line."""

    def __init__(self, text: RecordText) -> None:
        self.text = text
        self.values = array("d")
        self.lines = array("i")
        self.per_line = array("i")

    def add(self, words: list[str], line: int, plain: bool) -> None:
        try:
            if not plain:
                raise ValueError
            found = list(map(float, words))
        except ValueError:
            found = [self.text.number(word, line) for word in words]
        self.values.extend(found)
        self.lines.append(line)
        self.per_line.append(len(found))
        self._require_few(line)

    def _require_few(self, line: int) -> None:
        if len(self.values) > MOST_VALUES:
            raise self.text.fault(
                f"more than {MOST_VALUES:,} values, the most that are read of one file", line
            )

    def add_block(self, rows: list[tuple[int, str]]) -> None:
        """Rows at once, where all of them are plain numbers; else one by one."""
        joined = "\n".join(row for _, row in rows)
        try:
            if not _PLAIN.fullmatch(joined):
                raise ValueError
            self.values.extend(list(map(float, joined.split())))
        except ValueError:
            for line, row in rows:
                self.add(row.split(), line, plain=False)
            return
        self.lines.extend([line for line, _ in rows])
        self.per_line.extend([len(row.split()) for _, row in rows])
        self._require_few(rows[-1][0])

    def numbers(self) -> Numbers:
        values = np.frombuffer(self.values, np.float64).copy()
        per_line = np.frombuffer(self.per_line, np.int32).copy()
        lines = np.repeat(np.frombuffer(self.lines, np.int32), per_line)
        endless = np.flatnonzero(~np.isfinite(values))
        if endless.size:
            raise self.text.fault(
                "expected a finite number, found one that is too large", int(lines[endless[0]])
            )
        return Numbers(values, lines, per_line)


def words(
    text: RecordText, rows: Iterable[tuple[int, str]], *, count: int | None = None
) -> Numbers:
    """The numbers, separated by blanks, of rows (line number, line).

    Args:
        count: how many the header states; a last word that looks cut is not, if it is met.

    Raises:
        InputError: a word that is no number, or a file that ends within its last number.
    """
    collected = _Collected(text)
    held = [(line, row) for line, row in rows if row and not row.isspace()]
    for start in range(0, len(held), _BLOCK):
        collected.add_block(held[start : start + _BLOCK])
    found = collected.numbers()
    if held and found.values.size != count:
        at, row = held[-1]
        require_last(text, held[0][1].split()[0], row.split()[-1], at)
    return found


def fixed(
    text: RecordText,
    start: int,
    count: int,
    width: int,
    margin: int = 0,
    *,
    last: bool = False,
    ragged: bool = False,
) -> tuple[Numbers, int]:
    """`count` numbers in fields of `width` characters, from the line of index `start` on.

    Stops early at a line that is blank, ends the file, or says "End of".

    Args:
        margin: characters at the start of a line that belong to no field.
        last: whether no more numbers may follow.
        ragged: whether a line may be shorter than the first although others follow.

    Returns:
        The numbers and the index of the line after them.

    Raises:
        InputError: a row that is not a whole number of fields, or is shorter than the first
            although others follow; more numbers than expected.
    """
    collected = _Collected(text)
    at = start
    full = 0
    while len(collected.values) < count and at < len(text.lines):
        line = text.lines[at].rstrip()
        if not line or "END" in line[:40].upper():
            break
        fields = [line[k : k + width] for k in range(margin, len(line), width)]
        full = full or len(fields)
        held = len(collected.values) + len(fields)
        short = len(fields) != full and held < count and not ragged
        if short or not fields or len(fields[-1]) != width:
            raise text.fault(
                f"expected {full} fields of {width} characters, found {len(line)} characters",
                at + 1,
            )
        collected.add(fields, at + 1, _PLAIN.fullmatch(line) is not None)
        at += 1
    if last and at < len(text.lines) and _NUMBERS.fullmatch(text.lines[at]):
        raise text.fault(f"more numbers than the {count} that the header says", at + 1)
    return collected.numbers(), at


def require_last(text: RecordText, first: str, last: str, line: int) -> None:
    """Raise an error if a file ends within its last number: 1.5E-0 where others end in E-03."""
    usual, found = _EXPONENT.search(first), _EXPONENT.search(last)
    if usual is None or "." not in last:
        return
    if found is None or len(found[0]) < len(usual[0]):
        raise text.fault(
            f"cut short within a number: {quoted(last)}, where others are {quoted(first)}", line
        )


def require_count(text: RecordText, stated: int, found: int, what: str = "values") -> None:
    """Raise an error if the header says another number of values than was found."""
    if found != stated or found < 2:
        short = "cut short: " if found < stated else ""
        raise text.fault(f"{short}the header says {stated:.12g} {what}, found {found}")


def require_peak(
    text: RecordText,
    stated: str,
    line: int,
    values: NDArray[np.float64],
    *,
    per: float = 1.0,
    share: float = PEAK_SHARE,
    what: str = "values",
) -> None:
    """Raise an error if the largest value is not the one that the header states.

    Args:
        stated, line: the header's word and its line; zero states nothing.
        values: in any unit.
        per: one unit of the header in units of the values.
        share: by which they may differ, beside the rounding of the word.
    """
    peak = abs(text.number(stated, line)) * per
    found = float(np.abs(values).max())
    decimals = _DECIMALS.search(stated)
    digits = len(decimals[1]) - int(decimals[2] or 0) if decimals else 0
    if peak > 0.0 and not abs(found - peak) <= 0.51 * per * 10.0**-digits + share * peak:
        raise text.fault(
            f"the header says a peak of {quoted(stated.strip())}, {peak:.6g} in the unit of the "
            f"{what}, but the largest of them is {found:.6g}: one of the two is damaged",
            line,
        )


def require_peak_time(
    text: RecordText, stated: float, line: int, values: NDArray[np.float64], step: float
) -> None:
    """Raise an error if the largest value is not at the time that the header states.

    A time between two values is warned of: the step may be a little wrong, or the time rounded.

    Args:
        stated: [s] from the first value; a number that is no time states nothing.
        values: shape (n,), `step` [s] apart.
    """
    size = np.abs(values)
    at = stated / step
    if not 0.0 <= stated < _NO_TIME:
        return
    near = size[max(0, math.floor(at) - 1) : math.ceil(at) + 2]
    if near.size == 0 or near.max() < (1.0 - PEAK_SHARE) * size.max():
        raise text.fault(
            f"the header says a peak at {stated:g} s; with a time step of {step:g} s the largest "
            f"value is at {np.argmax(size) * step:g} s",
            line,
        )
    if abs(at - round(at)) > BETWEEN:
        log.warning(
            "%s, line %d: the header says a peak at %g s, which is no multiple of the time step of "
            "%g s; is one of the two damaged?",
            text.path,
            line,
            stated,
            step,
        )


def require_duration(
    text: RecordText, stated: float, line: int, count: int, step: float, *, within: float
) -> None:
    """Raise an error if count and time step do not make the duration that the header states.

    Args:
        stated: [s], of `count` or `count` - 1 steps.
        within: rounding of the header's number [s].
    """
    if min(abs(n * step - stated) for n in (count, count - 1)) > within:
        raise text.fault(
            f"the header says a duration of {stated:g} s, but {count} values with a time step of "
            f"{step:g} s last {count * step:g} s",
            line,
        )
