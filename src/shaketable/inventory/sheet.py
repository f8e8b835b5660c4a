"""A table as a file gives it: cells of text, each with the place where a user finds it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from shaketable.errors import InputError, printable

MOST_ROWS = 200_000
MOST_COLUMNS = 1000
LONGEST_TEXT = 1000  # characters of a cell


class Cell(NamedTuple):
    """A cell: its text without blanks around it, and where it is ("line 7", "cell B7")."""

    text: str
    where: str


@dataclass(frozen=True)
class Sheet:
    """A table's rows, from the file's first one on, those without text included.

    Attributes:
        path: the file.
        kind: what it was read as, in words.
        rows: cells of each row; a row may be shorter than others.
        decimal_comma: whether a comma in a number is a decimal sign.
    """

    path: Path
    kind: str
    rows: list[list[Cell]]
    decimal_comma: bool

    def fault(self, cell: Cell, message: str, header: str = "") -> str:
        """A fault of a cell in words, with its column's header."""
        named = f", {printable(header)}" if header else ""
        return f"{self.path}, {cell.where}{named}: {message}"

    def filled(self) -> Iterator[list[Cell]]:
        """The rows that hold any text."""
        return (row for row in self.rows if any(cell.text for cell in row))


def require_few(path: Path, rows: int, columns: int) -> None:
    """InputError for a table that is larger than any inventory."""
    if rows > MOST_ROWS:
        raise InputError(f"{path}: holds more than {MOST_ROWS:,} rows, the most that are read")
    if columns > MOST_COLUMNS:
        raise InputError(
            f"{path}: holds more than {MOST_COLUMNS:,} columns, the most that are read; each "
            "object needs a row, not a column"
        )
