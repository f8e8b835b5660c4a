"""How kernels are compiled, and a disk cache that always equals the source.

Numba's disk cache notices an edit in the file of the function that was called, not in the
files of the functions that this one calls. The cache directory is therefore named after a
hash of every source that holds compiled code: an edit anywhere opens a new, empty directory.
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

_PACKAGE = Path(__file__).resolve().parent.parent


def source_hash(package: Path = _PACKAGE) -> str:
    """Hash of what compiled code is made of: `kernels`, `engine` and the constants of `units`."""
    digest = hashlib.sha256()
    sources = [*package.glob("kernels/*.py"), *package.glob("engine/*.py"), package / "units.py"]
    for path in sorted(sources):
        digest.update(f"\0{path.relative_to(package).as_posix()}\0".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def cache_directory() -> Path | None:
    """A writable place for compiled kernels, or None: then each process compiles anew.

    NUMBA_CACHE_DIR if it is set, otherwise the user's cache folder. What lies there is run: a
    folder that others may write to, such as the temporary one, would not do.
    """
    root = Path(config.CACHE_DIR) if config.CACHE_DIR else user_cache_path("shaketable")
    directory = root / f"kernels-{source_hash()}"
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
    """A compiled function that is called as it is: the rare paths, too large to inline."""
    compiled = numba.njit(error_model="numpy", nogil=True)(function)
    return cast("Callable[P, R]", compiled)


def driver(function: Callable[P, R]) -> Callable[P, R]:
    """A compiled loop around kernels, entered from Python and cached on disk."""
    directory = cache_directory()
    before = config.CACHE_DIR
    config.CACHE_DIR = str(directory or "")  # numba reads it while it decorates
    try:
        compiled = numba.njit(error_model="numpy", nogil=True, cache=directory is not None)(
            function
        )
    finally:
        config.CACHE_DIR = before
    return cast("Callable[P, R]", compiled)
