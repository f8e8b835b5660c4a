"""Tables in files that users give: text with separators, .xlsx and .ods, as cells of text."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from shaketable.errors import quoted, refusal, refused
from shaketable.inputs import read_file
from shaketable.language import tell
from shaketable.tables import text_table, workbook
from shaketable.tables.decimals import with_a_point
from shaketable.tables.faults import condensed
from shaketable.tables.sheet import Cell, IsHeader, Sheet
from shaketable.tables.workbook import SheetChoiceError

__all__ = [
    "Cell",
    "IsHeader",
    "Sheet",
    "SheetChoiceError",
    "condensed",
    "read_sheet",
    "with_a_point",
]


def read_sheet(
    path: Path,
    wanted: str,
    is_header: IsHeader,
    *,
    sheet: str | None = None,
    strict: bool = True,
    known: Collection[str] = (),
    numbers: Sequence[int] = (),
) -> Sheet:
    """The table of a file, from its first row on.

    Args:
        path: of the file.
        wanted: the name of the sheet to read, where a workbook holds several.
        is_header: tells from a row's texts whether it names the columns that are looked for; it
            chooses between the sheets of a workbook where none has that name, and between encodings
            of a text.
        sheet: the name of the sheet to read, whatever the others hold.
        strict: whether a cell that cannot be used, such as an error, is one of the file, also
            where nothing reads it.
        known: names, in lower case, of sheets of a workbook that hold something else.
        numbers: of the rows below the first of a text in the file from which it was made.

    Raises:
        SheetChoiceError: several sheets may be meant.
        InputError: says what is wrong with the file, and where.
    """
    raw = read_file(path)
    if workbook.recognise(raw):
        found = workbook.read(path, raw, wanted, is_header, sheet, known)
        if strict and found.wrong:
            raise refusal(found.wrong)
        return found
    if sheet is not None:
        raise refused(path, tell("is a text, which has no sheet {sheet}", sheet=quoted(sheet)))
    return text_table.read(path, raw, is_header, numbers)
