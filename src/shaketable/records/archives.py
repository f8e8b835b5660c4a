"""The files in a zip archive, one after the other, within bounds."""

from __future__ import annotations

import io
import zipfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from shaketable.errors import InputError, quoted, refused
from shaketable.inputs import LARGEST_FILE, too_large
from shaketable.language import tell
from shaketable.records import seismological

LARGEST_ARCHIVE = 2_000_000_000  # bytes, unpacked
MOST_MEMBERS = 10_000
BOMB = 100  # times its own size: no text of numbers is packed more tightly
DEEPEST = 1  # archives in an archive
_ZIP = b"PK\x03\x04"
_OFFICE = {".xlsx", ".xlsm", ".docx", ".pptx", ".ods", ".odt", ".odp"}
HARMLESS = 16_000_000  # bytes, unpacked: less is never a bomb


def unpacked(path: Path) -> Iterator[tuple[str, bytes]]:
    """Names and contents of an archive's files, in order of names, and of the archives in it.

    Of a binary file only the beginning is given, enough to see that it is no record.

    Raises:
        InputError: an archive that cannot be unpacked, is larger than the limits when unpacked,
            holds two files of one name, or archives within archives within archives.
    """
    budget = _Budget()
    try:
        yield from _members(path, path, path.stat().st_size, budget, DEEPEST)
    except InputError:
        raise
    except Exception as error:  # zlib, lzma and struct raise their own errors on damaged data
        raise refused(path, tell("cannot be unpacked ({error})", error=error)) from None


class _Budget:
    """What all archives in one may hold together."""

    def __init__(self) -> None:
        self.files = self.size = 0


def _members(
    path: Path, source: Path | IO[bytes], packed: int, budget: _Budget, deeper: int
) -> Iterator[tuple[str, bytes]]:
    with zipfile.ZipFile(source) as archive:
        files = sorted(
            (one for one in archive.infolist() if not one.is_dir()), key=lambda one: one.filename
        )
        _require_bounds(path, files, packed, budget)
        for one in files:
            with archive.open(one) as file:
                content = file.read(4096)
                inner = content.startswith(_ZIP) and not is_office_name(one.filename)
                if inner or b"\0" not in content or seismological.recognise(content):
                    content += file.read(LARGEST_FILE)
            if len(content) > LARGEST_FILE:
                raise too_large(path / one.filename)
            if not inner:
                yield one.filename, content
                continue
            if not deeper:
                raise refused(
                    path / one.filename, tell("an archive too many levels deep; unpack it first")
                )
            below = path / one.filename
            for name, found in _members(
                below, io.BytesIO(content), len(content), budget, deeper - 1
            ):
                yield f"{one.filename}/{name}", found


def is_office_name(name: str) -> bool:
    """Whether a file in an archive is called like a spreadsheet or document, also an archive."""
    return Path(name).suffix.lower() in _OFFICE


def is_office(path: Path) -> bool:
    """Whether an archive is a spreadsheet or a document of an office program."""
    try:
        with zipfile.ZipFile(path) as archive:
            names = set(archive.namelist())
    except Exception:  # damaged in any way: `unpacked` says how
        return False
    return bool(names & {"xl/workbook.xml", "word/document.xml", "ppt/presentation.xml"}) or (
        {"mimetype", "content.xml"} <= names
    )


def _require_bounds(path: Path, files: list[zipfile.ZipInfo], packed: int, budget: _Budget) -> None:
    budget.files += len(files)
    if budget.files > MOST_MEMBERS:
        raise refused(
            path,
            tell(
                "holds {count:,} files; at most {most:,} are read",
                count=budget.files,
                most=MOST_MEMBERS,
            ),
        )
    name, times = Counter(one.filename for one in files).most_common(1)[0] if files else ("", 1)
    if times > 1:
        raise refused(
            path,
            tell(
                "holds {found} {times} times; which of them counts?",
                found=quoted(name),
                times=times,
            ),
        )
    unpacked = sum(one.file_size for one in files)
    packed = max(packed, 1)
    budget.size += unpacked
    if budget.size > LARGEST_ARCHIVE:
        raise refused(
            path,
            tell(
                "holds {unpacked:.3g} GB; at most {most:g} GB are read",
                unpacked=budget.size / 1e9,
                most=LARGEST_ARCHIVE / 1e9,
            ),
        )
    if unpacked > HARMLESS and unpacked > BOMB * packed:
        raise refused(
            path,
            tell(
                "unpacks to {unpacked:.4g} MB, {ratio:.0f} times its size; at most "
                "{most} times are unpacked",
                unpacked=unpacked / 1e6,
                ratio=unpacked / packed,
                most=BOMB,
            ),
        )
