"""Tables in spreadsheets: .xlsx with openpyxl, .ods with python-calamine."""

from __future__ import annotations

import datetime as dt
import io
import logging
import re
import warnings
import zipfile
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shaketable.errors import Fault, InputError, named, quoted, refusal, refused, remark
from shaketable.language import tell, translated
from shaketable.tables.open_document import Remark, remarks
from shaketable.tables.packed import require_elements, require_size
from shaketable.tables.sheet import (
    HEADER_WITHIN,
    Cell,
    IsHeader,
    Sheet,
    require_cells,
    require_few,
)

if TYPE_CHECKING:
    from openpyxl.worksheet.worksheet import Worksheet

log = logging.getLogger(__name__)

#: What is wrong with a cell.
REMARKS = {
    "error": "holds an error",
    "formula": "a formula without a value; open the file in a spreadsheet program and save it",
}
EXPLAINED = "columns"  # of a template
HIDDEN = "hidden cells are read like others: {cells}"
MOST_NAMED = 10
#: Parts of a number format that show nothing, and what stands for digits.
_SILENT = re.compile(r"\[[^\]]*\]|_.|\*.")
_DIGITS = re.compile(r"[#0?](?:[#0?,. /]*[#0?])?|general", re.IGNORECASE)
_LITERAL = re.compile(r'"([^"]*)"|\\(.)|([\'\s])')
_OPEN_DOCUMENT = b"mimetypeapplication/vnd.oasis.opendocument.spreadsheet"


class SheetChoiceError(InputError):
    """One of several sheets must be chosen.

    Attributes:
        sheets: names of those that hold anything.
    """

    sheets: tuple[str, ...] = ()


#: The name of the sheet to read, of all that hold anything.
Choose = Callable[[Mapping[str, Sequence[Sequence[object]]]], str]


def recognise(raw: bytes) -> bool:
    """Whether the bytes are a zip archive, as all of these spreadsheets are."""
    return raw.startswith(b"PK")


