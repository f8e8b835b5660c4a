"""The cells of a row by what they mean: sizes apart, in the row's unit, and which are not given."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import replace

from shaketable.errors import Fault, quoted
from shaketable.inventory.columns import (
    KILOGRAMS,
    METRES,
    SIZE,
    SIZES_OF_BODY,
    UNIT,
    Column,
    plain_unit,
)
from shaketable.inventory.numbers import has_a_unit, number_in, says_a_number
from shaketable.inventory.sizes import parts_of
from shaketable.inventory.vocabulary import plain
from shaketable.language import tell
from shaketable.tables.sheet import Cell, Sheet

NEEDED = ("depth", "width", "diameter", "height")
ROUNDING = 2e-3  # m: of a size that is given twice
Cells = dict[str, tuple[Cell, Column]]


def cells_of(columns: Sequence[Column | None], row: Sequence[Cell]) -> Cells:
    """The cells of a row and their columns by meaning; several sizes in a cell one by one.

    Where a size also has a column of its own, that one counts if it is filled.
    """
    found: Cells = {}
    for column, cell in zip(columns, row, strict=False):
        if column is not None and column.meaning == SIZE:
            found.update(_apart(cell, column))
    for column, cell in zip(columns, row, strict=False):
        if column is None or column.meaning == SIZE:
            continue
        if cell.text or cell.wrong or column.meaning not in found:
            found[column.meaning] = (cell, column)
    return found


def _apart(cell: Cell, column: Column) -> Cells:
    """The sizes in a cell, each as a cell of its own; empty ones for those that it does not hold.

    A cell that names all of its sizes need not follow the order of the heading; one that names some
    of them must.
    """
    parts = parts_of(cell.text)
    meanings = [part.meaning for part in parts]
    if parts and not all(meanings):
        order = list(column.order) if len(column.order) == len(parts) else []
        agrees = all(own in ("", due) for own, due in zip(meanings, order, strict=False))
        meanings = order if agrees else []
    if len(set(meanings)) < len(meanings):
        meanings = []
    empty = {} if "diameter" in meanings else dict.fromkeys(("depth", "width", "height"), "")
    texts = empty | {
        meaning: f"{part.text} {part.unit}".strip()
        for meaning, part in zip(meanings, parts, strict=False)
    }
    return {
        meaning: (cell._replace(text=text, typed=False), replace(column, meaning=meaning))
        for meaning, text in texts.items()
    }


def conflicts(
    sheet: Sheet, columns: Sequence[Column | None], row: Sequence[Cell]
) -> Iterator[Fault]:
    """Faults of sizes that one cell holds among others and another one by itself, differently."""
    inside: Cells = {}
    for column, cell in zip(columns, row, strict=False):
        if column is not None and column.meaning == SIZE:
            inside |= _apart(cell, column)
    for column, cell in zip(columns, row, strict=False):
        if column is None or column.meaning not in inside or not says_a_number(cell.text):
            continue
        other, its = inside[column.meaning]
        one, two = number_in(sheet, cell, column), number_in(sheet, other, its)
        if other.text and not (one.fault or two.fault) and abs(one.number - two.number) > ROUNDING:
            text = tell(
                "found {one:g} m, and {two:g} m among the sizes of this row",
                one=one.number,
                two=two.number,
            )
            yield sheet.fault(cell, "contradiction", text, column.cell.text)


def in_unit_of_row(sheet: Sheet, cells: Cells) -> tuple[Cells, list[Fault]]:
    """Cells with sizes in the unit that the row's own cell of units says, and faults of it."""
    if UNIT not in cells:
        return cells, []
    said, head = cells[UNIT]
    unit = plain_unit(plain(said.text))
    if unit and unit in KILOGRAMS and "mass" in cells:
        cell, column = cells["mass"]
        return {**cells, "mass": (cell, replace(column, unit=unit, stated=True))}, []
    sizes = [cell for meaning, (cell, _) in cells.items() if meaning in SIZES_OF_BODY]
    if unit and unit not in METRES and any(says_a_number(cell.text) for cell in sizes):
        text = tell("expected a unit of length, such as cm, found {found}", found=quoted(said.text))
        return cells, [sheet.fault(said, "unit", text, head.cell.text)]
    found, faults = dict(cells), list[Fault]()
    for meaning, (cell, column) in cells.items():
        if meaning not in SIZES_OF_BODY or not says_a_number(cell.text) or has_a_unit(cell):
            continue
        if not unit and not column.stated:
            text = tell("is empty: in which unit are the sizes of this row?")
            return cells, [sheet.fault(said, "unit", text, head.cell.text)]
        if unit and column.stated and column.factor != METRES[unit]:
            text = tell(
                "the unit is {one} in the column's name, and {other} in the row",
                one=column.unit,
                other=unit,
            )
            faults.append(sheet.fault(cell, "unit", text, column.cell.text))
        elif unit:
            found[meaning] = (cell, replace(column, unit=unit, stated=True))
    return found, faults


def without_words(cells: Cells) -> tuple[Cells, dict[str, str]]:
    """Cells without sizes that say no number, such as "?" and "unknown"; these by their meanings.

    What is merged or cannot be used is no such size.
    """
    found, words = dict(cells), dict[str, str]()
    for meaning, (cell, column) in cells.items():
        is_size = meaning in NEEDED and cell.text and cell.text[0] != "=" and not cell.wrong
        if is_size and not says_a_number(cell.text):
            words[meaning] = cell.text
            found[meaning] = (cell._replace(text=""), column)
    return found, words


def not_given(filled: Set[str], asked: Set[str], *, is_round: bool) -> list[str]:
    """Meanings of the sizes that a row must give and does not.

    Args:
        filled: meanings of its cells with text.
        asked: meanings that the list has columns for.
        is_round: whether one size across is enough, as of a cylinder. Without its width an object
            is assessed front to back; without its depth it would seem as stable as it is wide.
    """
    missing = [] if "height" in filled else ["height"]
    across = filled & {"depth", "width", "diameter"}
    if not across:
        return [*missing, next(size for size in ("depth", "width", "diameter") if size in asked)
                if asked & {"depth", "width", "diameter"} else "depth"]  # fmt: skip
    if "width" in across and "depth" in asked and not (is_round or across & {"depth", "diameter"}):
        missing.append("depth")
    return missing
