"""A table as a file gives it: cells of text, each with the place where a user finds it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from shaketable.errors import Fault, printable, refused
from shaketable.language import tell

MOST_ROWS = 200_000
MOST_COLUMNS = 1000
MOST_CELLS = 4_000_000
HEADER_WITHIN = 20  # rows with text, of which one must be the header
LONGEST_TEXT = 1000  # characters of a cell


#: One to three digits and groups of three: 1.800 and 1,800 may be a thousand times each other.
THOUSANDS = re.compile(r"[1-9]\d{0,2}([.,])\d{3}(\1\d{3})*")
_WITH_DECIMALS = re.compile(r"[-+]?\d*([.,])\d+")


#: Tells from a row's texts whether it names the columns that are looked for.
IsHeader = Callable[[Iterable[str]], bool]


class Cell(NamedTuple):
    """A cell of a table."""

    text: str  # without blanks around it
    where: str  # "line 7", "cell B7"
    row: int = 0  # its line in a text, its row in a sheet, from 1
    typed: bool = False  # whether the file holds a number, not its text
    wrong: str = ""  # why it cannot be used, such as a formula without a value
    shared: bool = False  # whether it is merged over several rows
    wide: bool = False  # whether it is merged over several columns
    unit: str = ""  # that the number's format shows beside it


@dataclass(frozen=True)
class Sheet:
    """A table's rows, from the file's first one on, those without text included.

    Attributes:
        path: the file.
        kind: what it was read as, in words.
        rows: cells of each row; a row may be shorter than others.
        name: of the sheet in a workbook, "" of a text.
        sheets: names of all that hold anything; none of a text.
    """

    path: Path
    kind: str
    rows: list[list[Cell]]
    name: str = ""
    sheets: tuple[str, ...] = ()

    @cached_property
    def decimal_signs(self) -> set[str]:
        """The decimal signs of the cells that leave no doubt about theirs."""
        texts = (cell.text for row in self.rows for cell in row if not cell.typed)
        found = (_WITH_DECIMALS.fullmatch(text) for text in texts if not THOUSANDS.fullmatch(text))
        return {match[1] for match in found if match}

    @property
    def wrong(self) -> list[Fault]:
        """Faults of all cells that cannot be used."""
        return [
            self.fault(cell, "cell", cell.wrong) for row in self.rows for cell in row if cell.wrong
        ]

    def fault(self, cell: Cell, kind: str, message: str, header: str = "") -> Fault:
        """A fault of a cell, with its column's header."""
        return Fault(self.path, cell.where, printable(header), kind, message)

    def filled(self) -> Iterator[list[Cell]]:
        """The rows that hold anything, also what cannot be used."""
        return (row for row in self.rows if any(cell.text or cell.wrong for cell in row))


def require_few(path: Path, rows: int, columns: int) -> None:
    """InputError for a table that is larger than any that people make."""
    if rows > MOST_ROWS:
        raise refused(
            path,
            tell(
                "holds more than {most:,} rows, the most that are read",
                most=MOST_ROWS,
            ),
        )
    if columns > MOST_COLUMNS:
        raise refused(
            path,
            tell(
                "holds more than {most:,} columns, the most that are read; what is listed "
                "needs a row each, not a column",
                most=MOST_COLUMNS,
            ),
        )
    require_cells(path, rows, columns)


def require_cells(path: Path, rows: int, columns: int) -> None:
    """InputError for a table that spans more cells than are read."""
    if rows * columns > MOST_CELLS:
        raise refused(
            path,
            tell(
                "spans {rows:,} rows and {columns:,} columns; at most {most:,} cells are "
                "read: delete what stands far away from the table",
                rows=rows,
                columns=columns,
                most=MOST_CELLS,
            ),
        )
