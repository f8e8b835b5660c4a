"""The header of a list as columns: what each means, by its name and by what stands below it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType

from shaketable.errors import Fault
from shaketable.inventory.columns import (
    KILOGRAMS,
    KNOWN_UNITS,
    LENGTH,
    METRES,
    ONCE,
    SIZE,
    SIZES_OF_BODY,
    UNIT,
    UNIT_IN_BRACKETS,
    UNITS,
    Column,
    ColumnsSaid,
    nearly,
    plain_unit,
    said_of,
    understood,
)
from shaketable.inventory.header_faults import faults_of
from shaketable.inventory.numbers import decimal_sign, has_a_unit
from shaketable.inventory.sizes import OTHER_SIZES, parts_of
from shaketable.inventory.vocabulary import (
    heading,
    plain,
    weak_headings,
)
from shaketable.language import tell
from shaketable.tables.sheet import Cell, Sheet

BASES = ("depth", "width", "diameter")
MOST_COUNTED = 100  # of one kind: a larger number is one of a room or an inventory

#: Letters of a word; one letter of a language without blanks may be one.
_WORD = re.compile(r"[^\W\d_]{4}|[\u3000-\u9fff]")
Columns = list[Column | None]


def columns_of(
    sheet: Sheet,
    header: list[Cell],
    rows: Sequence[Sequence[Cell]],
    said: ColumnsSaid = MappingProxyType({}),
    units: Mapping[int, str] = MappingProxyType({}),
    *,
    sizes: bool = True,
) -> tuple[Columns, list[Fault]]:
    """The columns, None for one that is not used, and the faults of the header.

    Args:
        sheet: where it stands.
        header: its cells.
        rows: of objects below it.
        said: what the user says of some; others of the same meaning are not used then.
        units: of columns whose names have none, by their places.
        sizes: whether columns of sizes are needed.
    """
    if not header:
        text = tell("the file is empty; its first row must name the columns")
        return [], [Fault(sheet.path, "", "", "empty", text)]
    columns = _by_name(header, said, units)
    values = [[row[k] for row in rows if k < len(row) and row[k].text] for k in range(len(header))]
    columns = _by_values(sheet, columns, header, values, said)
    elsewhere = set(units)
    columns = [
        None
        if column
        and _is_weak(column)
        and column.meaning in SIZES_OF_BODY
        and not said_of(column.cell, said)
        and not (column.stated or k in elsewhere or all(map(has_a_unit, values[k])))
        else column
        for k, column in enumerate(columns)
    ]
    columns = _once(_with_length(columns))
    columns = [
        column
        and replace(
            column,
            decimal=decimal_sign(
                _parts_alone(cells) if column.meaning == SIZE else cells, column.meaning
            ),
        )
        for column, cells in zip(columns, values, strict=True)
    ]
    return columns, faults_of(sheet, header, columns, values, said, sizes=sizes)


def _by_name(header: list[Cell], said: ColumnsSaid, units: Mapping[int, str]) -> Columns:
    """What each heading means by itself, or is meant to mean by the user."""
    columns = [understood(cell, said) if cell.text else None for cell in header]
    ruled = {column.meaning for column in columns if column and said_of(column.cell, said)}
    columns = [
        None if column and column.meaning in ruled and not said_of(column.cell, said) else column
        for column in columns
    ]
    exact = {column.meaning for column in columns if column}
    for k, cell in enumerate(header):
        if understood(cell, said):
            continue
        if columns[k] is None and cell.text and (near := nearly(cell, said)):
            columns[k] = near if near.meaning not in exact else None
            exact.add(near.meaning)
    return [
        replace(column, unit=units[k], stated=True)
        if column and k in units and not column.stated and units[k] in UNITS.get(column.meaning, {})
        else column
        for k, column in enumerate(columns)
    ]


def _by_values(
    sheet: Sheet,
    columns: Columns,
    header: list[Cell],
    values: Sequence[Sequence[Cell]],
    said: ColumnsSaid,
) -> Columns:
    """Columns whose names leave open what they are, by what stands below them."""
    found = [
        column if column is None or said_of(column.cell, said) else _by_cells(column, cells)
        for column, cells in zip(columns, values, strict=True)
    ]
    found = _without_weak(found, values, said)
    given = {column.meaning for column in found if column}
    if "height" in given and given & {*BASES, LENGTH}:
        return [
            None if column and column.meaning == SIZE and not said_of(column.cell, said) else column
            for column in found
        ]
    if SIZE not in given:
        for k, (cell, cells) in enumerate(zip(header, values, strict=True)):
            other = OTHER_SIZES.search(plain(cell.text)) or said_of(cell, said)
            if found[k] is None and cell.text and not other and _are_sizes(cells):
                found[k] = Column(cell, SIZE, "m", near=SIZE)
                break
    return found


def _by_cells(column: Column, cells: Sequence[Cell]) -> Column | None:
    """A column as its cells have it: units may be quantities, and sizes a word."""
    texts = [plain(cell.text) for cell in cells]
    if column.meaning == UNIT:
        known = [plain_unit(text) in METRES or plain_unit(text) in KILOGRAMS for text in texts]
        if any(known):
            return column  # what is none of them is told with its row
        plural = heading(column.cell.text).endswith(("s", "unità"))
        counts = plural and _are_counts(texts)
        return replace(column, meaning="quantity", unit="") if counts else None
    if column.meaning == SIZE and not _are_sizes(cells):
        return None
    if column.meaning == "quantity" and _is_weak(column) and not _are_counts(texts):
        return None
    return column


def _parts_alone(cells: Sequence[Cell]) -> list[Cell]:
    """Each of several sizes in cells as a cell."""
    return [
        cell._replace(text=part.text, typed=False) for cell in cells for part in parts_of(cell.text)
    ]


def _are_sizes(cells: Sequence[Cell]) -> bool:
    """Whether most cells hold several sizes."""
    with_digits = [cell for cell in cells if any(each.isdigit() for each in cell.text)]
    several = sum(bool(parts_of(cell.text)) for cell in with_digits)
    return 2 * several >= len(with_digits) and several > 0


def _are_counts(texts: Sequence[str]) -> bool:
    """Whether numbers count, and do not number: one of them comes twice, and none is large."""
    numbers = [int(text) for text in texts if text.isdecimal()]
    # 1, 2, 3, 1, 2: they begin anew in each room
    runs = numbers[:1] == [1] and all(other in (one + 1, 1) for one, other in pairwise(numbers))
    return (
        len(numbers) == len(texts) > 0
        and len(set(numbers)) < len(numbers)
        and max(numbers) <= MOST_COUNTED
        and not (runs and len(numbers) > 2)
    )


def _is_weak(column: Column) -> bool:
    words = heading(UNIT_IN_BRACKETS.sub("", plain(column.cell.text)))
    begin, _, unit = words.rpartition(" ")
    return words in weak_headings() or (unit in KNOWN_UNITS and begin in weak_headings())


def _without_weak(columns: Columns, values: Sequence[Sequence[Cell]], said: ColumnsSaid) -> Columns:
    """Columns without those whose heading means something only where no other column does.

    A name is text: numbers below "item" are those of objects where another column has names.
    """
    found = list(columns)
    names = [k for k, column in enumerate(columns) if column and column.meaning == "name"]
    numbered = [k for k in names if _are_numbers(values[k])]
    if len(numbered) < len(names):
        for k in numbered:
            found[k] = None
    strong = {column.meaning for column in found if column and not _is_weak(column)}
    return [
        column
        if column is None or said_of(column.cell, said) or not _is_weak(column)
        else None
        if column.meaning in strong
        else column
        for column in found
    ]


def _are_numbers(cells: Sequence[Cell]) -> bool:
    """Whether all cells are numbers or codes, such as "A-101", without a word."""
    return bool(cells) and all(
        any(map(str.isdigit, cell.text)) and not _WORD.search(cell.text) for cell in cells
    )


def _with_length(columns: Columns) -> Columns:
    """Columns with a length as the side of the base that no other column gives."""
    given = {column.meaning for column in columns if column}
    sides = [side for side in ("depth", "width") if side not in given]
    if LENGTH not in given or len(sides) == 2:
        return columns
    return [
        replace(column, meaning=sides[0], near=column.near or LENGTH, is_length=True)
        if column and sides and column.meaning == LENGTH
        else None
        if column and column.meaning == LENGTH
        else column
        for column in columns
    ]


def _once(columns: Columns) -> Columns:
    """Columns of which those of ONCE are there once."""
    found: Columns = []
    seen: set[str] = set()
    for column in columns:
        again = column is not None and column.meaning in ONCE and column.meaning in seen
        found.append(None if again else column)
        seen |= {column.meaning} if column else set()
    return found
