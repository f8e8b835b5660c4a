"""Where in a sheet the objects stand: its header, its rows, and what is about all of them.

Titles may stand above the header, a heading above several columns ("Size [cm]"), units below it.
Totals, footnotes, headings of parts and tables of something else are left out, each with a remark.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from types import MappingProxyType

from shaketable.errors import named, refused
from shaketable.inventory.columns import (
    LENGTHS,
    METRES,
    UNITS,
    Column,
    ColumnsSaid,
    bracketed,
    is_header,
    nearly,
    understood,
)
from shaketable.inventory.vocabulary import heading, plain, row_words
from shaketable.language import tell, translated
from shaketable.tables.sheet import HEADER_WITHIN, Cell, Sheet

MOST_NAMED = 20  # rows in a remark
GROUP_ABOVE = 2  # rows of headings above the header
_NUMBER = re.compile(r"[-+]?\d[\d.,]*")
_FOOTNOTE = re.compile(r"[*†‡※¹²³]|\(?\d\)")
_KNOWN_UNITS = {unit for units in UNITS.values() for unit in units}


@dataclass(frozen=True)
class Layout:
    """What a sheet holds.

    Attributes:
        header: names of the columns, with the units that stand elsewhere.
        rows: of objects.
        remarks: what was left out or taken from elsewhere, in words.
    """

    header: list[Cell]
    rows: list[list[Cell]]
    remarks: tuple[str, ...] = ()


def layout_of(sheet: Sheet, said: ColumnsSaid = MappingProxyType({})) -> Layout:
    """The header and the rows of objects of a sheet.

    The header is the row with the most known names.

    Args:
        sheet: a table.
        said: what the user says of its columns.

    Raises:
        InputError: numbers above the header: they belong to another table.
    """
    filled = list(sheet.filled())
    if not filled:
        return Layout([], [])
    known = [
        sum(understood(cell, said) is not None for cell in row) for row in filled[:HEADER_WITHIN]
    ]
    at = known.index(max(known)) if max(known) > 1 else 0
    for row in filled[:at]:
        if sum(_NUMBER.fullmatch(cell.text) is not None for cell in row) > 1:
            text = tell(
                "numbers stand above the header on {header}; begin the file with the header",
                header=filled[at][0].where,
            )
            raise refused(sheet.path, text, where=row[0].where)
    remarks: list[str] = []
    header = _with_names_above(filled[at], filled[max(0, at - GROUP_ABOVE) : at], said)
    rows = filled[at + 1 :]
    units = _units_below(rows[0], header) if rows else {}
    if units:
        rows = rows[1:]
    header = _with_units(header, units, filled[max(0, at - 1) : at], said)
    rows, left = _rows_of(header, rows, said)
    remarks += left
    header, told = _with_unit_of_sheet(header, [*filled[:at], *filled[at + 1 :]], said)
    return Layout(header, rows, (*remarks, *told))


def _with_names_above(
    header: list[Cell], above: Sequence[list[Cell]], said: ColumnsSaid
) -> list[Cell]:
    """A header whose empty cells have the names that stand right above them."""
    found = []
    for k, cell in enumerate(header):
        names = [row[k] for row in reversed(above) if k < len(row) and row[k].text]
        taken = next((each for each in names if understood(each, said)), None)
        found.append(taken if not cell.text and taken else cell)
    return found


def _units_below(row: list[Cell], header: list[Cell]) -> dict[int, str]:
    """Units in a row below the header, by their columns; none if it is another row."""
    filled = {k: cell.text for k, cell in enumerate(row) if cell.text}
    units = {k: plain(text.strip("[]() ")) for k, text in filled.items()}
    known = {k: unit for k, unit in units.items() if unit in _KNOWN_UNITS}
    others = [text for k, text in filled.items() if k not in known]
    if not known or any(text.strip("-–— ") for text in others) or len(header) < 2:
        return {}
    return known


def _with_units(
    header: list[Cell], units: dict[int, str], above: Sequence[list[Cell]], said: ColumnsSaid
) -> list[Cell]:
    """A header with the units below it, and those of a heading above several columns."""
    group, groups = "", dict[int, str]()
    for k, cell in enumerate(above[0] if above else []):
        group = bracketed(cell.text) if cell.text else group
        groups[k] = group
    found = []
    for k, cell in enumerate(header):
        column = understood(cell, said) or nearly(cell)
        unit = units.get(k) or groups.get(k, "")
        takes = column is not None and not column.stated and unit in UNITS.get(column.meaning, {})
        found.append(_named(cell, unit) if takes else cell)
    return found


def _named(cell: Cell, unit: str) -> Cell:
    return cell._replace(text=f"{cell.text} ({unit})")


def _with_unit_of_sheet(
    header: list[Cell], others: Sequence[list[Cell]], said: ColumnsSaid
) -> tuple[list[Cell], list[str]]:
    """A header with the unit of all lengths that a title or a footnote tells."""
    columns = [understood(cell, said) or nearly(cell) for cell in header]
    bare = [k for k, column in enumerate(columns) if _is_bare_length(column)]
    if not bare:
        return header, []
    for row in others:
        for text in dict.fromkeys(cell.text for cell in row if cell.text):
            unit = _unit_of_all(text)
            if unit:
                told = tell(
                    "lengths whose column names no unit are in {unit}, as {text!r} says",
                    unit=unit,
                    text=text,
                )
                units = {k: _named(cell, unit) for k, cell in enumerate(header) if k in bare}
                return [units.get(k, cell) for k, cell in enumerate(header)], [told]
    return header, []


def _is_bare_length(column: Column | None) -> bool:
    return column is not None and column.meaning in LENGTHS and not column.stated


def _unit_of_all(text: str) -> str:
    """The unit of which a text says that all sizes are in it, "" if it says nothing."""
    said = heading(text)
    if not any(words in said for words in row_words("all_sizes")):
        return ""
    found = [word.strip("[]()") for word in re.split(r"[\s:、。,;]+", said)]
    return next((word for word in reversed(found) if word in METRES and len(word) > 1), "")


def _rows_of(
    header: list[Cell], rows: list[list[Cell]], said: ColumnsSaid
) -> tuple[list[list[Cell]], list[str]]:
    """The rows of objects, and what is said of those that are left out."""
    names = [cell.text for cell in header]
    meanings = [column and column.meaning for column in (understood(c, said) for c in header)]
    at = meanings.index("name") if "name" in meanings else 0
    full = [k for k, row in enumerate(rows) if len({cell.text for cell in row if cell.text}) > 1]
    last = full[-1] if full else -1
    kept: list[list[Cell]] = []
    left: dict[str, list[str]] = {}
    for number, row in enumerate(rows):
        texts = [cell.text for cell in row]
        if [text for text in texts if text] == [text for text in names if text]:
            left.setdefault("the header again", []).append(row[0].where)
        elif is_header(texts, said):
            left.setdefault("another table, to the end", []).append(row[0].where)
            break
        elif _is_total(row):
            left.setdefault("totals", []).append(row[0].where)
        elif len(set(texts) - {""}) == 1 and _is_no_object(row, at, number > last):
            left.setdefault("notes and headings", []).append(row[0].where)
        else:
            kept.append(row)
    told = [
        tell("left out, as {what}: {rows}", what=translated(what), rows=named(where, MOST_NAMED))
        for what, where in left.items()
    ]
    return kept, told


def _is_total(row: list[Cell]) -> bool:
    """Whether a row's first word is that of a sum."""
    first = next(cell.text for cell in row if cell.text)
    return heading(first).rstrip(" =") in row_words("totals")


def _is_no_object(row: list[Cell], name_at: int, after_all: bool) -> bool:
    """Whether a row with one text is a footnote, or the heading of the rows below it."""
    filled = [k for k, cell in enumerate(row) if cell.text]
    text = row[filled[0]].text
    if text.startswith("#"):  # a comment, which the reader of rows tells of
        return False
    return after_all or len(filled) > 1 or filled[0] != name_at or bool(_FOOTNOTE.match(text))
