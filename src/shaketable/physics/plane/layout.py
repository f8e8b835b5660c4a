"""How a NamedTuple of numbers lies in a row of a table, so that nobody counts columns.

Compiled code reads a row of floats by the columns of its NamedTuple,
`columns(Side).velocity_ratio`; Python code sees the same memory as a structured array,
`struct_view(table, Side)["velocity_ratio"]`. Records themselves are of no use in compiled code:
Numba cannot unpack one into a NamedTuple, nor lay them out field after field, as vector lanes need.
"""

from __future__ import annotations

from functools import cache
from typing import Any, get_type_hints

import numpy as np
from numpy.typing import NDArray

#: A NamedTuple of numbers and of NamedTuples of numbers, the class itself; to type checkers a
#: type[Any] cannot be a key of a cache.
Kind = Any
#: A NamedTuple that holds each number's place instead of the number.
Columns = Any


@cache  # type hints take 30 µs to resolve
def _nested(kind: Kind) -> dict[str, Kind]:
    """Fields of a NamedTuple, each with its type if that is a NamedTuple, or None for a number."""
    hints = get_type_hints(kind)
    return {name: hints[name] if hasattr(hints[name], "_fields") else None for name in kind._fields}


def length(kind: Kind) -> int:
    """How many numbers a NamedTuple holds, including those of the NamedTuples in it."""
    return sum(length(inner) if inner else 1 for inner in _nested(kind).values())


def columns(kind: Kind, first: int = 0, step: int = 1) -> Columns:
    """Where the numbers of a NamedTuple lie.

    Args:
        kind: NamedTuple of numbers and of NamedTuples of numbers.
        first: place of the first number.
        step: distance from one number to the next.
    """
    places: list[Any] = []
    for inner in _nested(kind).values():
        places.append(columns(inner, first, step) if inner else first)
        first += step * (length(inner) if inner else 1)
    return kind(*places)


@cache
def row_type(kind: Kind) -> np.dtype[Any]:
    """The structured type of a row: a float64 for every number."""
    return np.dtype(
        [(name, row_type(inner) if inner else np.float64) for name, inner in _nested(kind).items()]
    )


def struct_view(table: NDArray[np.float64], kind: Kind) -> NDArray[Any]:
    """The same memory with names: (..., n) floats as (...) records.

    Args:
        table: contiguous, its last axis the numbers of `kind`.
    """
    return table.view(row_type(kind))[..., 0]
