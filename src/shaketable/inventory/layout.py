"""Where in a sheet the objects stand: its header, its rows, and what is about all of them.

Titles may stand above the header, a heading above several columns ("Size [cm]"), units below it.
Totals, footnotes, headings of parts and tables of something else are left out, each with a remark.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from shaketable.errors import refused
from shaketable.inventory.columns import (
    KNOWN_UNITS,
    LENGTHS,
    METRES,
    SIZES_OF_BODY,
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
from shaketable.tables.faults import places
from shaketable.tables.sheet import HEADER_WITHIN, Cell, Sheet

GROUP_ABOVE = 2  # rows of headings above the header
WITHOUT_BLANKS = "\u3000"  # letters beyond it are of languages without them
SENTENCE = 5  # words: of a note, and not of a name
#: A number, with a unit or as a range: not what stands in titles.
_NUMBER = re.compile(r"[-+]?\d[\d.,]*\s*([a-z]{1,3}|[-–—~〜].*)?", re.IGNORECASE)
_FOOTNOTE = re.compile(r"[*†‡※¹²³]|\(?\d\)")
_UNIT_SAID = {"in", "en", "単位", ":", "："}  # before a unit of one letter

Row = list[Cell]


@dataclass(frozen=True)
class Layout:
    """What a sheet holds.

    Attributes:
        header: names of the columns.
        rows: of objects.
        units: of columns whose names have none, by their places, where they stand elsewhere.
        remarks: what was left out or taken from elsewhere, in words.
    """

    header: Row
    rows: list[Row]
    units: Mapping[int, str] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()


def layout_of(sheet: Sheet, said: ColumnsSaid = MappingProxyType({})) -> Layout:
    """The header and the rows of objects of a sheet.

    The header is the first row that names all that is needed, or the one with the most known names.

    Args:
        sheet: a table.
        said: what the user says of its columns.

    Raises:
        InputError: numbers above the header, which belong to another table; a unit that is another
            in a column's name and below it.
    """
    filled = list(sheet.filled())
    if not filled:
        return Layout([], [])
    first = filled[:HEADER_WITHIN]
    known = [sum(understood(cell, said) is not None for cell in row) for row in first]
    at = known.index(max(known)) if max(known) > 1 else 0
    whole = (k for k, row in enumerate(first) if is_header((c.text for c in row), said))
    at = next(whole, at)
    for row in filled[:at]:
        if sum(_NUMBER.fullmatch(cell.text) is not None for cell in row) > 1:
            text = tell(
                "numbers stand above the header on {header}; begin the file with the header",
                header=filled[at][0].where,
            )
            raise refused(sheet.path, text, where=row[0].where)
    header = _with_names_above(filled[at], filled[max(0, at - GROUP_ABOVE) : at], said)
    columns = [understood(cell, said) or nearly(cell, said) for cell in header]
    rows = filled[at + 1 :]
    below = _units_below(rows[0]) if rows else {}
    if below:
        _require_same(sheet, columns, below, rows[0])
        rows = rows[1:]
    rows, left = _rows_of(filled[at], columns, rows, said)
    units = _of_group(columns, filled[max(0, at - 1) : at]) | below
    units = {k: unit for k, unit in units.items() if _takes(columns, k, unit)}
    remarks = [
        tell(
            "left out, as {what}: {rows}",
            what=translated(what),
            rows=places([row[0].where for row in some]),
        )
        for what, some in left.items()
    ]
    bare = [k for k, column in enumerate(columns) if k not in units and _is_bare_length(column)]
    for text in _texts([*filled[:at], *left.get(NOTES, [])]) if bare else ():
        unit = _unit_of_all(text)
        if unit:
            units |= dict.fromkeys(bare, unit)
            remarks.append(
                tell(
                    "lengths whose column names no unit are in {unit}, as {text!r} says",
                    unit=unit,
                    text=text,
                )
            )
            break
    return Layout(header, rows, units, tuple(remarks))


def _with_names_above(header: Row, above: Sequence[Row], said: ColumnsSaid) -> Row:
    """A header whose empty cells have the names that stand right above them."""
    found = []
    for k, cell in enumerate(header):
        names = [row[k] for row in reversed(above) if k < len(row) and row[k].text]
        taken = next((each for each in names if understood(each, said)), None)
        found.append(taken if not cell.text and taken else cell)
    return found


def _units_below(row: Row) -> dict[int, str]:
    """Units in a row below the header, by their columns; none if it is another row."""
    filled = {k: cell.text for k, cell in enumerate(row) if cell.text}
    units = {k: plain(text.strip("[]() ")) for k, text in filled.items()}
    known = {k: unit for k, unit in units.items() if unit in KNOWN_UNITS}
    others = [text for k, text in filled.items() if k not in known]
    return {} if any(text.strip("-–— ") for text in others) else known


def _require_same(
    sheet: Sheet, columns: Sequence[Column | None], below: Mapping[int, str], row: Row
) -> None:
    for k, unit in below.items():
        column = columns[k] if k < len(columns) else None
        units = UNITS.get(column.meaning, {}) if column else {}
        if column and column.stated and unit in units and units[unit] != column.factor:
            text = tell(
                "the unit is {one} in the column's name, and {other} below it",
                one=column.unit,
                other=unit,
            )
            raise refused(sheet.path, text, where=row[k].where, column=column.cell.text)


def _of_group(columns: Sequence[Column | None], above: Sequence[Row]) -> dict[int, str]:
    """Units of a heading above several columns, up to the first that has its own or is no size."""
    group, found = "", dict[int, str]()
    cells = {k: cell for row in above for k, cell in enumerate(row)}
    for k, column in enumerate(columns):
        text = cells[k].text if k in cells else ""
        group = bracketed(text) if text else group
        if column is None or column.stated or column.meaning not in SIZES_OF_BODY:
            group = bracketed(text) if text else ""
        elif group:
            found[k] = group
    return found


def _takes(columns: Sequence[Column | None], k: int, unit: str) -> bool:
    """Whether a column takes a unit that does not stand in its name, or may, once it is known."""
    column = columns[k] if k < len(columns) else None
    return column is None or (not column.stated and unit in UNITS.get(column.meaning, {}))


def _is_bare_length(column: Column | None) -> bool:
    return column is not None and column.meaning in LENGTHS and not column.stated


def _texts(rows: Sequence[Row]) -> Iterator[str]:
    for row in rows:
        yield from dict.fromkeys(cell.text for cell in row if cell.text)


def _unit_of_all(text: str) -> str:
    """The unit of which a text says that all sizes are in it, "" if it says nothing."""
    told = heading(text)
    if not any(_has_words(told, words) for words in row_words("all_sizes")):
        return ""
    tokens = [
        each.strip("[]()") for each in re.split(r"[\s、。,;]+|(?<=[:：])|(?=[:：])", plain(text))
    ]
    tokens = [each for each in tokens if each]
    for before, each in zip(["", *tokens], tokens, strict=False):
        # "in" is a word before it is a unit, and one letter alone says nothing
        if each in METRES and ((len(each) > 1 and each != "in") or before in _UNIT_SAID):
            return each
    return ""


def _has_words(text: str, words: str) -> bool:
    """Whether a text has some words as wholes; in languages without blanks anywhere."""
    if max(words) > WITHOUT_BLANKS:
        return words in text
    return re.search(rf"(?<!\w){re.escape(words)}(?!\w)", text) is not None


NOTES = "notes and headings"
AGAIN = "the header again"
OTHER_TABLE = "another table, to the end"


def _rows_of(
    header: Row, columns: Sequence[Column | None], rows: list[Row], said: ColumnsSaid
) -> tuple[list[Row], dict[str, list[Row]]]:
    """The rows of objects, and those that are left out by what they are."""
    names = [heading(cell.text) for cell in header if cell.text]
    mine = _kinds(columns)
    meanings = [column and column.meaning for column in columns]
    at = meanings.index("name") if "name" in meanings else 0
    full = [k for k, row in enumerate(rows) if len(_contents(row)) > 1]
    last = full[-1] if full else -1
    kept: list[Row] = []
    left: dict[str, list[Row]] = {}
    skips_units = False
    for number, row in enumerate(rows):
        texts = [cell.text for cell in row]
        if skips_units and _units_below(row):
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
        elif len(_contents(row)) == 1 and _is_no_object(row, at, number > last, kept):
            left.setdefault(NOTES, []).append(row)
        else:
            kept.append(row)
    return kept, left


def _kinds(columns: Sequence[Column | None]) -> list[tuple[str, str] | None]:
    """Meanings and units of columns, by which two headers are alike."""
    return [(column.meaning, column.unit) if column else None for column in columns]


def _contents(row: Row) -> set[str]:
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
    if _FOOTNOTE.match(text):
        return True
    if len(filled) > 1 or filled[0] != name_at:
        return not _NUMBER.fullmatch(text)
    apart = bool(before) and row[0].row - before[-1][0].row > 1
    return after_all and (apart or len(text.split()) >= SENTENCE)
