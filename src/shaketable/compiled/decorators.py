"""What is compiled, and in which way: kernels, routines, what drivers share, and drivers."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar, cast

import numba
import numba.core.config

from shaketable.compiled.caches import cache_of

log = logging.getLogger(__name__)

linking: Any
try:
    from shaketable.compiled import linking
except ImportError as error:
    log.info("%s: compiling takes several times as long", error)
    linking = None

config: Any = numba.core.config
jit: Any = numba.jit

P = ParamSpec("P")
R = TypeVar("R")

#: For all compiled code: divisions by zero give infinity, threads run side by side.
OPTIONS: dict[str, Any] = {"nopython": True, "error_model": "numpy", "nogil": True}


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


def driver(function: Callable[P, R]) -> Callable[P, R]:
    """A compiled loop around kernels, entered from Python and cached on disk.

    It writes what it finds into arrays: an interrupt (Ctrl-C) that arrives while Numba turns a
    returned tuple into Python objects would end the interpreter.
    """
    how = {"pipeline_class": linking.DriverCompiler} if linking else {}
    compiled: Any = jit(**OPTIONS, **how)(function)
    if hasattr(compiled, "enable_caching"):  # plain without a compiler
        compiled._cache = cache_of(function)
    return cast("Callable[P, R]", compiled)
