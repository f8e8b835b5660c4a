"""The numbers of a record, separated by blanks or in fields of one width."""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterable
from contextlib import suppress
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.text import RecordText

MOST_VALUES = 10_000_000  # in one series

_EXPONENT = re.compile(r"(?<=\d)[EeDd][+-]?\d*$|(?<=\.)[EeDd][+-]?\d*$")
_PLAIN = re.compile(r"[-+.0-9eE \t\n]*")
_BLOCK = 8000  # words that are converted at once
_NUMBERS = re.compile(r"\s*[-+.\d][-+.\dEeDd\s]*")


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
    """Numbers as they are read, line by line; words are converted many at a time."""

    def __init__(self, text: RecordText) -> None:
        self.text = text
        self.count = 0
        self.values = array("d")
        self.lines = array("i")
        self.per_line = array("i")
        self._words: list[str] = []
        self._from = 0  # the line, as an index of `lines`, on which the first of `_words` stands

    def add(self, words: list[str], line: int) -> None:
        """Enter the words of a line."""
        self._words += words
        self.count += len(words)
        self.lines.append(line)
        self.per_line.append(len(words))
        if len(self._words) > _BLOCK:
            self._convert()

    def _convert(self) -> None:
        # quick, but float() alone would take "1_0", "nan" and digits of other scripts
        found = None
        if _PLAIN.fullmatch("".join(self._words)):
            with suppress(ValueError):
                found = list(map(float, self._words))
        if found is None:
            lines = np.repeat(self.lines[self._from :], self.per_line[self._from :]).tolist()
            pairs = zip(self._words, lines, strict=True)
            found = [self.text.number(word, line) for word, line in pairs]
        self.values.extend(found)
        self._words, self._from = [], len(self.lines)
        if self.count > MOST_VALUES:
            raise self.text.fault(
                tell(
                    "more than {most_values:,} values in a series, the most that are read",
                    most_values=MOST_VALUES,
                ),
                self.lines[-1],
            )

    def numbers(self) -> Numbers:
        self._convert()
        values = np.frombuffer(self.values, np.float64).copy()
        per_line = np.frombuffer(self.per_line, np.int32).copy()
        lines = np.repeat(np.frombuffer(self.lines, np.int32), per_line)
        endless = np.flatnonzero(~np.isfinite(values))
        if endless.size:
            raise self.text.fault(
                tell("expected a finite number, found one that is too large"),
                int(lines[endless[0]]),
            )
        return Numbers(values, lines, per_line)


def free(text: RecordText, rows: Iterable[tuple[int, str]], *, count: int | None = None) -> Numbers:
    """The numbers, separated by blanks, of rows (line number, line).

    Args:
        count: how many the header states; a last word that looks cut is not, if it is met.

    Raises:
        InputError: a word that is no number, or a file that ends within its last number.
    """
    collected = _Collected(text)
    last: list[str] = []  # words of their lines
    line = 0
    for number, row in rows:
        words = row.split()
        if words:
            collected.add(words, number)
            last.append(words[-1])
            line = number
    found = collected.numbers()
    if last and found.values.size != count:
        _require_whole(text, last, line)
    return found


def fixed(
    text: RecordText,
    start: int,
    count: int,
    width: int,
    margin: int = 0,
    *,
    final: bool = False,
    ragged: bool = False,
) -> tuple[Numbers, int]:
    """`count` numbers in fields of `width` characters, from the line of index `start` on.

    Stops early at a line that is blank or has "END" in its first 40 characters, and at the end of
    the file.

    Args:
        margin: characters at the start of a line that belong to no field.
        final: whether no more numbers may follow.
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
    while collected.count < count and at < len(text.lines):
        line = text.lines[at].rstrip()
        if not line or "END" in line[:40].upper():
            break
        fields = [line[k : k + width] for k in range(margin, len(line), width)]
        full = full or len(fields)
        held = collected.count + len(fields)
        short = len(fields) != full and held < count and not ragged
        if short or not fields or len(fields[-1]) != width:
            raise text.fault(
                tell(
                    "expected {full} fields of {width} characters, found {count} characters",
                    full=full,
                    width=width,
                    count=len(line),
                ),
                at + 1,
            )
        collected.add(fields, at + 1)
        at += 1
    if final and at < len(text.lines) and _NUMBERS.fullmatch(text.lines[at]):
        raise text.fault(
            tell("more numbers than the {count} that the header says", count=count), at + 1
        )
    return collected.numbers(), at


def _require_whole(text: RecordText, words: list[str], line: int) -> None:
    """Raise an error if a file ends within its last number: 1.5E-0 where all others end in E-03.

    Args:
        text: of the file.
        words: the last ones of its lines.
        line: of the last of them.
    """
    *others, last = words
    if not others or "." not in last:
        return
    found = _EXPONENT.search(last)
    written = len(found[0]) if found else 0
    if (
        (usual := _EXPONENT.search(others[0]))
        and written < len(usual[0])
        and all((one := _EXPONENT.search(word)) and written < len(one[0]) for word in others)
    ):
        raise text.fault(
            tell(
                "cut short within a number: {found}, where others are {other}",
                found=quoted(last),
                other=quoted(others[0]),
            ),
            line,
        )


def table(
    text: RecordText, found: Numbers, columns: int
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """The numbers in rows, (row, column), and the line of each row, (row,).

    Raises:
        InputError: a row of another number of values.
    """
    odd = np.flatnonzero(found.per_line != columns)
    if odd.size:
        row = int(odd[0])
        line = int(found.lines[columns * row])  # each row before it has `columns` values
        raise text.fault(
            tell(
                "expected {columns} values, found {count}",
                columns=columns,
                count=found.per_line[row],
            ),
            line,
        )
    return found.values.reshape(-1, columns), found.lines[::columns]
