"""Which rows of a list are objects, and what the others are: totals, notes, headings of parts."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from shaketable.errors import refused
from shaketable.inventory.catalogue import common_thing
from shaketable.inventory.columns import (
    SIZE,
    SIZES_OF_BODY,
    Column,
    ColumnsSaid,
    is_header,
    nearly,
    understood,
)
from shaketable.inventory.said_units import units_below, units_in
from shaketable.inventory.vocabulary import heading, row_words
from shaketable.language import tell
from shaketable.tables.sheet import Cell, Sheet

NOTES = "notes and headings"
HEADINGS = "headings of parts"
AGAIN = "the header again"
OTHER_TABLE = "another table, to the end"
SENTENCE = 5  # words: of a note, and not of a name
#: A number, with a unit or as a range: not what stands in titles.
NUMBER = re.compile(r"[-+]?\d[\d.,]*\s*([a-z]{1,3}|[-–—~〜].*)?", re.IGNORECASE)
_FOOTNOTE = re.compile(r"[*†‡※¹²³]|\(?\d\)")

Row = list[Cell]


def rows_of(
    sheet: Sheet,
    header: Row,
    columns: Sequence[Column | None],
    rows: list[Row],
    below: Mapping[int, str],
    said: ColumnsSaid,
) -> tuple[list[Row], dict[str, list[Row]]]:
    """The rows of objects, and those that are left out by what they are.

    Args:
        sheet: where they stand.
        header: the row of the header next to them.
        columns: what its cells mean.
        rows: below it, and below the units there.
        below: these, by their columns.
        said: what the user says of columns.

    Raises:
        InputError: the header again, with other units below it.
    """
    names = [heading(cell.text) for cell in header if cell.text]
    mine = _kinds(columns)
    meanings = [column and column.meaning for column in columns]
    at = meanings.index("name") if "name" in meanings else 0
    full = [k for k, row in enumerate(rows) if len(contents(row)) > 1]
    last = full[-1] if full else -1
    kept: list[Row] = []
    left: dict[str, list[Row]] = {}
    skips_units = False
    for number, row in enumerate(rows):
        texts = [cell.text for cell in row]
        if skips_units and (again := units_below(row)):
            if again != below:
                text = tell(
                    "the header comes again with other units below it: give what stands below it "
                    "as a list of its own"
                )
                raise refused(sheet.path, text, where=row[0].where)
            left[AGAIN].append(row)
            skips_units = False
            continue
        skips_units = False
        if [heading(text) for text in texts if text] == names:
            left.setdefault(AGAIN, []).append(row)
            skips_units = True
        elif is_header(texts, said):
            if _kinds([understood(cell, said) or nearly(cell, said) for cell in row]) == mine:
                left.setdefault(AGAIN, []).append(row)
                continue
            left[OTHER_TABLE] = rows[number:]
            break
        elif _is_total(row, at):
            left.setdefault("totals", []).append(row)
        elif _is_part_again(row, at, columns, left):
            left[HEADINGS].append(row)
        elif len(contents(row)) == 1 and _is_part(rows, number, at, last, left):
            left.setdefault(HEADINGS, []).append(row)
        elif len(contents(row)) == 1 and _is_no_object(row, at, number > last, kept):
            left.setdefault(NOTES, []).append(row)
        else:
            kept.append(row)
    return kept, left


def _is_part_again(
    row: Row, name_at: int, columns: Sequence[Column | None], left: Mapping[str, list[Row]]
) -> bool:
    """Whether a row without sizes is the heading of a part, as those before it are called."""
    words = row[name_at].text.split() if name_at < len(row) else []
    sizes = any(
        column is not None
        and column.meaning in (*SIZES_OF_BODY, SIZE)
        and any(map(str.isdigit, cell.text))
        for column, cell in zip(columns, row, strict=False)
    )
    before = [next(c.text for c in part if c.text).split()[0] for part in left.get(HEADINGS, [])]
    return len(words) > 1 and not sizes and words[0] in before


def _is_part(
    rows: list[Row], number: int, name_at: int, last: int, left: Mapping[str, list[Row]]
) -> bool:
    """Whether a row with one text is the heading of a part of the list, such as a room.

    Objects follow it, and it is the first row, stands apart from the row before it, or others like
    it do. Anywhere else a name alone is an object without sizes.
    """
    row = rows[number]
    filled = [k for k, cell in enumerate(row) if cell.text or cell.wrong]
    text = row[filled[0]].text
    at_name = filled == [name_at] or (filled[0] <= name_at <= filled[-1] and len(filled) > 1)
    if number >= last or not at_name or row[filled[0]].wrong or units_in(text):
        return False
    if text.startswith("#") or _FOOTNOTE.match(text) or NUMBER.fullmatch(text):
        return False
    if len(contents(rows[number + 1])) < 2:
        return False
    apart = number == 0 or row[0].row - rows[number - 1][0].row > 1
    return (apart or HEADINGS in left) and common_thing(text) is None


def _kinds(columns: Sequence[Column | None]) -> list[tuple[str, str] | None]:
    """Meanings and units of columns, by which two headers are alike."""
    return [(column.meaning, column.unit) if column else None for column in columns]


def contents(row: Row) -> set[str]:
    """What stands in a row; each cell that cannot be used by itself."""
    return {cell.text or f"\0{cell.where}" for cell in row if cell.text or cell.wrong}


def _is_total(row: Row, name_at: int) -> bool:
    """Whether a row's name, or its first word where it has no name, is that of a sum."""
    named = row[name_at].text if name_at < len(row) else ""
    first = named or next((cell.text for cell in row if cell.text), "")
    return heading(first).rstrip(" =") in row_words("totals")


def _is_no_object(row: Row, name_at: int, after_all: bool, before: Sequence[Row]) -> bool:
    """Whether a row with one text is a footnote, or the heading of the rows below it.

    A name alone is an object whose sizes are missing.
    """
    filled = [k for k, cell in enumerate(row) if cell.text or cell.wrong]
    text = row[filled[0]].text
    if text.startswith("#") or row[filled[0]].wrong:  # a comment, of which the reader tells
        return False
    if _FOOTNOTE.match(text) or units_in(text):
        return True
    if len(filled) > 1 or filled[0] != name_at:
        return not NUMBER.fullmatch(text)
    apart = bool(before) and row[0].row - before[-1][0].row > 1
    return after_all and (apart or len(text.split()) >= SENTENCE)
