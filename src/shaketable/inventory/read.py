"""Inventory files as items: text tables, .xlsx and .ods."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from shaketable.errors import Fault, named, quoted, refusal, refused, remark
from shaketable.inventory.building_sheet import building_said
from shaketable.inventory.carriers import may_be_fastened
from shaketable.inventory.columns import Column
from shaketable.inventory.hints import (
    may_say_what_it_stands_on,
    mentions_anchors,
    must_be_kept,
)
from shaketable.inventory.item import Castors, Item
from shaketable.inventory.numbers import number_in
from shaketable.inventory.rows import BASES, FURNITURE, IMPLAUSIBLE, NOT_EXPECTED, item_of
from shaketable.inventory.table import read_table
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
    """

    items: list[Item]
    rows: list[list[str]]
    kind: str
    columns: list[tuple[str, Column | None]]
    said_in: Path | None = None
    building: Mapping[str, object] | None = None


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
) -> Inventory:
    """The items of an inventory file and how its columns were understood, as `read_inventory`."""
    path = Path(path)
    found = read_table(path, sheet, columns, catalogue=catalogue)
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
    places: dict[tuple[str, ...], Cell] = {}
    again = 0
    comments: list[str] = []
    remarks: list[Fault] = []
    faults += _nameless(table, header, rows)
    for row in rows:
        name = _text_of(known, row, "name")
        if name.startswith("#") and sum(bool(cell.text) for cell in row) == 1:
            comments.append(row[0].where)
            continue
        if name.startswith("#"):
            message = tell("begins with #, like a comment; delete the row, or only the sign")
            faults.append(table.fault(row[0], "comment", message, "name"))
        wrong, item = item_of(
            table,
            known,
            row,
            accept_sizes=accept_sizes,
            unread=unread,
            remarks=remarks,
            catalogue=catalogue,
        )
        faults += wrong
        # the same name may be in several buildings, on several floors and in several rooms; in the
        # list of a portfolio, which names buildings, also more than once in a room
        here = tuple(_text_of(known, row, meaning) for meaning in SAME)
        if here[0] and here in places and here[1]:
            again += 1
        elif here[0] and here in places:
            message = tell(
                "{name} is also on {where}; make the names or locations differ, or use one row "
                "with a quantity",
                name=quoted(here[0]),
                where=places[here].where,
            )
            faults.append(table.fault(row[0], "again", message, "name"))
        places.setdefault(here, row[0])
        if item is not None:
            items.append(item)
            rows_of.append(row)
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
    taken = [_taken(column) for column in known if column and column.near]
    for text in (*layout.remarks, *taken):
        log.warning(remark(path, text))
    _warn_of_unused(path, found.header, known, unread)
    warn_of_hints(path, items)
    _warn_of_assumed(path, items)
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
        building=building_said(table),
    )


def _taken(column: Column) -> str:
    """What a column is taken for whose name is not a known one."""
    return tell(
        "{column} is taken for {meaning!r}", column=quoted(column.cell.text), meaning=column.meaning
    )


def _nameless(sheet: Sheet, header: list[Cell], rows: list[list[Cell]]) -> Iterator[Fault]:
    """Faults of cells that stand below an empty cell of the header."""
    for row in rows:
        for head, cell in zip(header, row, strict=False):
            if cell.text and not head.text:
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
    for k, column in enumerate(columns):
        if column is None or column.meaning not in (*BASES, "height"):
            continue
        sizes = {
            cell: number_in(sheet, cell, column).number
            for row in rows
            for cell in row[k : k + 1]
            if cell.text
        }
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


def _text_of(columns: list[Column | None], row: list[Cell], meaning: str) -> str:
    """The text of a row's cell of a meaning, "" if there is none."""
    pairs = zip(columns, row, strict=False)
    return next((cell.text for column, cell in pairs if column and column.meaning == meaning), "")


