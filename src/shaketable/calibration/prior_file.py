"""Priors in tables: a row for each parameter."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

from shaketable.calibration.prior import PARAMETERS, UNIFORM, Prior, Range
from shaketable.errors import Fault, InputError, quoted, refusal, refused
from shaketable.inputs import number_of
from shaketable.tables import read_sheet, with_a_point

COLUMNS = ("parameter", "low", "high", "distribution")


def read_prior(path: str | Path, base: Prior | None = None) -> Prior:
    """Read a prior from a table; parameters that it does not name keep their ranges.

    Args:
        path: of a table with the columns parameter, low, high and distribution (uniform or
            log-uniform; uniform where it is empty); parameters are those of PARAMETERS, in SI.
        base: the ranges of what it does not name; the usual ones by default.

    Raises:
        InputError: lists the faults of the table, with the line of each.
    """
    path = Path(path)
    sheet = read_sheet(path, "Prior", lambda texts: set(COLUMNS[:3]) <= {t.lower() for t in texts})
    filled = list(sheet.filled())
    header = [cell.text.lower() for cell in filled[0]] if filled else []
    accepted = f"accepted columns: {', '.join(COLUMNS)}; parameters: {', '.join(PARAMETERS)}"
    if set(header) - {*COLUMNS, ""} or not set(COLUMNS[:3]) <= set(header):
        raise refused(path, f"found the columns {', '.join(header) or 'none'}; {accepted}")
    found: dict[str, Range] = {}
    faults = []
    for row in filled[1:]:
        cells = {name: cell for name, cell in zip(header, row, strict=False) if name}
        texts = {name: cell.text for name, cell in cells.items()}
        parameter = texts.get("parameter", "").lower()
        if parameter not in PARAMETERS or parameter in found:
            said = "named twice" if parameter in found else f"unknown: {quoted(parameter)}"
            faults.append(sheet.fault(row[0], "parameter", f"{said}; {accepted}", "parameter"))
            continue
        ends = []
        for end in ("low", "high"):
            text = texts.get(end, "")
            if end in cells and not cells[end].typed:
                text, message = with_a_point(sheet, text)
                faults += [sheet.fault(cells[end], "number", message, end)] if message else []
            number = number_of(text)
            if math.isnan(number):
                faults.append(
                    sheet.fault(row[0], "number", f"expected a number, found {quoted(text)}", end)
                )
            else:
                ends.append(number)
        if len(ends) == 2:
            try:
                kind = texts.get("distribution", "").lower() or UNIFORM
                found[parameter] = Range(ends[0], ends[1], kind)
            except InputError as error:
                faults.append(sheet.fault(row[0], "range", str(error), parameter))
    if not faults:
        try:
            return replace(base or Prior(), **found)
        except InputError as error:
            faults.append(Fault(path, "", "", "prior", str(error)))
    raise refusal(faults)
