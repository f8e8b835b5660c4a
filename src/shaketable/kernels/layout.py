"""How a NamedTuple of numbers lies in a row of a table, so that nobody counts columns.

Compiled code reads a row of floats by the columns of its NamedTuple, `columns(Side).keep`; Python
code sees the same memory as a structured array, `named(table, Side)["keep"]`. Records themselves
are of no use in compiled code: Numba cannot unpack one into a NamedTuple, nor lay them out field
after field, as vector lanes need.
"""

from __future__ import annotations

from typing import Any, get_type_hints

import numpy as np
from numpy.typing import NDArray

#: A NamedTuple that holds each number's place instead of the number.
Columns = Any


def _nested(kind: type[Any]) -> dict[str, type[Any] | None]:
    """Fields of a NamedTuple, each with its type if that is a NamedTuple, or None for a number."""
    hints = get_type_hints(kind)
    return {name: hints[name] if hasattr(hints[name], "_fields") else None for name in kind._fields}


def length(kind: type[Any]) -> int:
    """How many numbers a NamedTuple holds, including those of the NamedTuples in it."""
    return sum(length(inner) if inner else 1 for inner in _nested(kind).values())


def columns(kind: type[Any], first: int = 0, step: int = 1) -> Columns:
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


def row_type(kind: type[Any]) -> np.dtype[Any]:
    """The structured type of a row: a float64 for every number."""
    return np.dtype(
        [(name, row_type(inner) if inner else np.float64) for name, inner in _nested(kind).items()]
    )


def named(table: NDArray[np.float64], kind: type[Any]) -> NDArray[Any]:
    """The same memory with names: (..., n) floats as (...) records.

    Args:
        table: contiguous, its last axis the numbers of `kind`.
    """
    return table.view(row_type(kind))[..., 0]
