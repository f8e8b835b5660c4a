"""Tables in spreadsheets: .xlsx with openpyxl, .ods with python-calamine."""

from __future__ import annotations

import datetime as dt
import io
import logging
import warnings
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shaketable.errors import InputError, joined, quoted
from shaketable.inventory.sheet import Cell, Sheet, require_few

if TYPE_CHECKING:
    from openpyxl.worksheet.worksheet import Worksheet

log = logging.getLogger(__name__)

LARGEST = 200_000_000  # bytes, unpacked
_OPEN_DOCUMENT = b"mimetypeapplication/vnd.oasis.opendocument.spreadsheet"


def recognise(raw: bytes) -> bool:
    """Whether the bytes are a zip archive, as all of these spreadsheets are."""
    return raw.startswith(b"PK")


def read(path: Path, raw: bytes) -> Sheet:
    """The only table of a spreadsheet.

    Raises:
        InputError: no spreadsheet, none or several sheets with text, cells that are merged, hold a
            date, an error, or a formula whose value is not in the file.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(raw)) as archive:
            names = archive.namelist()
            size = sum(one.file_size for one in archive.infolist())
    except zipfile.BadZipFile as error:
        raise InputError(f"{path}: a damaged spreadsheet ({error})") from None
    if size > LARGEST:
        raise InputError(
            f"{path}: unpacks to {size / 1e6:.0f} MB; at most {LARGEST / 1e6:.0f} MB are read"
        )
    if _OPEN_DOCUMENT in raw[:200]:
        return _open_document(path, raw)
    if "xl/workbook.xml" in names:
        return _excel(path, raw)
    raise InputError(f"{path}: neither .xlsx nor .ods; accepted: CSV, .xlsx, .ods")


def _excel(path: Path, raw: bytes) -> Sheet:
    from openpyxl import load_workbook

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about extensions of Excel that hold no cells
            values = load_workbook(io.BytesIO(raw), data_only=True)
            formulas = load_workbook(io.BytesIO(raw), data_only=False)
    except Exception as error:  # openpyxl raises what XML and its own descriptors raise
        raise InputError(f"{path}: cannot be read as .xlsx ({error})") from None
    filled = [sheet for sheet in values.worksheets if any(_values(sheet))]
    sheet = filled[_only(path, [one.title for one in filled])]
    require_few(path, sheet.max_row, sheet.max_column)
    faults = [
        f"{path}, sheet {quoted(sheet.title)}: cells {merged} are merged; split them, so that each "
        "row holds one object"
        for merged in map(str, sheet.merged_cells.ranges)
        if sheet[merged.partition(":")[0]].row > 1  # a title above the table may be wide
    ]
    hidden = [
        *(f"column {name}" for name, one in sheet.column_dimensions.items() if one.hidden),
        *(f"row {number}" for number, one in sheet.row_dimensions.items() if one.hidden),
    ]
    if hidden:
        log.warning("%s: hidden cells are read like others: %s", path, ", ".join(hidden[:10]))
    typed = formulas[sheet.title]
    rows = []
    for row in sheet.iter_rows():
        cells = []
        for one in row:
            where = f"cell {one.coordinate}"
            formula = typed[one.coordinate].value
            if one.value is None and isinstance(formula, str) and formula.startswith("="):
                faults.append(
                    f"{path}, {where}: a formula without a value; open the file in a spreadsheet "
                    "program and save it"
                )
            cells.append(Cell(_text(path, where, one.value, faults), where))
        rows.append(cells)
    if faults:
        raise InputError(joined(faults))
    return Sheet(path, f"spreadsheet, sheet {quoted(sheet.title)}", rows, decimal_comma=True)


def _values(sheet: Worksheet) -> Any:
    return (cell for row in sheet.iter_rows(values_only=True) for cell in row if cell is not None)


def _open_document(path: Path, raw: bytes) -> Sheet:
    from python_calamine import CalamineWorkbook

    try:
        workbook = CalamineWorkbook.from_filelike(io.BytesIO(raw))
        tables = {
            name: workbook.get_sheet_by_name(name).to_python(skip_empty_area=False)
            for name in workbook.sheet_names
        }
    except Exception as error:  # what its parser raises
        raise InputError(f"{path}: cannot be read as .ods ({error})") from None
    filled = {name: rows for name, rows in tables.items() if any(any(row) for row in rows)}
    name = list(filled)[_only(path, list(filled))]
    table = filled[name]
    require_few(path, len(table), max(map(len, table), default=0))
    faults: list[str] = []
    rows = []
    for number, row in enumerate(table, 1):
        places = [f"cell {_letters(k)}{number}" for k in range(len(row))]
        cells = [
            Cell(_text(path, where, value, faults), where)
            for where, value in zip(places, row, strict=True)
        ]
        rows.append(cells)
    if faults:
        raise InputError(joined(faults))
    return Sheet(path, f"spreadsheet, sheet {quoted(name)}", rows, decimal_comma=True)


def _only(path: Path, names: list[str]) -> int:
    """The index of the only sheet with text, or of the one that is called an inventory."""
    if not names:
        raise InputError(f"{path}: no sheet holds anything")
    called = [k for k, name in enumerate(names) if name.strip().lower() == "inventory"]
    if len(names) > 1 and not called:
        raise InputError(
            f"{path}: holds {len(names)} sheets: {', '.join(map(quoted, names[:10]))}; call the "
            "one with the objects 'Inventory', or save it alone"
        )
    return called[0] if called else 0


def _text(path: Path, where: str, value: object, faults: list[str]) -> str:
    """A cell's value as text; dates and errors are faults."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (dt.date, dt.time, dt.timedelta)):
        faults.append(
            f"{path}, {where}: holds a date ({value}); a spreadsheet program may have made it of a "
            "number such as 1.80; format the cell as a number and enter it again"
        )
        return ""
    if isinstance(value, float):
        return f"{value:.15g}"
    text = str(value).strip()
    if text.startswith("#") and text.rstrip("!?").isupper() and text.endswith(("!", "?", "/A")):
        faults.append(f"{path}, {where}: holds the error {text}")
    return text


def _letters(column: int) -> str:
    """The letters of a column, counted from 0: A, B, ..., Z, AA."""
    letters = ""
    column += 1
    while column:
        column, rest = divmod(column - 1, 26)
        letters = chr(ord("A") + rest) + letters
    return letters
