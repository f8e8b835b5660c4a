"""What python-calamine does not tell of an .ods: errors, formulas without a value, merged cells."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element, iterparse

from shaketable.tables.sheet import require_few

_TABLE = "{urn:oasis:names:tc:opendocument:xmlns:table:1.0}"
_OFFICE = "{urn:oasis:names:tc:opendocument:xmlns:office:1.0}"
_CALC = "{urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0}"


MOST_REPEATED = 1000
_BEHIND = re.compile(r"\d\s*([^\W\d_]+\.?|['\"])$")


class Remark(NamedTuple):
    """Something about a cell, counted from 1, or about a whole row where `column` is 0."""

    sheet: str
    row: int
    column: int
    kind: str  # "error", "formula", "merged", "hidden" or "unit"
    rows: int = 1  # that are merged
    columns: int = 1
    text: str = ""  # of the unit that a number's format shows


def remarks(path: Path, raw: bytes) -> list[Remark]:
    """What stands in an .ods that must not be read like other cells.

    Raises:
        InputError: rows and cells that are said to be repeated make it larger than what is read.
    """
    found: list[Remark] = []
    with (
        zipfile.ZipFile(io.BytesIO(raw)) as archive,
        archive.open("content.xml") as content,
    ):
        sheet, number, widest = "", 1, 0
        for event, element in iterparse(content, events=("start", "end")):  # noqa: S314  no entities are expanded, sizes are bounded
            if event == "start" and element.tag == f"{_TABLE}table":
                sheet, number, widest = element.get(f"{_TABLE}name", ""), 1, 0
            elif event == "end" and element.tag == f"{_TABLE}table-row":
                if element.get(f"{_TABLE}visibility", "visible") != "visible" and _filled(element):
                    found.append(Remark(sheet, number, 0, "hidden"))
                found += _of_row(sheet, number, element)
                number += int(element.get(f"{_TABLE}number-rows-repeated", 1))
                if width := _width(element):  # empty rows behind the last are only counted
                    widest = max(widest, width)
                    require_few(path, number - 1, widest)
                element.clear()
    return found


def _filled(row: Element) -> bool:
    return any("".join(cell.itertext()).strip() for cell in row)


def _width(row: Element) -> int:
    """The number of the last column that holds anything, 0 if none does."""
    column = width = 0
    for cell in row:
        column += int(cell.get(f"{_TABLE}number-columns-repeated", 1))
        if len(cell) or cell.get(f"{_OFFICE}value-type"):
            width = column
    return width


def _of_row(sheet: str, number: int, row: Element) -> list[Remark]:
    found = []
    column = 1
    for cell in row:
        if kind := _kind_of(cell):
            rows, columns = (
                int(cell.get(f"{_TABLE}number-{what}-spanned", 1)) for what in ("rows", "columns")
            )
            found.append(Remark(sheet, number, column, kind, rows, columns))
        repeated = int(cell.get(f"{_TABLE}number-columns-repeated", 1))
        if unit := _unit_of(cell):
            found += [
                Remark(sheet, number, column + k, "unit", text=unit)
                for k in range(min(repeated, MOST_REPEATED))
            ]
        column += repeated
    return found


def _unit_of(cell: Element) -> str:
    """The word that is shown behind a number, "" if none is."""
    if cell.get(f"{_OFFICE}value-type") != "float":
        return ""
    shown = _BEHIND.search("".join(cell.itertext()).strip())
    return shown[1] if shown else ""


def _kind_of(cell: Element) -> str:
    text = "".join(cell.itertext()).strip()
    if cell.get(f"{_CALC}value-type") == "error" or text.startswith(("#", "Err:")):
        return "error"
    if cell.get(f"{_TABLE}formula") and not text and cell.get(f"{_OFFICE}value") is None:
        return "formula"
    spans = (cell.get(f"{_TABLE}number-{what}-spanned", "1") for what in ("rows", "columns"))
    return "merged" if any(span != "1" for span in spans) else ""
