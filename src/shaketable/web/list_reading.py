"""A list that a visitor gave: how it was understood, and what its columns mean."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from shaketable.errors import Fault, InputError, refusal
from shaketable.inventory import Inventory, Item, read_with_columns
from shaketable.inventory.columns import LENGTH, SIZE, UNIT, UNITS, WORDS, Column, bracketed
from shaketable.inventory.mapping import SUFFIX
from shaketable.inventory.sizes import LETTERS, SPELLED, letters_of
from shaketable.inventory.table import Table, read_table
from shaketable.inventory.vocabulary import heading
from shaketable.language import Language, speaking, tell, translated
from shaketable.report.run_log import RunLog
from shaketable.tables import Cell, SheetChoiceError
from shaketable.web.answers import ColumnMeaning, ColumnRead, Understood
from shaketable.web.limits import MOST_ROWS
from shaketable.web.uploads import Upload


class GivenList(NamedTuple):
    """Files of a list, as a visitor gave them.

    Attributes:
        file: the list.
        columns: what says the meanings of its columns, if anything does.
        accept_sizes, catalogue: as for `read_inventory`.
        rows: numbers of its rows in the file that the page made it of, as "3-9,11".
    """

    file: Upload
    columns: Upload | None = None
    accept_sizes: bool = False
    catalogue: bool = False
    rows: str = ""

    @classmethod
    def written(
        cls,
        folder: Path,
        name: str,
        data: bytes,
        columns: str,
        *,
        sizes: bool,
        catalogue: bool,
        rows: str = "",
    ) -> GivenList:
        """A list, written into a folder, with the text of the file that says its columns."""
        said = columns.encode()
        return cls(
            Upload.written(folder, name, data),
            Upload.written(folder, f"{name}{SUFFIX}", said) if said.strip() else None,
            sizes,
            catalogue,
            rows,
        )

    @property
    def numbers(self) -> list[int]:
        """Of its rows below the header, in the user's own file."""
        found: list[int] = []
        for span in filter(None, self.rows.split(",")):
            first, _, last = span.partition("-")
            if not (first.isdigit() and (last or first).isdigit()):
                continue
            found += islice(range(int(first), int(last or first) + 1), MOST_ROWS)
        return found[:MOST_ROWS]

    @property
    def said(self) -> Path | None:
        """Where its columns are said."""
        return self.columns.path if self.columns else None

    def read(self, sheet: str | None = None) -> Inventory:
        """Its objects.

        Raises:
            InputError: in the visitor's words.
        """
        try:
            found = read_with_columns(
                self.file.path,
                accept_sizes=self.accept_sizes,
                sheet=sheet,
                columns=self.said,
                catalogue=self.catalogue,
                numbers=self.numbers,
            )
            _require_rows(len(found.items))
        except InputError as error:
            raise self.refusal(error) from None
        return found

    def fault(self, fault: Fault) -> Fault:
        """A fault with the visitor's own names of the files."""
        for each in (self.columns, self.file):
            fault = each.fault(fault) if each else fault
        if fault.kind == "no column":
            mend = tell("choose it below, among the columns")
            if "--catalogue" in fault.mend:
                mend += tell("; or take usual sizes from the catalogue, below")
            return fault._replace(mend=mend)
        if fault.kind == "order":
            return fault._replace(mend=tell("or choose it below, among the columns"))
        if "--catalogue" in fault.mend:
            return fault._replace(mend=tell("or take usual sizes from the catalogue, below"))
        return fault

    def refusal(self, error: InputError) -> InputError:
        """An error in the visitor's words."""
        return refusal([self.fault(each) for each in error.listed])


def understand(
    name: str,
    data: bytes,
    accept_sizes: bool = False,
    language: Language = "en",
    sheet: str | None = None,
    columns: str = "",
    catalogue: bool = False,
    rows: str = "",
) -> Understood:
    """A list as it was read, with what is wrong with it, told in a language.

    Args:
        name, data: of its file.
        accept_sizes: whether objects may be of sizes that furniture does not have.
        language: of what is told.
        sheet: that is read, where a workbook has several.
        columns: text of the file that says what its columns mean.
        catalogue: whether sizes that are left out are taken from it.
        rows: numbers of its rows in the file that the page made it of, as "3-9,11".
    """
    with speaking(language), tempfile.TemporaryDirectory(prefix="shaketable-") as folder:
        given = GivenList.written(
            Path(folder),
            name,
            data,
            columns,
            sizes=accept_sizes,
            catalogue=catalogue,
            rows=rows,
        )
        with RunLog(shown=given.fault) as log:
            try:
                table = read_table(
                    given.file.path, sheet, given.said, catalogue=catalogue, numbers=given.numbers
                )
                _require_rows(len(table.layout.rows))
            except SheetChoiceError as choice:
                faults = [
                    given.fault(each)._replace(mend=tell("choose it above"))
                    for each in choice.listed
                ]
                return Understood(sheets=list(choice.sheets), faults=_told(faults))
            except InputError as error:
                raise given.refusal(error) from None
        return _understood(given, table, log)


