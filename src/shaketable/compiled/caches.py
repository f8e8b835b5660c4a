"""Machine code on disk: what this user's runs have compiled, and what came with the package.

A wheel for one platform may hold the code of all drivers for processors of level x86-64-v3 (x86-64
psABI: those of Intel since 2013 and of AMD since 2015). It is used where Python, Numba, the sources
and the processor fit; elsewhere a driver is compiled as without it. It is trusted as the package's
own files are, and never written to where it is installed: `scripts/compile_wheel.py` makes it.
"""
# mypy: allow-untyped-calls, disable-error-code="assignment"

from __future__ import annotations

import glob
import hashlib
import logging
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numba.core.config
from llvmlite import binding
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    _CacheLocator,
)

from shaketable.compiled.places import cache_directory
from shaketable.compiled.sources import PACKAGE, folder_of

log = logging.getLogger(__name__)

config: Any = numba.core.config

SHIPPED = PACKAGE / "machine_code"
LEVEL = "x86-64-v3"
FEATURES = {
    "avx", "avx2", "bmi", "bmi2", "cx16", "f16c", "fma", "lzcnt", "movbe", "popcnt", "sahf", "sse3",
    "sse4.1", "sse4.2", "ssse3", "xsave",
}  # fmt: skip


class Checked:
    """A disk cache of one driver by Numba, with a checksum beside each of its files.

    What Numba reads there it executes: a file that is not as it was written would end the run, or
    the interpreter. A cache that cannot be read or written is done without.
    """

    cache_path: Any
    _impl: Any

    def load_overload(self, *arguments: Any) -> Any:
        try:
            for path in self.files():
                if not _is_whole(path):
                    log.info("%s: damaged, compiled anew", path)
                    self.discard()
                    return None
            return super().load_overload(*arguments)  # type: ignore[misc]
        except OSError as error:
            log.info("compiled code cannot be read (%s), compiled anew", error)
            return None

    def save_overload(self, *arguments: Any) -> None:
        try:
            super().save_overload(*arguments)  # type: ignore[misc]
            self.add_sums()
        except OSError as error:  # a full disk
            log.info("compiled code is not kept (%s)", error)

    def add_sums(self) -> None:
        """Write the checksum of each file beside it."""
        for path in self.files():
            _sum_of(path).write_text(_digest(path), encoding="ascii")

    def files(self) -> list[Path]:
        """The driver's index and its machine code."""
        return sorted(
            Path(self.cache_path).glob(f"{glob.escape(self._impl.filename_base)}.*nb[ic]")
        )

    def discard(self) -> None:
        """Throw damaged files away."""
        for file in self.files():
            file.unlink()


class CheckedCache(Checked, FunctionCache):
    """A Checked cache of what a processor runs."""


class _ShippedPlace(_CacheLocator):
    """Where the package holds a driver's machine code."""

    def __init__(self, function: Any) -> None:
        self._function = function

    def get_cache_path(self) -> str:
        return str(SHIPPED / folder_of(self._function))

    def get_source_stamp(self) -> str:
        return folder_of(self._function)

    def get_disambiguator(self) -> str:
        return str(self._function.__code__.co_firstlineno)

    @classmethod
    def from_function(cls, py_func: Any, py_file: object) -> _ShippedPlace:
        return cls(py_func)


class _ShippedCode(CompileResultCacheImpl):
    _locator_classes = (_ShippedPlace,)


class ShippedCache(CheckedCache):
    """The machine code of one driver that came with the package."""

    _impl_class = _ShippedCode

    def load_overload(self, *arguments: Any) -> Any:
        return super().load_overload(*arguments) if fits_here() else None

    def save_overload(self, *arguments: Any) -> None:
        """What is compiled here is not written into the package."""

    def take(self, kept: KeptCache, folder: Path) -> list[Path]:
        """Write what was compiled here, for LEVEL, into a folder to be shipped; the files."""
        place = folder / Path(self.cache_path).name
        place.mkdir(parents=True, exist_ok=True)
        self._cache_path = str(place)
        self._cache_file = IndexDataCacheFile(
            self._cache_path, self._impl.filename_base, self._impl.locator.get_source_stamp()
        )
        for key in kept._cache_file._load_index():
            self._cache_file.save(key, kept._cache_file.load(key))
        self.add_sums()
        return self.files()

    def discard(self) -> None:
        """What is the package's own is left as it is."""

    def holds(self) -> bool:
        return fits_here() and bool(self.files())

    def _index_key(self, signature: object, codegen: Any) -> tuple[object, ...]:
        key = super()._index_key(signature, codegen)
        return key[0], (codegen.magic_tuple()[0], LEVEL, ""), key[2]


class KeptCache(CheckedCache):
    """The machine code of one driver: what came with the package, or what was compiled here."""

    def __init__(self, function: Callable[..., object], directory: Path) -> None:
        before = config.CACHE_DIR
        config.CACHE_DIR = str(directory)  # numba reads it while it sets up the cache
        try:
            super().__init__(function)
        finally:
            config.CACHE_DIR = before
        self._shipped = ShippedCache(function)

    def load_overload(self, *arguments: Any) -> Any:
        shipped = self._shipped.load_overload(*arguments)
        return super().load_overload(*arguments) if shipped is None else shipped

    def holds(self) -> bool:
        return self._shipped.holds() or bool(self.files())


def cache_of(function: Callable[..., object]) -> ShippedCache | KeptCache:
    """The cache of a driver."""
    directory = cache_directory(folder_of(function))
    return ShippedCache(function) if directory is None else KeptCache(function, directory)


@cache
def fits_here() -> bool:
    """Whether this processor executes what is shipped, and nobody has asked for another."""
    if config.CPU_NAME is not None or config.CPU_FEATURES is not None:
        return False
    try:
        there = binding.get_host_cpu_features()
    except RuntimeError:  # it cannot be told
        return False
    return binding.get_process_triple().startswith("x86_64") and all(map(there.get, FEATURES))


def may_be_kept(compiled: object) -> bool:
    """Whether a driver's machine code has a place on disk."""
    return isinstance(getattr(compiled, "_cache", None), KeptCache)


def is_kept(compiled: object) -> bool:
    """Whether some of a driver's machine code is on disk."""
    cache = getattr(compiled, "_cache", None)
    return isinstance(cache, ShippedCache | KeptCache) and cache.holds()


def _sum_of(path: Path) -> Path:
    return path.with_name(f"{path.name}.sha256")


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _is_whole(path: Path) -> bool:
    try:
        return _sum_of(path).read_bytes() == _digest(path).encode("ascii")
    except FileNotFoundError:
        return False
