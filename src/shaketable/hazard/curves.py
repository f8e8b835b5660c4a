"""The hazard curves of a file, before one of them is taken."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import quoted, refusal, refused
from shaketable.signal import Measure
from shaketable.tables import Cell, Sheet, with_a_point
from shaketable.units import STANDARD_GRAVITY

#: Units of levels, with the SI unit that they are of and their factor; ShakeMap's old words too.
UNITS = {
    "g": ("m/s2", STANDARD_GRAVITY), "%g": ("m/s2", STANDARD_GRAVITY / 100.0),
    "pctg": ("m/s2", STANDARD_GRAVITY / 100.0), "m/s2": ("m/s2", 1.0), "m/s²": ("m/s2", 1.0),
    "cm/s2": ("m/s2", 0.01), "gal": ("m/s2", 0.01), "m/s": ("m/s", 1.0), "cm/s": ("m/s", 0.01),
    "cms": ("m/s", 0.01), "m": ("m", 1.0), "cm": ("m", 0.01),
}  # fmt: skip
USUAL = "usual"  # the unit in which hazard tools write a measure: g, cm/s, cm


class Curves(NamedTuple):
    """The curves of a file, of one measure.

    Attributes:
        measure: its name, "" if the file does not say.
        unit: of the levels, "" if the file does not say; or USUAL.
        levels: as in the file, (n,).
        rates: of exceedance [1/year], (curve, n); infinite where the file tells none.
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
        raise refusal([sheet.fault(cell, "number", told, header)])
    return found


def numbers(
    sheet: Sheet, row: list[Cell], headers: list[str], at: Sequence[int] | None = None
) -> list[float]:
    """The numbers of a row, or of some of its cells.

    Raises:
        InputError: another number of cells than headers, or what `number` says.
    """
    if len(row) != len(headers):
        text = f"has {len(row)} cells, the header has {len(headers)}"
        raise refusal([sheet.fault(row[0], "more cells", text)])
    wanted = range(len(row)) if at is None else at
    return [number(sheet, row[k], headers[k]) for k in wanted]


def factor_of(path: Path, what: str, unit: str, measure: Measure) -> float:
    """From a unit of a measure to SI.

    Raises:
        InputError: no unit of this measure.
    """
    if unit not in UNITS or UNITS[unit][0] != measure.unit:
        fit = [name for name, (kind, _) in UNITS.items() if kind == measure.unit]
        raise refused(path, f"the unit {unit!r} is not one of {what}; accepted: {', '.join(fit)}")
    return UNITS[unit][1]
