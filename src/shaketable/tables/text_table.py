"""Tables in text files: commas, semicolons or tabs, in any of the usual encodings."""

from __future__ import annotations

import codecs
import csv
import io
import logging
import re
from collections import Counter
from itertools import islice
from pathlib import Path

from shaketable.errors import refused, remark
from shaketable.language import tell, translated
from shaketable.tables.sheet import MOST_ROWS, Cell, Sheet, require_few

log = logging.getLogger(__name__)

NO_TEXT = "not a text file; accepted: CSV, .xlsx, .ods"
SEPARATORS = {",": "commas", ";": "semicolons", "\t": "tabs"}
LOOKED_AT = 50  # lines, to tell what separates cells
_DIGIT = re.compile(r"\d")
_QUOTED = re.compile(r'"[^"]*"')
_MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}


def read(path: Path, raw: bytes) -> Sheet:
    """The table of a text file.

    Raises:
        InputError: no text, too many rows or columns, a quote that is not closed, or a last row
            that is cut short.
    """
    text, encoding = _decoded(path, raw)
    separator = _separator(text)
    try:
        # strict: a quote that is opened and not closed is an error
        reader = csv.reader(
            io.StringIO(text, newline=""), delimiter=separator, skipinitialspace=True, strict=True
        )
        found = [(reader.line_num, row) for row in islice(reader, MOST_ROWS + 1)]
    except csv.Error as error:
        raise refused(
            path,
            tell(
                "not a table of cells separated by {separators} ({error})",
                separators=translated(SEPARATORS[separator]),
                error=error,
            ),
        ) from None
    require_few(path, len(found), max((len(row) for _, row in found), default=0))
    word = translated("line")
    rows = [[Cell(cell.strip(), f"{word} {line}", line) for cell in row] for line, row in found]
    sheet = Sheet(path, f"text in {encoding}, cells separated by {SEPARATORS[separator]}", rows,
                  decimal_comma=separator != ",")  # fmt: skip
    filled = list(sheet.filled())
    if len(filled) > 1 and not text.endswith(("\n", "\r")):
        last, others = filled[-1], {len(row) for row in filled[:-1]}
        if len(last) < min(others):
            message = tell(
                "the file ends within this row: it has fewer cells than every other; is the file "
                "cut short?"
            )
            raise refused(path, message, where=last[0].where)
    for row in filled:
        for cell in row:
            lines = cell.text.splitlines()
            if any(line.count(separator) > 1 and _DIGIT.search(line) for line in lines[1:]):
                message = tell("a quote is not closed and swallows whole rows")
                raise refused(path, message, where=cell.where)
    return sheet


def _decoded(path: Path, raw: bytes) -> tuple[str, str]:
    """The text and the encoding's name."""
    encoding = next((name for mark, name in _MARKS.items() if raw.startswith(mark)), "utf-8")
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError:
        if encoding != "utf-8" or b"\0" in raw:
            raise refused(path, tell(NO_TEXT)) from None
        text, encoding = raw.decode("cp1252", "replace"), "Windows-1252"
        message = tell("not in UTF-8; read as Windows-1252: look at names with accents")
        log.warning(remark(path, message))
    if "\0" in text:
        raise refused(path, tell(NO_TEXT))
    return text, encoding.upper().removesuffix("-SIG")


def _separator(text: str) -> str:
    """The separator that stands equally often in the most lines, outside quotes.

    Titles have none, or another one, and decimal commas stand in no header.
    """
    lines = [_QUOTED.sub("", line) for line in text.splitlines()[:LOOKED_AT] if line.strip()]

    def alike(separator: str) -> tuple[int, int]:
        counts = Counter(count for line in lines if (count := line.count(separator)))
        often, lines_alike = max(counts.items(), key=lambda each: each[::-1], default=(0, 0))
        return lines_alike, often

    return max(SEPARATORS, key=alike)
