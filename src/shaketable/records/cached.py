"""A suite of motions kept in one file of the user's cache, so that it is parsed only once.

The file is named after the folder and the options. It holds the samples, as `MotionFile` reads
them; then JSON that says what is known of the motions, with a key made of every record's size and
modification time and of the source of this package's readers; then the length of that. If the key
does not match, or the file cannot be read, the suite is built again: nothing depends on the cache.
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
import struct
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from numbers import Integral, Real
from pathlib import Path
from typing import IO, Any
from zlib import crc32

from platformdirs import user_cache_path

from shaketable.lazy_motions import Head
from shaketable.motion import Motion
from shaketable.motion_file import MotionFile, append, bytes_of

log = logging.getLogger(__name__)

_ROOM = Path(__file__).resolve().parent
#: Source files that a suite depends on, besides the records.
_SOURCES = [
    *sorted(_ROOM.glob("*.py")),
    *(
        _ROOM.parent / name
        for name in ("motion.py", "motion_file.py", "lazy_motions.py", "origin.py", "units.py")
    ),
]

LENGTH = struct.Struct("<q")  # of the JSON, in the last bytes
CHUNK = 2**24  # bytes that are summed at a time

_ROOM_LOG = logging.getLogger(__package__)


def cached(
    folder: Path,
    files: list[Path],
    options: dict[str, Any],
    build: Callable[[], Iterable[Motion]],
) -> Iterator[Motion]:
    """What `build` makes of `files`, one by one, taken from the cache if it is there.

    What the readers warned of while it was built is kept with it and warned of again.

    Args:
        folder, options: what the cache file is named after.
    """
    directory = user_cache_path("shaketable") / "suites"
    path = directory / f"{_hash([str(folder.resolve()), options])[:24]}.motions"
    key = _key(files)
    with ExitStack() as opened:
        try:
            motions, warnings = _load(opened.enter_context(path.open("rb")), key)
        except (OSError, ValueError, KeyError, TypeError) as error:
            if not isinstance(error, FileNotFoundError):
                log.info("%s: built again (%s)", path, error)
        else:
            for template, *values in warnings:
                log.warning(template, *values)
            yield from motions
            return
    try:
        whole = _store(path, key, build)
    except OSError as error:
        log.info("%s: not stored (%s)", path, error)
        yield from build()
        return
    with whole:
        yield from _load(whole, key)[0]


class _Warnings(logging.Handler):
    """Collects the warnings of this package."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.messages: list[list[object]] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Templates and what fills them, so that they can be told in another language later."""
        if isinstance(record.msg, str) and isinstance(record.args, tuple):
            self.messages.append([record.msg, *map(_plain, record.args)])
        else:
            self.messages.append(["%s", record.getMessage()])

    def __enter__(self) -> _Warnings:
        _ROOM_LOG.addHandler(self)
        return self

    def __exit__(self, *_: object) -> None:
        _ROOM_LOG.removeHandler(self)


def _plain(value: object) -> int | float | str:
    """A value as JSON keeps it."""
    if isinstance(value, Integral):
        return int(value)
    return float(value) if isinstance(value, Real) else str(value)


def _hash(thing: Any) -> str:
    return hashlib.sha256(json.dumps(thing, sort_keys=True).encode()).hexdigest()


def _key(files: list[Path]) -> str:
    stats = [(str(file), *_stamp(file)) for file in files]
    return _hash([stats, [path.read_text(encoding="utf-8") for path in _SOURCES]])


def _stamp(file: Path) -> tuple[int, int]:
    status = file.stat()
    return status.st_size, status.st_mtime_ns


def _load(file: IO[bytes], key: str) -> tuple[MotionFile, list[list[Any]]]:
    """The motions, and the warnings of the run that read them.

    Raises:
        ValueError, KeyError, TypeError: the records have changed, or the file is damaged.
    """
    end = file.seek(0, os.SEEK_END) - LENGTH.size
    file.seek(max(end, 0))
    (length,) = LENGTH.unpack(file.read(LENGTH.size).ljust(LENGTH.size))
    if not 0 <= length <= end:
        raise ValueError("it is cut short")
    file.seek(end - length)
    about = json.loads(file.read(length))
    if about["key"] != key:
        raise ValueError("the records have changed")
    heads = [Head.from_dict(each) for each in about["motions"]]
    if sum(map(bytes_of, heads)) != end - length:
        raise ValueError(f"{end - length} bytes of samples are there, not those of its motions")
    if _sum_of(file, end - length) != about["crc32"]:
        raise ValueError("its samples are damaged")
    return MotionFile(file, heads), list(about["warnings"])


def _store(path: Path, key: str, build: Callable[[], Iterable[Motion]]) -> IO[bytes]:
    """Write what `build` makes; returns the file.

    Raises:
        OSError: the disk is full.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, suffix=path.suffix)
    try:
        with os.fdopen(handle, "w+b") as file:
            with _Warnings() as heard:
                heads = [append(motion, file) for motion in build()]
            about = {
                "key": key,
                "warnings": heard.messages,
                "crc32": _sum_of(file, sum(map(bytes_of, heads))),
                "motions": [head.as_dict() for head in heads],
            }
            content = json.dumps(about).encode()
            file.write(content + LENGTH.pack(len(content)))
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return path.open("rb")


def _sum_of(file: IO[bytes], length: int) -> int:
    """Of so many bytes from a file's beginning, after which its place is."""
    file.seek(0)
    found = 0
    for first in range(0, length, CHUNK):
        found = crc32(file.read(min(CHUNK, length - first)), found)
    return found
