"""OpenQuake's hazard curves: probabilities of exceedance in an investigation time.

    #,,,"generated_by='OpenQuake engine 3.26', kind='mean', investigation_time=50.0, imt='PGA'"
    lon,lat,depth,poe-0.0050000,poe-0.0100000,...
    8.50000,47.40000,0.00000,9.9E-01,9.7E-01,...

The rate is -ln(1 - poe)/T. Levels are in g for PGA and spectral accelerations, in cm/s for PGV.
"""

from __future__ import annotations

import re

import numpy as np

from shaketable.errors import refused
from shaketable.hazard.curves import USUAL, Curves, numbers
from shaketable.tables import Sheet

_TOLD = re.compile(r"(\w+)=(?:'([^']*)'|([^,\s\"]+))")
_LEVEL = "poe-"


def recognise(sheet: Sheet) -> bool:
    """Whether the header has probabilities at levels."""
    return any(cell.text.startswith(_LEVEL) for row in sheet.rows[:2] for cell in row)


def read(sheet: Sheet) -> Curves:
    """The curves of all sites.

    Raises:
        InputError: no comment with the measure and the time, or no probabilities of exceedance.
    """
    rows = list(sheet.filled())
    comment = " ".join(cell.text for cell in rows[0]) if rows[0][0].text.startswith("#") else ""
    told = {name: one or other for name, one, other in _TOLD.findall(comment)}
    try:
        years = float(told.get("investigation_time", "nan"))
    except ValueError:
        years = np.nan
    if not years > 0.0 or "imt" not in told:
        raise refused(
            sheet.path,
            "hazard curves of OpenQuake begin with a comment that has "
            "investigation_time= and imt=; it is not there",
        )
    header, body = (rows[1], rows[2:]) if len(rows) > 1 else ([], [])
    names = [cell.text for cell in header]
    at = [k for k, name in enumerate(names) if name.startswith(_LEVEL)]
    if not {"lon", "lat"} <= set(names) or not body:
        raise refused(sheet.path, f"expected columns lon, lat and {_LEVEL}..., and a site")
    try:
        levels = np.array([float(names[k].removeprefix(_LEVEL)) for k in at])
    except ValueError as error:
        raise refused(sheet.path, f"a column {_LEVEL}... has no level ({error})") from None
    place = [names.index("lon"), names.index("lat")]
    values = np.array([numbers(sheet, row, names, (*place, *at)) for row in body])
    poes = values[:, 2:]
    if not ((poes >= 0.0) & (poes <= 1.0)).all():
        wrong = float(poes[(poes < 0.0) | (poes > 1.0)][0])
        raise refused(
            sheet.path, f"probabilities lie between 0 and 1, found {wrong:g}; are these percents?"
        )
    with np.errstate(divide="ignore"):
        rates = -np.log1p(-poes) / years  # infinite where it is certain
    return Curves(told["imt"], USUAL, levels, rates, values[:, :2])