def _warn_of_assumed(path: Path, items: Sequence[Item]) -> None:
    """Warn of sizes that were taken from the catalogue."""
    told = list(
        dict.fromkeys(
            tell("{name} as {thing}", name=quoted(item.name), thing=quoted(item.assumed_as))
            for item in items
            if item.assumed
        )
    )
    if told:
        text = tell(
            "sizes that the list leaves out are assumed, as those of the catalogue: {things}",
            things=named(told, MOST_NAMED),
        )
        log.warning(remark(path, text))


def warn_of_hints(path: Path, items: Sequence[Item]) -> None:
    """Warn of names and notes that say what a column should say."""
    hints = {
        "may stand on castors. Say none, free or locked in a column 'castors'; until then they are "
        "simulated as if they had none, and get no class": [
            item.name for item in items if item.castors is Castors.UNKNOWN
        ],
        "may hang, or be fixed to the building: they are not simulated, and get no class. Say yes "
        "or no in a column 'anchored'": [item.name for item in items if item.hangs],
        "may be anchored, though the column 'anchored' says no: they are simulated as if they were "
        "not": [
            item.name
            for item in items
            if item.loose
            and not (item.surroundings and item.surroundings.straps)
            and mentions_anchors(item.name, item.note)
        ],
        "stand on castors of which it is not known whether they are locked: the worse of both is "
        "told, and in a room they are taken as locked. Say free or locked in a column 'castors'": [
            item.name for item in items if item.castors is Castors.SOME
        ],
        "are anchored, and not simulated: their walls, straps, pads and edges are not used": [
            item.name for item in items if item.anchored and item.surroundings
        ],
        "may be round, and what is round falls more often. Say box, cylinder or feet in a column "
        "'shape'; until then they are simulated as boxes, and get no class": [
            item.name for item in items if item.may_be_round
        ],
        "stand on something else, or are stacked. What they stand on is not simulated: they may "
        "fall with it, and it shakes them more strongly. They get no class. Assess what stands on "
        "the floor, and hold what stands on it": [
            item.name for item in items if item.stands_on and item.loose
        ],
        "stand on a bench, a plinth or a shelf, which is taken as fastened to the building. Name "
        "what moves in a column 'stands on', such as shelf or trolley": [
            item.name
            for item in items
            if item.loose
            and not (item.stands_on or item.rolls)
            and may_be_fastened(item.name, item.note, item.location)
        ],
        "may have to be kept from falling. Say yes or no in a column 'must_not_fall'": [
            item.name
            for item in items
            if not item.must_not_fall and must_be_kept(item.name, item.note)
        ],
    }
    for hint, names in hints.items():
        if names:
            told = named([quoted(name) for name in dict.fromkeys(names)], MOST_NAMED)
            text = tell(
                "by name, note or location, {names} {hint}", names=told, hint=translated(hint)
            )
            log.warning(remark(path, text))


def _warn_of_unused(
    path: Path, header: list[Cell], columns: list[Column | None], unread: tuple[str, ...]
) -> None:
    """Warn of columns that are not used, first of those that decide what can be said."""
    if unread:
        told = named([quoted(each) for each in unread], MOST_NAMED)
        text = tell(
            "{columns} may say what stands on castors, what is anchored or what is round, and is "
            "not understood: nothing gets a class. Call it castors, anchored, strap or shape, or "
            "put # before its name if it says none of these",
            columns=told,
        )
        log.warning(remark(path, text))
    unused = [
        cell.text
        for cell, column in zip(header, columns, strict=True)
        if column is None and cell.text and cell.text not in unread
    ]
    stands = [text for text in unused if may_say_what_it_stands_on(text)]
    if stands:
        text = tell(
            "{columns} may say what objects stand on, which is not simulated: what stands on "
            "furniture may fall with it, and is shaken more strongly. Assess what stands on the "
            "floor, and hold what stands on it",
            columns=named([quoted(each) for each in stands], MOST_NAMED),
        )
        log.warning(remark(path, text))
    if unused:
        told = named([quoted(each) for each in unused], MOST_NAMED)
        log.warning(remark(path, tell("columns that are not used: {columns}", columns=told)))
