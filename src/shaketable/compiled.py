"""How kernels are compiled, and a disk cache that always equals the source.

Numba's disk cache notices an edit in the file of the function that was called, but not in the
files of the functions that it calls. The cache directory is therefore named after a hash of every
source that the compiled code may be made of: an edit in any of them opens a new, empty directory.
The rooms in one entry of `COMPILED_TOGETHER` share a hash; an edit in the room of the oscillators
does not compile the contact kernels anew.
"""

from __future__ import annotations

import glob
import hashlib
import logging
import os
import stat
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, ParamSpec, TypeVar, cast

import numba
import numba.core.config
from numba.core.caching import FunctionCache
from platformdirs import user_cache_path

log = logging.getLogger(__name__)

linking: Any
try:
    from shaketable import linking
except ImportError as error:
    log.info("%s: compiling takes several times as long", error)
    linking = None

config: Any = numba.core.config
jit: Any = numba.jit

P = ParamSpec("P")
R = TypeVar("R")

_PACKAGE = Path(__file__).resolve().parent

#: Rooms that hold compiled code, grouped by what is compiled together.
COMPILED_TOGETHER = {
    "engine": ("kernels", "engine"),
    "oscillators": ("oscillators",),
    "solids": ("solids",),
}
SHARED_SOURCES = ("compiled.py", "linking.py", "units.py")  # decorators and constants

#: For all compiled code: divisions by zero give infinity, threads run side by side.
OPTIONS: dict[str, Any] = {"nopython": True, "error_model": "numpy", "nogil": True}


def source_hash(room: str, package: Path = _PACKAGE) -> str:
    """Hash of the sources that a room's drivers are made of."""
    digest = hashlib.sha256()
    rooms = COMPILED_TOGETHER[room]
    sources = [path for each in rooms for path in package.glob(f"{each}/*.py")]
    for path in sorted([*sources, *(package / name for name in SHARED_SOURCES)]):
        digest.update(f"\0{path.relative_to(package).as_posix()}\0".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def cache_directory(room: str) -> Path | None:
    """A writable place for a room's compiled drivers, or None: each process then compiles anew.

    It is in NUMBA_CACHE_DIR if that is set, otherwise in the user's cache folder. What lies there
    is executed, so a folder into which others may write will not do.
    """
    root = Path(config.CACHE_DIR) if config.CACHE_DIR else user_cache_path("shaketable")
    directory = root / f"{room}-{source_hash(room)}"
    try:
        _make_private(directory)
        others = writable_by_others(directory)
        if others is not None:
            log.warning(
                "%s: others may write there, so that no compiled code is kept in %s and each run "
                "compiles anew: chmod go-w, or set NUMBA_CACHE_DIR to a folder of your own",
                others,
                root,
            )
            return None
        with tempfile.TemporaryFile(dir=directory):
            return directory
    except OSError:
        return None


def _make_private(directory: Path) -> None:
    """Make a folder, with those above it that are missing, for its owner alone."""
    if directory.is_dir():
        return
    _make_private(directory.parent)
    directory.mkdir(mode=0o700, exist_ok=True)


def writable_by_others(directory: Path) -> Path | None:
    """The folder itself, or one above it, into which others than the user and root may write.

    None if there is none. Above it one with the sticky bit, as the temporary one has it, will do:
    what lies in it is its owner's alone.
    """
    if not hasattr(os, "getuid"):  # Windows keeps users' folders apart
        return None
    place = directory.resolve()
    for each in (place, *place.parents):
        status = each.stat()
        if status.st_uid not in (0, os.getuid()):
            return each
        kept = each != place and status.st_mode & stat.S_ISVTX
        if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH) and not kept:
            return each
    return None


def kernel(function: Callable[P, R]) -> Callable[P, R]:
    """A scalar function, always inlined into its caller, so that loops over it vectorise."""
    return _inner(function, forceinline=True, _nrt=False)


def routine(function: Callable[P, R]) -> Callable[P, R]:
    """A compiled function that is called, not inlined: for rare paths that are too large for it."""
    return _inner(function, forceinline=False, _nrt=False)


def driver_part(function: Callable[P, R]) -> Callable[P, R]:
    """What drivers share and is inlined into each; it alone may make or return arrays."""
    return _inner(function, forceinline=True, _nrt=True)


def _inner(function: Callable[P, R], **options: bool) -> Callable[P, R]:
    if linking is None:
        return cast("Callable[P, R]", jit(**{**OPTIONS, **options, "_nrt": True})(function))
    if config.DISABLE_JIT:
        return function
    compiled = linking.InnerFunction(function, targetoptions={**OPTIONS, **options})
    return cast("Callable[P, R]", compiled)


class CheckedCache(FunctionCache):
    """Numba's disk cache of one driver, with a checksum beside each of its files.

    What Numba reads there it executes: a file that is not as it was written would end the run, or
    the interpreter. Such files are thrown away, and the driver is compiled anew. A cache that
    cannot be read or written is done without.
    """

    def load_overload(self, *arguments: Any) -> Any:
        try:
            for path in self.files():
                if not _is_whole(path):
                    log.info("%s: damaged, compiled anew", path)
                    for file in self.files():
                        file.unlink()
                    return None
            return super().load_overload(*arguments)  # type: ignore[no-untyped-call]
        except OSError as error:
            log.info("compiled code cannot be read (%s), compiled anew", error)
            return None

    def save_overload(self, *arguments: Any) -> None:
        try:
            super().save_overload(*arguments)  # type: ignore[no-untyped-call]
            for path in self.files():
                _sum_of(path).write_text(_digest(path), encoding="ascii")
        except OSError as error:  # a full disk
            log.info("compiled code is not kept (%s)", error)

    def files(self) -> list[Path]:
        """The driver's index and its machine code."""
        return sorted(
            Path(self.cache_path).glob(f"{glob.escape(self._impl.filename_base)}.*nb[ic]")
        )


def _sum_of(path: Path) -> Path:
    return path.with_name(f"{path.name}.sha256")


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _is_whole(path: Path) -> bool:
    try:
        return _sum_of(path).read_bytes() == _digest(path).encode("ascii")
    except FileNotFoundError:
        return False


def driver(function: Callable[P, R]) -> Callable[P, R]:
    """A compiled loop around kernels, entered from Python and cached on disk.

    It writes what it finds into arrays: an interrupt (Ctrl-C) that arrives while Numba turns a
    returned tuple into Python objects would end the interpreter.
    """
    how = {"pipeline_class": linking.DriverCompiler} if linking else {}
    compiled: Any = jit(**OPTIONS, **how)(function)
    directory = cache_directory(Path(function.__code__.co_filename).parent.name)
    if directory is not None and hasattr(compiled, "enable_caching"):  # plain without a compiler
        before = config.CACHE_DIR
        config.CACHE_DIR = str(directory)  # numba reads it while it sets up the cache
        try:
            compiled._cache = CheckedCache(function)  # type: ignore[no-untyped-call]
        finally:
            config.CACHE_DIR = before
    return cast("Callable[P, R]", compiled)


def may_be_kept(compiled: object) -> bool:
    """Whether a driver's machine code has a place on disk."""
    return isinstance(getattr(compiled, "_cache", None), CheckedCache)


def is_kept(compiled: object) -> bool:
    """Whether some of a driver's machine code is on disk."""
    cache = getattr(compiled, "_cache", None)
    return isinstance(cache, CheckedCache) and bool(cache.files())
