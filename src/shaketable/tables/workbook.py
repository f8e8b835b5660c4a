"""Tables in spreadsheets: .xlsx with openpyxl, .ods with python-calamine."""

from __future__ import annotations

import datetime as dt
import io
import logging
import warnings
import zipfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shaketable.errors import Fault, InputError, named, quoted, refusal, refused, remark
from shaketable.language import tell, translated
from shaketable.tables.open_document import remarks
from shaketable.tables.packed import require_elements, require_size
from shaketable.tables.sheet import HEADER_WITHIN, Cell, Sheet, require_cells, require_few

if TYPE_CHECKING:
    from openpyxl.worksheet.worksheet import Worksheet

log = logging.getLogger(__name__)

#: What is wrong with a cell.
REMARKS = {
    "error": "holds an error",
    "formula": "a formula without a value; open the file in a spreadsheet program and save it",
    "merged": "is merged with others; split them, so that each row stands for itself",
}
HIDDEN = "hidden cells are read like others: {cells}"
MOST_NAMED = 10
_OPEN_DOCUMENT = b"mimetypeapplication/vnd.oasis.opendocument.spreadsheet"


#: Tells from a row's texts whether it names the columns that are looked for.
IsHeader = Callable[[Iterable[str]], bool]


def recognise(raw: bytes) -> bool:
    """Whether the bytes are a zip archive, as all of these spreadsheets are."""
    return raw.startswith(b"PK")


def read(path: Path, raw: bytes, wanted: str, is_header: IsHeader) -> Sheet:
    """The table of a spreadsheet: its only sheet with text, or the one that is wanted.

    Args:
        path, raw: the file and its bytes.
        wanted, is_header: as for `read_sheet`.

    Raises:
        InputError: no spreadsheet, none or several sheets that may be wanted, too many rows
            or columns, cells that are merged below the first row, hold a date, an error, or a
            formula whose value is not in the file.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(raw)) as archive:
            names = archive.namelist()
            require_size(path, archive)
    except InputError:
        raise
    except Exception as error:  # zipfile has more than one error for damage
        raise refused(path, tell("a damaged spreadsheet ({error})", error=error)) from None
    if _OPEN_DOCUMENT in raw[:200]:
        return _open_document(path, raw, wanted, is_header)
    if "xl/workbook.xml" in names:
        return _excel(path, raw, wanted, is_header)
    raise refused(path, tell("neither .xlsx nor .ods; accepted: CSV, .xlsx, .ods"))


def _excel(path: Path, raw: bytes, wanted: str, is_header: IsHeader) -> Sheet:
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
    heads = {one.title: one.iter_rows(max_row=HEADER_WITHIN, values_only=True) for one in filled}
    sheet = values[_only(path, heads, wanted, is_header)]
    require_few(path, sheet.max_row, sheet.max_column)
    faults = [
        Fault(
            path,
            tell("sheet {sheet}", sheet=quoted(sheet.title)),
            "",
            "merged",
            tell(
                "cells {merged} are merged; split them, so that each row stands for itself",
                merged=merged,
            ),
        )
        for merged in map(str, sheet.merged_cells.ranges)
        if sheet[merged.partition(":")[0]].row > 1  # a title above the table may be wide
    ]
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
        for one in row:
            where = f"{word} {one.coordinate}"
            formula = typed[one.coordinate].value
            if one.value is None and isinstance(formula, str) and formula.startswith("="):
                faults.append(Fault(path, where, "", "formula", translated(REMARKS["formula"])))
            cells.append(_cell(path, where, number, one.value, faults))
        rows.append(cells)
    if faults:
        raise refusal(faults)
    return Sheet(path, f"spreadsheet, sheet {quoted(sheet.title)}", rows, decimal_comma=True)


def _values(sheet: Worksheet) -> Any:
    return (cell for row in sheet.iter_rows(values_only=True) for cell in row if cell is not None)


def _open_document(path: Path, raw: bytes, wanted: str, is_header: IsHeader) -> Sheet:
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
    heads = {title: rows[:HEADER_WITHIN] for title, rows in filled.items()}
    name = _only(path, heads, wanted, is_header)
    table = filled[name]
    require_few(path, len(table), max(map(len, table), default=0))
    faults: list[Fault] = []
    word = translated("cell")
    for one in noted:
        where = f"{word} {get_column_letter(max(one.column, 1))}{one.row}"
        if one.sheet != name:
            continue
        if one.kind == "hidden":
            row_number = tell("row {number}", number=one.row)
            log.warning(remark(path, tell(HIDDEN, cells=row_number)))
        elif one.kind != "merged" or one.row > 1:
            text = translated(REMARKS[one.kind])
            faults.append(Fault(path, where, "", one.kind, text))
    rows = []
    for number, row in enumerate(table, 1):
        places = [f"{word} {get_column_letter(k + 1)}{number}" for k in range(len(row))]
        cells = [
            _cell(path, where, number, value, faults)
            for where, value in zip(places, row, strict=True)
        ]
        rows.append(cells)
    if faults:
        raise refusal(faults)
    return Sheet(path, f"spreadsheet, sheet {quoted(name)}", rows, decimal_comma=True)


def _only(
    path: Path,
    heads: Mapping[str, Iterable[Iterable[object]]],
    wanted: str,
    is_header: IsHeader,
) -> str:
    """The name of the sheet to read: the only one, or the wanted one, or the only one whose first
    rows hold a header.

    Args:
        path: of the file.
        heads: the first rows of each sheet that holds anything.
        wanted, is_header: as for `read_sheet`.
    """
    if not heads:
        raise refused(path, tell("no sheet holds anything"))
    called = [name for name in heads if name.strip().lower() == wanted.lower()]
    if len(heads) == 1 or called:
        return called[0] if called else next(iter(heads))
    usable = [name for name, rows in heads.items() if any(is_header(map(str, row)) for row in rows)]
    if len(usable) != 1:
        raise refused(
            path,
            tell(
                "holds {count} sheets: {names}; call the one to read {wanted!r}, or save it alone",
                count=len(heads),
                names=named(list(map(quoted, heads)), MOST_NAMED),
                wanted=wanted,
            ),
        )
    others = [quoted(name) for name in heads if name != usable[0]]
    told = named(others, MOST_NAMED)
    log.warning(remark(path, tell("sheets that are not read: {names}", names=told)))
    return usable[0]


def _cell(path: Path, where: str, row: int, value: object, faults: list[Fault]) -> Cell:
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return Cell(_text(path, where, value, faults), where, row, typed=number)


def _text(path: Path, where: str, value: object, faults: list[Fault]) -> str:
    """A cell's value as text; dates and errors are faults."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (dt.date, dt.time, dt.timedelta)):
        message = tell(
            "holds a date ({value}); a spreadsheet program may have made it of a number such as "
            "1.80; format the cell as a number and enter it again",
            value=str(value),
        )
        faults.append(Fault(path, where, "", "date", message))
        return ""
    if isinstance(value, float):
        return f"{value:.15g}"
    text = str(value).strip()
    if text.startswith("#") and text.rstrip("!?").isupper() and text.endswith(("!", "?", "/A")):
        message = tell("holds the error {text}", text=text)
        faults.append(Fault(path, where, "", "error", message))
    return text
