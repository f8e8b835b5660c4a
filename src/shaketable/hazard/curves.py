"""The hazard curves of a file, before one of them is taken."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, quoted
from shaketable.tables import Cell, Sheet, with_a_point

USUAL = "usual"  # the unit in which hazard tools write a measure: g, cm/s, cm


class Curves(NamedTuple):
    """The curves of a file, of one measure.

    Attributes:
        measure: its name, "" if the file does not say.
        unit: of the levels, "" if the file does not say; or USUAL.
        levels: as in the file, (n,).
        rates: of exceedance [1/year], (curve, n).
        sites: longitude and latitude of each [degrees], (curve, 2); none if it has no places.
    """

    measure: str
    unit: str
    levels: NDArray[np.float64]
    rates: NDArray[np.float64]
    sites: NDArray[np.float64]


def number(sheet: Sheet, cell: Cell, header: str) -> float:
    """The number of a cell.

    Raises:
        InputError: none, or one that is not finite.
    """
    text, wrong = with_a_point(sheet, cell.text)
    try:
        found = math.nan if wrong else float(text)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        told = wrong or f"expected a number, found {quoted(cell.text)}"
        raise InputError(sheet.fault(cell, told, header))
    return found


def numbers(sheet: Sheet, row: list[Cell], headers: list[str]) -> list[float]:
    """The numbers of a whole row.

    Raises:
        InputError: another number of cells than headers, or what `number` says.
    """
    if len(row) != len(headers):
        raise InputError(
            sheet.fault(row[0], f"has {len(row)} cells, the header has {len(headers)}")
        )
    return [number(sheet, cell, header) for cell, header in zip(row, headers, strict=True)]
