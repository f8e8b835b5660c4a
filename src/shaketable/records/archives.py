"""The files in a zip archive, one after the other, within bounds."""

from __future__ import annotations

import zipfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from shaketable.errors import InputError, quoted, refused
from shaketable.inputs import LARGEST_FILE, too_large
from shaketable.language import tell
from shaketable.records import miniseed

LARGEST_ARCHIVE = 2_000_000_000  # bytes, unpacked
MOST_MEMBERS = 10_000
BOMB = 100  # times its own size: no text of numbers is packed more tightly
HARMLESS = 16_000_000  # bytes, unpacked: less is never a bomb


def unpacked(path: Path) -> Iterator[tuple[str, bytes]]:
    """Names and contents of an archive's files, in order of names.

    Of a binary file only the beginning is given, enough to see that it is no record.

    Raises:
        InputError: an archive that cannot be unpacked, is larger than the limits when unpacked,
            or holds two files of one name.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            files = sorted(
                (one for one in archive.infolist() if not one.is_dir()),
                key=lambda one: one.filename,
            )
            _require_bounds(path, files)
            for one in files:
                with archive.open(one) as file:
                    content = file.read(4096)
                    if b"\0" not in content or miniseed.recognise(content):
                        content += file.read(LARGEST_FILE)
                if len(content) > LARGEST_FILE:
                    raise too_large(path / one.filename)
                yield one.filename, content
    except InputError:
        raise
    except Exception as error:  # zlib, lzma and struct raise their own errors on damaged data
        raise refused(path, tell("cannot be unpacked ({error})", error=error)) from None


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


def _require_bounds(path: Path, files: list[zipfile.ZipInfo]) -> None:
    if len(files) > MOST_MEMBERS:
        raise refused(
            path,
            tell(
                "holds {count:,} files; at most {most:,} are read",
                count=len(files),
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
    packed = max(path.stat().st_size, 1)
    if unpacked > LARGEST_ARCHIVE:
        raise refused(
            path,
            tell(
                "holds {unpacked:.3g} GB; at most {most:g} GB are read",
                unpacked=unpacked / 1e9,
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
