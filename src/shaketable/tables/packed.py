"""What a spreadsheet holds, counted in its XML before anything is built of it.

A file of a few kilobytes can ask a reader for memory without end: by cells merged over a whole
sheet, by millions of styles, by rows that are said to be repeated, by entities of entities.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections import Counter
from pathlib import Path
from xml.parsers import expat

from shaketable.errors import refused
from shaketable.language import tell

LARGEST = 20_000_000  # bytes, unpacked
#: How many of a kind are read, all others together; those of cells are bounded by the bytes.
CELLS = {"row", "c", "v", "f", "is", "t", "si"}
MOST = {
    "definedName": 1_000,
    "sheet": 255,
    "mergeCell": 1_000,
    "xf": 70_000,  # Excel itself has 65,490
    "table-row": 300_000,
    "table-cell": 1_000_000,
    "p": 1_000_000,
}
MOST_OTHERS = 100_000
MOST_MERGED = 100_000  # cells
_RANGE = re.compile(r"([A-Z]{1,3})(\d{1,7})(?::([A-Z]{1,3})(\d{1,7}))?")
CHUNK = 2**16


def require_size(path: Path, archive: zipfile.ZipFile) -> None:
    """InputError for a spreadsheet that is larger, unpacked, than any list of objects."""
    size = sum(one.file_size for one in archive.infolist())
    if size > LARGEST:
        raise refused(
            path,
            tell(
                "unpacks to {size:.0f} MB; at most {most:.0f} MB are read; save the sheet as CSV",
                size=size / 1e6,
                most=LARGEST / 1e6,
            ),
        )


def require_elements(path: Path, raw: bytes) -> None:
    """Raise an error for a spreadsheet that has more of anything than a list of objects.

    Raises:
        InputError: names the limit.
        ExpatError, BadZipFile, ...: it is damaged.
    """
    counted = _Counted(path)
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        for name in archive.namelist():
            if name.endswith((".xml", ".rels")):
                counted.look(archive, name)


class _Counted:
    """Elements of all the parts of a spreadsheet."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._found: Counter[str] = Counter()
        self._merged = 0

    def look(self, archive: zipfile.ZipFile, name: str) -> None:
        """Count those of a part."""
        parser = expat.ParserCreate(namespace_separator=" ")
        parser.StartElementHandler = self._element
        parser.StartDoctypeDeclHandler = self._refuse_entities
        with archive.open(name) as part:
            while chunk := part.read(CHUNK):
                parser.Parse(chunk)
            parser.Parse(b"", True)

    def _element(self, name: str, attributes: dict[str, str]) -> None:
        tag = name.rpartition(" ")[2]
        if tag in CELLS:
            return
        kind = tag if tag in MOST else ""
        self._found[kind] += 1
        most = MOST.get(kind, MOST_OTHERS)
        if self._found[kind] > most:
            raise refused(
                self._path,
                tell(
                    "holds more than {most:,} elements {kind}, the most that are read; "
                    "save the sheet as CSV",
                    most=most,
                    kind=kind or tag,
                ),
            )
        if kind == "mergeCell":
            self._merged += _cells(attributes.get("ref", ""))
            if self._merged > MOST_MERGED:
                raise refused(
                    self._path,
                    tell(
                        "more than {most:,} cells are merged; split them, so that each "
                        "row stands for itself",
                        most=MOST_MERGED,
                    ),
                )

    def _refuse_entities(self, *_: object) -> None:
        raise refused(self._path, tell("declares entities, which are not read"))


def _cells(reference: str) -> int:
    """How many cells a range such as B2:C7 has."""
    found = _RANGE.fullmatch(reference)
    if found is None or found[3] is None:
        return 1
    columns = _column(found[3]) - _column(found[1]) + 1
    return columns * (int(found[4]) - int(found[2]) + 1)


def _column(letters: str) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + ord(letter) - ord("A") + 1
    return number
