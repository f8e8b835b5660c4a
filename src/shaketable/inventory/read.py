"""Inventory files as items: text tables, .xlsx and .ods."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from statistics import median

from shaketable.errors import Fault, named, quoted, refusal, refused, remark
from shaketable.inventory.blank_places import with_places_from_above
from shaketable.inventory.building_sheet import building_said
from shaketable.inventory.cells import cells_of, in_unit_of_row
from shaketable.inventory.columns import Column
from shaketable.inventory.item import Item
from shaketable.inventory.numbers import number_in
from shaketable.inventory.object_rows import contents
from shaketable.inventory.plausible import BASES, FURNITURE, IMPLAUSIBLE, NOT_EXPECTED
from shaketable.inventory.rows import item_of
from shaketable.inventory.table import read_table
from shaketable.inventory.told import (
    warn_of_assumed,
    warn_of_hints,
    warn_of_missing,
    warn_of_unused,
)
from shaketable.language import tell, translated
from shaketable.tables import Cell, Sheet, condensed

log = logging.getLogger(__name__)

OUTLIER = 100.0  # times the median of the rows
#: What one object may share with another, but not all of it.
SAME = ("name", "building", "latitude", "longitude", "floor", "location", "x", "y")
MOST_NAMED = 20  # objects or columns in a warning


@dataclass(frozen=True, kw_only=True)
class Inventory:
    """An inventory file as it was understood.

    Attributes:
        items: its objects.
        rows: the texts of each one's row.
        kind: what the file was read as, in words.
        columns: its columns, each with its header; None for one that is not used.
        said_in: the file that says what it does not say of itself, None without one.
        building: what a sheet of it says of the building, as a building's file would; None without.
        not_assessed: names of the objects whose sizes it does not give.
    """

    items: list[Item]
    rows: list[list[str]]
    kind: str
    columns: list[tuple[str, Column | None]]
    said_in: Path | None = None
    building: Mapping[str, object] | None = None
    not_assessed: list[str] = field(default_factory=list)


def read_inventory(
    path: str | Path,
    *,
    accept_sizes: bool = False,
    sheet: str | None = None,
    columns: str | Path | None = None,
    catalogue: bool = False,
) -> list[Item]:
    """Read the objects of an inventory file: CSV, .xlsx or .ods.

    Args:
        path: of the file.
        accept_sizes: whether objects may be smaller or larger than furniture is.
        sheet: name of the sheet of a workbook, where several may hold the objects.
        columns: file that says what columns mean, and which sheet is read; if None the one
            beside the list, such as list.xlsx.columns.toml, where there is one.
        catalogue: whether sizes that are left out are taken from the catalogue of common things,
            by their names: the ones of its ranges that tip most easily.

    Raises:
        InputError: lists the faults of the file, one a line, with the row or cell of each.
    """
    found = read_with_columns(
        path, accept_sizes=accept_sizes, sheet=sheet, columns=columns, catalogue=catalogue
    )
    if found.building:
        text = tell("its sheet of the building is not used here; --building takes a file of one")
        log.warning(remark(path, text))
    return found.items


def read_with_columns(
    path: str | Path,
    *,
    accept_sizes: bool = False,
    sheet: str | None = None,
    columns: str | Path | None = None,
    catalogue: bool = False,
    numbers: Sequence[int] = (),
) -> Inventory:
    """The items of an inventory file and how its columns were understood, as `read_inventory`.

    Args:
        path, accept_sizes, sheet, columns, catalogue: as there.
        numbers: of the rows below the first of a text, in the file from which it was made.
    """
    path = Path(path)
    found = read_table(path, sheet, columns, catalogue=catalogue, numbers=numbers)
    table, layout, known = found.sheet, found.layout, found.columns
    header, rows, faults = layout.header, layout.rows, list(found.faults)
    if faults:
        raise refusal(faults)
    if not rows:
        text = tell("holds no objects; each needs a row below the header")
        raise refused(path, "; ".join([text, *layout.remarks]))
    unread = tuple(head.text for k, head in enumerate(header) if found.is_unread(k))
    items: list[Item] = []
    rows_of: list[list[Cell]] = []
    places: dict[tuple[str, ...], list[Cell]] = {}
    again = 0
    comments: list[str] = []
    remarks: list[Fault] = []
    faults += _nameless(table, header, rows, remarks)
    rows, filled = with_places_from_above(table, known, rows)
    remarks += filled
    from_above = {fault.where for fault in filled}
    without: list[tuple[str, tuple[Fault, ...]]] = []
    for row in rows:
        name = _text_of(known, row, "name")
        if contents(row) and all(text.startswith("#") for text in contents(row)):
            comments.append(row[0].where)
            continue
        if name.startswith("#"):
            message = tell("begins with #, like a comment; delete the row, or only the sign")
            faults.append(table.fault(row[0], "comment", message, "name"))
        read = item_of(
            table,
            known,
            row,
            accept_sizes=accept_sizes,
            unread=unread,
            remarks=remarks,
            catalogue=catalogue,
        )
        faults += [*read.faults, *read.missing]
        item = read.item
        if read.missing:
            without.append((name, read.missing))
        # a name may be in several buildings, floors and rooms, and with other sizes more than once
        # in a room; in the list of a portfolio also with the same ones
        here = tuple(_text_of(known, row, meaning) for meaning in SAME)
        same = here in places and _texts(places[here]) == _texts(row)
        same = same and not {cell.where for cell in row} & from_above  # two of one, in one place
        if here[0] and here in places and (here[1] or not same):
            again += 1
        elif here[0] and here in places:
            message = tell(
                "{name} is also on {where}; make the names or locations differ, or use one row "
                "with a quantity",
                name=quoted(here[0]),
                where=places[here][0].where,
            )
            faults.append(table.fault(row[0], "again", message, "name"))
        places.setdefault(here, row)
        if item is not None:
            items.append(item)
            rows_of.append(row)
    lost = [fault for _, missing in without for fault in missing]
    if items and all(fault in lost for fault in faults):
        faults = []  # the other objects are assessed, and these named
    if not (faults or accept_sizes):
        faults += _outliers(table, known, rows_of)
    if any(fault.kind == IMPLAUSIBLE for fault in faults):
        text = tell(
            "sizes of {least:g} to {most:g} m are expected; name the unit in the header, as in "
            "'height_cm', or in the cell, as in '180 cm'; if they are right, pass --accept-sizes",
            least=FURNITURE[0],
            most=FURNITURE[1],
        )
        faults.append(Fault(path, "", "", "accepted", text))
    if faults:
        raise refusal(condensed(faults))
    if not items:
        rest = named(comments, MOST_NAMED)
        raise refused(path, tell("holds no objects but comments ({rest})", rest=rest))
    if again:
        text = tell(
            "{rows:,} rows repeat the name, building, floor and location of another; all of them "
            "count",
            rows=again,
        )
        log.warning(remark(path, text))
    for each in condensed(remarks):
        log.warning(each)
    warn_of_missing(path, without)
    taken = [_taken(column) for column in known if column and column.near]
    for text in (*layout.remarks, *taken):
        log.warning(remark(path, text))
    warn_of_unused(path, found.header, known, unread, rows)
    warn_of_hints(path, items)
    warn_of_assumed(path, items)
    if comments:
        told = named(comments, MOST_NAMED)
        text = tell("left out, as {what}: {rows}", what=translated("comments"), rows=told)
        log.warning(remark(path, text))
    used = zip(header, known, strict=True)
    return Inventory(
        items=items,
        rows=[[cell.text for cell in row] for row in rows_of],
        kind=table.kind,
        columns=[(cell.text, column) for cell, column in used],
        said_in=found.said.path,
        not_assessed=[name for name, _ in without],
        building=building_said(table),
    )


def _taken(column: Column) -> str:
    """What a column is taken for whose name is not a known one."""
    return tell(
        "{column} is taken for {meaning!r}", column=quoted(column.cell.text), meaning=column.meaning
    )


def _is_index(cells: Sequence[Cell]) -> bool:
    """Whether cells number the rows, as a table's index does."""
    numbers = [int(cell.text) for cell in cells if cell.text.isdecimal()]
    rises = all(one < other for one, other in pairwise(numbers))
    return len(numbers) == sum(bool(cell.text) for cell in cells) > 0 and rises


