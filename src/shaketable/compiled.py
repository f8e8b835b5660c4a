"""How kernels are compiled, and a disk cache that always equals the source.

Numba's disk cache notices an edit in the file of the function that was called, but not in the
files of the functions that it calls. The cache directory is therefore named after a hash of every
source that the compiled code may be made of: an edit in any of them opens a new, empty directory.
The rooms in one entry of `COMPILED_TOGETHER` share a hash; an edit in the room of the oscillators
does not compile the contact kernels anew.
"""

from __future__ import annotations

import hashlib
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, ParamSpec, TypeVar, cast

import numba
import numba.core.config
from platformdirs import user_cache_path

config: Any = numba.core.config

P = ParamSpec("P")
R = TypeVar("R")

_PACKAGE = Path(__file__).resolve().parent

#: Rooms that hold compiled code, grouped by what is compiled together.
COMPILED_TOGETHER = {
    "engine": ("kernels", "engine"),
    "oscillators": ("oscillators",),
}
SHARED_SOURCES = ("compiled.py", "units.py")  # decorators and constants


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
    is executed, so a folder that others may write to, such as the temporary one, will not do.
    """
    root = Path(config.CACHE_DIR) if config.CACHE_DIR else user_cache_path("shaketable")
    directory = root / f"{room}-{source_hash(room)}"
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=directory):
            return directory
    except OSError:
        return None


def kernel(function: Callable[P, R]) -> Callable[P, R]:
    """A scalar function, always inlined into its caller, so that loops over it vectorise."""
    compiled = numba.njit(error_model="numpy", nogil=True, forceinline=True)(function)
    return cast("Callable[P, R]", compiled)


def routine(function: Callable[P, R]) -> Callable[P, R]:
    """A compiled function that is called, not inlined: for rare paths that are too large for it."""
    compiled = numba.njit(error_model="numpy", nogil=True)(function)
    return cast("Callable[P, R]", compiled)


def driver(function: Callable[P, R]) -> Callable[P, R]:
    """A compiled loop around kernels, entered from Python and cached on disk.

    It writes what it finds into arrays: an interrupt (Ctrl-C) that arrives while Numba turns a
    returned tuple into Python objects would end the interpreter.
    """
    directory = cache_directory(Path(function.__code__.co_filename).parent.name)
    before = config.CACHE_DIR
    config.CACHE_DIR = str(directory or "")  # numba reads it while it decorates
    try:
        compiled = numba.njit(error_model="numpy", nogil=True, cache=directory is not None)(
            function
        )
    finally:
        config.CACHE_DIR = before
    return cast("Callable[P, R]", compiled)
