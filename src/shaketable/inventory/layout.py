"""Where in a sheet the objects stand: its header, its rows, and what is about all of them.

Titles may stand above the header, a heading above several columns ("Size [cm]"), units below it,
and the header may have two rows. Totals, footnotes and tables of something else are left out, each
with a remark. The heading of a part of the list is where the objects below it stand.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from shaketable.errors import named, quoted, refused
from shaketable.inventory.columns import (
    LENGTHS,
    METRES,
    SIZE,
    SIZES_OF_BODY,
    UNIT_IN_BRACKETS,
    UNITS,
    Column,
    ColumnsSaid,
    bracketed,
    has_columns_of_sizes,
    is_header,
    nearly,
    plain_unit,
    understood,
)
from shaketable.inventory.object_rows import HEADINGS, NOTES, NUMBER, contents, rows_of
from shaketable.inventory.said_units import SEVERAL, unit_alone, unit_of_all, units_below, units_in
from shaketable.inventory.sizes import OTHER_SIZES
from shaketable.inventory.vocabulary import plain
from shaketable.language import tell, translated
from shaketable.tables.faults import places
from shaketable.tables.sheet import HEADER_WITHIN, Cell, Sheet

GROUP_ABOVE = 2  # rows of headings above the header
MOST_NAMED = 20  # headings of parts in a remark
PARTS = "location"  # heading of the column of the parts of a list

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
    at, tall = _place_of_header(filled[:HEADER_WITHIN], said)
    for row in filled[:at]:
        if sum(NUMBER.fullmatch(cell.text) is not None for cell in row) > 1:
            text = tell(
                "numbers stand above the header on {header}; begin the file with the header",
                header=filled[at][0].where,
            )
            raise refused(sheet.path, text, where=row[0].where)
    if tall == 1:
        above = filled[max(0, at - 1) : at]
        header = _with_names_above(filled[at], filled[max(0, at - GROUP_ABOVE) : at], said)
    else:
        above = filled[at : at + 1]
        header = _joined(filled[at], filled[at + 1])
    columns = [understood(cell, said) or nearly(cell, said) for cell in header]
    rows = filled[at + tall :]
    below = units_below(rows[0]) if rows else {}
    if below:
        _require_same(sheet, columns, below, rows[0])
        rows = rows[1:]
    rows, left = rows_of(sheet, filled[at + tall - 1], columns, rows, below, said)
    units = _of_group(columns, above) | below
    alone = {unit for k, unit in below.items() if unit in METRES}
    if len(alone) == 1 and not any(_takes(columns, k, unit) and columns[k] for k, unit in
                                   below.items() if k < len(columns)):  # fmt: skip
        # "(ft)" below the names is about all sizes
        units |= dict.fromkeys((k for k, c in enumerate(columns) if _is_bare_length(c)), *alone)
    units = {k: unit for k, unit in units.items() if _takes(columns, k, unit)}
    _require_one_unit(sheet, columns, units, rows, left.get(NOTES, []))
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
        unit = unit_of_all(text)
        if unit == SEVERAL:
            message = tell(
                "names several units: {found}. Say the unit of each column in its heading",
                found=quoted(text),
            )
            raise refused(sheet.path, message)
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
    if HEADINGS in left:
        names = [next(cell.text for cell in row if cell.text) for row in left[HEADINGS]]
        remarks = [each for each in remarks if translated(HEADINGS) not in each]
        remarks.append(
            tell(
                "{parts} are read as headings of parts of the list",
                parts=named([quoted(each) for each in names], MOST_NAMED),
            )
        )
        header, rows = _with_parts(header, columns, rows, left[HEADINGS])
    return Layout(header, rows, units, tuple(remarks))


def _place_of_header(first: Sequence[Row], said: ColumnsSaid) -> tuple[int, int]:
    """Where the header begins, and of how many rows it is.

    Two rows are one header where neither alone names all that is needed and both together do.
    """
    texts = [[cell.text for cell in row] for row in first]
    for k, row in enumerate(texts):
        after = first[k + 1] if k + 1 < len(first) else []
        numbers = any(NUMBER.fullmatch(cell.text) for cell in (*first[k], *after))
        both = [] if numbers or not after else [cell.text for cell in _joined(first[k], after)]
        if is_header(row, said):
            apart = has_columns_of_sizes(both, said) and not has_columns_of_sizes(row, said)
            return k, 2 if apart or (both and _goes_on(row, after, said)) else 1
        if is_header(both, said) and not is_header(texts[k + 1], said):
            return k, 2
    known = [sum(understood(cell, said) is not None for cell in row) for row in first]
    if max(known) > 1:
        return known.index(max(known)), 1
    # what stands right above the first numbers
    counts = [sum(NUMBER.fullmatch(cell.text) is not None for cell in row) for row in first]
    return max(next((k for k, count in enumerate(counts) if count > 1), 0) - 1, 0), 1


def _goes_on(row: Sequence[str], after: Row, said: ColumnsSaid) -> bool:
    """Whether a row of headings goes on below, where it has groups of columns or nothing."""
    filled = [k for k, cell in enumerate(after) if cell.text]
    free = all(
        k >= len(row) or not row[k] or OTHER_SIZES.search(plain(row[k])) is not None for k in filled
    )
    return free and sum(understood(after[k], said) is not None for k in filled) > 1


def _joined(upper: Row, lower: Row) -> Row:
    """A header of two rows as one: what stands below counts, and a unit there goes with a name."""
    found = []
    group = ""
    for k, cell in enumerate(upper):
        under = lower[k] if k < len(lower) else None
        group = cell.text or group
        if under is None or not under.text or under.text == cell.text:
            found.append(cell)
            continue
        unit = unit_alone(under.text)
        named = f"{UNIT_IN_BRACKETS.sub('', cell.text).strip()} ({unit})" if unit else ""
        if OTHER_SIZES.search(plain(group)):  # those of its packing are not its own
            found.append(under._replace(text=f"{group}: {under.text}"))
            continue
        column = understood(cell._replace(text=named)) if named else None  # "T" may be a depth
        fits = column is not None and column.stated and column.unit == unit
        found.append(cell._replace(text=named) if fits else under)
    return [*found, *lower[len(upper) :]]


def _with_parts(
    header: Row, columns: Sequence[Column | None], rows: list[Row], parts: list[Row]
) -> tuple[Row, list[Row]]:
    """A header and rows with the part of the list as the place, where no column says that."""
    if any(column and column.meaning == "location" for column in columns):
        return header, rows
    titles = {row[0].row: next(cell.text for cell in row if cell.text) for row in parts}
    found = []
    for row in rows:
        above = [number for number in titles if number < row[0].row]
        part = titles[max(above)] if above else ""
        bare = Cell("", row[0].where, row[0].row)
        filled = [*row, *[bare] * (len(header) - len(row))]
        found.append([*filled, bare._replace(text=part)])
    width = max(len(header), *(len(row) - 1 for row in found)) if found else len(header)
    head = [*header, *[Cell("", header[0].where)] * (width - len(header))]
    return [*head, Cell(PARTS, header[0].where, header[0].row)], found


def _require_one_unit(
    sheet: Sheet,
    columns: Sequence[Column | None],
    units: Mapping[int, str],
    rows: Sequence[Row],
    notes: Sequence[Row],
) -> None:
    """InputError where a row among the objects says another unit for those below it."""
    own = {
        units.get(k, column.unit)
        for k, column in enumerate(columns)
        if column and column.meaning in (*SIZES_OF_BODY, SIZE)
    }
    for row in notes:
        among = rows and rows[0][0].row < row[0].row < rows[-1][0].row
        for text in _texts([row]) if among else ():
            found = units_in(text)
            if found and (len(own) != 1 or any(METRES[each] != METRES.get(*own) for each in found)):
                message = tell(
                    "says another unit among the objects: {found}. Give what stands below it as a "
                    "list of its own",
                    found=quoted(text),
                )
                raise refused(sheet.path, message, where=row[0].where)


def _with_names_above(header: Row, above: Sequence[Row], said: ColumnsSaid) -> Row:
    """A header whose empty cells have the names that stand right above them.

    Sizes below the heading of others, such as "Packing (cm)", are called so.
    """
    groups = above[-1] if above and len(contents(above[-1])) > 1 else []
    found = []
    for k, cell in enumerate(header):
        group = groups[k] if k < len(groups) else None
        if group and cell.text and OTHER_SIZES.search(plain(group.text)):
            found.append(cell._replace(text=f"{group.text}: {cell.text}"))
            continue
        names = [row[k] for row in reversed(above) if k < len(row) and row[k].text]
        taken = next((each for each in names if understood(each, said)), None)
        found.append(taken if not cell.text and taken else cell)
    return found


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
    merged = False
    for k, column in enumerate(columns):
        text = cells[k].text if k in cells else ""
        if text:
            group = _unit_of_sizes(text)
        elif merged:  # where the merged heading ends, so does what it says
            group = ""
        merged = k in cells and cells[k].wide
        if column is None or column.stated or column.meaning not in SIZES_OF_BODY:
            # a title may end in brackets, too
            above_it = understood(Cell(text, "")) if text else None
            group = _unit_of_sizes(text) if above_it and above_it.meaning == SIZE else ""
        elif group:
            found[k] = group
    return found


def _unit_of_sizes(text: str) -> str:
    """The unit of a heading above several columns: "Size [cm]", "Abmessungen in cm"."""
    column = understood(Cell(text, ""))
    stated = column.unit if column and column.meaning == SIZE and column.stated else ""
    return stated or plain_unit(bracketed(text)) or unit_alone(text)


def _takes(columns: Sequence[Column | None], k: int, unit: str) -> bool:
    """Whether a column takes a unit that does not stand in its name, or may, once it is known."""
    column = columns[k] if k < len(columns) else None
    return column is None or (not column.stated and unit in UNITS.get(column.meaning, {}))


def _is_bare_length(column: Column | None) -> bool:
    return column is not None and column.meaning in LENGTHS and not column.stated


def _texts(rows: Sequence[Row]) -> Iterator[str]:
    for row in rows:
        yield from dict.fromkeys(cell.text for cell in row if cell.text)
