"""Machine code of a GPU's kernels on disk: those of the general model compile for minutes.

It is of one kind of device, toolkit and version of Numba's CUDA; another one compiles anew, beside
it. This builds on parts of Numba's CUDA that it does not promise to keep: where the import of this
module fails, each process compiles.
"""
# mypy: allow-untyped-calls, allow-subclassing-any, disable-error-code="import-untyped"

from __future__ import annotations

from typing import Any

from numba.cuda.core.caching import _CacheLocator
from numba.cuda.dispatcher import CUDACache, CUDACacheImpl

from shaketable.compiled.caches import Checked
from shaketable.compiled.places import cache_directory
from shaketable.compiled.sources import folder_of


class _Place(_CacheLocator):
    """The folder of a kernel, named after all sources that it is made of."""

    def __init__(self, function: Any) -> None:
        self._function = function

    def get_cache_path(self) -> str:
        return str(cache_directory(folder_of(self._function)))

    def get_source_stamp(self) -> str:
        return folder_of(self._function)

    def get_disambiguator(self) -> str:
        return str(self._function.__code__.co_firstlineno)

    @classmethod
    def from_function(cls, py_func: Any, py_file: object) -> _Place:
        return cls(py_func)


class _DeviceCode(CUDACacheImpl):
    _locator_classes = (_Place,)


class DeviceCache(Checked, CUDACache):
    """The machine code of one kernel."""

    _impl_class = _DeviceCode


def device_cache_of(function: Any) -> DeviceCache | None:
    """The cache of a kernel, or None where there is no folder for it."""
    return DeviceCache(function) if cache_directory(folder_of(function)) else None
