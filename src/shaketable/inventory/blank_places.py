"""Rooms and floors that a list writes once, above the objects that stand there."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from shaketable.errors import Fault
from shaketable.inventory.columns import Column
from shaketable.inventory.object_rows import contents
from shaketable.inventory.row_words import DASHES
from shaketable.language import tell
from shaketable.tables.sheet import Cell, Sheet

#: From the largest to the smallest: a new building ends what its floors and rooms were.
PLACES = ("building", "floor", "location")


def with_places_from_above(
    sheet: Sheet, columns: Sequence[Column | None], rows: Sequence[list[Cell]]
) -> tuple[list[list[Cell]], list[Fault]]:
    """Rows whose empty places are those of the row above, and what was filled in so.

    A list writes its places once where its first object has one, it names several, none stands in
    two rows that follow each other, and at least every third cell is empty, two or more. Anywhere
    else an empty cell says that no place is known, and stays empty; so do those of a portfolio
    with sites. A heading, a total or an empty row ends a place, and so does a dash.
    """
    bare = [Cell("", row[0].where, row[0].row) for row in rows]
    found = [
        [*row, *[cell] * (len(columns) - len(row))] for row, cell in zip(rows, bare, strict=True)
    ]
    # what a comment or a name alone leaves empty is nobody's place
    objects = [row for row in found if len(contents(row)) > 1]
    given = [[cell.text for cell in row] for row in objects]
    remarks = []
    larger: list[int] = []
    sites = any(each and each.meaning == "latitude" for each in columns)
    for meaning in () if sites else PLACES:
        at = next((k for k, each in enumerate(columns) if each and each.meaning == meaning), None)
        column = None if at is None else columns[at]
        if at is None or column is None:
            continue
        if _is_written_once([texts[at] for texts in given]):
            for above, row, was in zip(objects, objects[1:], given[1:], strict=False):
                moved = any(was[k] and was[k] != above[k].text for k in larger)
                ended = row[0].row - above[0].row > 1 or above[at].text in ("", *DASHES)
                if not (row[at].text or row[at].wrong or moved or ended):
                    row[at] = row[at]._replace(text=above[at].text)
                    text = tell("empty, and taken to be the same as above")
                    remarks.append(sheet.fault(row[at], "above", text, column.cell.text))
        larger.append(at)
    return found, remarks


def _is_written_once(texts: Sequence[str]) -> bool:
    """Whether texts name a place in its first row alone."""
    again = any(one and one == other for one, other in pairwise(texts))
    empty, places = texts.count(""), {*texts} - {"", *DASHES}
    once = bool(texts and texts[0]) and len(places) > 1 and not again
    return once and max(2, len(texts) / 3) <= empty
