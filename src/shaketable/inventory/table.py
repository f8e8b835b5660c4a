"""A list's table: the sheet of a file, where in it objects stand, and what its columns mean."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from shaketable.errors import Fault, named, quoted, refused, remark
from shaketable.inventory.answers import ANSWERING
from shaketable.inventory.building_sheet import titles
from shaketable.inventory.columns import Column, is_header, said_of
from shaketable.inventory.header import columns_of
from shaketable.inventory.hints import may_say_what_decides
from shaketable.inventory.layout import Layout, layout_of
from shaketable.inventory.mapping import ListSaid, mapping_beside, read_mapping
from shaketable.language import tell
from shaketable.tables import Cell, Sheet, read_sheet

log = logging.getLogger(__name__)

OBJECTS = "Inventory"  # the sheet that is read where a workbook has one of that name


@dataclass(frozen=True, kw_only=True)
class Table:
    """The table of a list.

    Attributes:
        sheet: all of its cells.
        layout: its header and rows.
        columns: what each column means; None for one that is not used.
        faults: of the header.
        said: what the user says of it.
    """

    sheet: Sheet
    layout: Layout
    columns: list[Column | None]
    faults: list[Fault]
    said: ListSaid

    @cached_property
    def header(self) -> list[Cell]:
        """Names of the columns; # begins those of which the user says that they are not used."""
        return [
            cell._replace(text=f"#{cell.text}") if self.is_said_unused(cell) else cell
            for cell in self.layout.header
        ]

    def is_said_unused(self, cell: Cell) -> bool:
        """Whether the user says that a column is not used."""
        said = self.said.columns
        return said.get(said_of(cell, said)) == ""

    def is_unread(self, k: int) -> bool:
        """Whether a column is not used and may say castors, anchors or shapes.

        One that begins with # is left out on purpose.
        """
        head = self.header[k]
        return (
            self.columns[k] is None
            and head.text != ""
            and not head.text.startswith("#")
            and may_say_what_decides(
                head.text,
                [cell.text for row in self.layout.rows for cell in row[k : k + 1]],
                ANSWERING,
            )
        )


def read_table(
    path: Path,
    sheet: str | None = None,
    columns: str | Path | None = None,
    *,
    catalogue: bool = False,
    numbers: Sequence[int] = (),
) -> Table:
    """The table of a list; arguments as for `read_inventory`.

    Raises:
        InputError: the file, or the one that says what columns mean, cannot be used.
    """
    beside = mapping_beside(path) if columns is None else Path(columns)
    said = read_mapping(beside) if beside else ListSaid()
    if beside and columns is None:
        log.warning(remark(path, tell("columns are read as {file} says", file=beside.name)))
    found = read_sheet(
        path,
        OBJECTS,
        lambda texts: is_header(texts, said.columns),
        sheet=said.sheet if sheet is None else sheet,
        strict=False,
        known=titles("columns") | titles("building"),
        numbers=numbers,
    )
    layout = layout_of(found, said.columns)
    lost = set(said.columns) - {said_of(cell, said.columns) for cell in layout.header}
    if lost and beside:
        text = tell(
            "no column of the list is called {names}", names=named(sorted(map(quoted, lost)), 5)
        )
        raise refused(beside, text)
    known, faults = columns_of(
        found, layout.header, layout.rows, said.columns, layout.units, sizes=not catalogue
    )
    return Table(sheet=found, layout=layout, columns=known, faults=faults, said=said)
