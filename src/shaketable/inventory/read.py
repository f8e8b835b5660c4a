"""Inventory files as items: text tables, .xlsx and .ods."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from shaketable.errors import InputError, joined, quoted
from shaketable.inputs import read_file
from shaketable.inventory import text_table, workbook
from shaketable.inventory.columns import Column, columns_of, header_of
from shaketable.inventory.item import Castors, Item
from shaketable.inventory.rows import FURNITURE, item_of, size_of
from shaketable.inventory.sheet import Cell, Sheet

log = logging.getLogger(__name__)

REMEDY = "no size of furniture"
OUTLIER = 100.0  # times the median of the rows
MOST_NAMED = 20  # columns in a warning


@dataclass(frozen=True, kw_only=True)
class Inventory:
    """An inventory file as it was understood.

    Attributes:
        items: its objects.
        kind: what the file was read as, in words.
        columns: its columns, each with its header; None for one that is not used.
    """

    items: list[Item]
    kind: str
    columns: list[tuple[str, Column | None]]


def read_inventory(path: str | Path, *, accept_sizes: bool = False) -> list[Item]:
    """The items of an inventory file: CSV, .xlsx or .ods.

    Args:
        path: of the file.
        accept_sizes: whether objects may be smaller or larger than furniture is.

    Raises:
        InputError: lists the faults of the file, one a line, with the row or cell of each.
    """
    return read_table(path, accept_sizes=accept_sizes).items


def read_table(path: str | Path, *, accept_sizes: bool = False) -> Inventory:
    """The items of an inventory file and how its columns were understood, as `read_inventory`."""
    path = Path(path)
    raw = read_file(path)
    sheet = (workbook if workbook.recognise(raw) else text_table).read(path, raw)
    header, rows = header_of(sheet)
    columns, faults = columns_of(sheet, header)
    if faults:
        raise InputError(joined(faults))
    if not rows:
        raise InputError(f"{path}: holds no objects; each needs a row below the header")
    items: list[Item] = []
    rows_of: list[list[Cell]] = []
    places: dict[tuple[str, str], Cell] = {}
    for row in rows:
        found, item = item_of(sheet, columns, row, accept_sizes=accept_sizes)
        faults += found
        name, floor = (_text_of(columns, row, meaning) for meaning in ("name", "floor"))
        here = (name, floor)  # the same name may be on several floors
        if name and here in places:
            faults.append(
                sheet.fault(row[0], f"{quoted(name)} is also on {places[here].where}", "name")
            )
        places.setdefault(here, row[0])
        if item is not None:
            items.append(item)
            rows_of.append(row)
    if not (faults or accept_sizes):
        faults += _outliers(sheet, columns, rows_of)
    if any(REMEDY in fault for fault in faults):
        faults.append(
            f"{path}: sizes of {FURNITURE[0]:g} to {FURNITURE[1]:g} m are expected; name the unit "
            "in the header, as in 'height_cm', or pass --accept-sizes (in Python accept_sizes=True)"
        )
    if faults:
        raise InputError(joined(faults))
    _warn_of_unused(path, header, columns)
    _warn_of_castors(path, items)
    used = zip(header, columns, strict=True)
    return Inventory(
        items=items, kind=sheet.kind, columns=[(cell.text, column) for cell, column in used]
    )


def _outliers(sheet: Sheet, columns: list[Column | None], rows: list[list[Cell]]) -> Iterator[str]:
    """Faults of sizes that are OUTLIER times those of the other rows, or a share of that."""
    for k, column in enumerate(columns):
        if column is None or column.meaning not in ("depth", "width", "height"):
            continue
        sizes = {
            cell: size_of(sheet, cell, column)
            for row in rows
            for cell in row[k : k + 1]
            if cell.text
        }
        usual = median(sizes.values()) if len(sizes) > 2 else 0.0
        for cell, size in sizes.items():
            times = size / usual if usual else 1.0
            if not 1.0 / OUTLIER < times < OUTLIER:
                said = f"{times:.0f} times" if times > 1.0 else f"a {1 / times:.0f}th of"
                yield sheet.fault(
                    cell,
                    f"{size:g} m is {said} what the other rows have, {usual:g} m: {REMEDY} beside "
                    "them; is it in another unit?",
                    column.cell.text,
                )


def _text_of(columns: list[Column | None], row: list[Cell], meaning: str) -> str:
    """The text of a row's cell of a meaning, "" if there is none."""
    pairs = zip(columns, row, strict=False)
    return next((cell.text for column, cell in pairs if column and column.meaning == meaning), "")


def _warn_of_castors(path: Path, items: list[Item]) -> None:
    names = [item.name for item in items if item.castors is Castors.UNKNOWN]
    if names:
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        log.warning(
            "%s: by its name or note an object may stand on castors: %s%s; say none, free or "
            "locked in a column 'castors'; until then it is simulated as if it had none, and gets "
            "no class",
            path,
            ", ".join(map(quoted, names[:MOST_NAMED])),
            more,
        )


def _warn_of_unused(path: Path, header: list[Cell], columns: list[Column | None]) -> None:
    unused = [
        cell.text
        for cell, column in zip(header, columns, strict=True)
        if column is None and cell.text
    ]
    if unused:
        log.warning(
            "%s: columns that are not used: %s", path, ", ".join(map(quoted, unused[:MOST_NAMED]))
        )