def read(
    path: Path,
    raw: bytes,
    wanted: str,
    is_header: IsHeader,
    chosen: str | None = None,
    known: Collection[str] = (),
) -> Sheet:
    """The table of a spreadsheet: its only sheet with text, or the one that is wanted.

    A value that stands in merged cells counts for each of them.

    Args:
        path, raw: the file and its bytes.
        wanted, is_header: as for `read_sheet`.
        chosen: `sheet` there.
        known: as there.

    Raises:
        InputError: no spreadsheet, none or several sheets that may be wanted, too many rows
            or columns.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(raw)) as archive:
            names = archive.namelist()
            require_size(path, archive)
    except InputError:
        raise
    except Exception as error:  # zipfile has more than one error for damage
        raise refused(path, tell("a damaged spreadsheet ({error})", error=error)) from None
    choose = partial(
        _only, path, wanted=wanted, is_header=is_header, chosen=chosen, known=(EXPLAINED, *known)
    )
    if _OPEN_DOCUMENT in raw[:200]:
        return _open_document(path, raw, choose)
    if "xl/workbook.xml" in names:
        return _excel(path, raw, choose)
    raise refused(path, tell("neither .xlsx nor .ods; accepted: CSV, .xlsx, .ods"))


def _excel(path: Path, raw: bytes, choose: Choose) -> Sheet:
    from openpyxl import load_workbook

    try:
        require_elements(path, raw)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about extensions of Excel that hold no cells
            values = load_workbook(io.BytesIO(raw), data_only=True)
            formulas = load_workbook(io.BytesIO(raw), data_only=False)
    except InputError:
        raise
    except Exception as error:  # openpyxl raises what XML and its own descriptors raise
        raise refused(
            path, tell("cannot be read as {kind} ({error})", kind=".xlsx", error=error)
        ) from None
    for page in values.worksheets:  # before their cells are looked at
        require_cells(path, page.max_row, page.max_column)
    filled = [sheet for sheet in values.worksheets if any(_values(sheet))]
    tables = {one.title: list(one.iter_rows(values_only=True)) for one in filled}
    sheet = values[choose(tables)]
    require_few(path, sheet.max_row, sheet.max_column)
    ranges = sheet.merged_cells.ranges
    merged = {
        place: sheet.cell(one.min_row, one.min_col) for one in ranges for place in _places(one)
    }
    tall = {place for one in ranges if one.max_row > one.min_row for place in _places(one)}
    broad = {place for one in ranges if one.max_col > one.min_col for place in _places(one)}
    hidden = [
        *(
            tell("column {name}", name=name)
            for name, one in sheet.column_dimensions.items()
            if one.hidden
        ),
        *(
            tell("row {number}", number=number)
            for number, one in sheet.row_dimensions.items()
            if one.hidden
        ),
    ]
    if hidden:
        told = named(hidden, MOST_NAMED)
        log.warning(remark(path, tell(HIDDEN, cells=told)))
    typed = formulas[sheet.title]
    word = translated("cell")
    rows = []
    for number, row in enumerate(sheet.iter_rows(), 1):
        cells = []
        for place, one in enumerate(row, 1):
            first = merged.get((number, place), one)
            cell = _cell(f"{word} {one.coordinate}", number, first.value)
            cell = cell._replace(
                shared=(number, place) in tall,
                wide=(number, place) in broad,
                unit=_unit_shown(first.number_format) if cell.typed else "",
            )
            formula = typed[first.coordinate].value
            if first.value is None and isinstance(formula, str) and formula.startswith("="):
                cell = cell._replace(wrong=translated(REMARKS["formula"]))
            cells.append(cell)
        rows.append(cells)
    kind = f"spreadsheet, sheet {quoted(sheet.title)}"
    return Sheet(path, kind, rows, name=sheet.title, sheets=tuple(tables))


def _places(merged: Any) -> Iterator[tuple[int, int]]:
    """Row and column of each of some merged cells."""
    return product(
        range(merged.min_row, merged.max_row + 1), range(merged.min_col, merged.max_col + 1)
    )


def _values(sheet: Worksheet) -> Any:
    return (cell for row in sheet.iter_rows(values_only=True) for cell in row if cell is not None)


def _open_document(path: Path, raw: bytes, choose: Choose) -> Sheet:
    from openpyxl.utils import get_column_letter
    from python_calamine import CalamineWorkbook

    try:
        # first, as it refuses what is no XML: python-calamine would look for a tag's end for ever
        require_elements(path, raw)
        noted = remarks(path, raw)
        workbook = CalamineWorkbook.from_filelike(io.BytesIO(raw))
        tables = {
            name: workbook.get_sheet_by_name(name).to_python(skip_empty_area=False)
            for name in workbook.sheet_names
        }
    except InputError:
        raise
    except Exception as error:  # what the parsers of its XML raise
        raise refused(
            path, tell("cannot be read as {kind} ({error})", kind=".ods", error=error)
        ) from None
    filled = {name: rows for name, rows in tables.items() if any(any(row) for row in rows)}
    name = choose(filled)
    table = [list(row) for row in filled[name]]
    require_few(path, len(table), max(map(len, table), default=0))
    word = translated("cell")
    wrong: dict[tuple[int, int], str] = {}
    tall: set[tuple[int, int]] = set()
    shown: dict[tuple[int, int], str] = {}
    for one in (each for each in noted if each.sheet == name):
        if one.kind == "hidden":
            row_number = tell("row {number}", number=one.row)
            log.warning(remark(path, tell(HIDDEN, cells=row_number)))
        elif one.kind == "merged":
            tall |= _fill(table, one)
        elif one.kind == "unit":
            shown[one.row, one.column] = one.text
        else:
            wrong[one.row, one.column] = translated(REMARKS[one.kind])
    rows = []
    for number, values in enumerate(table, 1):
        cells = [
            _cell(f"{word} {get_column_letter(k)}{number}", number, value)
            for k, value in enumerate(values, 1)
        ]
        rows.append(
            [
                cell._replace(
                    wrong=wrong.get((number, k), cell.wrong),
                    shared=(number, k) in tall,
                    unit=shown.get((number, k), "") if cell.typed else "",
                )
                for k, cell in enumerate(cells, 1)
            ]
        )
    kind = f"spreadsheet, sheet {quoted(name)}"
    return Sheet(path, kind, rows, name=name, sheets=tuple(filled))


def _fill(table: list[list[Any]], merged: Remark) -> set[tuple[int, int]]:
    """Put the value of merged cells into each of them; those that span several rows."""
    first = table[merged.row - 1 : merged.row]
    value = first[0][merged.column - 1 : merged.column] if first else []
    if not value:
        return set()  # nothing stands there
    columns = slice(merged.column - 1, merged.column - 1 + merged.columns)
    for row in table[merged.row - 1 : merged.row - 1 + merged.rows]:
        row[columns] = value * len(row[columns])
    return {
        (merged.row + down, merged.column + right)
        for down in range(merged.rows if merged.rows > 1 else 0)
        for right in range(merged.columns)
    }


def _only(
    path: Path,
    tables: Mapping[str, Sequence[Sequence[object]]],
    *,
    wanted: str,
    is_header: IsHeader,
    chosen: str | None,
    known: Collection[str],
) -> str:
    """The name of the sheet to read: the chosen one, the only one, the wanted one, or the only one
    whose first rows hold a header.

    Args:
        path: of the file.
        tables: each sheet that holds anything.
        wanted, is_header, chosen, known: as for `read`.
    """
    if not tables:
        raise refused(path, tell("no sheet holds anything"))
    names = named(list(map(quoted, tables)), MOST_NAMED)
    if chosen is not None:
        found = [name for name in tables if name.strip().lower() == chosen.strip().lower()]
        if not found:
            text = tell("has no sheet {sheet}; it has {names}", sheet=quoted(chosen), names=names)
            raise refused(path, text)
        _tell_others(path, tables, found[0], known)
        return found[0]
    called = [name for name in tables if name.strip().lower() == wanted.lower()]
    if len(tables) == 1:
        return next(iter(tables))
    if called:
        _require_largest(path, tables, called[0], known)
        return called[0]
    usable = {
        name: below
        for name, rows in tables.items()
        if (below := _rows_below_header(rows, is_header)) is not None
    }
    if len(usable) != 1:
        text = tell("holds {count} sheets: {names}", count=len(tables), names=names)
        if usable:
            most = max(usable, key=lambda name: usable[name])
            text = tell(
                "several sheets may hold the objects: {names}. {likely} has the most rows, "
                "{rows:,}",
                names=named([quoted(name) for name in usable], MOST_NAMED),
                likely=quoted(most),
                rows=usable[most],
            )
        raise _choice(path, tables, text)
    (name,) = usable
    _require_largest(path, tables, name, known)
    return name


def _choice(path: Path, tables: Mapping[str, object], text: str) -> SheetChoiceError:
    """The error that asks for a sheet."""
    mend = tell(
        "name it by --sheet, or in a file {file} as sheet = {example}, or save it alone",
        file=quoted(f"{path.name}.columns.toml"),
        example='"…"',
    )
    error = refusal([Fault(path, "", "", "sheet", text, mend)], SheetChoiceError)
    error.sheets = tuple(tables)
    return error


def _require_largest(
    path: Path, tables: Mapping[str, Sequence[Sequence[object]]], name: str, known: Collection[str]
) -> None:
    """Warn of the sheets that are not read, and ask where one of them holds as many rows.

    Raises:
        SheetChoiceError: a sheet that is left out holds at least as many rows as the one that is
            read: it may be the list, under headings that are not known.
    """
    rows = {each: _rows_of_cells(table) for each, table in tables.items()}
    larger = [
        each
        for each, count in rows.items()
        if each != name and each.strip().lower() not in known and count >= rows[name]
    ]
    if larger:
        text = tell(
            "only {read} names columns that are known, in {rows:,} rows, and {left} holds "
            "{more:,}: which of them is the list?",
            read=quoted(name),
            rows=rows[name],
            left=quoted(larger[0]),
            more=rows[larger[0]],
        )
        raise _choice(path, tables, text)
    _tell_others(path, tables, name, known)


def _rows_of_cells(rows: Sequence[Sequence[object]]) -> int:
    """How many rows hold two cells or more: a table's, not a note's."""
    return sum(sum(cell not in (None, "") for cell in row) > 1 for row in rows)


def _rows_below_header(rows: Sequence[Sequence[object]], is_header: IsHeader) -> int | None:
    """Rows with text below a header that is among the first; None if there is none."""
    texts = [[_text(cell) for cell in row] for row in rows[: HEADER_WITHIN + 1]]
    for k, row in enumerate(texts[:HEADER_WITHIN], 1):
        below = texts[k] if k < len(texts) else []
        alone = is_header(row)
        both = not alone and not is_header(below) and is_header([*row, *below])
        if alone or both:
            return sum(any(cell not in (None, "") for cell in each) for each in rows[k + both :])
    return None


def _tell_others(
    path: Path, tables: Mapping[str, object], name: str, known: Collection[str]
) -> None:
    """Warn of the sheets beside the one that is read."""
    others = [quoted(each) for each in tables if each != name and each.strip().lower() not in known]
    if others:
        told = named(others, MOST_NAMED)
        log.warning(remark(path, tell("sheets that are not read: {names}", names=told)))


def _cell(where: str, row: int, value: object) -> Cell:
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    text = _text(value)
    wrong = ""
    if isinstance(value, (dt.date, dt.time, dt.timedelta)):
        wrong = tell(
            "holds a date ({value}); a spreadsheet program may have made it of a number such as "
            "1.80; format the cell as a number and enter it again",
            value=text,
        )
    elif text.startswith("#") and text.rstrip("!?").isupper() and text.endswith(("!", "?", "/A")):
        wrong = tell("holds the error {text}", text=text)
    return Cell(text, where, row, number, wrong)


def _unit_shown(number_format: str) -> str:
    """The word that a format shows behind a number: ft of '0.0" ft"', "" of any other."""
    first = _SILENT.sub("", (number_format or "").split(";")[0])
    numbers = list(_DIGITS.finditer(first))
    if not numbers:
        return ""
    behind = first[numbers[-1].end() :]
    shown = "".join(each[1] or each[2] or each[3] or "" for each in _LITERAL.finditer(behind))
    return shown.strip()


def _text(value: object) -> str:
    """A cell's value as text."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.15g}"
    return str(value).strip()
