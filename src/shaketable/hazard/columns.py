"""A hazard curve as a table of two columns: level, annual rate of exceedance.

PGV [cm/s], annual rate
5, 0.12
10, 0.041
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.errors import InputError
from shaketable.hazard.curves import Curves, numbers
from shaketable.tables import Sheet

_HEADED = re.compile(r"(?P<name>[A-Za-z]+(?:\([\d.]+\))?)\s*[\[(]\s*(?P<unit>[^\])]+?)\s*[\])]")


def read(sheet: Sheet) -> Curves:
    """The curve; its measure and unit where the header has them, as "PGV [cm/s]".

    Raises:
        InputError: other columns, percents, or no rows.
    """
    rows = list(sheet.filled())
    if not rows or any(len(row) != 2 for row in rows):
        wrong = next((row for row in rows if len(row) != 2), None)
        where = f", {wrong[0].where}" if wrong else ""
        raise InputError(
            f"{sheet.path}{where}: not a hazard curve as OpenQuake or the USGS write it, and not "
            "a table of two columns, the level and the annual rate of exceedance"
        )
    names = [cell.text for cell in rows[0]]
    try:
        numbers(sheet, rows[0], ["", ""])
    except InputError:
        rows = rows[1:]  # a header
    else:
        names = ["level", "annual rate"]
    if "%" in names[1] or "poe" in names[1].lower() or "prob" in names[1].lower():
        raise InputError(
            f"{sheet.path}: the second column is {names[1]!r}, but annual rates of exceedance "
            "are needed: a probability p in T years is a rate of -ln(1 - p)/T"
        )
    values = np.array([numbers(sheet, row, names) for row in rows]).reshape(-1, 2)
    told = _HEADED.fullmatch(names[0])
    measure, unit = (told["name"], told["unit"]) if told else ("", "")
    return Curves(measure, unit, values[:, 0], values[None, :, 1], np.zeros((0, 2)))
