"""A hazard curve as a table of two columns: level, annual rate of exceedance.

PGV [cm/s], annual rate
5, 0.12
10, 0.041

A probability p of exceedance in T years is a rate of -ln(1 - p)/T, if exceedances are a Poisson
process: T stands in the header, as in "PE in 50 years", or is given.
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.errors import InputError, refused
from shaketable.hazard.curves import Curves, numbers
from shaketable.tables import Sheet

_RATE = re.compile(r"\brates?\b|frequen|1\s*/\s*(yr|year|a)\b|lambda|λ", re.IGNORECASE)
_PROBABILITY = re.compile(r"\bp\s*o?\s*e(?![a-z])|prob", re.IGNORECASE)
_CHANCE = re.compile(rf"{_PROBABILITY.pattern}|exceed|%", re.IGNORECASE)
_EACH_YEAR = re.compile(r"annual|yearly|(per|in a|each)\s+(year|annum)", re.IGNORECASE)
_YEARS = re.compile(r"(\d+(?:\.\d+)?)\s*-?\s*(?:years?|yrs?|a)\b|\bpo?e\s*_?(\d+)", re.IGNORECASE)
_HEADED = re.compile(r"(?P<name>[A-Za-z]+(?:\([\d.]+\))?)\s*[\[(]\s*(?P<unit>[^\])]+?)\s*[\])]")


def read(sheet: Sheet, exposure: float | None = None) -> Curves:
    """The curve; its measure and unit where the header has them, as "PGV [cm/s]".

    Args:
        sheet: the table.
        exposure: years in which its probabilities are, where the header does not say it.

    Raises:
        InputError: other columns, a header that says neither a rate nor a probability in some
            years, values that are none, or no rows.
    """
    rows = list(sheet.filled())
    if not rows or any(len(row) != 2 for row in rows):
        wrong = next((row for row in rows if len(row) != 2), None)
        raise refused(
            sheet.path,
            "not a hazard curve as OpenQuake or the USGS write it, and not a table of two columns, "
            "the level and the annual rate of exceedance",
            where=wrong[0].where if wrong else "",
        )
    names = [cell.text for cell in rows[0]]
    try:
        numbers(sheet, rows[0], ["", ""])
    except InputError:
        rows = rows[1:]  # a header
    else:
        names = ["level", ""]
    years = _years(sheet, names[1], exposure)
    values = np.array([numbers(sheet, row, names) for row in rows]).reshape(-1, 2)
    if years is not None:
        chance = values[:, 1] / (100.0 if "%" in names[1] else 1.0)
        if not ((chance >= 0.0) & (chance <= 1.0)).all():
            raise refused(
                sheet.path,
                f"{names[1]!r} is taken as a probability in {years:g} years, and "
                f"goes from {chance.min():g} to {chance.max():g}; it must lie in 0 to 1",
            )
        with np.errstate(divide="ignore"):
            values[:, 1] = -np.log1p(-chance) / years
    told = _HEADED.fullmatch(names[0])
    measure, unit = (told["name"], told["unit"]) if told else ("", "")
    return Curves(measure, unit, values[:, 0], values[None, :, 1], np.zeros((0, 2)))


def _years(sheet: Sheet, header: str, exposure: float | None) -> float | None:
    """In how many years the second column is a probability; None where it is an annual rate.

    Raises:
        InputError: the header says neither or both, or a rate beside an exposure.
    """
    rate = bool(_RATE.search(header))
    chance = bool(_CHANCE.search(header))
    in_years = _YEARS.search(header)
    mixed = rate and (in_years or _PROBABILITY.search(header) or "%" in header)
    if rate and not mixed and exposure is not None:
        raise refused(sheet.path, f"the second column is {header!r}, a rate, which needs no years")
    if rate and not mixed:
        return None
    if not mixed and exposure is not None:
        return exposure
    if not mixed and chance and in_years:
        return float(in_years[1] or in_years[2])
    if not mixed and _PROBABILITY.search(header) and _EACH_YEAR.search(header):
        return 1.0
    said = f"is {header!r}" if header else "has no header"
    raise refused(
        sheet.path,
        f"the second column {said}, which does not say whether it is an annual "
        "rate (call it 'annual rate'), or a probability and in how many years: write 'PE in 50 "
        "years', or 'PE' and give exposure= (--exposure-years)",
    )
