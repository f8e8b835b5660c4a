"""Inner functions are compiled once, in their driver, and as Numba would have done it."""

from __future__ import annotations

import math
import os
import pickle
import subprocess
import sys
from typing import Any

import numba
import numpy as np
import pytest
from numba.core import errors, event
from numpy.typing import NDArray

from shaketable.compiled import OPTIONS, driver_part, kernel, routine
from shaketable.compiled.decorators import linking

pytestmark = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="nothing is compiled")


@kernel
def doubled(x: float) -> float:
    return 2.0 * x


@routine
def shifted(x: float, by: int) -> float:
    return doubled(x) + by


@kernel
def repeated(x: float, count: int) -> float:
    for _ in range(count):
        x = doubled(x)
    return x


@routine
def halves(values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return values[: values.size // 2], values[values.size // 2 :]


@driver_part
def fresh(count: int) -> NDArray[np.float64]:
    return np.full(count, 0.5)


def as_driver(function: Any) -> Any:
    return numba.jit(**OPTIONS, pipeline_class=linking.DriverCompiler)(function)


def compiled_while(call: Any) -> list[str]:
    """The functions that were compiled meanwhile, each as often as it was."""
    with event.install_recorder("numba:compile") as recorder:
        call()
    return [each.data["dispatcher"].py_func.__name__ for _, each in recorder.buffer if each.is_end]


def test_each_function_is_compiled_once_and_kernels_for_each_constant() -> None:
    def drive(count: int, results: NDArray[np.float64]) -> None:
        results[0] = shifted(1.5, 3)
        results[1] = shifted(1.5, 4)
        results[2] = shifted(1.5, count)
        results[3] = repeated(1.5, 3)
        results[4] = repeated(1.5, 4)

    results = np.zeros(5)
    names = compiled_while(lambda: as_driver(drive)(5, results))
    assert results.tolist() == [6.0, 7.0, 8.0, 12.0, 24.0]
    assert sorted(names) == ["doubled", "drive", "repeated", "repeated", "shifted"]
    assert not shifted.overloads  # type: ignore[attr-defined]  # no wrapper for Python


def test_loops_over_lanes_may_use_the_widest_registers() -> None:
    def drive(results: NDArray[np.float64]) -> None:
        for k in range(results.size):
            results[k] = doubled(results[k])

    driven, results = as_driver(drive), np.ones(16)
    driven(results)
    assert results.tolist() == [2.0] * 16
    assert '"prefer-vector-width"="512"' in driven.inspect_llvm(driven.signatures[0])


def test_inner_functions_are_called_from_python_too() -> None:
    assert shifted(1.0, 2) == 4.0
    assert repeated(1.0, 5) == 32.0
    assert pickle.loads(pickle.dumps(shifted))(1.0, 2) == 4.0


def test_a_caller_that_numba_compiles_by_itself() -> None:
    @numba.njit  # type: ignore[untyped-decorator]
    def plain(x: float) -> Any:
        return shifted(x, 1) + repeated(x, 2)

    assert plain(1.0) == 7.0


def test_arrays_are_made_by_parts_of_drivers_alone() -> None:
    def drive(results: NDArray[np.float64]) -> None:
        results[:] = fresh(results.size)

    results = np.zeros(4)
    for _ in range(3):  # a count of references that is off would free what is in use
        as_driver(drive)(results)
        assert results.tolist() == [0.5] * 4

    def wrong(results: NDArray[np.float64]) -> None:
        results[:1] = halves(results)[1][0]

    with pytest.raises(errors.NumbaError, match="halves returns an array: make it a driver"):
        as_driver(wrong)(results)


def test_exceptions_of_inner_functions_are_told() -> None:
    @routine
    def refuse(x: float) -> float:
        if x < 0.0:
            raise ValueError("negative")
        return math.sqrt(x)

    def drive(x: float, results: NDArray[np.float64]) -> None:
        results[0] = refuse(x)

    driven, results = as_driver(drive), np.zeros(1)
    driven(4.0, results)
    assert results[0] == 2.0
    with pytest.raises(ValueError, match="negative"):
        driven(-4.0, results)


KNOWN = """
import numpy as np
from shaketable.compiled import decorators
from shaketable.engine.body_tables import tabulate_blocks
print(decorators.linking is not None, tabulate_blocks(np.array([[0.2, 0.5, 0.1, 0.3, 1.0]]),
      np.zeros(1), np.nan).tobytes().hex())
"""


def test_another_numba_compiles_in_its_own_way() -> None:
    """The same numbers, from a version that is not known from within."""

    def said(before: str) -> list[str]:
        run = subprocess.run(
            [sys.executable, "-c", before + KNOWN], capture_output=True, text=True, check=True,
            env={**os.environ, "NUMBA_CACHE_DIR": "/dev/null"},
        )  # fmt: skip
        return run.stdout.split()

    known, other = said(""), said("import numba; numba.__version__ = '9.0.0'\n")
    assert (known[0], other[0]) == ("True", "False")
    assert known[1] == other[1]
