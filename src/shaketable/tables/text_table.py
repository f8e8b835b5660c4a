"""Tables in text files: commas, semicolons or tabs, in any of the usual encodings."""

from __future__ import annotations

import codecs
import csv
import io
import logging
import re
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from itertools import islice
from pathlib import Path

from shaketable.errors import refused, remark
from shaketable.language import tell, translated
from shaketable.tables.sheet import (
    HEADER_WITHIN,
    MOST_ROWS,
    Cell,
    IsHeader,
    Sheet,
    require_few,
)

log = logging.getLogger(__name__)

NO_TEXT = "not a text file; accepted: CSV, .xlsx, .ods"
SEPARATORS = {",": "commas", ";": "semicolons", "\t": "tabs"}
LOOKED_AT = 50  # lines, to tell what separates cells
LOOKED_AT_BYTES = 100_000
LATIN_1 = "cp1252"
#: Encodings of the languages in which headings are known.
WITH_WORDS = (LATIN_1, "cp932", "euc_jp")
NAMES = {"cp1252": "Windows-1252", "cp932": "Shift-JIS", "euc_jp": "EUC-JP"}
LAST_LATIN = "\u024f"
LATIN = 0.5  # share of the letters of a text that is written in Latin ones
MOSTLY_ASCII = 0.6  # likewise of those without accents
_DIGIT = re.compile(r"\d")
_QUOTED = re.compile(r'"[^"]*"')
_MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}


def read(
    path: Path,
    raw: bytes,
    is_header: IsHeader = lambda _: False,
    numbers: Sequence[int] = (),
) -> Sheet:
    """The table of a text file.

    Args:
        path, raw: the file and its bytes.
        is_header: tells from a row's texts whether it names the columns that are looked for; what
            is not in UTF-8 is in the encoding in which one does.
        numbers: of the rows below the first in the file from which this text was made.

    Raises:
        InputError: no text, too many rows or columns, a quote that is not closed, or a last row
            that is cut short.
    """
    text, encoding = _decoded(path, raw, is_header)
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
    for row, number in zip(rows[1:], numbers, strict=False):
        where = tell("row {number}", number=number)
        row[:] = [cell._replace(where=where, row=number) for cell in row]
    sheet = Sheet(path, f"text in {encoding}, cells separated by {SEPARATORS[separator]}", rows)
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


def _decoded(path: Path, raw: bytes, is_header: IsHeader) -> tuple[str, str]:
    """The text and the encoding's name.

    Raises:
        InputError: no text, or letters that no encoding makes words of.
    """
    encoding = next((name for mark, name in _MARKS.items() if raw.startswith(mark)), "utf-8")
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError:
        if encoding != "utf-8" or b"\0" in raw:
            raise refused(path, tell(NO_TEXT)) from None
        codec = _codec(path, raw, is_header)
        text, encoding = raw.decode(codec, "replace"), NAMES.get(codec, codec)
        message = tell("not in UTF-8; read as {encoding}: look at the names", encoding=encoding)
        log.warning(remark(path, message))
    if "\0" in text:
        raise refused(path, tell(NO_TEXT))
    known = encoding == "utf-8" or encoding in _MARKS.values()
    return text, encoding.upper().removesuffix("-SIG") if known else encoding


def _codec(path: Path, raw: bytes, is_header: IsHeader) -> str:
    """The codec of bytes that are not in UTF-8.

    It is the one in which they hold a header; else what a detector finds, where it is of another
    script than Latin.
    """
    for codec in WITH_WORDS:
        with suppress(UnicodeDecodeError):
            if _has_header(raw.decode(codec), is_header):
                return codec
    from charset_normalizer import from_bytes

    found = from_bytes(raw[:LOOKED_AT_BYTES]).best()
    codec = found.encoding if found else ""
    if codec and _share_of_latin(raw.decode(codec, "replace")) < LATIN:
        return codec
    western = raw.decode(LATIN_1, "replace")
    if _share_of_latin(western) < LATIN or _share_of_ascii(western) < MOSTLY_ASCII:
        text = tell(
            "not in UTF-8, and in no encoding that can be told: save it as CSV in UTF-8, or as "
            ".xlsx"
        )
        raise refused(path, text)
    return LATIN_1


def _has_header(text: str, is_header: IsHeader) -> bool:
    """Whether one of the first rows, or two of them together, name what is looked for."""
    separator = _separator(text)
    lines = text.splitlines()[:HEADER_WITHIN]
    with suppress(csv.Error):
        rows = list(csv.reader(lines, delimiter=separator))
        return any(is_header(row) or is_header([*row, *next_row]) or is_header([*row, "name"])
                   for row, next_row in zip(rows, [*rows[1:], []], strict=True))  # fmt: skip
    return False


def _share_of_latin(text: str) -> float:
    letters = [each for each in text if each.isalpha()]
    return sum(each < LAST_LATIN for each in letters) / max(len(letters), 1)


def _share_of_ascii(text: str) -> float:
    letters = [each for each in text if each.isalpha() or not each.isascii()]
    return sum(each.isascii() for each in letters) / max(len(letters), 1)


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
