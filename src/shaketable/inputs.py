"""Files that users give: one way to open them, and one way to say why that cannot be."""

from __future__ import annotations

import math
import re
import stat
from pathlib import Path

from shaketable.errors import Fault, InputError, quoted, refusal, refused
from shaketable.language import tell

LARGEST_FILE = 64_000_000  # bytes: some five million values
LONGEST_NAME = 4096  # letters, as of a path on Linux
#: A number in ASCII digits, Fortran's 1.5D-3 among them. No digit can be matched in two ways, so
#: that a pattern with it is quick on any text.
NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[EeDd][-+]?\d+)?"


_NUMBER = re.compile(NUMBER, re.ASCII)


def number_of(text: str) -> float:
    """The number that a text is, NaN if it is none."""
    return float(text.upper().replace("D", "E")) if _NUMBER.fullmatch(text) else math.nan


class TooLargeError(InputError):
    """A file of more than LARGEST_FILE bytes."""


def require_readable(name: str) -> None:
    """InputError for a name that no text file can hold: it goes into reports and tables."""
    if len(name) > LONGEST_NAME:
        raise InputError(
            tell(
                "{name}: longer than the {most} letters of a name",
                name=quoted(name),
                most=LONGEST_NAME,
            )
        )
    try:
        name.encode()
    except UnicodeEncodeError:
        raise InputError(
            tell("{name}: the name is not in UTF-8; rename it", name=quoted(name))
        ) from None


def require_file(path: Path) -> None:
    """InputError unless there is a file that can be read more than once."""
    require_readable(str(path))
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        raise refused(path, tell("no such file")) from None
    except OSError as error:
        raise refused(
            path, tell("cannot be read ({error})", error=error.strerror or error)
        ) from None
    except ValueError as error:  # a path that no system accepts
        raise InputError(
            tell("{name}: cannot be read ({error})", name=quoted(str(path)), error=error)
        ) from None
    if stat.S_ISDIR(mode):
        raise refused(path, tell("is a folder; a file is needed"))
    if not stat.S_ISREG(mode):
        raise refused(path, tell("is a pipe or a device; save what it gives in a file"))


def read_file(path: Path) -> bytes:
    """What a file holds.

    Raises:
        InputError: says why it cannot be read.
        TooLargeError: it is larger than LARGEST_FILE.
    """
    require_file(path)
    try:
        with path.open("rb") as file:
            raw = file.read(LARGEST_FILE + 1)
    except OSError as error:
        raise refused(
            path, tell("cannot be read ({error})", error=error.strerror or error)
        ) from None
    if len(raw) > LARGEST_FILE:
        raise too_large(path)
    return raw


def too_large(path: Path) -> TooLargeError:
    """The error for a file of more than LARGEST_FILE bytes."""
    text = f"is larger than {LARGEST_FILE / 1e6:g} MB, the most that is read"
    return refusal([Fault(path, "", "", "too large", text)], TooLargeError)
