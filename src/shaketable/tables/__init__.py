"""Tables in files that users give: text with separators, .xlsx and .ods, as cells of text."""

from __future__ import annotations

from pathlib import Path

from shaketable.inputs import read_file
from shaketable.tables import text_table, workbook
from shaketable.tables.decimals import with_a_point
from shaketable.tables.faults import condensed
from shaketable.tables.sheet import Cell, Sheet
from shaketable.tables.workbook import IsHeader

__all__ = ["Cell", "IsHeader", "Sheet", "condensed", "read_sheet", "with_a_point"]


def read_sheet(path: Path, wanted: str, is_header: IsHeader) -> Sheet:
    """The table of a file, from its first row on.

    Args:
        path: of the file.
        wanted: the name of the sheet to read, where a workbook holds several.
        is_header: tells from a row's texts whether it names the columns that are looked for; it
            chooses between the sheets of a workbook where none has that name.

    Raises:
        InputError: says what is wrong with the file, and where.
    """
    raw = read_file(path)
    if workbook.recognise(raw):
        return workbook.read(path, raw, wanted, is_header)
    return text_table.read(path, raw)