def _understood(given: GivenList, table: Table, log: RunLog) -> Understood:
    items: list[Item] = []
    building = None
    faults = [given.fault(each) for each in table.faults]
    notes = log.messages
    if not faults:
        with RunLog(shown=given.fault) as log:
            try:
                inventory = given.read(table.sheet.name or None)
                items, building = inventory.items, inventory.building
            except InputError as error:
                faults = list(error.listed)
        notes = log.messages
    return Understood(
        sheets=list(table.sheet.sheets),
        sheet=table.sheet.name,
        columns=_columns(table),
        meanings=_meanings(),
        rows=[_sent(row, table) for row in table.layout.rows],
        numbers=[row[0].row for row in table.layout.rows],
        objects=len(items),
        building=None if building is None else {name: _plain(v) for name, v in building.items()},
        floors=any(item.floor for item in items),
        notes=without_level(notes),
        faults=_told(faults),
    )


UNREADABLE = "=?"  # of a cell without a value that can be used: a formula, an error


def _sent(row: Sequence[Cell], table: Table) -> list[str]:
    """The texts of a row, as the page shows them and sends them back.

    A cell that cannot be used stays one; what is merged over rows and left out is left out.
    """
    columns = {k: column.meaning for k, column in enumerate(table.columns) if column}
    return [
        ""
        if cell.shared and columns.get(k) in ("mass", "quantity", "cost")
        else f"{cell.text} {cell.unit}".strip() or (UNREADABLE if cell.wrong else "")
        for k, cell in enumerate(row)
    ]


def _columns(table: Table) -> list[ColumnRead]:
    """Columns, those of one heading told apart by a number, as each is said by its heading."""
    found = []
    seen = {heading(cell.text) for cell in table.layout.header}
    known: set[str] = set()
    elsewhere = table.layout.units
    unsure = {fault.column for fault in table.faults if fault.kind in ("column", "order")}
    if any(column and column.meaning == UNIT for column in table.columns):
        unsure |= {column.cell.text for column in table.columns if column}  # each row says its own
    for k, (cell, column) in enumerate(zip(table.layout.header, table.columns, strict=True)):
        name, again = cell.text, 1
        while name and heading(name) in (known if again == 1 else known | seen):
            again += 1
            name = f"{cell.text} {again}"
        known.add(heading(name))
        said = elsewhere.get(k) or bracketed(cell.text)
        found.append(
            ColumnRead(
                header=name,
                meaning=_meaning(column) if column else "",
                unit=("" if cell.text in unsure and not column.stated else _offered(column))
                if column
                else _SPELLED.get(said, said),
                renamed=again > 1,
                # by its new name it would be taken for a slip in a known one
                unused=table.is_said_unused(cell) or (again > 1 and column is None),
                asked=table.is_unread(k),
            )
        )
    return found


#: Each unit as it is offered: "lb" for "lbs".
_SPELLED = {
    unit: next(one for one, same in units.items() if same == factor)
    for units in UNITS.values()
    for unit, factor in units.items()
}


def _meanings() -> list[ColumnMeaning]:
    """All that a column may mean; of several sizes in a cell every order."""
    found = []
    for meaning in WORDS:
        units = list(_by_factor(meaning).values())
        if meaning == SIZE:
            label = translated("several sizes in a cell, each with its letter")
            found.append(ColumnMeaning(meaning=meaning, label=label, units=units))
            for letters in SPELLED:
                names = " × ".join(translated(LETTERS[each]) for each in letters)
                found.append(ColumnMeaning(meaning=f"{SIZE}_{letters}", label=names, units=units))
        else:
            label = translated(meaning.replace("_", " "))
            found.append(ColumnMeaning(meaning=meaning, label=label, units=units))
    return found


def _meaning(column: Column) -> str:
    """A column's meaning as the menu has it."""
    if column.is_length:
        return LENGTH
    letters = letters_of(column.order)
    return f"{column.meaning}_{letters}" if letters else column.meaning


def _offered(column: Column) -> str:
    """The unit of a column as it is offered: "cm" where the list has centimetres."""
    return _by_factor(column.meaning)[column.factor] if column.unit else ""


def _by_factor(meaning: str) -> dict[float, str]:
    """The units of a meaning, one spelling each."""
    found: dict[float, str] = {}
    for unit, factor in UNITS.get(meaning, {}).items():
        found.setdefault(factor, unit)
    return found


def _plain(value: object) -> str | float:
    return value if isinstance(value, (int, float)) else str(value)


def without_level(messages: Sequence[str]) -> list[str]:
    """Messages of a log without "WARNING", which says nothing where there are no others."""
    return [each.removeprefix("WARNING: ") for each in messages]


def _told(faults: Sequence[Fault]) -> list[str]:
    return [str(each) for each in faults]


def _require_rows(count: int) -> None:
    if count > MOST_ROWS:
        raise InputError(
            tell(
                "the list has {count:,} rows; at most {most:,} are taken here",
                count=count,
                most=MOST_ROWS,
            )
        )
