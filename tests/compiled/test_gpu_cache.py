"""Machine code of a GPU's kernels on disk; a device is pretended, which none is compiled for."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest


class Codegen:
    """Of a device and a toolkit."""

    def __init__(self, capability: tuple[int, int]) -> None:
        self.capability = capability

    def magic_tuple(self) -> tuple[object, ...]:
        return ((13, 0), self.capability)


def context(capability: tuple[int, int]) -> Any:
    return SimpleNamespace(refresh=lambda: None, codegen=lambda: Codegen(capability))


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    from numba.cuda import dispatcher

    from shaketable.compiled import gpu_cache

    def rock_member() -> None: ...

    monkeypatch.setattr(gpu_cache, "cache_directory", lambda name: tmp_path / name)
    monkeypatch.setattr(gpu_cache, "folder_of", lambda function: "engine-0123")
    monkeypatch.setattr(dispatcher._Kernel, "_rebuild", staticmethod(lambda **payload: payload))
    return gpu_cache.device_cache_of(rock_member)


def test_what_was_compiled_for_a_device_is_found_again(cache: Any) -> None:
    """It is that of the same kind of device alone."""
    kernel = SimpleNamespace(
        codegen=Codegen((9, 0)), _reduce_states=lambda: {"cubin": b"machine code"}
    )
    assert cache.load_overload("signature", context((9, 0))) is None
    cache.save_overload("signature", kernel)
    assert cache.load_overload("signature", context((9, 0))) == {"cubin": b"machine code"}
    assert cache.load_overload("signature", context((8, 0))) is None
    assert cache.load_overload("another", context((9, 0))) is None


def test_damaged_machine_code_is_not_run(cache: Any) -> None:
    kernel = SimpleNamespace(
        codegen=Codegen((9, 0)), _reduce_states=lambda: {"cubin": b"machine code"}
    )
    cache.save_overload("signature", kernel)
    (code,) = Path(cache.cache_path).glob("*.nbc")
    code.write_bytes(code.read_bytes().replace(b"machine", b"another"))
    assert cache.load_overload("signature", context((9, 0))) is None
    assert not cache.files()  # and is thrown away


def test_kernels_are_kept_where_their_sources_say() -> None:
    from shaketable.compiled.places import cache_directory
    from shaketable.compiled.sources import folder_of
    from shaketable.engine import cuda_kernels

    for kernel in (cuda_kernels.rock_members, cuda_kernels.move_members):
        place = folder_of(kernel.py_func)
        assert kernel._cache.cache_path == str(cache_directory(place))