def _nameless(
    sheet: Sheet, header: list[Cell], rows: list[list[Cell]], remarks: list[Fault]
) -> Iterator[Fault]:
    """Faults of cells that stand below an empty cell of the header; an index of rows is told."""
    indices = set()
    for k, head in enumerate(header):
        if not head.text and _is_index([row[k] for row in rows if k < len(row)]):
            indices.add(k)
            text = tell("left out: a column without a name that numbers the rows")
            remarks.append(Fault(sheet.path, head.where, "", "index", text))
    for row in rows:
        for k, (head, cell) in enumerate(zip(header, row, strict=False)):
            if cell.text and not head.text and k not in indices:
                yield sheet.fault(
                    cell,
                    "nameless",
                    tell(
                        "stands in a column that the header does not name: {found}",
                        found=quoted(cell.text),
                    ),
                )


def _outliers(
    sheet: Sheet, columns: list[Column | None], rows: list[list[Cell]]
) -> Iterator[Fault]:
    """Faults of sizes that are OUTLIER times those of the other rows, or a share of that."""
    for column in columns:
        if column is None or column.meaning not in (*BASES, "height"):
            continue
        sizes = {}
        for row in rows:
            cells, _ = in_unit_of_row(sheet, cells_of(columns, row))
            cell, own = cells.get(column.meaning, (Cell("", ""), column))
            if cell.text:
                sizes[cell] = number_in(sheet, cell, own).number
        usual = median(sizes.values()) if len(sizes) > 2 else 0.0
        for cell, size in sizes.items():
            times = size / usual if usual else 1.0
            if not 1.0 / OUTLIER < times < OUTLIER:
                said = tell("a {times:.0f}th of", times=1 / times)
                if times > 1.0:
                    said = tell("{times:.0f} times", times=times)
                message = tell(
                    "{size:g} m is {times} what the other rows have, {usual:g} m: this "
                    "{implausible} beside them; is it in another unit?",
                    size=size,
                    times=said,
                    usual=usual,
                    implausible=translated(NOT_EXPECTED),
                )
                yield sheet.fault(cell, IMPLAUSIBLE, message, column.cell.text)


def _texts(row: Sequence[Cell]) -> list[str]:
    return [cell.text for cell in row]


def _text_of(columns: list[Column | None], row: list[Cell], meaning: str) -> str:
    """The text of a row's cell of a meaning, "" if there is none."""
    pairs = zip(columns, row, strict=False)
    return next((cell.text for column, cell in pairs if column and column.meaning == meaning), "")
