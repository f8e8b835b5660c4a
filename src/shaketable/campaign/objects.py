"""Small objects and files of a store, in a folder or wherever fsspec reaches by a URL."""

from __future__ import annotations

import json
import os
import re
import uuid
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from shaketable.atomic_files import NO_ROOM
from shaketable.errors import InputError, SimulationError
from shaketable.extras import require

_URL = re.compile(r"[a-zA-Z][a-zA-Z0-9+.-]+://")


@contextmanager
def disk_of(objects: Objects) -> Iterator[None]:
    """Faults of a store's disk, told with its place.

    Raises:
        SimulationError: the disk is full.
    """
    try:
        yield
    except OSError as error:
        if error.errno not in NO_ROOM:
            raise
        raise SimulationError(
            f"{objects.place}: {error.strerror or error}; what was done is kept: once there is "
            "room the same command goes on"
        ) from None


class Objects:
    """Objects by their names below one place; each appears whole or not at all.

    In a folder that is an atomic rename; what an object store gives is what it promises.
    """

    def __init__(self, place: str | Path) -> None:
        """A place: a path, or a URL that fsspec knows.

        Raises:
            InputError: a URL that cannot be used, or an extra that is not installed.
        """
        require("campaign", "a campaign")
        from fsspec.core import url_to_fs
        from fsspec.implementations.local import LocalFileSystem

        self.place = str(place)
        if _URL.match(self.place) and "::" not in self.place:
            try:
                self._fs, root = url_to_fs(self.place)
            except (ValueError, ImportError) as error:
                raise InputError(f"{self.place}: cannot be used as a store ({error})") from None
        elif "::" in self.place or not self.place.strip():
            raise InputError(f"a store is a folder or a URL, got {self.place!r}")
        else:
            self._fs, root = LocalFileSystem(), str(Path(self.place).absolute())
        self._root = str(root).rstrip("/")
        if not self._root:
            raise InputError(f"{self.place}: name a folder in it")
        self.folder = Path(self._root) if isinstance(self._fs, LocalFileSystem) else None

    def path(self, name: str = "") -> str:
        """The full name of an object, as its file system spells it."""
        return f"{self._root}/{name}" if name else str(self._root)

    def get(self, name: str) -> bytes | None:
        """The content of an object; None if there is none."""
        try:
            return bytes(self._fs.cat_file(self.path(name)))
        except (FileNotFoundError, NotADirectoryError):
            return None

    def put(self, name: str, content: bytes) -> None:
        """Write an object."""
        if self.folder is None:
            self._fs.pipe_file(self.path(name), content)
            return
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        fresh = _beside(path)
        try:
            with fresh.open("wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            fresh.replace(path)
        finally:
            fresh.unlink(missing_ok=True)

    def create(self, name: str, content: bytes) -> bool:
        """Write an object unless there is one; whether it was written."""
        if self.folder is None:
            if self._fs.exists(self.path(name)):
                return False
            self._fs.pipe_file(self.path(name), content)
            return True
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        fresh = _beside(path)
        try:
            fresh.write_bytes(content)
            os.link(fresh, path)  # whole, and of several only one succeeds
        except FileExistsError:
            return False
        finally:
            fresh.unlink(missing_ok=True)
        return True

    def get_many(self, names: Sequence[str]) -> dict[str, bytes]:
        """The contents of several objects, asked for together, but of those that are not there."""
        # `cat` would take odd names for patterns
        found = self._fs.cat_ranges([self.path(name) for name in names], None, None)
        told = {}
        for name, content in zip(names, found, strict=True):
            if isinstance(content, (FileNotFoundError, NotADirectoryError)):
                continue
            if isinstance(content, BaseException):
                raise content
            told[name] = bytes(content)
        return told

    def sizes(self, below: str) -> dict[str, int]:
        """Bytes of all objects below a name, by their names, by one question."""
        try:
            found = self._fs.find(self.path(below), detail=True, refresh=True)
        except TypeError:  # a folder's listing is never kept
            found = self._fs.find(self.path(below), detail=True)
        start = len(self._fs._strip_protocol(self.path())) + 1
        return {name[start:]: int(told["size"]) for name, told in found.items()}

    def names(self, below: str = "") -> list[str]:
        """Names of the objects directly below a name, in order; [] if there are none."""
        try:
            found = self._fs.ls(self.path(below), detail=False, refresh=True)
        except (FileNotFoundError, NotADirectoryError):
            return []
        return sorted(str(each).rstrip("/").rsplit("/", 1)[-1] for each in found)

    def remove(self, name: str) -> None:
        """Remove an object, or all below a name; nothing where there is none."""
        try:
            self._fs.rm(self.path(name), recursive=True)
        except FileNotFoundError:
            return

    def get_json(self, name: str) -> dict[str, Any] | None:
        """An object that is JSON; None if there is none.

        Raises:
            SimulationError: one that is damaged.
        """
        content = self.get(name)
        if content is None:
            return None
        try:
            found = json.loads(content)
        except ValueError:
            found = None
        if not isinstance(found, dict):
            raise SimulationError(f"{self.place}: {name} is damaged")
        return found

    def put_json(self, name: str, content: dict[str, Any]) -> None:
        self.put(name, json.dumps(content, indent=1).encode())


def _beside(path: Path) -> Path:
    """A hidden name beside a path that nobody else has."""
    return path.with_name(f".{path.name}.{uuid.uuid4().hex}")
