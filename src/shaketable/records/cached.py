"""A suite of motions kept in one file of the user's cache, so that it is parsed only once.

The file is named after the folder and the options. It holds a key made of every record's size and
modification time and of the source of this package's readers. If the key does not match, or the
file cannot be read, the suite is built again: nothing depends on the cache.
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
import tempfile
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from platformdirs import user_cache_path

from shaketable.motion import Motion
from shaketable.origin import Origin

log = logging.getLogger(__name__)

_ROOM = Path(__file__).resolve().parent
#: Source files that a suite depends on, besides the records.
_SOURCES = [
    *sorted(_ROOM.glob("*.py")),
    *(_ROOM.parent / name for name in ("motion.py", "origin.py", "units.py")),
]

_ROOM_LOG = logging.getLogger(__package__)


def cached(
    folder: Path,
    files: list[Path],
    options: dict[str, Any],
    build: Callable[[], list[Motion]],
) -> list[Motion]:
    """What `build` makes of `files`, taken from the cache if it is there.

    What the readers warned of while it was built is kept with it and warned of again.

    Args:
        folder, options: what the cache file is named after.
    """
    directory = user_cache_path("shaketable") / "suites"
    path = directory / f"{_hash([str(folder.resolve()), options])[:24]}.npz"
    key = _key(files)
    try:
        motions, warnings = _load(path, key)
        for warning in warnings:
            log.warning("%s", warning)
        return motions
    except FileNotFoundError:
        pass
    except Exception as error:  # a damaged file may raise any exception
        log.info("%s: built again (%s)", path, error)
    with _Warnings() as heard:
        motions = build()
    try:
        _store(path, key, motions, heard.messages)
    except OSError as error:
        log.info("%s: not stored (%s)", path, error)
    return motions


class _Warnings(logging.Handler):
    """Notes the warnings of this room."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(record.getMessage())

    def __enter__(self) -> _Warnings:
        _ROOM_LOG.addHandler(self)
        return self

    def __exit__(self, *_: object) -> None:
        _ROOM_LOG.removeHandler(self)


def _hash(thing: Any) -> str:
    return hashlib.sha256(json.dumps(thing, sort_keys=True).encode()).hexdigest()


def _key(files: list[Path]) -> str:
    stats = [(str(file), *_stamp(file)) for file in files]
    return _hash([stats, [path.read_text(encoding="utf-8") for path in _SOURCES]])


def _stamp(file: Path) -> tuple[int, int]:
    status = file.stat()
    return status.st_size, status.st_mtime_ns


def _load(path: Path, key: str) -> tuple[list[Motion], list[str]]:
    """The motions, and the warnings of the run that read them."""
    with path.open("rb") as file, np.load(file, allow_pickle=False) as store:
        about = json.loads(str(store["about"]))
        if about["key"] != key:
            raise ValueError("the records have changed")
        samples = store["samples"]
    motions = []
    at = 0
    for one in about["motions"]:
        count = one["count"]
        horizontal = samples[at : at + count]
        at += count
        others: dict[str, np.ndarray[Any, Any] | None] = {"vertical": None, "transverse": None}
        for which in others:
            if one[which]:
                others[which] = samples[at : at + count]
                at += count
        motions.append(
            Motion(
                horizontal,
                one["time_step"],
                **others,
                name=one["name"],
                origin=_origin(one["origin"]),
                vertical_origin=_origin(one["vertical_origin"]),
                transverse_origin=_origin(one["transverse_origin"]),
            )
        )
    if at != samples.size:
        raise ValueError(f"{samples.size} samples, expected {at}")
    return motions, list(about["warnings"])


def _origin(fields: dict[str, Any] | None) -> Origin | None:
    if fields is None:
        return None
    return Origin(**{**fields, "processing": tuple(fields["processing"])})


def _store(path: Path, key: str, motions: list[Motion], warnings: list[str]) -> None:
    about = {
        "key": key,
        "warnings": warnings,
        "motions": [
            {
                "count": motion.horizontal.size,
                "time_step": motion.time_step,
                "vertical": motion.vertical is not None,
                "transverse": motion.transverse is not None,
                "name": motion.name,
                "origin": motion.origin and asdict(motion.origin),
                "vertical_origin": motion.vertical_origin and asdict(motion.vertical_origin),
                "transverse_origin": motion.transverse_origin and asdict(motion.transverse_origin),
            }
            for motion in motions
        ],
    }
    series = [
        part
        for motion in motions
        for part in (motion.horizontal, motion.vertical, motion.transverse)
    ]
    samples = np.concatenate([part for part in series if part is not None])
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, suffix=".npz")
    try:
        with os.fdopen(handle, "wb") as file:
            np.savez(file, about=np.array(json.dumps(about)), samples=samples)
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
